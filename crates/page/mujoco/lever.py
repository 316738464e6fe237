#!/usr/bin/env python3
"""Replays lever-ups and 3-D plans of pushplan in MuJoCo and reports their results.

    python3 lever.py SCENE.xml ... > results.jsonl
    python3 lever.py --against ours.jsonl --played results.jsonl

Needs Python 3.11 and `pip install mujoco`. Prints one line of JSON for each scene: `lift`, the
poses of the levered plate at equal intervals of the last rotation; `rest`, its final pose;
`reached`, whether the goals of the scene are met; and `failure`, the reason if they are not, if no
state is finite, or if an object falls that may not. An unstable replay is repeated with half the
time step. A pose is x, y, z and the quaternion w, x, y, z. With `--against`, the output of
`pushplan-learn generate --format mjcf` for the same scenes, it finally prints the differences to
stderr. `--played` reads lines written earlier.
"""

import argparse
import json
import math
import os
import statistics
import sys

import mujoco
import numpy as np

REST = 1e-3  # speed below which a body is at rest, m/s
STILL = 0.1  # duration at rest, seconds
PATIENCE = 4.0  # maximum waiting time, seconds
FALLEN = -0.1  # height below which an object has left the table, m


def turned(a, b):
    """Returns the quaternion of rotation b followed by rotation a."""
    found = np.zeros(4)
    mujoco.mju_mulQuat(found, np.array(a), np.array(b))
    return found


def rotated(vector, quaternion):
    found = np.zeros(3)
    mujoco.mju_rotVecQuat(found, np.array(vector, dtype=float), np.array(quaternion))
    return found


class Hand:
    """Body on a prescribed path: a blade, or a pushing tool."""

    def __init__(self, scene, name):
        self.scene = scene
        joint = scene.model.body(name).jntadr[0]
        self.position = scene.model.jnt_qposadr[joint]
        self.velocity = scene.model.jnt_dofadr[joint]

    def put(self, at, turn, speed=(0, 0, 0), spin=(0, 0, 0)):
        data = self.scene.data
        data.qpos[self.position : self.position + 7] = [*at, *turn]
        data.qvel[self.velocity : self.velocity + 6] = [*speed, *spin]

    def away(self):
        """Moves the body far away from all others."""
        self.put([50 + self.position, 0, 0], [1, 0, 0, 0])

    def go(self, pose, time, dt):
        """Sets pose and velocity for a step from `time`; `pose` maps a time to position and
        rotation."""
        (at, turn), (later, after) = pose(time), pose(time + dt)
        if np.dot(turn, after) < 0:
            after = -after
        spin = np.zeros(3)
        mujoco.mju_subQuat(spin, np.array(after), np.array(turn))
        self.put(at, turn, (np.array(later) - np.array(at)) / dt, spin / dt)


class Scene:
    """One scene and its replay."""

    def __init__(self, path, finer=1):
        self.model = mujoco.MjModel.from_xml_path(path)
        self.model.opt.timestep /= finer
        self.data = mujoco.MjData(self.model)
        self.numbers = {}
        for k in range(self.model.nnumeric):
            numeric = self.model.numeric(k)
            self.numbers[numeric.name] = numeric.data
        plate = next(n.removeprefix("levered ") for n in self.numbers if n.startswith("levered "))
        self.plate = self.model.body(plate).id
        self.plates = [
            k for k in range(self.model.nbody) if self.model.body(k).name.startswith("plate/")
        ]
        self.kept = [
            k for k in self.plates if f"may fall of {self.model.body(k).name}" not in self.numbers
        ]
        steps = [n.split() for n in self.numbers if n.startswith(("lever ", "pushes "))]
        self.steps = sorted((int(k), kind) for kind, k in steps)
        self.step = self.model.opt.timestep
        self.texts = texts(self.model)
        self.raised = {}
        self.time = 0.0
        self.hand = None
        self.way = None

    def blade(self, k):
        """Returns the lever-up and the pose of the blade's centre as a function of time."""
        keys = "depth pivot angle turn hold retreat speed frames".split()
        lever = dict(zip(keys, self.numbers[f"lever {k}"]))
        length, thickness = self.numbers[f"blade {k}"]
        frame, frame_turn = self.numbers[f"frame {k}"][:3], self.numbers[f"frame {k}"][3:]

        def pose(time):
            angle = lever["angle"] * min(max(time / lever["turn"], 0), 1)
            way = (time - lever["turn"] - lever["hold"]) * lever["speed"]
            way = min(max(way, 0), lever["retreat"])
            angle = math.copysign(angle, lever["pivot"])
            turn = [math.cos(angle / 2), 0, math.sin(angle / 2), 0]
            pivot = np.array([lever["pivot"], 0, 0])
            middle = np.array([lever["depth"] - length / 2, 0, -thickness / 2])
            at = pivot + rotated(middle - pivot, turn) - rotated([way, 0, 0], turn)
            return frame + rotated(at, frame_turn), turned(frame_turn, turn)

        return lever, pose

    def pose(self):
        return [*self.data.xpos[self.plate].tolist(), *self.data.xquat[self.plate].tolist()]

    def speed(self):
        fastest = 0.0
        for plate in self.plates:
            found = np.zeros(6)
            mujoco.mj_objectVelocity(
                self.model, self.data, mujoco.mjtObj.mjOBJ_BODY, plate, found, 0
            )
            speed = np.linalg.norm(found[3:]) + 0.1 * np.linalg.norm(found[:3])
            fastest = max(fastest, speed)
        return fastest

    def until(self, end):
        steps = max(1, math.ceil((end - self.time) / self.step - 1e-9))
        began, dt = self.time, (end - self.time) / steps
        self.model.opt.timestep = dt
        for k in range(steps):
            if self.hand:
                self.hand.go(self.way, began + k * dt, dt)
            mujoco.mj_step(self.model, self.data)
        check_finite(self.data)
        mujoco.mj_forward(self.model, self.data)
        if np.any(self.data.xpos[self.kept, 2] < FALLEN):
            raise Failed("falls off the table")
        self.time = end

    def rest(self):
        began = moved = self.time
        while self.time - moved < STILL and self.time - began < PATIENCE:
            self.until(self.time + 0.01)
            if self.speed() > REST:
                moved = self.time

    def lever(self, k):
        lever, pose = self.blade(k)
        began, lift = self.time, []
        before = self.edge(k)
        self.hand = Hand(self, f"blade/{k}")
        self.way = lambda time: pose(time - began)
        count = round(lever["frames"])
        for frame in range(1, count + 1):
            self.until(began + lever["turn"] * frame / count)
            lift.append(self.pose())
        self.raised[self.levered(k)] = self.edge(k, before[0])[1][2] - before[1][2]
        self.until(began + lever["turn"] + lever["hold"] + lever["retreat"] / lever["speed"])
        self.rest()
        self.hand.away()
        self.hand = None
        return lift

    def levered(self, k):
        """Returns the plate that step k levers."""
        name = self.texts.get(f"plate {k}")
        return self.model.body(name).id if name else self.plate

    def edge(self, k, local=None):
        """Returns the lever point in the plate's frame and in the world."""
        mujoco.mj_forward(self.model, self.data)
        plate = self.levered(k)
        at, turn = self.data.xpos[plate].copy(), self.data.xquat[plate].copy()
        if local is None:
            back = turn * np.array([1, -1, -1, -1])
            local = rotated(np.array(self.numbers[f"frame {k}"][:3]) - at, back)
        return local, at + rotated(local, turn)

    def pushes(self, k):
        lift, *strokes = self.numbers[f"pushes {k}"]
        for first in range(0, len(strokes), 8):
            start, end = (
                np.array(strokes[first : first + 3]),
                np.array(strokes[first + 3 : first + 6]),
            )
            duration, settle = strokes[first + 6 : first + 8]
            began = self.time

            def pose(time):
                x, y, heading = start + (end - start) * min((time - began) / duration, 1)
                return [x, y, lift], [math.cos(heading / 2), 0, 0, math.sin(heading / 2)]

            self.hand, self.way = Hand(self, f"tool/{k}"), pose
            self.until(began + duration)
            if settle:
                self.hand.away()
                self.hand = None
                self.rest()

    def run(self):
        lift, failure = [], None
        try:
            for k, kind in self.steps:
                if kind == "lever":
                    lift = self.lever(k)
                else:
                    self.pushes(k)
        except Failed as failed:
            failure = str(failed)
        if failure is None and "goals" in self.texts and not all_judged(self, self.texts)[0]:
            failure = "misses the goal"
        found = {"lift": lift, "rest": self.pose(), "reached": failure is None, "failure": failure}
        return {**found, "mujoco": mujoco.__version__, "timestep": self.step}

    def seen(self, name, frame=None):
        """Returns x, y and heading of an object in the world, or in the frame of another object."""
        body = self.data.body(f"plate/{name}")
        pose = [*body.xpos[:2].tolist(), math.atan2(body.xmat[3], body.xmat[0])]
        return pose if frame is None else seen(pose, self.seen(frame))

    def has_left(self, name):
        """Returns `True` if an object has fallen off the table."""
        return self.data.body(f"plate/{name}").xpos[2] < 0.0

    def lifted(self, name):
        """Returns how far a lever-up has lifted the edge of an object, metres."""
        return self.raised.get(self.model.body(f"plate/{name}").id, 0.0)

    def leaning(self, name):
        """Returns the angle between an object's upper side and the vertical, radians."""
        return math.acos(max(-1.0, min(1.0, float(self.data.body(f"plate/{name}").xmat[8]))))


def far(one, other):
    """Returns distance in millimetres and angle in degrees between two poses."""
    cosine = abs(np.dot(one[3:], other[3:]))
    return 1e3 * math.dist(one[:3], other[:3]), 2 * math.degrees(math.acos(min(1, cosine)))


def main():
    parser = argparse.ArgumentParser(description="Replays lever-ups in MuJoCo.")
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("--played", metavar="FILE", help="results of earlier replays")
    parser.add_argument("--against", metavar="FILE", help="results of pushplan for the same scenes")
    arguments = parser.parse_args()
    ours = {}
    if arguments.against:
        with open(arguments.against) as lines:
            ours = {line["scene"]: line for line in map(json.loads, lines)}
    played = []
    if arguments.played:
        with open(arguments.played) as lines:
            played = [json.loads(line) for line in lines]
    for path in arguments.scenes:
        played.append({"scene": path, **decided(lambda finer: Scene(path, finer).run())})
        print(json.dumps(played[-1]), flush=True)
    differences = []
    for found in played:
        if (other := ours.get(os.path.basename(found["scene"]))) and found["lift"]:
            end, rest = far(found["lift"][-1], other["lift"][-1]), far(found["rest"], other["rest"])
            squares = [far(*pair)[0] ** 2 for pair in zip(found["lift"], other["lift"])]
            differences.append([math.sqrt(statistics.mean(squares)), *end, rest[0]])
    if differences:
        middle = [statistics.median(column) for column in zip(*differences)]
        print(
            "{} lever-ups, median differences: during the rotation {:.2f} mm, at its end {:.2f} mm "
            "and "
            "{:.2f} degrees, at rest {:.2f} mm".format(len(differences), *middle),
            file=sys.stderr,
        )
    return 0
