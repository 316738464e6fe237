#!/usr/bin/env python3
"""Runs tasks in hidden worlds of 15 kinds that break a rule, hold a joint or exchange objects.

    python3 crates/lab/benches/broken_worlds.py --out worlds --run target/release/pushplan

The true states are read from the saved run. An answer is wrong if it is "reached" (exit code 0)
while a goal is missed, a kept object was moved, or an object is in a region that it must not enter,
each by a margin of 3 mm or 2 degrees. Every other answer is accepted. `--fair` runs the same tasks
in worlds as they state, and there an answer other than "reached" counts as wrong. Lengths are in
metres, masses in kilograms. Only Python is needed. The exit code is 0 if no answer is wrong.
"""

import itertools
import json
import math
import subprocess
import sys

from drawn import Draw, chosen, counts, num, parser

NOISE = "noise: {position: 0.0005, heading_deg: 0.2}"
POSITION, HEADING = 0.003, math.radians(2.0)


class World(Draw):
    """A task with a hidden world, and the conditions for the true states after a run."""

    def __init__(self, seed):
        super().__init__(seed)
        self.robot = "reach: {min: 0.1, max: 0.9}"
        self.tools, self.pushes = "[finger, paddle]", "max_count: 2, directions: 8"
        self.world, self.changed, self.wanted, self.areas = [], [], [], []
        self.radius = {}

    def can(self, x, y, r, height=0.08, name="can", mass=None):
        self.radius[name] = r
        super().can(x, y, r, height, name, mass)

    def region(self, x, y, a, b):
        """Adds a rectangle that no object may enter."""
        self.strip(x, y, a, b, ["objects"])
        self.areas.append((x, y, a / 2, b / 2))

    def joined(self, a, b, kind, more=""):
        self.world.append(f"{{between: [{a}, {b}], kind: {kind}{more}}}")

    def want(self, name, x, y, tolerance=0.02):
        self.goal(x, y, tolerance, name)
        self.wanted.append((name, "position", (x, y), tolerance))

    def want_joint(self, name, key, goal, tolerance, axis=None):
        limit = "heading_tolerance_deg" if axis is None else "tolerance"
        self.goals.append(f"{{object: {name}, {key}: {num(goal)}, {limit}: {num(tolerance)}}}")
        kind = "turn" if axis is None else "slide"
        self.wanted.append((name, kind, (goal, axis), tolerance))

    def world_text(self, fair):
        lines = [NOISE, f"seed: {self.rng.randrange(1000)}"]
        if self.world and not fair:
            lines.append(f"joints: [{', '.join(self.world)}]")
        if self.changed and not fair:
            lines.append(f"objects: [{', '.join(self.changed)}]")
        return "\n".join([*lines, ""])


def beside(d, name="vase", gap=(0.0, 0.012)):
    """A can that is pushed forward, and another object beside it."""
    r, other, side = d.u(0.035, 0.045), d.u(0.025, 0.035), d.rng.choice([-1, 1])
    d.can(0.5, 0.0, r, mass=0.4)
    y = side * (r + other + 0.002 + d.u(*gap))
    d.can(0.5, y, other, 0.1, name, 0.4)
    return r, y


def kept_is_fixed_to_the_can(d):
    beside(d)
    d.want("can", 0.5 + d.u(0.08, 0.14), 0.0)
    d.joined("can", "vase", "fixed")
    d.kept.append("vase")


def kept_is_hinged_to_the_can(d):
    r, y = beside(d)
    d.want("can", 0.5 + d.u(0.1, 0.14), 0.0)
    d.joined("can", "vase", "revolute", f", at: [0.5, {num(math.copysign(r, y))}]")
    d.kept.append("vase")


def kept_is_joined_through_a_third(d):
    _, y = beside(d, "link")
    d.can(0.5, y + math.copysign(0.075, y), 0.03, 0.12, "vase", 0.4)
    d.want("can", 0.5 + d.u(0.08, 0.14), 0.0)
    d.joined("can", "link", "fixed")
    d.joined("link", "vase", "fixed")
    d.kept.append("vase")


def kept_falls_with_the_can(d):
    _, y = beside(d)
    d.objects[:] = [one.replace("[0.5, ", "[0.55, ") for one in d.objects]
    d.table = "friction: 0.4, size: [0.5, 0.4], position: [0.5, 0]"
    d.goals.append(f"{{object: can, off_table: {'left' if y < 0 else 'right'}}}")
    d.joined("can", "vase", "fixed")
    d.kept.append("vase")


def light_and_slippery_kept(d):
    """A box far heavier than stated turns on its way and touches a vase that slides easily."""
    a, side = d.u(0.1, 0.13), d.rng.choice([-1, 1])
    d.box(0.45, 0.0, a, 0.06, mass=0.4, yaw=d.u(-10, 10))
    d.can(0.45 + d.u(0.11, 0.15), side * d.u(0.066, 0.075), 0.03, 0.1, "vase", 0.3)
    d.want("can", 0.45 + d.u(0.2, 0.26), 0.0)
    d.changed.append(f"{{name: can, mass: {num(d.u(3, 8))}, support: corners}}")
    d.changed.append("{name: vase, mass: 0.1, friction: 0.05}")
    d.kept.append("vase")


def partner_swings_into_a_region(d):
    r, y = beside(d, "cup")
    way = d.u(0.1, 0.14)
    d.want("can", 0.5 + way, 0.0)
    d.joined("can", "cup", "fixed")
    d.region(0.55 + way, math.copysign(r + 0.06, y), 2 * way, 0.09)


def can_pulled_into_a_region(d):
    """The can turns about a hidden pin, into a region beside its way."""
    r, side = d.u(0.035, 0.045), d.rng.choice([-1, 1])
    d.can(0.5, 0.0, r, mass=0.4)
    d.want("can", 0.62, side * 0.01)
    d.joined("can", "world", "revolute", f", at: [0.5, {num(side * 0.1)}]")
    d.region(0.59, side * (r + 0.03), 0.06, 0.02)


def door(d):
    """A door on a hinge of the world, or of a cabinet; returns what holds it and its limits."""
    side, goal = d.rng.choice([-1, 1]), d.u(40, 65)
    d.box(0.6, side * 0.125, 0.02, 0.24, 0.15, "door", d.u(0.8, 1.5))
    holder = d.rng.choice(["world", "wall-0"])
    if holder == "wall-0":
        d.wall(0.6, side * -0.05, 0.08, 0.06)
    limits = f", limits_deg: [{'-5, 110' if side < 0 else '-110, 5'}]"
    hinge = ", at: [0.6, 0]"
    d.joints.append(f"{{between: [{holder}, door], kind: revolute{hinge}{limits}}}")
    d.want_joint("door", "joint_deg", -side * goal, 8)
    return holder, hinge, limits, side


def stuck_door(d):
    holder, *_ = door(d)
    d.joined(holder, "door", "fixed")


def short_door(d):
    holder, hinge, _, side = door(d)
    stop = d.u(10, 25)
    low, high = (-2, stop) if side < 0 else (-stop, 2)
    d.joined(holder, "door", "revolute", f"{hinge}, limits_deg: [{num(low)}, {num(high)}]")


def other_hinge(d):
    holder, _, limits, side = door(d)
    limits = ", limits_deg: [-20, 20]"
    d.joined(holder, "door", "revolute", f", at: [0.6, {num(side * 0.24)}]{limits}")


def springy_door(d):
    holder, hinge, limits, _ = door(d)
    d.joined(holder, "door", "revolute", f"{hinge}{limits}, spring: {num(d.u(0.5, 2.0))}")


def drawer(d):
    """A drawer, pushed shut: stuck, with a shorter travel, or on a spring."""
    goal = d.u(0.06, 0.1)
    d.box(0.55, 0.0, 0.14, 0.2, 0.1, "drawer", d.u(0.6, 1.2))
    for sign in (-1, 1):
        d.wall(0.6, sign * 0.125, 0.3, 0.03)
    slide = ", axis: [1, 0]"
    d.joints.append(
        f"{{between: [world, drawer], kind: prismatic{slide}, limits: [-0.02, 0.15]}}"
    )
    d.want_joint("drawer", "joint", goal, 0.012, axis=(1, 0))
    which = d.rng.randrange(3)
    if which == 0:
        d.joined("world", "drawer", "fixed")
        return
    end = 0.15 if which == 2 else num(d.u(0.01, 0.03))
    spring = f", spring: {num(d.u(40, 90))}" if which == 2 else ""
    d.joined("world", "drawer", "prismatic", f"{slide}, limits: [-0.02, {end}]{spring}")


def exchanged(d, shape, mass):
    """Two objects stand in each other's places."""
    y = d.rng.choice([-1, 1]) * d.u(0.18, 0.24)
    d.can(0.5, 0.0, 0.04, mass=0.4)
    d.thing("other", shape, 0.5, y, 0.0, mass)
    d.want("can", 0.5 + d.u(0.08, 0.12), d.u(-0.03, 0.03))
    d.changed += [f"{{name: can, position: [0.5, {num(y)}]}}", "{name: other, position: [0.5, 0]}"]


def unlike_exchanged(d):
    shapes = ["cuboid: {size: [0.07, 0.07, 0.09]}", "cylinder: {radius: 0.028, height: 0.12}"]
    exchanged(d, d.rng.choice(shapes), d.u(0.3, 0.5))


def unlike_masses_exchanged(d):
    exchanged(d, "cylinder: {radius: 0.04, height: 0.08}", d.u(1.2, 3.0))


def unlike_roles_exchanged(d):
    """One of two like cans must stay."""
    exchanged(d, "cylinder: {radius: 0.04, height: 0.08}", 0.4)
    d.kept.append("other")


KINDS = [
    kept_is_fixed_to_the_can,
    kept_is_hinged_to_the_can,
    kept_is_joined_through_a_third,
    kept_falls_with_the_can,
    light_and_slippery_kept,
    partner_swings_into_a_region,
    can_pulled_into_a_region,
    stuck_door,
    short_door,
    other_hinge,
    springy_door,
    drawer,
    unlike_exchanged,
    unlike_masses_exchanged,
    unlike_roles_exchanged,
]


def faults(d, trace):
    """Returns the faults in the true states of a run."""
    names = [one["name"] for one in trace["task"]["scene"]["objects"]]
    states = [trace["before"]] + [step["world"] for step in trace["steps"]]
    poses = [dict(zip(names, state["state"]["poses"])) for state in states]
    found = []
    for name, kind, goal, tolerance in d.wanted:
        first, last = poses[0][name], poses[-1][name]
        way = [b - a for a, b in zip(first["position"], last["position"])]
        if kind == "position":
            off = math.dist(last["position"], goal) - tolerance - POSITION
        elif kind == "slide":
            off = abs(sum(a * b for a, b in zip(way, goal[1])) - goal[0]) - tolerance - POSITION
        else:
            turn = last["heading"] - first["heading"] - math.radians(goal[0])
            off = abs(math.remainder(turn, math.tau)) - math.radians(tolerance) - HEADING
        if off > 0:
            found.append(f"{name} misses its goal")
    for name in d.kept:
        far = max(math.dist(poses[0][name]["position"], one[name]["position"]) for one in poses)
        if far > 0.005 + POSITION:
            found.append(f"{name} was moved by {1000 * far:.0f} mm")
    for (x, y, a, b), pose in itertools.product(d.areas, poses[1:]):
        for name, one in pose.items():
            out = [abs(p - q) - h for p, q, h in zip(one["position"], (x, y), (a, b))]
            if math.hypot(*(max(0.0, far) for far in out)) < d.radius.get(name, 0.0) - POSITION:
                found.append(f"{name} was in the region")
    return list(dict.fromkeys(found))


def main():
    options = parser(__doc__, count=4)
    options.add_argument("--fair", action="store_true", help="worlds as the tasks state them")
    options.add_argument("--run", help="path of the program; default none")
    arguments = options.parse_args()
    wrong, tried = 0, 0
    for name, kind in chosen(KINDS, arguments):
        codes = []
        for k in range(arguments.count):
            draw = World(f"{arguments.seed} {name} {k}")
            kind(draw)
            draw.more.append("unknown: [masses, frictions]")
            path = arguments.out / f"{name}-{k:02}.yaml"
            draw.files[f"{path.stem}.world.yaml"] = draw.world_text(arguments.fair)
            draw.write(path)
            if not arguments.run:
                continue
            command = [arguments.run, "run", path, "--world", path.with_suffix(".world.yaml")]
            command += ["--out", path.parent / "runs"]
            command += ["--samples", "8", "--quiet", "--threads", "1"]
            done = subprocess.run(command, capture_output=True, text=True)
            codes.append(done.returncode)
            found = []
            if done.returncode == 0:
                trace = path.parent / "runs" / f"{path.stem}.run.json"
                found = faults(draw, json.loads(trace.read_text()))
            elif arguments.fair:
                found = [(done.stdout + done.stderr).splitlines()[0]]
            if found:
                wrong += 1
                print(f"  {path.name}: {', '.join(found)}", flush=True)
        tried += len(codes)
        if arguments.run:
            print(f"{name}: {counts(codes)}".replace("solved", "reached"), flush=True)
    if arguments.run:
        print(f"{wrong} of {tried} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
