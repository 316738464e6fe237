#!/usr/bin/env python3
"""Replays plans of pushplan in MuJoCo and reports whether they reach their goals.

    pushplan export plans/*.plan.json --out mjcf
    python3 mjcf/replay.py mjcf/pull-back.xml       # one scene
    python3 mjcf/replay.py mjcf > results.jsonl     # all scenes of a folder, and a summary

Needs Python 3.11 and `pip install mujoco`; the scenes hold everything else. A line of JSON for each
plan goes to stdout, a table for several to stderr; the exit code is 0 if all of them work.

A plan works if all objects are at rest at the end and the goal object is within the tolerance of
position and, if the goal has one, heading, or has fallen over the right edge. Meanwhile no other
object may topple, no object may enter an obstacle by 2 mm, and none may fall off the table unless
the task allows it. The tool may not be set down on an object, and tool and hand may not touch
anything while they travel. An arm in the scene is driven by servos alone along its joint
trajectory, and may not collide. An unstable replay is repeated with half the time step. Lengths are
in metres, angles in radians.
"""

import argparse
import json
import math
import multiprocessing
import re
import statistics
import sys
from contextlib import nullcontext
from pathlib import Path

import mujoco
import numpy as np

RISES = 0.1  # speed at which a tool is lifted, m/s
JAMMED = 2e-3  # penetration depth above which an object or an arm is jammed, m
LAID_ASIDE = 2.0  # height of unused tools above the table, m
SET_DOWN = 1e-4  # overlap that still counts as touching when the tool comes down, m
TOPPLED = math.cos(math.radians(10))  # cosine of the inclination above which an object has toppled
# Factor and addend, m/s, of the tool's speed. Only unstable contacts make objects faster.
UNSTABLE = (3.0, 0.3)
FALLEN = 0.1  # drop below its start height beyond which an object has left the table, m
KINDS = ["object", "obstacle", "tool", "table", "region", "arm"]
BASE = "obstacle/robot base"
SOLIDS = {
    mujoco.mjtGeom.mjGEOM_BOX: "cuboid",
    mujoco.mjtGeom.mjGEOM_CYLINDER: "cylinder",
    mujoco.mjtGeom.mjGEOM_MESH: "prism",
}


class Arm:
    """Joints of an arm and their trajectory."""

    def __init__(self, model, numbers):
        rows = np.array([data for name, data in numbers.items() if name.startswith("joints ")])
        joints = [model.joint(k) for k in range(model.njnt)]
        joints = [joint for joint in joints if joint.name.startswith("arm/")]
        self.position = [joint.qposadr[0] for joint in joints]
        self.servos = [model.actuator(f"{joint.name}/position").id for joint in joints]
        self.speeds = [model.actuator(f"{joint.name}/speed").id for joint in joints]
        self.times, self.points = rows[:, 0], rows[:, 1 : 1 + len(joints)]
        self.velocities = rows[:, 1 + len(joints) : 1 + 2 * len(joints)]
        self.accelerations = rows[:, 1 + 2 * len(joints) :]
        self.off = 0.0  # maximum error of a joint

    def at(self, time):
        """Returns joint positions and velocities between the points, by quintic interpolation, or
        cubic where points have no accelerations."""
        k = int(np.clip(np.searchsorted(self.times, time) - 1, 0, len(self.times) - 2))
        dt = self.times[k + 1] - self.times[k]
        s = min(max((time - self.times[k]) / dt, 0.0), 1.0)
        a, way = self.points[k], self.points[k + 1] - self.points[k]
        v, w = self.velocities[k : k + 2] * dt
        if self.accelerations.size:
            b, c = self.accelerations[k : k + 2] * dt**2
            powers = [
                a, v, b / 2, 10 * way - 6 * v - 4 * w - 1.5 * b + c / 2,
                8 * v + 7 * w - 15 * way + 1.5 * b - c, 6 * way - 3 * v - 3 * w - b / 2 + c / 2,
            ]
        else:
            powers = [a, v, 3 * way - 2 * v - w, v + w - 2 * way]
        place = sum(power * s**n for n, power in enumerate(powers))
        return place, sum(n * power * s ** (n - 1) for n, power in enumerate(powers) if n) / dt

    def command(self, data, time):
        """Sets the targets of the servos for this time."""
        place, speed = self.at(time)
        self.off = max(self.off, float(np.abs(data.qpos[self.position] - place).max()))
        data.ctrl[self.servos], data.ctrl[self.speeds] = place, speed


class Replay:
    """One scene and its replay."""

    def __init__(self, model, finer=1):
        self.model = model
        self.data = mujoco.MjData(self.model)
        self.step = self.model.opt.timestep / finer
        self.model.opt.timestep = self.step
        bodies = [self.model.body(k) for k in range(self.model.nbody)]
        self.objects = {b.name: b.id for b in bodies if b.name.startswith("object/")}
        self.bodies = list(self.objects.values())
        geoms = [self.model.geom(k).name for k in range(self.model.ngeom)]
        self.kind = np.array([KINDS.index(name.split("/")[0]) for name in geoms])
        self.others = [
            k for k, name in enumerate(geoms) if name.split("/")[0] in ("object", "obstacle")
        ]
        self.obstacles = sum(name.startswith("obstacle/") and name != BASE for name in geoms)
        joints = [self.model.joint(k) for k in range(self.model.njnt)]
        names = [b.name for b in bodies if b.name.split(" ")[0] == "tool"]
        self.tools = [[j for j in joints if j.name.rpartition(" ")[0] == name] for name in names]
        for tool in self.tools:
            for joint in tool:  # the tool is held, so its weight is compensated
                if joint.name.endswith(" z"):
                    weight = -self.model.body("tool").mass[0] * self.model.opt.gravity[2]
                    self.data.qfrc_applied[joint.dofadr[0]] = weight
        self.deepest = np.zeros(len(KINDS))
        numerics = [self.model.numeric(k) for k in range(self.model.nnumeric)]
        self.numbers = {numeric.name: numeric.data for numeric in numerics}
        self.pushes = [data for name, data in self.numbers.items() if name.startswith("push ")]
        self.arm = Arm(model, self.numbers) if "joints 2" in self.numbers else None
        if not self.arm:
            self.take(0)
        self.texts = texts(self.model)
        self.loose = [
            b for name, b in self.objects.items() if f"may fall of {name}" in self.numbers
        ]
        self.upright = [body for body in self.bodies if body not in self.loose]
        free = [
            joint.dofadr[0] for joint in joints
            if joint.type[0] == mujoco.mjtJoint.mjJNT_FREE and joint.bodyid[0] not in self.loose
        ]
        self.free = np.array(free, dtype=int)[:, None] + np.arange(3)
        factor, above = UNSTABLE
        self.fastest = above + factor * max(map(speed_of, self.pushes), default=0.0)
        mujoco.mj_kinematics(self.model, self.data)
        self.heights = self.data.xpos[:, 2].copy()

    def has_fallen(self, body):
        """Returns `True` if the body has left the table and is allowed to."""
        return body in self.loose and self.data.xpos[body, 2] < self.heights[body] - FALLEN

    def run(self):
        """Executes all pushes, in order."""
        if self.arm:
            return self.follow()
        mujoco.mj_forward(self.model, self.data)  # a plan may have no pushes
        lifted = True
        for index, push in enumerate(self.pushes):
            duration, settle = push[4], push[5]
            turn = push[6:8]  # empty if no tool rotates
            start, end = np.append(push[0:2], turn[:1]), np.append(push[2:4], turn[1:])
            if "tools" in self.numbers:
                self.take(int(self.numbers["tools"][index]) - 1)
            if lifted:
                travel(self, index + 1)
                self.set_down(start)
            steps = math.ceil(duration / self.step - 1e-9)
            self.model.opt.timestep = duration / steps
            every = max(1, round(steps * STRIDE / max(math.dist(start, end), STRIDE)))
            for k in range(steps):
                self.move(start + (end - start) * k / steps, (end - start) / duration)
                if k % every == 0:
                    met(self, "the hand collides", hand=True)
            if settle:
                self.coast(end)
                back = self.numbers.get(f"retreat {index + 1}")
                self.lift_off(start, end, duration, 0.0 if back is None else back[0])
            lifted = settle
        travel(self, len(self.pushes) + 1)

    def take(self, index):
        """Takes a tool; unused tools are kept high above the table."""
        for k, tool in enumerate(self.tools):
            for joint in tool:
                if joint.name.endswith(" z"):
                    self.data.qpos[joint.qposadr[0]] = 0.0 if k == index else LAID_ASIDE
                self.data.qvel[joint.dofadr[0]] = 0.0
        tool = self.tools[index]
        self.tool_geoms = np.flatnonzero(self.model.geom_bodyid == tool[0].bodyid[0])
        self.tool_height = [joint for joint in tool if joint.name.endswith(" z")]
        joints = [joint for joint in tool if not joint.name.endswith(" z")]
        self.tool_position = [joint.qposadr[0] for joint in joints]
        self.tool_velocity = [joint.dofadr[0] for joint in joints]

    def follow(self):
        """Moves the arm along its trajectory, and waits until everything rests."""
        self.data.qpos[self.arm.position] = self.arm.points[0]
        mujoco.mj_forward(self.model, self.data)
        for k in range(math.ceil(self.arm.times[-1] / self.step)):
            self.arm.command(self.data, k * self.step)
            self.advance()
        self.arm.command(self.data, self.arm.times[-1])
        self.rest(self.advance)

    def set_down(self, place):
        """Lowers the tool from above."""
        self.place(place, 0.0)
        mujoco.mj_forward(self.model, self.data)
        contact = self.data.contact
        touching = self.kind[contact.geom].max(axis=1) == KINDS.index("tool")
        if np.any(contact.dist[touching] < -SET_DOWN):
            raise Failed("set down on an object")

    def lift_off(self, start, end, duration, back):
        """Moves the tool back along the push by `back`, then lifts it. Objects that stick to it
        move along."""
        way = np.linalg.norm(end[:2] - start[:2])
        if back == 0.0 or way == 0.0:
            return
        share = back / way
        there = end + (start - end) * share
        steps = math.ceil(duration * share / self.step)
        for k in range(steps):
            self.move(end + (there - end) * k / steps, (start - end) / duration)
        self.coast(there)
        height = self.numbers["rise"][0]
        steps = math.ceil(height / RISES / self.step)
        for k in range(steps):
            self.move(there, 0.0, height * k / steps, RISES)
        self.coast(there, height)

    def coast(self, place, height=0.0):
        """Holds the tool still until everything rests."""
        self.rest(lambda: self.move(place, 0.0, height))

    def rest(self, advance):
        """Steps until everything rests."""
        speed, every, most = self.numbers["rest"]
        self.model.opt.timestep = self.step
        waited = 0
        while not self.is_resting(speed):
            if waited == most:
                raise Failed("never rests")
            for _ in range(round(every / self.step)):
                advance()
            waited += 1

    def place(self, place, velocity, height=0.0, rises=0.0):
        # The tool also needs a velocity; otherwise its contacts would have the friction of a
        # resting tool.
        self.data.qpos[self.tool_position] = place
        self.data.qvel[self.tool_velocity] = velocity
        for joint in self.tool_height:
            self.data.qpos[joint.qposadr[0]] = height
            self.data.qvel[joint.dofadr[0]] = rises

    def move(self, place, velocity, height=0.0, rises=0.0):
        """Makes one step with the tool at `place`, lifted by `height`."""
        self.place(place, velocity, height, rises)
        self.advance()

    def advance(self):
        """Makes one step."""
        mujoco.mj_step(self.model, self.data)
        contact = self.data.contact
        depth = contact.includemargin - contact.dist
        np.maximum.at(self.deepest, self.kind[contact.geom].max(axis=1), depth)
        check_finite(self.data)
        velocities = self.data.qvel[self.free]
        velocities[:, 2] = np.maximum(velocities[:, 2], 0.0)  # falls are fast
        if np.any(np.linalg.norm(velocities, axis=1) > self.fastest):
            raise Failed(TOO_FAST)
        if self.deepest[KINDS.index("obstacle")] > JAMMED:
            raise Failed("jams")
        if self.deepest[KINDS.index("arm")] > JAMMED:
            raise Failed("the arm collides")
        if self.upright and self.data.xmat[self.upright, 8].min() < TOPPLED:
            raise Failed("topples")
        if np.any(self.data.xpos[self.upright, 2] < self.heights[self.upright] - FALLEN):
            raise Failed("falls off the table")

    def is_resting(self, limit):
        velocity = np.zeros(6)
        for name, body in self.objects.items():
            if self.has_fallen(body):
                continue
            kind = mujoco.mjtObj.mjOBJ_BODY
            mujoco.mj_objectVelocity(self.model, self.data, kind, body, velocity, 0)
            shape = self.model.geom(name)
            box = shape.type[0] == mujoco.mjtGeom.mjGEOM_BOX
            rim = math.hypot(*shape.size[:2]) if box else shape.size[0]
            if max(math.hypot(*velocity[3:5]), abs(velocity[2]) * rim) >= limit:
                return False
        return True

    def seen(self, name, frame=None):
        """Returns the pose of an object in the world, or in the frame of another object."""
        pose = self.pose(self.objects[f"object/{name}"])
        return pose if frame is None else seen(pose, self.seen(frame))

    def has_left(self, name):
        """Returns `True` if an object has fallen off the table."""
        return self.has_fallen(self.objects[f"object/{name}"])

    def pose(self, body):
        """Returns x, y and heading of a body."""
        turn = self.data.xmat[body]
        return [*self.data.xpos[body][:2].tolist(), math.atan2(turn[3], turn[0])]


def speed_of(push):
    """Returns the speed of a push; of a rotating one, at a distance of one metre."""
    turn = abs(push[7] - push[6]) if len(push) > 6 else 0.0
    return (math.dist(push[0:2], push[2:4]) + turn) / push[4]


def replay(path):
    """Replays the scene of a file, and returns its results for JSON."""
    return decided(lambda finer: replay_once(path, finer))


def replay_once(path, finer):
    """Replays the scene of a file with its time step divided by `finer`."""
    scene = Replay(mujoco.MjModel.from_xml_path(str(path)), finer)
    failure = None
    try:
        scene.run()
    except Failed as failed:
        failure = str(failed)
    poses = {name: scene.pose(body) for name, body in scene.objects.items()}
    # Of several goals, the first is reported.
    reached, error, heading_error = all_judged(scene, scene.texts)
    if failure is None and not reached:
        failure = "misses the goal"
    name = "object/" + json.loads(scene.texts["goals"])[0]["object"]
    ours = scene.numbers.get(f"3-D replay of {name}")
    solid = SOLIDS[mujoco.mjtGeom(scene.model.geom(name).type[0])]
    return {
        "scene": str(path),
        "plan": path.stem,
        "reached": failure is None,
        "failure": failure,
        "mujoco": mujoco.__version__,
        "timestep": scene.step,
        "error": error,
        "heading_error": heading_error,
        # Difference between the ends of this replay and of pushplan's own in 3-D.
        "difference": None if ours is None else math.dist(poses[name][:2], ours[:2]),
        "deepest": dict(zip(KINDS, scene.deepest.tolist())),
        "poses": poses,
        "pushes": len(scene.pushes),
        "obstacles": scene.obstacles,
        "goal_object": solid,
        # Maximum joint error of an arm, radians or metres.
        "joints_off": scene.arm.off if scene.arm else None,
    }


def table(results):
    """Returns a Markdown table of the share of working plans by kind."""
    groups = {"all": results}
    for result in results:
        one, walls = result["pushes"] < 2, result["obstacles"]
        kind = re.sub(r"[-_]?\d+$", "", result["plan"])
        for group in (
            *([kind] if kind != result["plan"] else []),  # tasks of `pushplan-lab random`
            "with obstacles" if walls else "without obstacles",
            "one push" if one else "two and more pushes",
            result["goal_object"] + (", with obstacles" if walls else ", without obstacles"),
        ):
            groups.setdefault(group, []).append(result)
    failures = sorted({result["failure"] for result in results} - {None})
    lines = [["plans", "number", "work", "difference, median", "p95", *failures]]
    lines.append(["---"] + ["--:"] * (len(lines[0]) - 1))
    # Kinds by name, then their values.
    for group in sorted(groups, key=lambda name: (name != "all", " " in name, name)):
        chosen = groups[group]
        share = sum(result["reached"] for result in chosen) / len(chosen)
        apart = sorted(1e3 * r["difference"] for r in chosen if r["difference"] is not None)
        spread = ["", ""]
        if apart:
            high = apart[math.ceil(0.95 * len(apart)) - 1]
            spread = [f"{statistics.median(apart):.2f} mm", f"{high:.1f} mm"]
        counts = [str(sum(r["failure"] == failure for r in chosen)) for failure in failures]
        lines.append([group, str(len(chosen)), f"{share:.1%}", *spread, *counts])
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scenes", nargs="+", type=Path, help="scenes, or folders of scenes (*.xml)")
    parser.add_argument("--jobs", type=int, default=None, help="processes; default one per core")
    arguments = parser.parse_args()
    scenes = []
    for path in arguments.scenes:
        # Another script replays the lever-ups of the same folder.
        ours = (scene for scene in path.glob("*.xml") if "lever.py" not in scene.read_text())
        scenes += sorted(ours) if path.is_dir() else [path]
    results = []
    alone = len(scenes) == 1 or arguments.jobs == 1
    with nullcontext() if alone else multiprocessing.Pool(arguments.jobs) as pool:
        for result in (pool.imap if pool else map)(replay, scenes):
            print(json.dumps(result), flush=True)
            results.append(result)
    if len(results) > 1:
        print(table(results), file=sys.stderr)
    return 0 if all(result["reached"] for result in results) else 1
