#!/usr/bin/env python3
"""Counts the shipped tasks that arms can execute, and checks their plans with Pinocchio.

    pip install pin example-robot-data pyyaml mujoco
    python3 crates/lab/benches/arms.py --program target/release/pushplan --out arms [--mujoco]

Every task that is solved without an arm is solved again with a Panda, a UR5 and an xArm7, its
flange 12 and 25 cm above the tool's underside. Pinocchio checks solved plans from the URDF and the
joint trajectory in the plan file: the pose of the flange (1 mm, half a degree), the limits and
speeds of joints, and collisions between links that are apart at home. With --mujoco the arm also
executes the plans in MuJoCo, its joints moved by servos, and the plans that reach their goals are
counted. Lengths are in metres.
"""

import argparse
import json
import math
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pinocchio as pin
import yaml

ARMS = {
    "panda": ("panda_description/urdf/panda.urdf", "panda_link8"),
    "ur5": ("ur_description/urdf/ur5_robot.urdf", "tool0"),
    "xarm7": ("xarm_description/urdf/xarm7.urdf", "link_eef"),
}
FLANGES = [0.12, 0.25]
PLAYED = ["plan", "reached", "failure", "error", "difference", "joints_off"]
OFF, TURNED = 1e-3, math.radians(0.5)


def robots():
    """Returns the folder of robots of example-robot-data, if installed."""
    for folder in sys.path:
        found = Path(folder) / "cmeel.prefix/share/example-robot-data/robots"
        if found.is_dir():
            return found
    return None


class Judge:
    """An arm in Pinocchio."""

    def __init__(self, urdf, flange, packages=None, axis="z"):
        packages = [str(packages or urdf.parents[4])]
        self.model = pin.buildModelFromUrdf(str(urdf))
        try:
            self.solids = pin.buildGeomFromUrdf(self.model, str(urdf), pin.COLLISION, packages)
        except ValueError as error:
            # Pinocchio does not find meshes by the end of their path; pushplan does.
            print(f"collisions are not checked: {error}", file=sys.stderr)
            self.solids = pin.GeometryModel()
        self.flange = self.model.getFrameId(flange, pin.BODY)
        # Only the chain to the flange is checked, not a gripper, and no neighbours.
        chain = set(self.model.supports[self.model.frames[self.flange].parentJoint])
        parents = [solid.parentJoint for solid in self.solids.geometryObjects]
        for a, first in enumerate(parents):
            for b, second in enumerate(parents):
                if first + 1 < second and {first, second} <= chain:
                    self.solids.addCollisionPair(pin.CollisionPair(a, b))
        self.data = self.model.createData()
        sign, of = (-1.0 if axis[0] == "-" else 1.0), "xyz".index(axis[-1])
        out = pin.Quaternion.FromTwoVectors(np.eye(3)[2], sign * np.eye(3)[of])
        self.out = pin.SE3(out.matrix(), np.zeros(3))

    def pose(self, names, values, base):
        """Returns the pose of the flange in the world, its z axis pointing out of it."""
        pin.framesForwardKinematics(self.model, self.data, self.full(names, values))
        turn = pin.Quaternion(np.array(base["rotation"])).matrix()
        stand = pin.SE3(turn, np.array(base["position"]))
        return stand * self.data.oMf[self.flange] * self.out

    def full(self, names, values):
        q = pin.neutral(self.model)
        for name, value in zip(names, values):
            joint = self.model.joints[self.model.getJointId(name)]
            if joint.nq == 2:
                q[joint.idx_q : joint.idx_q + 2] = math.cos(value), math.sin(value)
            else:
                q[joint.idx_q] = value
        return q

    def hits(self, q):
        """Returns colliding pairs of links of the chain, except neighbours."""
        data = self.solids.createData()
        pin.computeCollisions(self.model, self.data, self.solids, data, q, False)
        return {
            (self.solids.geometryObjects[pair.first].name,
             self.solids.geometryObjects[pair.second].name)
            for k, pair in enumerate(self.solids.collisionPairs)
            if data.collisionResults[k].isCollision()
        }

    def faults(self, plan, length):
        """Returns the faults of a plan's joint trajectory."""
        path = plan["joints"]
        names, points, model = path["joints"], path["points"], self.model
        found = []
        base = plan["task"]["robot"]["arm"]["base"]
        joints = [model.joints[model.getJointId(name)] for name in names]
        # A continuous joint has the coordinates cosine and sine, and no limits.
        lower = [-np.inf if j.nq == 2 else model.lowerPositionLimit[j.idx_q] for j in joints]
        upper = [np.inf if j.nq == 2 else model.upperPositionLimit[j.idx_q] for j in joints]
        speed = [model.velocityLimit[j.idx_v] for j in joints]
        home = self.hits(self.full(names, points[0]["positions"]))
        for a, b in zip(points, points[1:]):
            for share in (0.0, 0.25, 0.5, 0.75, 1.0):
                q = between(a, b, share)
                rate = between(a, b, share, 1)
                for k, name in enumerate(names):
                    if not lower[k] - 1e-6 <= q[k] <= upper[k] + 1e-6:
                        found.append(f"{name} at {q[k]:.3f}")
                    if speed[k] > 0 and abs(rate[k]) > speed[k] * 1.001:
                        found.append(f"{name} at {rate[k]:.2f}/s")
                if share in (0.0, 0.5):
                    for pair in self.hits(self.full(names, q)) - home:
                        found.append(f"{pair[0]} in {pair[1]}")
        steps = [step["push"] for step in plan["plan"]["steps"] if "push" in step]
        worst = 0.0
        for (begin, end), step in zip(path["pushes"], steps):
            for k in range(begin, end + 1):
                shares = (0.0, 0.5) if k < end else (0.0,)
                for share in shares:
                    nxt = points[min(k + 1, len(points) - 1)]
                    q = between(points[k], nxt, share)
                    off, turned = self.off(self.pose(names, q, base), step, length)
                    worst = max(worst, off)
                    if off > OFF or turned > TURNED:
                        found.append(f"error {off * 1e3:.2f} mm, {math.degrees(turned):.2f} deg")
            ends = [points[begin]["positions"], points[end]["positions"]]
            goals = [
                np.array(step["start"]),
                np.array(step["start"]) + step["length"] * heading(step),
            ]
            for q, goal in zip(ends, goals):
                if np.linalg.norm(self.pose(names, q, base).translation[:2] - goal) > OFF:
                    found.append("a push begins or ends elsewhere")
        return sorted(set(found)), worst

    @staticmethod
    def off(pose, step, length):
        at, start = pose.translation, np.array(step["start"])
        along = np.clip((at[:2] - start) @ heading(step), 0.0, step["length"])
        nearest = np.array([*(start + along * heading(step)), step["lift"] + length])
        yaw = step["grip_yaw"]
        held = pin.rpy.rpyToMatrix(0.0, 0.0, yaw) @ np.diag([1.0, -1.0, -1.0])
        return np.linalg.norm(at - nearest), np.linalg.norm(pin.log3(held.T @ pose.rotation))


def heading(step):
    return np.array([math.cos(step["direction"]), math.sin(step["direction"])])


def between(a, b, s, order=0):
    """Interpolates joint positions, or their derivatives, between a point and the next."""
    dt = b["time"] - a["time"]
    way = np.subtract(b["positions"], a["positions"])
    v, w = (np.array(point["velocities"]) * dt for point in (a, b))
    p, q = (np.array(point["accelerations"]) * dt**2 for point in (a, b))
    powers = [
        np.array(a["positions"]), v, p / 2, 10 * way - 6 * v - 4 * w - 1.5 * p + q / 2,
        8 * v + 7 * w - 15 * way + 1.5 * p - q, 6 * way - 3 * v - 3 * w - p / 2 + q / 2,
    ]
    for _ in range(order):
        powers = [n * power for n, power in enumerate(powers)][1:]
    return sum(power * s**n for n, power in enumerate(powers)) / dt**order


def solve(program, task, out, arguments):
    before = time.process_time()
    command = [program, "solve", task, "--out", out, "--quiet", "--json", *arguments]
    done = subprocess.run(command, capture_output=True, text=True)
    return done.returncode, done


def played(program, plans, out):
    """Replays plans in MuJoCo, where servos move the arm, and returns a line for each."""
    subprocess.run([program, "export", *plans, "--out", out], capture_output=True, check=True)
    done = subprocess.run([sys.executable, out / "replay.py", out], capture_output=True, text=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="pushplan")
    parser.add_argument("--tasks", type=Path, default=Path("tasks"))
    parser.add_argument("--out", type=Path, default=Path("arms"))
    parser.add_argument("--arms", default=",".join(ARMS))
    parser.add_argument("--flanges", default=",".join(map(str, FLANGES)))
    parser.add_argument("--only", help="only tasks with this text in the name")
    parser.add_argument("--effort", default="standard")
    parser.add_argument("--mujoco", action="store_true", help="also execute the plans in MuJoCo")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    folder, more = robots(), ["--effort", options.effort]
    if folder is None:
        sys.exit("pip install example-robot-data")
    tasks = sorted(
        path for path in options.tasks.glob("*.yaml") if (options.only or "") in path.name
    )
    solved = []
    for path in tasks:
        code, _ = solve(options.program, path, options.out / "without", more)
        print(json.dumps({"task": path.stem, "arm": None, "code": code}), flush=True)
        if code == 0:
            solved.append(path)
    for arm in options.arms.split(","):
        urdf, flange = folder / ARMS[arm][0], ARMS[arm][1]
        judge = Judge(urdf, flange)
        for length in map(float, options.flanges.split(",")):
            count = passed = 0
            plans = []
            for path in solved:
                task = yaml.safe_load(path.read_text())
                task.setdefault("name", path.stem)
                old = task["robot"]
                task["robot"] = {
                    "urdf": str(urdf), "flange": flange, "tool_mount": {"length": length},
                    **{key: old[key] for key in ("travel", "max_force") if key in old},
                }
                name = options.out / f"{path.stem}.{arm}.{round(length * 100)}.yaml"
                name.write_text(json.dumps(task))
                out = options.out / f"{arm}-{round(length * 100)}"
                code, done = solve(options.program, name, out, [*more, "--root", urdf.parents[4]])
                faults, worst = None, None
                if code == 0:
                    count += 1
                    plans.append(out / f"{task['name']}.plan.json")
                    plan = json.loads(plans[-1].read_text())
                    if plan["plan"]["steps"]:
                        faults, worst = judge.faults(plan, length)
                    passed += not faults
                line = {"task": path.stem, "arm": arm, "flange": length, "code": code}
                if code == 0:
                    line |= {"faults": faults, "off_mm": worst and round(worst * 1e3, 4)}
                else:
                    line["message"] = (done.stderr or done.stdout)[-300:]
                print(json.dumps(line), flush=True)
            total = {"arm": arm, "flange": length, "tasks": len(solved), "solved": count}
            total["pinocchio_agrees"] = passed
            if options.mujoco and plans:
                lines = played(
                    options.program, plans, options.out / f"{arm}-{round(length * 100)}-scenes"
                )
                for line in lines:
                    print(json.dumps({k: line[k] for k in PLAYED}), flush=True)
                total["reached_in_mujoco"] = sum(line["reached"] for line in lines)
            print(json.dumps(total), flush=True)


if __name__ == "__main__":
    main()
