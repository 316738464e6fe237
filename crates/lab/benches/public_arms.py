#!/usr/bin/env python3
"""Plans pushes for arms of public packages, and checks the trajectories.

    pip install pin example-robot-data pybullet robosuite rtb-data pyyaml mujoco
    python3 crates/lab/benches/public_arms.py --program target/release/pushplan --out arms

Each arm gets the same pushes, scaled to its reach: a can pushed away, to both sides and back, a box
that is rotated, and a can behind a wall. A task is feasible if it is solved for an end effector
confined to the arm's annulus. Pinocchio checks the trajectories from the URDF: the pose of the
flange (1 mm, half a degree), limits of position and speed, and the accelerations and jerks of the
quintics against pushplan's defaults; overlaps of links are counted apart. MuJoCo executes the plans
by servos. Lengths are in metres.
"""

import argparse
import json
import sys
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from arms import Judge, between, played, robots, solve

SMALL, USUAL, FLOOR = 0.05, 0.12, {"height": -0.7}
# Name: package, licence as the package states it, file, flange, tool mount, base pose.
ARMS = {
    "Panda": ("example-robot-data", "Apache-2.0", "panda_description/urdf/panda.urdf",
              "panda_link8", {}, {}),
    "UR3": ("example-robot-data", "BSD", "ur_description/urdf/ur3_robot.urdf",
            "tool0", {}, {}),
    "UR5": ("example-robot-data", "BSD", "ur_description/urdf/ur5_robot.urdf",
            "tool0", {}, {}),
    "UR10": ("example-robot-data", "BSD", "ur_description/urdf/ur10_robot.urdf",
             "tool0", {}, {}),
    "xArm7": ("example-robot-data", "BSD-3-Clause", "xarm_description/urdf/xarm7.urdf",
              "link_eef", {}, {}),
    "Z1": ("example-robot-data", "MPL-2.0", "z1_description/urdf/z1.urdf",
           "link06", {"axis": "x"}, {}),
    "Jaco 2": ("example-robot-data", "BSD", "kinova_description/robots/kinova.urdf",
               "j2s6s200_end_effector", {}, {}),
    "SO-100": ("example-robot-data", "Apache-2.0", "so_arm_description/urdf/so100.urdf",
               "gripper", {"axis": "-y", "length": 0.1}, {}),
    "SO-101": ("example-robot-data", "Apache-2.0", "so_arm_description/urdf/so101.urdf",
               "gripper_frame_link", {"length": SMALL}, {}),
    "TIAGo": ("example-robot-data", "Apache-2.0", "tiago_description/robots/tiago.urdf",
              "arm_tool_link", {"axis": "x"}, FLOOR),
    "TIAGo Pro": ("example-robot-data", "Apache-2.0",
                  "tiago_pro_description/robots/tiago_pro.urdf",
                  "arm_left_tool_link", {}, FLOOR),
    "PR2": ("example-robot-data", "BSD", "pr2_description/urdf/pr2.urdf",
            "r_gripper_tool_frame", {"axis": "x"}, FLOOR),
    "Baxter": ("example-robot-data", "BSD", "baxter_description/urdf/baxter.urdf",
               "left_hand_link", {}, {}),
    "TALOS": ("example-robot-data", "Apache-2.0", "talos_data/robots/talos_left_arm.urdf",
              "wrist_left_ft_tool_link", {"axis": "-z"}, {"height": 0.5}),
    "xArm6": ("pybullet", "zlib", "pybullet_data/xarm/xarm6_robot.urdf", "link6", {}, {}),
    "iiwa 7": ("pybullet", "zlib", "pybullet_data/kuka_iiwa/model.urdf",
               "lbr_iiwa_link_7", {}, {}),
    "Sawyer": ("robosuite", "MIT",
               "robosuite/models/assets/bullet_data/sawyer_description/urdf/sawyer_arm.urdf",
               "right_l6", {}, {}),
    "iiwa 14": ("rtb-data", "MIT",
                "rtbdata/xacro/kuka_description/kuka_lbr_iiwa/urdf/lbr_iiwa_14_r820.urdf",
                "tool0", {}, {}),
    "KR 16": ("rtb-data", "MIT",
              "rtbdata/xacro/kuka_description/kuka_kr16/urdf/kr16_2.urdf", "tool0", {}, {}),
    "Puma 560": ("rtb-data", "MIT",
                 "rtbdata/xacro/unimation_puma560_description/urdf/puma560_robot.urdf",
                 "link7", {}, {}),
}
MODULES = {"pybullet": "pybullet_data", "robosuite": "robosuite", "rtb-data": "rtbdata"}
ACCELERATION, JERK = {False: 10.0, True: 1.0}, {False: 200.0, True: 20.0}


def folder(package):
    """Returns the folder of a package's files and the root of its meshes."""
    if package == "example-robot-data":
        return robots(), robots().parent.parent
    place = Path(find_spec(MODULES[package]).submodule_search_locations[0]).parent
    return place, place / "rtbdata/xacro" if package == "rtb-data" else place


def tasks(near, far, yaw, centre, length):
    """Returns the pushes of an arm by name, about the middle of its annulus. Things are lower than
    its flange."""
    turn = np.array([[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]])
    size = float(np.clip(0.4 * far, 0.25, 0.4))
    middle = 0.5 * (near + far)

    def at(x, y):
        return [round(v, 4) for v in centre + turn @ [middle + size * x, size * y]]

    def task(start, goal, shape, tools, extra=None, walls=()):
        thing = {"name": "thing", "shape": shape, "mass": 0.3, "friction": 0.4, "position": start}
        heading = {"yaw_deg": round(float(np.degrees(yaw)), 3)}
        scene = {"objects": [thing | heading]}
        if walls:
            scene["obstacles"] = [wall | heading for wall in walls]
        goal = {"object": "thing", "position": goal, "tolerance": 0.01} | (extra or {})
        return {"scene": scene, "tools": tools, "pushes": {"length": 0.1}, "goal": goal}

    height = min(0.06, length - 0.02)
    can = {"cylinder": {"radius": 0.03, "height": height}}
    box = {"cuboid": {"size": [0.08, 0.06, height]}}
    turned = {"heading_deg": round(float(np.degrees(yaw)) + 20, 3), "heading_tolerance_deg": 8}
    wall = {"name": "wall", "size": [0.02, 0.08, 0.04], "position": at(-0.12, 0.0)}
    hooks = ["hook", "l-hook", "paddle"]
    return {
        "away": task(at(-0.1, 0), at(0.08, 0), can, ["finger", "paddle"]),
        "left": task(at(0, -0.1), at(0, 0.1), can, ["finger", "paddle"]),
        "right": task(at(0, 0.1), at(0.02, -0.1), can, ["finger", "paddle"]),
        "back": task(at(0.1, 0.02), at(-0.02, 0.02), can, hooks),
        "turned": task(at(0, 0), at(0.06, 0.03), box, ["finger", "paddle"], turned),
        "wall": task(at(0, 0.05), at(0.08, 0.1), can, ["finger", "paddle"], walls=[wall]),
    }


def rates(plan):
    """Returns the largest shares of the default acceleration and jerk in a plan's trajectory."""
    slides = [bool(joint.get("slides")) for joint in plan["task"]["robot"]["arm"]["joints"]]
    limits = [[ACCELERATION[kind] for kind in slides], [JERK[kind] for kind in slides]]
    points, worst = plan["joints"]["points"], [0.0, 0.0]
    for a, b in zip(points, points[1:]):
        for s in np.linspace(0, 1, 9):
            for k, limit in enumerate(limits):
                worst[k] = max(worst[k], float(np.max(abs(between(a, b, s, 2 + k)) / limit)))
    return worst


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="pushplan")
    parser.add_argument("--out", type=Path, default=Path("arms"))
    parser.add_argument("--arms", default=",".join(ARMS))
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    rows = []
    for name in options.arms.split(","):
        package, licence, urdf, flange, mount, base = ARMS[name]
        place, root = folder(package)
        urdf, mount = place / urdf, {"length": USUAL} | mount
        robot = {"urdf": str(urdf), "flange": flange, "tool_mount": mount, "base_pose": base}
        row = {"arm": name, "package": f"{package} {version(package)}", "licence": licence}
        more, out = ["--root", root, "--effort", "standard"], options.out / name.replace(" ", "-")

        def attempt(task, label, robot, solved_in):
            path = options.out / f"{label}.yaml"
            path.write_text(json.dumps(task | {"name": label, "robot": robot}))
            return solve(options.program, path, solved_in, more)[0]

        # A plan without pushes contains the arm's annulus.
        first = tasks(0.2, 0.6, 0.0, np.zeros(2), USUAL)["away"]
        first["goal"] = {"object": "thing", "position": [3.0, 3.0], "tolerance": 0.05}
        first["scene"]["objects"][0]["position"] = [3.0, 3.0]
        label = f"{name.replace(' ', '-')}-first"
        code = attempt(first, label, robot, out)
        found = list(out.glob(f"{label}.plan.json"))
        row |= {"read": bool(found), "feasible": 0, "planned": 0, "within": 0}
        row |= {"overlaps": 0, "reached": 0}
        if not found:
            print(json.dumps(row | {"code": code}), file=sys.stderr, flush=True)
            rows.append(row)
            continue
        arm = json.loads(found[0].read_text())["task"]["robot"]["arm"]
        row["joints"] = len(arm["joints"])
        (near, far), centre = arm["places"]["ring"], np.array(arm["places"].get("centre", [0, 0]))
        judge = Judge(urdf, flange, root, mount.get("axis", "z"))
        home = judge.pose([joint["name"] for joint in arm["joints"]], arm["home"], arm["base"])
        home = home.translation[:2] - centre
        yaw, plans = float(np.arctan2(home[1], home[0])), []
        ring = {"min": max(0.1, near), "max": far}
        own = tasks(near, far, yaw, centre, mount["length"])
        bare = tasks(near, far, yaw, np.zeros(2), mount["length"])
        for kind, task in own.items():
            label = f"{name.replace(' ', '-')}-{kind}"
            ringed = {"reach": ring, "base": "none"}
            if attempt(bare[kind], f"{label}-bare", ringed, options.out / "bare") != 0:
                continue
            row["feasible"] += 1
            if attempt(task, label, robot, out) != 0:
                print(json.dumps({"missed": label}), file=sys.stderr, flush=True)
                continue
            row["planned"] += 1
            plans.append(out / f"{label}.plan.json")
            plan = json.loads(plans[-1].read_text())
            faults, _ = judge.faults(plan, mount["length"])
            worst = rates(plan)
            # Links whose solids overlap in many postures are not checked by pushplan.
            row["overlaps"] += any(" in " in fault for fault in faults)
            faults = [fault for fault in faults if " in " not in fault]
            row["within"] += not faults and max(worst) <= 1.001
            if faults or max(worst) > 1.001:
                line = {"task": label, "faults": faults, "rates": worst}
                print(json.dumps(line), file=sys.stderr, flush=True)
        if plans:
            lines = played(options.program, plans, options.out / f"{out.name}-scenes")
            row["reached"] = sum(line["reached"] for line in lines)
        print(json.dumps(row), file=sys.stderr, flush=True)
        rows.append(row)
    mujoco = f"reach in MuJoCo {version('mujoco')}"
    print(f"| arm | package, licence | joints | feasible | planned | within limits | {mujoco} |")
    print("| --- | --- |" + " --: |" * 5)
    keys = ("feasible", "planned", "within", "reached")
    for row in rows:
        cells = [str(row.get("joints", "")), *(str(row[key]) for key in keys)]
        print(f"| {row['arm']} | {row['package']}, {row['licence']} | " + " | ".join(cells) + " |")
    sums = " | ".join(str(sum(row[key] for row in rows)) for key in keys)
    print(f"| all {len(rows)} | | | {sums} |")


if __name__ == "__main__":
    main()
