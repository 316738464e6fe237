#!/usr/bin/env python3
"""Counts the shipped tasks that arms can execute, and checks their plans with Pinocchio.

    pip install pin example-robot-data pyyaml mujoco
    python3 crates/lab/benches/arms.py --program target/release/pushplan --out arms [--mujoco]

Every task that is solved without an arm is solved again with a Panda, a UR5 and an xArm7, its flange 12 and
25 cm above the tool's underside. Pinocchio checks solved plans from the URDF and the joint trajectory in the
plan file: the pose of the flange (1 mm, half a degree), the limits and speeds of joints, and collisions between
links that are apart at home. With --mujoco the arm also executes the plans in MuJoCo, its joints moved by
servos, and the plans that reach their goals are counted. Lengths are in metres.
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

    def __init__(self, urdf, flange):
        packages = [str(urdf.parents[4])]
        self.model = pin.buildModelFromUrdf(str(urdf))
        self.solids = pin.buildGeomFromUrdf(self.model, str(urdf), pin.COLLISION, packages)
        self.solids.addAllCollisionPairs()
        self.flange = self.model.getFrameId(flange)
        # Only the chain to the flange is checked, not a gripper.
        self.chain = set(self.model.supports[self.model.frames[self.flange].parentJoint])
        self.data = self.model.createData()

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
        found = set()
        for k, pair in enumerate(self.solids.collisionPairs):
            a, b = (self.solids.geometryObjects[i] for i in (pair.first, pair.second))
            joints = sorted([a.parentJoint, b.parentJoint])
            moving = all(joint in self.chain for joint in joints)
            if moving and joints[1] - joints[0] > 1 and data.collisionResults[k].isCollision():
                found.add((a.name, b.name))
        return found

    def faults(self, plan, length):
        """Returns the faults of a plan's joint trajectory."""
        path = plan["joints"]
        names, points, model = path["joints"], path["points"], self.model
        found = []
        lower, upper, speed = (
            [float(v[model.joints[model.getJointId(name)].idx_v]) if len(v) == model.nv
             else float(v[model.joints[model.getJointId(name)].idx_q]) for name in names]
            for v in (model.lowerPositionLimit, model.upperPositionLimit, model.velocityLimit)
        )
        home = self.hits(self.full(names, points[0]["positions"]))
        for a, b in zip(points, points[1:]):
            dt = b["time"] - a["time"]
            for share in (0.0, 0.25, 0.5, 0.75, 1.0):
                q = between(a, b, share)
                rate = (between(a, b, share + 1e-4) - between(a, b, share - 1e-4)) / (2e-4 * dt)
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
                    pin.framesForwardKinematics(model, self.data, self.full(names, q))
                    pose = self.data.oMf[self.flange]
                    off, turned = self.off(pose, step, length)
                    worst = max(worst, off)
                    if off > OFF or turned > TURNED:
                        found.append(f"error {off * 1e3:.2f} mm, {math.degrees(turned):.2f} deg")
            ends = [points[begin]["positions"], points[end]["positions"]]
            goals = [np.array(step["start"]), np.array(step["start"]) + step["length"] * heading(step)]
            for q, goal in zip(ends, goals):
                pin.framesForwardKinematics(model, self.data, self.full(names, q))
                if np.linalg.norm(self.data.oMf[self.flange].translation[:2] - goal) > OFF:
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


def between(a, b, s):
    """Interpolates joint positions between a point and the next."""
    dt = b["time"] - a["time"]
    p, q = np.array(a["positions"]), np.array(b["positions"])
    v, w = np.array(a["velocities"]), np.array(b["velocities"])
    return (
        (2 * s**3 - 3 * s**2 + 1) * p + (s**3 - 2 * s**2 + s) * dt * v
        + (3 * s**2 - 2 * s**3) * q + (s**3 - s**2) * dt * w
    )


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
    tasks = sorted(path for path in options.tasks.glob("*.yaml") if (options.only or "") in path.name)
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
                    line["says"] = (done.stderr or done.stdout)[-300:]
                print(json.dumps(line), flush=True)
            total = {"arm": arm, "flange": length, "tasks": len(solved), "solved": count}
            total["pinocchio_agrees"] = passed
            if options.mujoco and plans:
                lines = played(options.program, plans, options.out / f"{arm}-{round(length * 100)}-scenes")
                for line in lines:
                    print(json.dumps({k: line[k] for k in PLAYED}), flush=True)
                total["reached_in_mujoco"] = sum(line["reached"] for line in lines)
            print(json.dumps(total), flush=True)


if __name__ == "__main__":
    main()
