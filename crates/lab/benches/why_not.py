#!/usr/bin/env python3
"""Writes tasks of 12 kinds that one limit keeps from having a plan, and asks for that cause.

    python3 crates/lab/benches/why_not.py --out why-not --count 10 --seed 1
    python3 crates/lab/benches/why_not.py --out why-not --solve target/release/pushplan

The answer must not be "solved", and its first cause must name the limit. Each task has a second
version in which the limit is widened as advised; it must be solved. The cause of a task without a
plan is in the first line; for a plan that fails, the verdict counts as well. Lengths are in metres,
masses in kilograms. Only Python is needed. The exit code is 0 if every cause is right and every
advice works.
"""

import re
import sys

from drawn import Draw, chosen, counts, num, solve, solver

THIN_STICK = """name: thin-stick
friction: 0.4
parts:
  - {name: bar, size: [0.25, 0.02, 0.05], position: [0.135, 0]}
"""


def hand(d, fixed):
    """A finger fits between two walls, and the hand above it does not."""
    r = d.u(0.025, 0.03)
    d.tools, d.robot = "[finger]", d.robot + (", hand: none" if fixed else "")
    d.can(0.5, 0.0, r)
    d.goal(0.5 + d.u(0.08, 0.13), 0.0)
    height = d.u(0.18, 0.25)
    for sign in (-1, 1):
        d.wall(0.55, sign * (r + d.u(0.008, 0.012) + 0.01), 0.6, 0.02, height)
    return r"\bhand\b"


def force(d, fixed):
    mass, share = d.u(15, 25), d.u(0.8, 1.5)
    d.box(0.5, 0.0, 0.12, 0.14, 0.12, "crate", mass)
    d.robot += f", max_force: {num(mass * (10 if fixed else share))}"
    d.tools = "[finger, paddle]"
    d.goal(0.62, d.u(-0.03, 0.03), 0.02, "crate")
    return r"\bforce\b|\d N\b"


def length(d, fixed):
    """Pushes so short that three of them are too few."""
    d.can(0.4, 0.0, 0.04)
    d.tools, allowed = "[finger, paddle]", d.u(0.06, 0.065)
    d.pushes = f"length: {num(0.4 if fixed else allowed)}, directions: 8, max_count: 1"
    d.goal(d.u(0.73, 0.75), d.u(-0.03, 0.03))
    return r"length|too short|mm are needed|one push"


def enclosed(d, fixed):
    size, d.tools = d.u(0.22, 0.28), "[finger]"
    d.can(0.52, d.u(-0.03, 0.03), d.u(0.03, 0.04))
    d.pen(0.52, 0.0, size, size, 0.015, d.u(0.09, 0.11))
    if fixed:
        d.obstacles.pop(2)
    d.goal(0.52 + size / 2 + 0.09, 0.0)
    return r"enclosed|surrounded|`wall-2`"


def clear(d, fixed):
    """Objects fill the end of a blind lane, in which the goal lies."""
    r, d.tools = d.u(0.03, 0.035), "[finger, paddle]"
    inner, end = 2 * r + 0.02, 0.72
    d.can(0.45, 0.0, r)
    d.goal(end - r - 0.01, 0.0, 0.015)
    for sign in (-1, 1):
        d.wall(0.63, sign * (inner / 2 + 0.01), 0.18, 0.02, 0.1)
    d.wall(end + 0.01, 0.0, 0.02, inner, 0.1)
    if not fixed:
        for k in range(d.rng.choice([1, 2])):
            d.box(end - 0.03 - 0.06 * k, 0.0, 0.05, inner - 0.01, 0.1, f"block-{k}", 0.8)
    return r"\bclear|block-0"


def far(d, fixed):
    """The longest tool ends 10 cm before the goal."""
    d.tools, d.robot = "[stick]", f"reach: {{min: 0.25, max: {1.3 if fixed else 0.8}}}"
    d.can(1.15, d.u(-0.05, 0.05), d.u(0.035, 0.05))
    d.pushes = "length: 0.4, directions: 8, max_count: 2"
    d.goal(d.u(1.56, 1.6), d.u(-0.05, 0.05), 0.03)
    return r"\bfar|reach"


def tool(d, fixed):
    d.tools = "[stick, l-hook]" if fixed else "[stick]"
    d.robot = "reach: {min: 0.3, max: 0.66}"
    d.can(d.u(0.8, 0.84), d.u(-0.08, 0.08), d.u(0.035, 0.05))
    d.goal(d.u(0.64, 0.68), 0.0, 0.03)
    return r"\btools?\b"


def edge(d, fixed):
    r, y = d.u(0.035, 0.045), d.u(-0.1, 0.1)
    size = "[1.6, 0.8], position: [0.9, 0]" if fixed else "[0.8, 0.8], position: [0.5, 0]"
    d.table += f", size: {size}"
    d.tools, d.robot = "[finger, paddle]", "reach: {min: 0.2, max: 0.95}"
    d.can(0.72, y, r)
    d.goal(0.9 - d.u(0.001, 0.002), y, 0.004)
    return r"\bedge\b"


def near(d, fixed):
    """A finger between two walls would have to come nearer to the base."""
    limit = d.u(0.5, 0.54)
    d.tools, d.robot = "[finger]", f"reach: {{min: {0.25 if fixed else num(limit)}, max: 0.95}}"
    r = d.u(0.03, 0.04)
    d.can(0.48, 0.0, r)
    d.goal(d.u(0.58, 0.62), 0.0)
    for sign in (-1, 1):
        d.wall(0.55, sign * (r + 0.03), 0.5, 0.02, 0.1)
    return r"reach\.min|\bnear\b|too close"


def fragile(d, fixed):
    mass, share, d.tools = d.u(1.5, 3.0), d.u(1.0, 2.0), "[finger, paddle]"
    d.can(0.5, 0.0, 0.045, mass=mass)
    limit = num(mass * (30 if fixed else share))
    d.objects[0] = d.objects[0][:-1] + f", max_force: {limit}}}"
    d.goal(d.u(0.6, 0.65), 0.0)
    return r"fragile|max_force|\d N\b"


def keep(d, fixed):
    """A vase stands where the can must go."""
    d.tools = "[finger, paddle]"
    d.can(0.45, 0.0, 0.035)
    x, y = d.u(0.58, 0.62), d.u(-0.03, 0.03)
    d.can(x, y, d.u(0.03, 0.04), 0.1, "vase", 0.5)
    d.kept += [] if fixed else ["vase"]
    d.goal(x, y, 0.02)
    return r"\bkeep\b|\bkept\b|vase"


def no_tool(d, fixed):
    """A thin bar passes through a slot, and no tool of the task does."""
    r = d.u(0.027, 0.03)
    d.tools = "[stick, l-hook, inverse-l, paddle, t-head" + (", thin-stick]" if fixed else "]")
    d.files["tools/thin-stick.yaml"] = THIN_STICK
    d.can(0.6, 0.0, r)
    d.goal(0.6 + d.u(0.07, 0.1), 0.0)
    inner, height = 2 * r + 0.012, d.u(0.18, 0.25)
    for sign in (-1, 1):
        d.wall(0.7, sign * (inner / 2 + 0.01), 0.32, 0.02, height)
        d.wall(0.53, sign * 0.122, 0.02, 0.2, height)
    d.wall(0.87, 0.0, 0.02, inner + 0.04, height)
    return r"\btools?\b"


KINDS = [
    hand, force, length, enclosed, clear, far, tool, edge, near, fragile, keep, no_tool
]


def cause(code, text):
    """Returns the first cause of an answer, without the plan that comes closest."""
    lines = text.splitlines()
    found = lines[0].partition(": ")[2] if lines else ""
    found = re.split(r"; the (closest|nearest|best)", found)[0]
    if code in (5, 7):
        found += "; ".join(line for line in lines if line.startswith("verdict"))
    return found


def main():
    arguments = solver(__doc__).parse_args()
    tried, named, solved = 0, 0, 0
    for name, kind in chosen(KINDS, arguments):
        codes, causes, advised = [], 0, 0
        for k in range(arguments.count):
            answers = []
            for fixed in (False, True):
                draw = Draw(f"{arguments.seed} {name} {k}")
                words = kind(draw, fixed)
                path = arguments.out / f"{name}-{k:02}{'-fixed' if fixed else ''}.yaml"
                draw.write(path)
                options = ["--more-tools", path.parent / "tools"] if draw.files and fixed else []
                options += ["--effort", arguments.effort]
                if arguments.solve:
                    answers.append((path, *solve(arguments.solve, path, *options)))
            if not answers:
                continue
            (path, code, text), (fixed, code_fixed, _) = answers
            codes.append(code)
            right = code != 0 and re.search(words, cause(code, text)) is not None
            causes, advised = causes + right, advised + (code_fixed == 0)
            if not right:
                print(f"  {path.name}: {text.splitlines()[0]}", flush=True)
            if code_fixed != 0:
                print(f"  {fixed.name}: not solved", flush=True)
        tried, named, solved = tried + len(codes), named + causes, solved + advised
        if arguments.solve:
            print(f"{name}: {counts(codes)}; {causes} right causes, {advised} solved as advised")
    if arguments.solve:
        print(f"of {tried}: {named} right causes, {solved} solved as advised")
    return 0 if named == solved == tried else 1


if __name__ == "__main__":
    sys.exit(main())
