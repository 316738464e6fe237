#!/usr/bin/env python3
"""Writes tasks of what people have: doors, drawers, compounds, regions, several goals, things in the way.

    python3 crates/lab/benches/everyday.py --out everyday --solve target/release/pushplan
    pushplan export everyday/plans/*.plan.json --out everyday/mjcf
    python3 everyday/mjcf/replay.py everyday/mjcf > everyday/mujoco.jsonl

All but those with things in the way can be solved: doors and drawers are asked for what their joints allow, and
the other goals are where pushes in the planar engine have brought things, so the program is needed to write them. A plan that is
not solved has another name (`.failed.plan.json` and so on): leave it out of the export. Lengths are in
metres, masses in kilograms, angles in degrees where a key says so. Files are JSON, which is YAML. Nothing but
Python is needed.
"""

import argparse
import json
import math
import random
import subprocess
import sys
from pathlib import Path

ROBOT = {"reach": {"min": 0.3, "max": 0.9}}
TOOLS = ["stick", "hook", "paddle", "t-head", "l-hook", "finger"]


class Retry(Exception):
    """These draws make no task; draw again."""


class Draw:
    """The random numbers of one task, and the program that says what pushes do."""

    def __init__(self, seed, program, folder):
        self.rng, self.program, self.folder = random.Random(seed), program, folder

    def u(self, low, high, digits=3):
        return round(self.rng.uniform(low, high), digits)

    def pushed(self, objects, moved):
        """Where `objects` are after each of `moved` has been pushed in some direction, in the plane."""
        goal = {"object": "o0", "position": [0.5, 0.0], "tolerance": 0.02}
        path = self.folder / "drawn.yaml"
        path.write_text(json.dumps(task({"objects": objects}, goal, len(objects))))
        command = [self.program, "predict", path, "--tool", self.rng.choice(TOOLS)]
        command += ["--model", "planar", "--alone", "--json", "--quiet"]
        for k in moved:
            command += ["--push", f"o{k}:{self.rng.choice([0, 90, -90, 180])}"]
        done = subprocess.run(command, capture_output=True, text=True)
        path.unlink()
        if done.returncode != 0:
            raise Retry
        effect = json.loads(done.stdout)["effects"][0]
        poses = effect["state"]["poses"]
        for k in moved:
            way = math.dist(poses[k]["position"], objects[k]["position"])
            if not (way > 0.06 and 0.35 < math.hypot(*poses[k]["position"]) < 0.85):
                raise Retry
        if effect["warnings"]:
            raise Retry
        return [{"position": [round(v, 4) for v in pose["position"]], "heading": pose["heading"]} for pose in poses]

    def solid(self, name):
        height = self.u(0.04, 0.1)
        if self.rng.random() < 0.5:
            shape = {"cylinder": {"radius": self.u(0.025, 0.05), "height": height}}
        else:
            shape = {"cuboid": {"size": [self.u(0.05, 0.12), self.u(0.05, 0.1), height]}}
        return {"name": name, "shape": shape, "mass": self.u(0.15, 1.0), "friction": self.u(0.3, 0.6)}

    def compound(self, name):
        """A mug, a T, an L, a dumb-bell or a tray with two rims."""
        kind, height = self.rng.choice(["mug", "tee", "ell", "bell", "tray"]), self.u(0.04, 0.1)
        box = lambda x, y, z=height: {"cuboid": {"size": [x, y, z]}}
        can = lambda radius: {"cylinder": {"radius": radius, "height": height}}
        part = lambda shape, x, y=0.0: {"shape": shape, "position": [round(x, 4), round(y, 4)]}
        if kind == "mug":
            radius, length = self.u(0.03, 0.045), self.u(0.02, 0.04)
            shape, parts = can(radius), [part(box(length, 0.015), radius + length / 2 - 0.003)]
        elif kind in ("tee", "ell"):
            long, wide, leg = self.u(0.1, 0.16), self.u(0.025, 0.04), self.u(0.05, 0.1)
            aside = 0.0 if kind == "tee" else (long - wide) / 2
            shape, parts = box(long, wide), [part(box(wide, leg), aside, -(wide + leg) / 2)]
        elif kind == "bell":
            radius, length = self.u(0.025, 0.04), self.u(0.06, 0.1)
            bar, end = part(box(length, 0.02), radius + length / 2 - 0.004), part(can(radius), 2 * radius + length - 0.008)
            shape, parts = can(radius), [bar, end]
        else:
            long, wide = self.u(0.1, 0.16), self.u(0.08, 0.12)
            shape = box(long, wide, 0.02)
            parts = [part(box(0.015, wide, 0.05), side * (long - 0.015) / 2) for side in (-1, 1)]
        return {"name": name, "shape": shape, "parts": parts, "mass": self.u(0.2, 0.9), "friction": self.u(0.3, 0.6)}

    def placed(self, objects):
        """Puts objects on the table, well apart."""
        for k, thing in enumerate(objects):
            places = ([self.u(0.42, 0.62), self.u(-0.22, 0.22)] for _ in range(200))
            clear = lambda at: all(math.dist(at, other["position"]) >= 0.22 for other in objects[:k])
            thing["position"] = next(filter(clear, places), None)
            if thing["position"] is None:
                raise Retry
            thing["yaw_deg"] = self.u(-180, 180, 1)
        return objects


def task(scene, goal, count=1):
    return {"scene": scene, "robot": ROBOT, "tools": "all", "pushes": {"max_count": 4 if count > 1 else 3}, "goal": goal}


def wrapped(heading):
    return round((math.degrees(heading) + 180) % 360 - 180, 2)


def doors(d):
    """A door that stands ajar before its cabinet, to be opened farther or nearly shut."""
    width, front, middle = d.u(0.20, 0.34), d.u(0.59, 0.72), d.u(-0.15, 0.15)
    side = d.rng.choice([-1, 1])  # On which side of the cabinet's middle its hinge is not.
    ajar = d.u(20, 45, 1)
    yaw = round(90 * side + side * ajar, 3)  # From shut, along the cabinet, towards the robot.
    c, s = math.cos(math.radians(yaw)), math.sin(math.radians(yaw))
    hinge = [front, round(middle - side * width / 2, 4)]
    limits = sorted([-side * (ajar - 1), side * (105 - ajar)])
    turn = side * d.u(25, 60, 1) if d.rng.random() < 0.7 else -side * (ajar - d.u(3, 10, 1))
    turn = round(min(max(turn, limits[0] + 2), limits[1] - 2), 1)
    door = {
        "name": "door", "shape": {"cuboid": {"size": [width, 0.02, 0.15]}}, "mass": d.u(0.8, 3.0), "friction": d.u(0.1, 0.4),
        "position": [round(hinge[0] + c * width / 2, 6), round(hinge[1] + s * width / 2, 6)], "yaw_deg": yaw,
    }
    joint = {"between": ["door", "cabinet"], "kind": "revolute", "at": hinge, "limits_deg": limits}
    cabinet = {"name": "cabinet", "size": [0.2, round(width + 0.06, 3), 0.15], "position": [round(front + 0.13, 3), middle]}
    scene = {"objects": [door], "joints": [joint], "obstacles": [cabinet]}
    return task(scene, {"object": "door", "joint_deg": turn, "heading_tolerance_deg": 5})


def drawers(d):
    """A drawer with a bar on a post, between walls or in a heavy cabinet that is free to move."""
    width, depth, x, y = d.u(0.14, 0.26), d.u(0.15, 0.22), d.u(0.66, 0.74), d.u(-0.2, 0.2)
    opens, free = d.rng.random() < 0.7, d.rng.random() < 0.25
    drawer = {
        "name": "drawer", "shape": {"cuboid": {"size": [depth, width, 0.1]}}, "mass": d.u(0.5, 2.5), "friction": d.u(0.1, 0.3),
        "position": [x, y],
        "parts": [
            {"name": "post", "shape": {"cuboid": {"size": [0.10, 0.02, 0.1]}}, "position": [round(-depth / 2 - 0.05, 4), 0]},
            {"name": "bar", "shape": {"cuboid": {"size": [0.02, round(0.8 * width, 3), 0.1]}}, "position": [round(-depth / 2 - 0.11, 4), 0]},
        ],
    }
    limits, shift = ([0, round(0.8 * depth, 3)], d.u(0.05, min(0.7 * depth, 0.15))) if opens else ([-0.1, 0.05], -d.u(0.04, 0.09))
    joint = {"kind": "prismatic", "axis": [-1, 0], "limits": limits}
    back = x + depth / 2 + (0.01 if opens else 0.12)
    scene = {"objects": [drawer], "obstacles": [], "joints": [joint]}
    if free:
        mass = d.u(10, 30)
        drawer["mass"] = round(mass / d.u(8, 18), 2)
        scene["objects"].append({
            "name": "cabinet", "shape": {"cuboid": {"size": [0.16, 0.2, 0.1]}}, "mass": mass, "friction": 0.6,
            "position": [round(back + 0.08, 3), y],
        })
        joint["between"] = ["cabinet", "drawer"]
    else:
        front = x - depth / 2 + 0.01
        for name, side in (("left", 1), ("right", -1)):
            middle = [round((front + back) / 2, 4), round(y + side * (width / 2 + 0.015), 4)]
            scene["obstacles"].append({"name": name, "size": [round(back - front, 4), 0.02, 0.12], "position": middle})
        joint["between"] = ["drawer", "world"]
    return task(scene, {"object": "drawer", "joint": shift, "tolerance": 0.015})


def compounds(d):
    objects = d.placed([d.compound("o0")])
    end = d.pushed(objects, [0])[0]
    goal = {"object": "o0", "position": end["position"], "tolerance": 0.02}
    return task({"objects": objects}, goal | {"heading_deg": wrapped(end["heading"]), "heading_tolerance_deg": 10})


def headings(d):
    objects = d.placed([d.rng.choice([d.compound, d.solid])("o0")])
    if "cylinder" in objects[0]["shape"] and "parts" not in objects[0]:
        raise Retry
    end = d.pushed(objects, [0])[0]
    if abs(math.degrees(end["heading"]) - objects[0]["yaw_deg"]) < 15:
        raise Retry
    return task({"objects": objects}, {"object": "o0", "heading_deg": wrapped(end["heading"]), "heading_tolerance_deg": 5})


def regions(d):
    objects = d.placed([d.solid("o0")])
    x, y = d.pushed(objects, [0])[0]["position"]
    rectangle = {"rectangle": {"size": [d.u(0.1, 0.2), d.u(0.08, 0.15)]}}
    triangle = {"polygon": {"corners": [[-0.08, -0.06], [0.08, -0.06], [0.0, 0.1]]}}
    area = d.rng.choice([rectangle, {"circle": {"radius": d.u(0.05, 0.08)}}, triangle])
    at = [round(x + d.u(-0.03, 0.03), 4), round(y + d.u(-0.02, 0.02), 4)]
    return task({"objects": objects}, {"object": "o0", "region": {"area": area, "position": at, "yaw_deg": d.u(-90, 90, 1)}})


def relative(d):
    objects = d.placed([d.solid("o0"), d.solid("o1")])
    # What is pushed may have pushed the other one.
    own, other = d.pushed(objects, [0])
    (x, y), (ox, oy), turn = own["position"], other["position"], other["heading"]
    c, s = math.cos(turn), math.sin(turn)
    at = [round(c * (x - ox) + s * (y - oy), 4), round(c * (y - oy) - s * (x - ox), 4)]
    return task({"objects": objects}, {"object": "o0", "relative_to": "o1", "position": at, "tolerance": 0.015}, 2)


def several(count):
    def goals(d):
        objects = d.placed([d.solid(f"o{k}") for k in range(count)])
        ends = d.pushed(objects, range(count))
        goals = [{"object": f"o{k}", "position": end["position"], "tolerance": 0.02} for k, end in enumerate(ends)]
        return task({"objects": objects}, goals, count)

    return goals


def aside(count):
    """A can, the place before a wall where it is to go, and crates there and before it."""

    def blocked(d):
        x, y = d.u(0.75, 0.86), d.u(-0.15, 0.15)
        can = d.solid("o0") | {"shape": {"cylinder": {"radius": d.u(0.03, 0.04), "height": 0.1}}}
        can["position"] = [d.u(0.53, 0.6), round(y + d.u(-0.12, 0.12), 3)]
        objects, placed, back = [can], [], round(x + 0.09, 3)
        for k in range(count):
            size = [d.u(0.06, 0.1), d.u(0.06, 0.11), 0.08]
            around = math.hypot(*size[:2]) / 2
            spread = [(-0.01, 0.01), (-0.02, 0.02)] if k == 0 else [(-0.16, 0.02), (-0.16, 0.16)]
            at = [round(centre + d.u(*span), 3) for centre, span in zip([x, y], spread)]
            near = any(math.dist(at, other) < around + room + 0.01 for other, room in placed)
            if near or at[0] + size[0] / 2 > back - 0.012 or math.dist(at, can["position"]) < around + 0.09:
                raise Retry
            placed.append((at, around))
            crate = {"name": f"o{k + 1}", "shape": {"cuboid": {"size": size}}, "mass": d.u(0.2, 0.8), "friction": 0.4}
            objects.append(crate | {"position": at})
        wall = {"name": "wall", "size": [0.02, 0.34, 0.1], "position": [back, y]}
        goal = {"object": "o0", "position": [x, y], "tolerance": 0.02}
        made = task({"objects": objects, "obstacles": [wall]}, goal)
        return made | {"pushes": {"length": 0.25, "max_count": count + 3}}

    return blocked


def two_tools(d):
    """What is beyond the hand's reach is pulled nearer by a hook, which does not fit between the rails of the puck."""
    side = d.rng.choice([-1, 1])
    far, y = d.u(0.82, 0.9), round(side * d.u(0.12, 0.2), 3)
    can = d.solid("o0") | {"shape": {"cylinder": {"radius": d.u(0.03, 0.045), "height": 0.1}}, "position": [far, y]}
    puck = d.solid("o1") | {"shape": {"cylinder": {"radius": d.u(0.02, 0.03), "height": 0.06}}}
    x, along = d.u(0.37, 0.4), round(-side * d.u(0.17, 0.22), 3)
    puck["position"] = [x, along]
    apart = puck["shape"]["cylinder"]["radius"] + d.u(0.008, 0.012) + 0.015
    rail = lambda name, at: {"name": name, "size": [0.3, 0.03, 0.06], "position": [0.42, round(along + at, 3)]}
    scene = {"objects": [can, puck], "obstacles": [rail("rail-1", apart), rail("rail-2", -apart)]}
    goals = [
        {"object": "o0", "position": [round(far - d.u(0.1, 0.17), 3), y], "tolerance": 0.025},
        {"object": "o1", "position": [round(x + d.u(0.1, 0.15), 3), along], "tolerance": 0.02},
    ]
    robot = {"reach": {"min": 0.3, "max": 0.62}}
    return task(scene, goals) | {"robot": robot, "tools": ["finger", "l-hook"], "pushes": {"max_count": 2}}


KINDS = {
    "door": doors, "drawer": drawers, "compound": compounds, "heading": headings, "region": regions, "relative": relative,
    "two-goals": several(2), "three-goals": several(3), "two-tools": two_tools,
    "one-aside": aside(1), "two-aside": aside(2), "three-aside": aside(3),
}


def drawn(seed, kind, k, program, folder):
    """The first task that the draws of this kind and number make."""
    for attempt in range(1000):
        try:
            return KINDS[kind](Draw(f"{seed} {kind} {k} {attempt}", program, folder))
        except Retry:
            pass
    sys.exit(f"no task of kind {kind} in 1000 draws: does `{program}` run?")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--out", type=Path, required=True, help="folder of the tasks")
    parser.add_argument("--solve", required=True, help="the program that is asked")
    parser.add_argument("--count", type=int, default=20, help="tasks of each kind; default 20")
    parser.add_argument("--seed", type=int, default=1, help="of all draws; default 1")
    parser.add_argument("--kind", action="append", choices=KINDS, help="these alone; default all")
    parser.add_argument("--effort", default="standard", help="how hard it tries; default standard")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    for kind in arguments.kind or KINDS:
        solved = 0
        for k in range(arguments.count):
            made = drawn(arguments.seed, kind, k, arguments.solve, arguments.out)
            path = arguments.out / f"{kind}-{k:02}.yaml"
            path.write_text(json.dumps(made, indent=1))
            command = [arguments.solve, "solve", path, "--effort", arguments.effort, "--quiet", "--threads", "1"]
            done = subprocess.run([*command, "--out", arguments.out / "plans"], capture_output=True, text=True)
            solved += done.returncode == 0
            if done.returncode != 0:
                print(f"  {path.name}: {(done.stdout or done.stderr).splitlines()[0]}", flush=True)
        print(f"{kind}: {solved} of {arguments.count} solved", flush=True)


if __name__ == "__main__":
    main()
