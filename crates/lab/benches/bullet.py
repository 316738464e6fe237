#!/usr/bin/env python3
"""Records perturbed pushes of plans in Bullet, an engine that was not used in training.

    crates/lab/benches/mujoco OUT 300 7
    pip install pybullet
    python3 crates/lab/benches/bullet.py OUT --out bullet
    pushplan predict bullet

The first push of every plan with one object is executed, shifted sideways and back by random
distances, so that it differs from the choice of the model. Obstacles are omitted. Objects stand on
the feet of the MuJoCo export, and tools move at the speed of the push against any resistance.
Lengths are in metres, times in seconds.
"""

import argparse
import json
import math
import random
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

import pybullet as bullet

STEP = 1 / 960
FRAME = 0.1
# Heavy relative to all objects; the velocity of the tool is also set anew in every step.
TOOL_MASS = 1e4


def numbers(text):
    return [float(word) for word in text.split()]


def body(mass, solids, position, heading, friction, group, mask):
    """Creates a rigid body of several solids with its own collision group."""
    one = bullet.createMultiBody(
        mass, basePosition=position, baseOrientation=bullet.getQuaternionFromEuler([0, 0, heading]),
        baseCollisionShapeIndex=compound(solids))
    bullet.changeDynamics(
        one,
        -1,
        lateralFriction=friction,
        spinningFriction=0,
        rollingFriction=0,
        restitution=0,
        linearDamping=0,
        angularDamping=0,
        activationState=bullet.ACTIVATION_STATE_DISABLE_SLEEPING,
    )
    bullet.setCollisionFilterGroupMask(one, -1, group, mask)
    return one


def compound(solids):
    kinds, sizes, radii, lengths, places, turns = zip(*solids)
    return bullet.createCollisionShapeArray(
        shapeTypes=list(kinds), halfExtents=list(sizes), radii=list(radii), lengths=list(lengths),
        collisionFramePositions=list(places), collisionFrameOrientations=list(turns))


def solid_box(half, at=(0, 0, 0), heading=0.0):
    return bullet.GEOM_BOX, half, 0, 0, at, bullet.getQuaternionFromEuler([0, 0, heading])


def solid_round(kind, radius, length, at=(0, 0, 0)):
    return kind, [0, 0, 0], radius, length, at, [0, 0, 0, 1]


class Push:
    """A push of an object by a tool."""

    def __init__(self, plan, scene, rng):
        document, root = json.loads(plan.read_text()), xml.parse(scene).getroot()
        self.object = document["task"]["scene"]["objects"][0]
        self.tool, self.push = document["tools"][0], document["plan"]["steps"][0]["push"]
        self.table = document["task"]["scene"]["table"].get("friction", 0.5)
        self.body = root.find(f".//body[@name='object/{self.object['name']}']")
        # Range of the draw: up to 15 mm aside, up to 20 mm back.
        ahead = [math.cos(self.push["direction"]), math.sin(self.push["direction"])]
        aside, behind = rng.uniform(-0.015, 0.015), rng.uniform(0.0, 0.02)
        start = self.push["start"]
        self.start = [
            start[0] - behind * ahead[0] - aside * ahead[1],
            start[1] - behind * ahead[1] + aside * ahead[0],
        ]
        self.ahead, self.length = ahead, self.push["length"] + behind

    def frame(self, travelled):
        """Returns the tool frame at a distance along the push."""
        grip = self.tool.get("grip", {"position": [0, 0], "yaw_deg": 0})
        heading = self.push["grip_yaw"] - math.radians(grip.get("yaw_deg", 0))
        c, s = math.cos(heading), math.sin(heading)
        x, y = grip["position"]
        at = [p + travelled * a for p, a in zip(self.start, self.ahead)]
        return [at[0] - (c * x - s * y), at[1] - (s * x + c * y), heading]

    def solids(self):
        found = []
        for geom in self.body.findall("geom"):
            at = numbers(geom.get("pos"))
            if geom.get("class") == "foot":
                found.append(solid_round(bullet.GEOM_SPHERE, 0.001, 0, at))
            elif geom.get("type") == "box":
                found.append(solid_box(numbers(geom.get("size")), at))
            elif geom.get("type") == "cylinder":
                radius, half = numbers(geom.get("size"))
                found.append(solid_round(bullet.GEOM_CYLINDER, radius, 2 * half, at))
            else:
                raise ValueError("only boxes and cylinders are supported")
        return found

    def play(self):
        bullet.resetSimulation()
        bullet.setGravity(0, 0, -9.81)
        bullet.setPhysicsEngineParameter(
            fixedTimeStep=STEP,
            numSolverIterations=200,
            enableConeFriction=1,
            solverResidualThreshold=0,
        )
        friction = self.object["friction"]
        pair = lambda other: 0.5 * (friction + other)
        # Bullet multiplies the friction values of two bodies; the object's value is one.
        plane = bullet.createMultiBody(0, bullet.createCollisionShape(bullet.GEOM_PLANE))
        bullet.changeDynamics(plane, -1, lateralFriction=pair(self.table), restitution=0)
        bullet.setCollisionFilterGroupMask(plane, -1, 1, 2)
        mass, solids = self.object["mass"], self.solids()
        pose = self.body.get("pos"), self.body.get("euler", "0 0 0")
        position, heading = numbers(pose[0]), numbers(pose[1])[2]
        thing = body(mass, solids, position, heading, 1.0, 2, 1 | 4)
        bullet.changeDynamics(thing, -1, localInertiaDiagonal=self.inertia(mass))
        lift = self.push["lift"]
        parts = []
        for part in self.tool["parts"]:
            x, y, *_ = part["position"]
            size = part["size"]
            parts.append(
                solid_box(
                    [0.5 * side for side in size],
                    [x, y, 0.5 * size[2]],
                    math.radians(part.get("yaw_deg", 0)),
                )
            )
        x, y, turn = self.frame(0.0)
        tool = body(TOOL_MASS, parts, [x, y, lift], turn, pair(self.tool["friction"]), 4, 2)
        bullet.changeDynamics(tool, -1, localInertiaDiagonal=[TOOL_MASS] * 3)
        if bullet.getClosestPoints(thing, tool, 0.001):
            raise ValueError("the tool would be set down on the object")
        speed = self.push["speed"]
        steps = math.ceil(self.length / speed / STEP)
        frames, rest = [], 0
        for step in range(steps + round(1.0 / STEP)):
            travelled = min(step * speed * STEP, self.length)
            x, y, turn = self.frame(travelled)
            if step % round(FRAME / STEP) == 0:
                at, rotation = bullet.getBasePositionAndOrientation(thing)
                yaw = math.degrees(bullet.getEulerFromQuaternion(rotation)[2])
                frames.append(
                    {"pusher": [x, y, math.degrees(turn)], "objects": [[at[0], at[1], yaw]]}
                )
            bullet.resetBasePositionAndOrientation(
                tool, [x, y, lift], bullet.getQuaternionFromEuler([0, 0, turn])
            )
            moves = speed if step < steps else 0.0
            bullet.resetBaseVelocity(
                tool, [moves * self.ahead[0], moves * self.ahead[1], 9.81 * STEP], [0, 0, 0]
            )
            bullet.stepSimulation()
        at, rotation = bullet.getBasePositionAndOrientation(thing)
        if at[2] < 0.8 * position[2] or at[2] > 1.2 * position[2]:
            raise ValueError("the object fell over")
        return self.recording(frames)

    def inertia(self, mass):
        shape = self.object["shape"]
        if "cylinder" in shape:
            radius, height = shape["cylinder"]["radius"], shape["cylinder"]["height"]
            across = mass * (3 * radius**2 + height**2) / 12
            return [across, across, 0.5 * mass * radius**2]
        x, y, z = shape["cuboid"]["size"]
        return [
            mass * (y * y + z * z) / 12,
            mass * (x * x + z * z) / 12,
            mass * (x * x + y * y) / 12,
        ]

    def recording(self, frames):
        thing = {
            key: self.object[key]
            for key in ("name", "shape", "mass", "friction", "support")
            if key in self.object
        }
        return {
            "schema_version": 1, "kind": "recording", "frame_time": FRAME,
            "scene": {"table": {"friction": self.table}, "objects": [thing]},
            "pusher": {"tool": self.tool, "lift": self.push["lift"]}, "frames": frames,
        }


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument(
        "folder", type=Path, help="folder with `plans` and `scenes`, written by `mujoco`"
    )
    parser.add_argument("--out", type=Path, required=True, help="folder of the recordings")
    parser.add_argument("--seed", type=int, default=1, help="seed of all random draws; default 1")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    bullet.connect(bullet.DIRECT)
    written = 0
    for scene in sorted((arguments.folder / "scenes").glob("*.xml")):
        plan = arguments.folder / "plans" / f"{scene.stem}.plan.json"
        if len(json.loads(plan.read_text())["task"]["scene"]["objects"]) != 1:
            continue
        try:
            recording = Push(plan, scene, random.Random(f"{arguments.seed} {scene.stem}")).play()
        except ValueError as why:
            print(f"{scene.stem}: {why}", file=sys.stderr)
            continue
        (arguments.out / f"{scene.stem}.recording.json").write_text(json.dumps(recording))
        written += 1
    print(f"{written} pushes recorded")


if __name__ == "__main__":
    main()
