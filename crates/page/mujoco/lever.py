#!/usr/bin/env python3
"""Plays lever-ups of pushplan in MuJoCo and says where the plates come to.

    python3 lever.py SCENE.xml ... > results.jsonl
    python3 lever.py --against ours.jsonl --played results.jsonl

Needs Python 3.11 and `pip install mujoco`. A line of JSON for each scene: `lift`, the levered plate at
the end of each of equal times of the turn, and `rest`, as x, y, z and the quaternion w, x, y, z. With
`--against` (what `pushplan-learn generate --format mjcf` says of the same scenes) it ends with how far both are
from each other, on standard error; `--played` takes lines that were written before.
"""

import argparse
import json
import math
import os
import statistics
import sys

import mujoco
import numpy as np

REST = 1e-3  # slower than this, m/s, is at rest
STILL = 0.1  # for so long, seconds
PATIENCE = 4.0  # and never waited for longer, seconds


def turned(a, b):
    """The quaternion of turn b, then a."""
    found = np.zeros(4)
    mujoco.mju_mulQuat(found, np.array(a), np.array(b))
    return found


def rotated(vector, quaternion):
    found = np.zeros(3)
    mujoco.mju_rotVecQuat(found, np.array(vector, dtype=float), np.array(quaternion))
    return found


class Lever:
    """One scene."""

    def __init__(self, path):
        self.model = mujoco.MjModel.from_xml_path(path)
        self.data = mujoco.MjData(self.model)
        self.numbers = {}
        for k in range(self.model.nnumeric):
            numeric = self.model.numeric(k)
            self.numbers[numeric.name] = numeric.data
        plate = next(n.removeprefix("levered ") for n in self.numbers if n.startswith("levered "))
        self.plate = self.model.body(plate).id
        joint = self.model.body("blade").jntadr[0]
        self.position = self.model.jnt_qposadr[joint]
        self.velocity = self.model.jnt_dofadr[joint]
        keys = "depth pivot angle turn hold retreat speed frames".split()
        self.lever = dict(zip(keys, self.numbers["lever"]))

    def blade(self, time):
        """Position and turn of the blade's centre."""
        lever, (length, thickness) = self.lever, self.numbers["blade"]
        angle = lever["angle"] * min(max(time / lever["turn"], 0), 1)
        way = (time - lever["turn"] - lever["hold"]) * lever["speed"]
        way = min(max(way, 0), lever["retreat"])
        angle = math.copysign(angle, lever["pivot"])
        turn = [math.cos(angle / 2), 0, math.sin(angle / 2), 0]
        pivot = np.array([lever["pivot"], 0, 0])
        middle = np.array([lever["depth"] - length / 2, 0, -thickness / 2])
        at = pivot + rotated(middle - pivot, turn) - rotated([way, 0, 0], turn)
        frame, frame_turn = self.numbers["frame"][:3], self.numbers["frame"][3:]
        return frame + rotated(at, frame_turn), turned(frame_turn, turn)

    def step(self, time, dt):
        """One step from `time`."""
        (at, turn), (later, after) = self.blade(time), self.blade(time + dt)
        if np.dot(turn, after) < 0:
            after = -after
        spin = np.zeros(3)
        mujoco.mju_subQuat(spin, after, turn)
        self.data.qpos[self.position : self.position + 7] = [*at, *turn]
        self.data.qvel[self.velocity : self.velocity + 6] = [*((later - at) / dt), *(spin / dt)]
        mujoco.mj_step(self.model, self.data)

    def pose(self):
        return [*self.data.xpos[self.plate].tolist(), *self.data.xquat[self.plate].tolist()]

    def speed(self):
        found = np.zeros(6)
        mujoco.mj_objectVelocity(
            self.model, self.data, mujoco.mjtObj.mjOBJ_BODY, self.plate, found, 0
        )
        return np.linalg.norm(found[3:]) + 0.1 * np.linalg.norm(found[:3])

    def until(self, time, end):
        steps = max(1, math.ceil((end - time) / STEP - 1e-9))
        dt = (end - time) / steps
        self.model.opt.timestep = dt
        for k in range(steps):
            self.step(time + k * dt, dt)
        mujoco.mj_forward(self.model, self.data)
        return end

    def run(self):
        lever, time, lift = self.lever, 0.0, []
        count = round(lever["frames"])
        for k in range(1, count + 1):
            time = self.until(time, lever["turn"] * k / count)
            lift.append(self.pose())
        time = self.until(time, lever["turn"] + lever["hold"] + lever["retreat"] / lever["speed"])
        began, moved = time, time
        while time - moved < STILL and time - began < PATIENCE:
            time = self.until(time, time + 0.01)
            if self.speed() > REST:
                moved = time
        return {"lift": lift, "rest": self.pose()}


def apart(one, other):
    """Distance in millimetres and angle in degrees between two poses."""
    cosine = abs(np.dot(one[3:], other[3:]))
    return 1e3 * math.dist(one[:3], other[:3]), 2 * math.degrees(math.acos(min(1, cosine)))


parser = argparse.ArgumentParser(description="Plays lever-ups in MuJoCo.")
parser.add_argument("scenes", nargs="*", metavar="SCENE")
parser.add_argument("--played", metavar="FILE", help="scenes that have been played")
parser.add_argument("--against", metavar="FILE", help="their outcome in pushplan")
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
    scene = Lever(path)
    STEP = scene.model.opt.timestep
    played.append({"scene": path, **scene.run()})
    print(json.dumps(played[-1]), flush=True)
differences = []
for found in played:
    if other := ours.get(os.path.basename(found["scene"])):
        end, rest = apart(found["lift"][-1], other["lift"][-1]), apart(found["rest"], other["rest"])
        squares = [apart(*pair)[0] ** 2 for pair in zip(found["lift"], other["lift"])]
        differences.append([math.sqrt(statistics.mean(squares)), *end, rest[0]])
if differences:
    middle = [statistics.median(column) for column in zip(*differences)]
    print(
        "{} lever-ups, medians: over the turn {:.2f} mm, at its end {:.2f} mm and "
        "{:.2f} degrees, at rest {:.2f} mm".format(len(differences), *middle),
        file=sys.stderr,
    )
