"""Other programs read the formats: MuJoCo scenes, `mcap` recordings, and NumPy data."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any, Callable

import numpy as np
import pytest

import pushplan

mujoco = pytest.importorskip("mujoco")
jsonschema = pytest.importorskip("jsonschema")

KITCHEN = "tests/cmd/import.in/kitchen.xml"


def plan(task: pushplan.Task) -> pushplan.Plan:
    push = pushplan.Push((0.3, 0.0), 0.1, 0.1, 0.1)
    return pushplan.Plan.of(task, "stick", [push])


def test_what_mujoco_reads_is_what_is_imported(root: Path) -> None:
    """Sizes, masses and places of a scene, as MuJoCo's own compiler has them."""
    model = mujoco.MjModel.from_xml_path(str(root / KITCHEN))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with pytest.warns(UserWarning, match="`damping` of this joint"):
        task = pushplan.import_task(root / KITCHEN)
    scene: Any = task.to_dict()["scene"]
    bodies = {
        "can": "can",
        "lying-box": "lying box",
        "door": "door",
        "leaf": "leaf",
        "wedge": "wedge",
    }
    assert [thing["name"] for thing in scene["objects"]] == list(bodies)
    for thing in scene["objects"]:
        body = model.body(bodies[thing["name"]])
        # The position of an object is its centre of mass, as in MuJoCo.
        assert data.xipos[body.id][:2] == pytest.approx(thing["position"], abs=1e-9)
        assert body.mass[0] == pytest.approx(thing["mass"], rel=1e-9)
        [geom] = [
            g
            for g in range(model.ngeom)
            if model.geom_bodyid[g] == body.id and model.geom_contype[g]
        ]
        turn = data.geom_xmat[geom].reshape(3, 3)
        if "cuboid" in thing["shape"]:
            ahead = turn @ np.diag(2 * model.geom_size[geom])
            size = thing["shape"]["cuboid"]["size"]
            assert np.sort(np.linalg.norm(ahead, axis=0)) == pytest.approx(np.sort(size), abs=1e-9)
            assert np.abs(ahead[2]).sum() == pytest.approx(size[2], abs=1e-9)
            yaw = math.radians(thing["yaw_deg"])
            along = np.array([math.cos(yaw), math.sin(yaw), 0.0]) @ turn
            assert np.abs(along).max() == pytest.approx(1.0, abs=1e-9)
        elif "cylinder" in thing["shape"]:
            radius, half = model.geom_size[geom][:2]
            assert thing["shape"]["cylinder"] == pytest.approx(
                {"radius": radius, "height": 2 * half}
            )
    [wall] = scene["obstacles"]
    assert data.body("wall").xpos[:2] == pytest.approx(wall["position"])
    assert wall["yaw_deg"] == pytest.approx(30.0) and wall["size"] == pytest.approx(
        [0.02, 0.2, 0.06]
    )
    assert scene["table"]["size"] == pytest.approx([1.0, 0.8])


def test_an_exported_scene_opens_in_mujoco_and_comes_back(
    task: pushplan.Task, tmp_path: Path
) -> None:
    pushplan.export_mjcf(plan(task), tmp_path / "scene.xml")
    assert (tmp_path / "scene.xml").read_text() == plan(task).to_mjcf()
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "scene.xml"))
    with pytest.warns(UserWarning, match="the tool is not imported here"):
        again = pushplan.import_task(tmp_path / "scene.xml")
    assert again.objects == task.objects and again.goal_object == task.goal_object
    assert again.start == pytest.approx(task.start, abs=1e-9)
    for name in again.objects:
        assert model.body(f"object/{name}").mass[0] == pytest.approx(
            next(o["mass"] for o in again.to_dict()["scene"]["objects"] if o["name"] == name)
        )
    assert pushplan.import_tool(tmp_path / "scene.xml").friction == plan(task).tool.friction


def assert_alike(one: Any, other: Any, where: str = "") -> None:
    """The same keys and words, and numbers to MuJoCo's single precision of meshes."""
    if isinstance(one, dict) and isinstance(other, dict):
        assert one.keys() == other.keys(), where
        for key in one:
            assert_alike(one[key], other[key], f"{where}/{key}")
    elif isinstance(one, list) and isinstance(other, list):
        assert len(one) == len(other), where
        for k, pair in enumerate(zip(one, other)):
            assert_alike(*pair, f"{where}/{k}")
    elif isinstance(one, float):
        assert other == pytest.approx(one, abs=1e-7), where
    else:
        assert one == other, where


def test_a_loaded_model_becomes_what_its_file_does(root: Path, task: pushplan.Task) -> None:
    with pytest.warns(UserWarning, match="`damping` of this joint"):
        wanted = pushplan.import_task(root / KITCHEN)
    model = mujoco.MjModel.from_xml_path(str(root / KITCHEN))
    with pytest.warns(UserWarning, match="`damping` of this joint"):
        found = pushplan.scene_from(model, name=wanted.name)
    assert_alike(wanted.to_dict()["scene"], found.to_dict()["scene"])
    # Without a file, and with the goal stored in an exported plan.
    model = mujoco.MjModel.from_xml_string(plan(task).to_mjcf())
    with pytest.warns(UserWarning, match="the tool is not imported here"):
        again = pushplan.scene_from(model)
    assert again.objects == task.objects and again.goal_position == pytest.approx(
        task.goal_position
    )
    assert again.start == pytest.approx(task.start, abs=1e-9)


MOVED = """<mujoco><worldbody><geom type="plane" size="1 1 .1"/>
<body name="can" pos=".5 .1 .05"><freejoint/><geom type="cylinder" size=".04 .05" mass=".4"/></body>
<body name="drawer" pos=".7 0 .03" euler="0 0 90"><joint type="slide" axis="1 0 0" range="-.1 .2"/>
<geom type="box" size=".05 .1 .03" mass="1"/></body>
<body name="door" pos=".6 -.4 .05"><joint type="hinge" axis="0 0 1" pos="-.1 0 0" range="-60 60"/>
<geom type="box" size=".1 .01 .05" mass=".5"/></body>
<body name="wall" pos=".3 .3 .05"><geom type="box" size=".01 .1 .05"/></body>
</worldbody></mujoco>"""


def test_things_are_where_the_data_has_them() -> None:
    model = mujoco.MjModel.from_xml_string(MOVED)
    data = mujoco.MjData(model)
    data.joint(0).qpos[:] = [0.45, -0.1, 0.05, math.cos(0.2), 0, 0, math.sin(0.2)]
    data.qpos[7:] = [0.05, math.radians(30)]
    before = data.qpos.copy()
    task = pushplan.scene_from(model, data, friction=0.4)
    assert (data.qpos == before).all() and (data.xpos == 0).all(), "it is only read"
    mujoco.mj_kinematics(model, data)
    assert task.objects == ["can", "drawer", "door"]
    for k, name in enumerate(task.objects):
        turn = data.body(name).xmat.reshape(3, 3)
        heading = math.atan2(turn[1, 0], turn[0, 0])
        assert task.start[k, :2] == pytest.approx(data.body(name).xpos[:2], abs=1e-9)
        # A drawer of two equal halves looks identical from either end.
        off = math.remainder(task.start[k, 2] - heading, math.pi)
        assert name == "can" or off == pytest.approx(0, abs=1e-9)
    scene: Any = task.to_dict()["scene"]
    limits = {
        joint["kind"]: joint.get("limits") or joint.get("limits_deg") for joint in scene["joints"]
    }
    # Relative to the current positions.
    assert sorted(map(abs, limits["prismatic"])) == pytest.approx([0.15, 0.15])
    assert sorted(map(abs, limits["revolute"])) == pytest.approx([30, 90])
    assert pushplan.scene_from(model).start[0] == pytest.approx([0.5, 0.1, 0])
    # Errors of the importer are also raised here.
    ball = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody><body name='ball'><freejoint/><geom size='.05'/></body></worldbody>"
        "</mujoco>"
    )
    with pytest.raises(pushplan.FileError, match="`ball` is a sphere"):
        pushplan.scene_from(ball)


def test_faults_of_a_file_have_places(tmp_path: Path) -> None:
    path = tmp_path / "ball.xml"
    path.write_text(
        "<mujoco><worldbody>\n<body name='ball'><freejoint/>\n<geom size='0.05'/></body>"
        "</worldbody></mujoco>"
    )
    with pytest.raises(pushplan.FileError) as raised:
        pushplan.import_task(path)
    [fault] = raised.value.faults
    assert (fault.line, fault.column) == (3, 1) and "`ball` is a sphere" in fault.message
    with pytest.raises(pushplan.FileError, match="cannot read the file"):
        pushplan.import_tool(tmp_path / "missing.urdf")


def recorded(path: Path) -> dict[str, list[tuple[int, Any]]]:
    """Messages of a file by topic, each with its time, read with the package `mcap`."""
    from mcap.reader import make_reader

    found: dict[str, list[tuple[int, Any]]] = {}
    with path.open("rb") as file:
        for schema, channel, message in make_reader(file, validate_crcs=True).iter_messages():
            assert schema is not None and schema.encoding == "jsonschema"
            assert json.loads(schema.data)["title"] == schema.name
            assert channel.message_encoding == "json"
            held = json.loads(message.data)
            jsonschema.validate(held, json.loads(schema.data))
            found.setdefault(channel.topic, []).append((message.log_time, held))
    return found


def test_a_recording_is_read_by_mcap(task: pushplan.Task, tmp_path: Path) -> None:
    from mcap.reader import make_reader

    path = tmp_path / "plan.mcap"
    predicted = pushplan.predict(plan(task), "planar")
    pushplan.export_mcap(plan(task), path, trajectory=predicted)
    topics = recorded(path)
    assert set(topics) == {"/scene", "/tf", "/state"}
    times = [at / 1e9 for at, _ in topics["/tf"]]
    assert times == pytest.approx(predicted.times, abs=1e-9)
    for frame, (_, message) in enumerate(topics["/tf"]):
        transforms = {t["child_frame_id"]: t for t in message["transforms"]}
        for index, name in enumerate(task.objects):
            transform = transforms[f"object/{name}"]
            x, y, heading = predicted.poses[frame, index]
            assert (transform["translation"]["x"], transform["translation"]["y"]) == (x, y)
            turn = transform["rotation"]
            off = 2 * math.atan2(turn["z"], turn["w"]) - heading
            assert math.remainder(off, math.tau) == pytest.approx(0.0, abs=1e-9)
            assert transform["parent_frame_id"] == "table"
    [(_, scene)] = topics["/scene"]
    frames = {entity["frame_id"] for entity in scene["entities"]}
    assert frames == {"table", "tool", *(f"object/{name}" for name in task.objects)}
    with path.open("rb") as file:
        reader = make_reader(file)
        [attached] = reader.iter_attachments()
        [stated] = reader.iter_metadata()
    assert attached.media_type == "application/json"
    assert pushplan.Plan.parse(attached.data.decode()).to_dict() == plan(task).to_dict()
    assert (
        float(stated.metadata["error_m"]) == predicted.error
        and stated.metadata["model"] == "planar"
    )


def test_the_command_writes_the_same_recording(
    task: pushplan.Task, tmp_path: Path, installed: Callable[..., Any]
) -> None:
    plan(task).save(tmp_path / "p.plan.json")
    made = installed(
        "export",
        tmp_path / "p.plan.json",
        "--format",
        "mcap",
        "--model",
        "planar",
        "--out",
        tmp_path,
    )
    assert made.returncode == 0, made.stderr
    pushplan.export_mcap(plan(task), tmp_path / "own.mcap", model="planar")
    assert (tmp_path / "p.mcap").read_bytes() == (tmp_path / "own.mcap").read_bytes()


def test_a_trajectory_of_another_task_is_refused(task: pushplan.Task, tmp_path: Path) -> None:
    other: Any = task.to_dict()
    other["scene"]["objects"].append(
        {**other["scene"]["objects"][0], "name": "more", "position": [0.3, 0.4]}
    )
    predicted = pushplan.predict(plan(pushplan.Task.from_dict(other)))
    with pytest.raises(ValueError, match="of another task"):
        pushplan.export_mcap(plan(task), tmp_path / "x.mcap", trajectory=predicted)
    assert not (tmp_path / "x.mcap").exists()


def test_data_are_read_by_numpy_and_equal_the_results_of_the_engines(
    tmp_path: Path, learn: Callable[..., Any]
) -> None:
    made = learn("generate", tmp_path, "--format", "npz", "--episodes", 40, "--seed", 3)
    assert made.returncode == 0, made.stderr
    with np.load(tmp_path / "episodes-00000.npz") as file:
        data = dict(file)
    frames, objects = data["pose"].shape[:2]
    assert data["episode"].tolist() == list(range(40)) and data["mass"].shape == (40, objects)
    assert data["frame_start"][-1] == frames == len(data["time"]) and data["settles"].dtype == bool
    off = []
    for episode in range(40):
        strokes = slice(*data["stroke_start"][episode : episode + 2])
        stroke = data["stroke"][strokes]
        if np.any(stroke[:, 2] != stroke[:, 5]) or not data["settles"][strokes].all():
            continue  # the tool rotates, unlike in pushes
        scene, tool = (json.loads(data[key][episode]) for key in ("scene", "tool"))
        assert tool["grip"] == {"position": [0.0, 0.0], "yaw_deg": 0.0}
        count = data["objects"][episode]
        assert [o["mass"] for o in scene["objects"]] == data["mass"][episode, :count].tolist()
        name, place = scene["objects"][0]["name"], scene["objects"][0]["position"]
        task = pushplan.Task.from_dict({
            "scene": scene,
            "robot": {"reach": {"max": 10}, "base": "none"},
            "tools": "all",
            "pushes": {"lift": float(data["lift"][episode])},
            "goal": {"object": name, "position": place, "tolerance": 0.01},
        })
        along = stroke[:, 3:5] - stroke[:, 0:2]
        length = np.hypot(*along.T)
        pushes = np.column_stack(
            [
                stroke[:, :2],
                np.arctan2(along[:, 1], along[:, 0]),
                length,
                length / data["stroke_time"][strokes],
            ]
        )
        # If the height of the push is unknown, the 3-D engine provides the ground truth.
        model = "planar" if "push_height" in scene else "3d"
        first, behind = data["frame_start"][episode : episode + 2]
        poses = data["pose"][first:behind, :count]
        # Headings in files are within a full turn, headings in the data count turns.
        rolled = pushplan.rollout(
            task,
            pushplan.Tool.from_dict(tool),
            pushes[None],
            grip_yaw=stroke[0, 2],
            start=poses[0],
            model=model,
        )
        assert rolled.frames[0] == behind - first
        off.append(np.abs(rolled.poses[0] - poses).max())
        assert rolled.times[0] == pytest.approx(data["time"][first:behind])
    # Directions were converted to angles and back: last digits differ, which some contacts amplify.
    assert len(off) > 10 and np.median(off) < 1e-9 and max(off) < 0.02
    statistics = json.loads((tmp_path / "statistics.json").read_text())
    for key in ("mass", "friction", "size", "pose", "velocity", "change"):
        columns = (
            data[key].reshape(-1, 3)
            if data[key].shape[-1] == 3 and data[key].ndim > 2
            else data[key].reshape(-1, 1)
        )
        stated = statistics[key]
        assert stated["mean"] == pytest.approx(np.nanmean(columns, axis=0), abs=1e-12), key
        assert stated["std"] == pytest.approx(np.nanstd(columns, axis=0), rel=1e-9), key
        assert stated["count"] == np.sum(~np.isnan(columns), axis=0).tolist()
    change = np.diff(data["pose"], axis=0)
    inside = np.setdiff1d(np.arange(1, frames), data["frame_start"])
    assert data["change"][inside] == pytest.approx(change[inside - 1], nan_ok=True)


def test_a_mesh_of_a_library_is_what_mujoco_compiles(tmp_path: Path) -> None:
    """Mass, centre and outline of a body that a file holds, with a mesh of another file."""
    corners = [(x, y, z) for x in (0, 60) for y in (0, 40) for z in (0, 50)]
    faces = ["1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"]
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + [f"f {face}" for face in faces]
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes/block.obj").write_text("\n".join(lines) + "\n")
    scale = "<mesh name='m' file='meshes/block.obj' scale='.001 .001 .001'/>"
    (tmp_path / "block.xml").write_text(
        f"<mujoco><asset>{scale}</asset><worldbody><body><body name='object' pos='.5 .1 0'>"
        "<geom type='mesh' mesh='m' density='500'/></body></body></worldbody></mujoco>"
    )
    with pytest.raises(pushplan.FileError, match="no body of the file moves freely"):
        pushplan.import_task(tmp_path / "block.xml", strict=True)
    with pytest.warns(UserWarning, match="the file has no table"):
        task = pushplan.import_task(tmp_path / "block.xml", free=["object"])
    scene: Any = task.to_dict()["scene"]
    [thing] = scene["objects"]
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "block.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    body = model.body("object").id
    assert thing["mass"] == pytest.approx(model.body_mass[body])
    assert thing["position"] == pytest.approx(data.xipos[body][:2])
    corner = np.array(thing["shape"]["prism"]["corners"])
    assert np.ptp(corner, axis=0) == pytest.approx([0.06, 0.04])
    assert thing["shape"]["prism"]["height"] == pytest.approx(0.05)
