"""Tasks that are drawn at random: the shared part of `impossible.py`, `around.py`, `why_not.py` and
`broken_worlds.py`. Lengths are in metres, masses in kilograms. Only Python is needed.
"""

import argparse
import math
import random
import subprocess
from pathlib import Path

VERDICTS = {
    0: "solved", 3: "refused", 4: "no plan", 5: "failed", 7: "fragile", 8: "partial", 9: "stopped"
}


def num(value):
    return f"{value:.5f}".rstrip("0").rstrip(".")


def turned(x, y, turn):
    c, s = math.cos(turn), math.sin(turn)
    return c * x - s * y, s * x + c * y


class Draw:
    """A task while it is drawn; everything is rotated about the robot's base by `turn`."""

    def __init__(self, seed):
        self.rng = random.Random(seed)
        self.turn = 0.0
        self.objects, self.obstacles, self.joints, self.more = [], [], [], []
        self.regions, self.kept, self.files = [], [], {}
        self.robot = "reach: {min: 0.25, max: 0.95}"
        self.pushes = "length: 0.25, directions: 8, max_count: 2"
        self.table, self.goals, self.tools = "friction: 0.5", [], "all"

    def u(self, low, high):
        return self.rng.uniform(low, high)

    def place(self, x, y, yaw=0.0):
        x, y = turned(x, y, self.turn)
        return f"position: [{num(x)}, {num(y)}], yaw_deg: {num(math.degrees(self.turn) + yaw)}"

    def thing(self, name, shape, x, y, yaw=0.0, mass=None):
        mass = self.u(0.1, 1.0) if mass is None else mass
        self.objects.append(
            f"{{name: {name}, shape: {{{shape}}}, mass: {num(mass)}, friction: 0.4, "
            f"{self.place(x, y, yaw)}}}"
        )

    def can(self, x, y, r, height=0.08, name="can", mass=None):
        self.thing(name, f"cylinder: {{radius: {num(r)}, height: {num(height)}}}", x, y, 0.0, mass)

    def box(self, x, y, a, b, height=0.08, name="can", mass=None, yaw=0.0):
        self.thing(name, f"cuboid: {{size: [{num(a)}, {num(b)}, {num(height)}]}}", x, y, yaw, mass)

    def wall(self, x, y, a, b, height=0.12, yaw=0.0, z=None):
        name, at = f"wall-{len(self.obstacles)}", self.place(x, y, yaw)
        at = at if z is None else at.replace("]", f", {num(z)}]", 1)
        self.obstacles.append(
            f"{{name: {name}, size: [{num(a)}, {num(b)}, {num(height)}], {at}}}"
        )

    def strip(self, x, y, a, b, kinds, yaw=0.0):
        """Adds a rectangle that bodies of these kinds must not enter."""
        area = f"{{rectangle: {{size: [{num(a)}, {num(b)}]}}}}"
        self.regions.append(
            f"{{name: strip-{len(self.regions)}, area: {area}, {self.place(x, y, yaw)}, "
            f"for: [{', '.join(kinds)}]}}"
        )

    def pen(self, x, y, inner_x, inner_y, thick, height=0.12):
        """Adds four walls around a rectangle."""
        for sign in (-1, 1):
            self.wall(x + sign * (inner_x + thick) / 2, y, thick, inner_y + 2 * thick, height)
            self.wall(x, y + sign * (inner_y + thick) / 2, inner_x, thick, height)

    def gap(self, x, width, thick=0.02, height=0.12):
        """Adds two walls that no push leads around."""
        for sign in (-1, 1):
            self.wall(x, sign * (width / 2 + 0.6), thick, 1.2, height)

    def goal(self, x, y, tolerance=0.02, object="can", heading=None):
        x, y = turned(x, y, self.turn)
        more = (
            ""
            if heading is None
            else f", heading_deg: {num(heading + math.degrees(self.turn))}"
            ", heading_tolerance_deg: 8"
        )
        self.goals.append(
            f"{{object: {object}, position: [{num(x)}, {num(y)}], tolerance: {tolerance}{more}}}"
        )

    def text(self):
        listed = lambda items: "[" + ", ".join(items) + "]"
        goals = self.goals[0] if len(self.goals) == 1 else listed(self.goals)
        return "\n".join(
            [
                "scene:",
                f"  table: {{{self.table}}}",
                "  objects:",
                *(f"    - {one}" for one in self.objects),
                *(["  joints:", *(f"    - {one}" for one in self.joints)] if self.joints else []),
                *(
                    ["  obstacles:", *(f"    - {one}" for one in self.obstacles)]
                    if self.obstacles
                    else []
                ),
                f"robot: {{{self.robot}}}",
                f"tools: {self.tools}",
                f"pushes: {{{self.pushes}}}",
                f"goal: {goals}",
                *([f"keep: {{objects: {listed(self.kept)}}}"] if self.kept else []),
                *([f"keep_out: {listed(self.regions)}"] if self.regions else []),
                *self.more,
                "",
            ]
        )

    def write(self, path):
        """Writes the task, and its other files beside it."""
        path.write_text(self.text())
        for name, text in self.files.items():
            (path.parent / name).parent.mkdir(exist_ok=True)
            (path.parent / name).write_text(text)


def parser(text, count=10):
    """Returns a parser with the options that all generators share, described by the first line of a
    text."""
    parser = argparse.ArgumentParser(description=text.split("\n")[0])
    parser.add_argument("--out", type=Path, required=True, help="folder of the tasks")
    parser.add_argument(
        "--count", type=int, default=count, help=f"number of each kind; default {count}"
    )
    parser.add_argument("--seed", type=int, default=1, help="seed of all random draws; default 1")
    parser.add_argument("--kind", action="append", help="only this kind, repeatable; default all")
    return parser


def solver(text):
    """Returns a parser for generators whose tasks a program can solve."""
    own = parser(text)
    own.add_argument("--solve", help="path of the program that solves the tasks; default none")
    own.add_argument("--effort", default="standard", help="search effort; default standard")
    return own


def chosen(kinds, arguments):
    """Makes the folder, and returns name and function of the requested kinds."""
    arguments.out.mkdir(parents=True, exist_ok=True)
    named = [(kind.__name__.replace("_", "-"), kind) for kind in kinds]
    return [one for one in named if not arguments.kind or one[0] in arguments.kind]


def solve(program, path, *options, verb=("solve",)):
    """Solves a task and returns the exit code and the output."""
    command = [program, *verb, path, "--quiet", "--threads", "1", "--out", path.parent / "plans"]
    done = subprocess.run([*command, *options], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def counts(codes):
    """Returns how often each verdict occurs in a list of exit codes."""
    each = sorted((code, codes.count(code)) for code in set(codes))
    return ", ".join(f"{count} {VERDICTS.get(code, f'exit {code}')}" for code, count in each)


def table(found, unit="tasks", names=VERDICTS):
    """Returns a Markdown table of how often each verdict occurs, by kind and in all. The first
    verdict has a column even if it never occurs."""
    codes = [code for mine in found.values() for code in mine]
    first, *others = [*names, *sorted(set(codes) - set(names))]
    shown = [first, *(code for code in others if code in codes)]
    heads = ["kind", unit, *(str(names.get(code, f"exit {code}")) for code in shown)]
    rows = [("all", codes), *found.items()]
    cells = [[kind, len(mine), *map(mine.count, shown)] for kind, mine in rows]
    rule = ["---"] + ["--:"] * (len(heads) - 1)
    return "\n".join("|" + "|".join(map(str, row)) + "|" for row in [heads, rule, *cells])
