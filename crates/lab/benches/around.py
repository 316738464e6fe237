#!/usr/bin/env python3
"""Writes tasks of 12 kinds with easy pushes, where the way to, between or from them is closed.

    python3 crates/lab/benches/around.py --out around --count 10 --seed 1
    python3 crates/lab/benches/around.py --out around --solve target/release/pushplan
    python3 crates/lab/benches/around.py --out around --solve target/release/pushplan --solvable

Each task is impossible by construction, with a margin of centimetres: a planner that solves one is
wrong. `--solvable` writes the twin of each task instead, in which the way is open: low walls, a
gap, a region elsewhere, a goal outside. A planner that does not solve one is too strict. Lengths
are in metres, masses in kilograms. Only Python is needed. The exit code is 0 if no answer is wrong.
"""

import math
import sys

from drawn import Draw, chosen, counts, num, solve, solver, table

SMALL = ["[finger]", "[finger, paddle]", "[finger, t-head]"]
SOME = [*SMALL, "[finger, stick]", "all"]


def high(d, ok):
    """Returns the height of a wall: above every lifted tool, or below it."""
    return d.u(0.06, 0.24) if ok else math.exp(d.u(math.log(0.45), math.log(3.0)))


def tall(d, ok):
    """Returns the height of an object that stands in the way, or that does not."""
    return d.u(0.06, 0.15) if ok else d.u(0.42, 0.6)


def free(d):
    """Draws tool, turn and reach, with a base that is stated or not."""
    d.turn, d.tools = d.u(-0.8, 0.8), d.rng.choice(SOME)
    d.robot = d.rng.choice(["reach: {min: 0.2, max: 0.95}", "reach: {max: 0.95}"])


def can_in_the_middle(d, x, mass=None):
    """Adds a can at `x` with a goal 8 to 11 cm away."""
    r, way, angle = d.u(0.025, 0.035), d.u(0.08, 0.11), d.u(0, math.tau)
    dx, dy = way / 2 * math.cos(angle), way / 2 * math.sin(angle)
    d.can(x - dx, -dy, r, mass=mass)
    d.goal(x + dx, dy)


def ring(d, x, inner, thick, height, mass, gap=0.002, without=None):
    """Adds movable posts around a square, three on each side; `without` leaves out one side."""
    part = (inner + 2 * thick) / 3
    for side in range(4):
        if side == without:
            continue
        c, s = [(1, 0), (0, 1), (-1, 0), (0, -1)][side]
        for k in (-1, 0, 1):
            along = k * part if c else k * (inner - gap) / 3
            at = x + c * (inner + thick) / 2 - s * along, s * (inner + thick) / 2 + c * along
            size = (part if c else (inner - gap) / 3) - gap
            d.box(*at, thick, size, height, f"post-{side}-{k + 1}", mass, 90 * side)


def row(d, x, thick, height, mass, without=None):
    """Adds movable slabs in a row that is longer than the reach; `without` leaves out one."""
    for k in range(-4, 4):
        if k != without:
            d.box(x, (k + 0.5) * 0.4, thick, 0.398, height, f"slab-{k + 4}", mass)


def pen_around_the_can(d, ok):
    free(d)
    size = d.u(0.36, 0.44)
    can_in_the_middle(d, 0.6)
    d.pen(0.6, 0.0, size, size, d.u(0.01, 0.03), high(d, ok))


def pen_around_home(d, ok):
    free(d)
    can_in_the_middle(d, 0.72)
    if d.rng.random() < 0.5:
        d.robot, size = "reach: {min: 0.16, max: 0.95}", d.u(0.22, 0.3)
        home, middle = turned_home(d, 0.36), 0.36
    else:
        d.robot, size = "reach: {min: 0.16, max: 0.95}", d.u(0.75, 0.9)
        home, middle = turned_home(d, d.u(0.2, 0.25)), 0.0
    d.robot = f"home: {home}, {d.robot}"
    d.pen(middle, 0.0, size, size, d.u(0.01, 0.03), high(d, ok))


def turned_home(d, x):
    return f"[{num(x * math.cos(d.turn))}, {num(x * math.sin(d.turn))}]"


def heavy_posts_around_the_can(d, ok):
    free(d)
    d.tools, d.robot = d.rng.choice(SMALL), d.robot + f", max_force: {num(d.u(20, 40))}"
    can_in_the_middle(d, 0.6, 0.8)
    ring(d, 0.6, d.u(0.38, 0.44), d.u(0.05, 0.08), tall(d, ok), d.u(40, 75))


def in_a_low_room(d, ok):
    """A room with a lid: closed, or open only at the far side, where no tool gets to."""
    d.turn, low, size = d.u(-0.8, 0.8), d.u(0.056, 0.1), d.u(0.36, 0.44)
    d.tools, closed = d.rng.choice(SOME), d.rng.random() < 0.6
    d.robot = "reach: {min: 0.2, max: " + ("0.95}" if closed else "0.6}")
    d.can(0.52, d.u(-0.03, 0.03), d.u(0.025, 0.035), 0.05)
    d.goal(0.6, 0.0)
    d.pen(0.56, 0.0, size, size, 0.02, low)
    x, y = (-0.4, 0.9) if ok else (0.56, 0.0)
    thick = d.u(0.01, 0.4) if closed else d.u(0.4, 0.6)
    d.wall(x, y, size + 0.04, size + 0.04, thick, z=low)
    if not closed:
        d.obstacles.pop(2)


def fence_across(d, ok):
    free(d)
    can_in_the_middle(d, 0.68)
    if ok and d.rng.random() < 0.5:
        d.wall(0.45, 0.0, d.u(0.01, 0.04), 0.5, high(d, False))
    else:
        d.wall(0.45, 0.0, d.u(0.01, 0.04), 3.4, high(d, ok))


def strips_around(d, ok):
    """A ring of regions around the can, or a region across the reach."""
    free(d)
    d.tools, kinds = "[finger]", d.rng.choice([["tool", "hand"], ["hand"], ["tool"]])
    can_in_the_middle(d, 0.6)
    size, wide = d.u(0.36, 0.42), d.u(0.04, 0.08)
    if d.rng.random() < 0.5:
        d.strip(0.38, 0.7 if ok else 0.0, wide, 0.4 if ok else 3.4, kinds)
        return
    sides = [(1, 0), (0, 1), (-1, 0), (0, -1)]
    if ok:
        sides.pop(d.rng.randrange(4))
    for c, s in sides:
        at = 0.6 + c * (size + wide) / 2, s * (size + wide) / 2
        d.strip(*at, wide, size + 2 * wide, kinds, 90 * abs(s))


def kept_in_the_way(d, ok):
    """A vase or a turnstile that stays fills the only gap, or the way of the only push."""
    r, which, d.tools = d.u(0.03, 0.04), d.rng.choice(["vase", "gate", "fan", "fan"]), "[finger]"
    d.can(0.45, 0.0, r)
    d.goal(0.68, 0.0)
    d.pushes = f"length: 0.3, directions: 8, max_count: {1 if which == 'fan' else 2}"
    d.kept.append("kept")
    x, y = (0.75, 0.4) if ok else (0.55, 0.0)
    if which == "vase":
        vase = d.u(0.03, 0.05)
        d.gap(0.55, 2 * vase + 2 * r * d.u(0.6, 1.4) + ok * 0.1)
        d.can(x, y, vase, d.u(0.08, 0.15), "kept")
        return
    long = d.u(0.12, 0.24) if which == "gate" else d.u(0.22, 0.3)
    if which == "gate":
        d.gap(0.55, long + r * d.u(0.3, 1.2))
    else:
        y += d.rng.choice([-1, 1]) * (long / 2 - d.u(0.02, 0.04))
    d.box(x, y, 0.03, long, 0.08, "kept", d.u(0.2, 0.6))
    d.joints.append(f"{{between: [kept, world], kind: revolute, at: [{num(x)}, {num(y)}]}}")


def goal_in_the_base(d, ok):
    d.turn, r = d.u(-0.8, 0.8), d.u(0.03, 0.045)
    d.tools = d.rng.choice(["[l-hook, finger]", "[hook, finger]", "[finger]"])
    d.robot = d.rng.choice(["reach: {max: 0.9}"] * 2 + ["base: 0.08, reach: {min: 0.14, max: 0.9}"])
    d.pushes = "length: 0.3, directions: 8, max_count: 2"
    d.can(d.u(0.4, 0.5), 0.0, r)
    d.goal(d.u(0.28, 0.3) if ok else d.u(0.0, 0.06), d.u(-0.03, 0.03))


def goal_in_the_foot(d, ok):
    """The root link of an arm, or a link that is fixed to it, stands on the table."""
    r, side = d.u(0.03, 0.045), d.rng.choice([-1, 1])
    edge, wide = d.u(0.24, 0.3), d.u(0.3, 0.4)
    shape = d.rng.choice(["box", "cylinder", "plinth"])
    if shape == "cylinder":
        solid = f'<cylinder radius="{num(edge)}" length="0.10"/>'
        origin = "0 0 0.05"
    else:
        solid = f'<box size="{num(edge + 0.1)} {num(wide)} 0.10"/>'
        origin = f"{num((edge - 0.1) / 2)} 0 0.05"
    text = f'<collision><origin xyz="{origin}"/><geometry>{solid}</geometry></collision>'
    root, plinth = (text, "") if shape != "plinth" else ("", text)
    d.files[f"{d.name}.urdf"] = ARM.format(root=root, plinth=plinth)
    d.robot = f"urdf: {d.name}.urdf, flange: hand, tool_mount: {{length: 0.10}}"
    d.tools, d.pushes = "[finger, l-hook]", "length: 0.12"
    away = edge + r + d.u(0.04, 0.05) if ok else edge + d.u(-0.01, 0.0)
    y = side * d.u(0.0, 0.06)
    d.can(edge + 0.13, y, r, 0.1)
    d.goal(away, y, 0.01)


ARM = """<robot name="desk-arm">
  <link name="base">{root}</link><link name="plinth">{plinth}</link>
  <joint name="screws" type="fixed"><parent link="base"/><child link="plinth"/></joint>
  <link name="turret"/><link name="upper"/><link name="fore"/><link name="wrist"/>
  <link name="twist"/><link name="hand"/>
  <joint name="pan" type="revolute"><parent link="base"/><child link="turret"/>
    <origin xyz="0 0 0.12"/><axis xyz="0 0 1"/>
    <limit lower="-2.8" upper="2.8" effort="10" velocity="3"/></joint>
  <joint name="lift" type="revolute"><parent link="turret"/><child link="upper"/>
    <origin xyz="0 0 0.05"/><axis xyz="0 1 0"/>
    <limit lower="-1.8" upper="1.8" effort="10" velocity="3"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/>
    <origin xyz="0 0 0.30"/><axis xyz="0 1 0"/>
    <limit lower="-2.6" upper="2.6" effort="10" velocity="3"/></joint>
  <joint name="turn" type="revolute"><parent link="fore"/><child link="twist"/>
    <origin xyz="0 0 0.14"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="10" velocity="3"/></joint>
  <joint name="flex" type="revolute"><parent link="twist"/><child link="wrist"/>
    <origin xyz="0 0 0.14"/><axis xyz="0 1 0"/>
    <limit lower="-2.6" upper="2.6" effort="10" velocity="3"/></joint>
  <joint name="roll" type="revolute"><parent link="wrist"/><child link="hand"/>
    <origin xyz="0 0 0.06"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="10" velocity="3"/></joint>
</robot>
"""


def tool_change_into_a_pen(d, ok):
    """A far can needs a hook, and a puck in a pen of high walls the finger."""
    side, height = d.rng.choice([-1, 1]), d.u(0.06, 0.1) if ok else high(d, ok)
    d.tools = f"[finger, {'l-hook' if side > 0 else 'inverse-l'}]"
    d.robot = "reach: {min: 0.3, max: 0.62}"
    d.pushes = "max_count: 2"
    x, y = d.u(0.84, 0.87), side * d.u(0.15, 0.18)
    d.can(x, y, 0.04, 0.1, mass=0.3)
    d.goal(x - d.u(0.14, 0.17), y, 0.025)
    start, y = d.u(0.38, 0.4), side * d.u(-0.22, -0.2)
    d.can(start, y, 0.025, 0.06, "puck", 0.2)
    d.goal(start + d.u(0.11, 0.13), y, 0.02, "puck")
    for x, wide in ((start - 0.135, 0.24), (start + 0.225, 0.24)):
        d.wall(x, y, 0.03, wide, height)
    for sign in (-1, 1):
        d.wall(start + 0.045, y + sign * 0.105, 0.33, 0.03, height)


def tall_row_across(d, ok):
    free(d)
    d.tools, d.robot = d.rng.choice(SMALL), d.robot + f", max_force: {num(d.u(20, 40))}"
    can_in_the_middle(d, 0.68, 0.8)
    gap = ok and d.rng.random() < 0.5
    d.tools = "[finger]" if gap else d.tools
    height, mass = tall(d, ok and not gap), d.u(50, 75)
    row(d, 0.45, d.u(0.05, 0.08), height, mass, d.rng.choice([-2, 1]) if gap else None)


def kept_tall_things(d, ok):
    """Light objects that stay, taller than a lifted tool: around the can, or in a row."""
    free(d)
    d.tools, height = "[finger]" if ok else d.rng.choice(SMALL), tall(d, False)
    around = d.rng.random() < 0.5
    can_in_the_middle(d, 0.6 if around else 0.68)
    if around:
        without = d.rng.randrange(4) if ok else None
        ring(d, 0.6, d.u(0.4, 0.44), d.u(0.05, 0.08), height, d.u(1, 4), without=without)
    else:
        row(d, 0.45, d.u(0.05, 0.08), height, d.u(2, 8), d.rng.choice([-2, 1]) if ok else None)
    d.kept = [one[7 : one.index(",")] for one in d.objects[1:]]


KINDS = [
    pen_around_the_can,
    pen_around_home,
    heavy_posts_around_the_can,
    in_a_low_room,
    fence_across,
    strips_around,
    kept_in_the_way,
    goal_in_the_base,
    goal_in_the_foot,
    tool_change_into_a_pen,
    tall_row_across,
    kept_tall_things,
]


def main():
    parser = solver(__doc__)
    parser.add_argument("--solvable", action="store_true", help="write the solvable twins")
    arguments = parser.parse_args()
    wrong, found = 0, {}
    for name, kind in chosen(KINDS, arguments):
        codes = found[name] = []
        for k in range(arguments.count):
            draw = Draw(f"{arguments.seed} {name} {k}")
            draw.name = f"{name}-{'open' if arguments.solvable else 'closed'}-{k:02}"
            kind(draw, arguments.solvable)
            path = arguments.out / f"{draw.name}.yaml"
            draw.write(path)
            if arguments.solve:
                code, text = solve(arguments.solve, path, "--effort", arguments.effort)
                codes.append(code)
                if (code == 0) != arguments.solvable:
                    wrong += 1
                    print(f"  {path.name}: {text.splitlines()[0]}", flush=True)
        if arguments.solve:
            print(f"{name}: {counts(codes)}", flush=True)
    if arguments.solve:
        print(f"{wrong} of {sum(map(len, found.values()))} wrong\n\n{table(found)}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
