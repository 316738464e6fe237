#!/usr/bin/env python3
"""Writes tasks that no shipped tool solves, and designs tools for them.

    python3 crates/lab/benches/design.py --out designed --solve target/release/pushplan

Draws tasks of eight kinds, and keeps up to `--count` of each kind for which `solve` finds no
working plan with the shipped tools. It is unknown whether any tool solves them. `design` then
evaluates `--candidates` tools, and a tenth of them. The baseline is the best of as many random
draws of the same forms, without variation. Prints the number of solved tasks by kind. With
`--mujoco` it also replays the plans of the first way. Existing tasks are not drawn again. Lengths
are in metres, masses in kilograms. Files are JSON, which is also YAML.
"""

import argparse
import json
import random
import subprocess
import sys
from pathlib import Path

from puzzles import replayed, version_of_mujoco

NO_PLAN, FAILED, PARTIAL = 4, 5, 8


class Draw:
    """A task while it is drawn, mirrored in half of the cases."""

    def __init__(self, seed):
        self.rng = random.Random(seed)
        self.side = self.rng.choice([-1, 1])
        self.objects, self.obstacles = [], []

    def u(self, low, high):
        return round(self.rng.uniform(low, high), 3)

    def at(self, x, y):
        return [round(x, 4), round(self.side * y, 4)]

    def can(self, x, y, radius, name="can"):
        self.objects.append(
            {
                "name": name,
                "shape": {"cylinder": {"radius": radius, "height": 0.1}},
                "mass": self.u(0.2, 0.6),
                "friction": self.u(0.3, 0.5),
                "position": self.at(x, y),
            }
        )

    def box(self, x, y, wide, name="can"):
        self.objects.append(
            {
                "name": name,
                "shape": {"cuboid": {"size": [wide, self.u(0.05, 0.08), 0.08]}},
                "mass": self.u(0.2, 0.6),
                "friction": self.u(0.3, 0.5),
                "position": self.at(x, y),
            }
        )

    def wall(self, x, y, long, wide, height):
        name = f"wall-{len(self.obstacles)}"
        self.obstacles.append(
            {
                "name": name,
                "size": [round(long, 4), round(wide, 4), height],
                "position": self.at(x, y),
            }
        )

    def slot(self, x, y, width, height, thick=0.03):
        """Adds a wall across the table with one gap."""
        for sign in (-1, 1):
            self.wall(x, y + sign * (width / 2 + 0.7), thick, 1.4, height)

    def task(self, reach, *goals, **pushes):
        goals = [
            {"object": name, "position": self.at(x, y), "tolerance": 0.02} for name, x, y in goals
        ]
        return {
            "scene": {"objects": self.objects, "obstacles": self.obstacles},
            "robot": {"reach": {"min": 0.25, "max": reach}}, "tools": "all",
            "pushes": {"max_count": 2} | pushes, "goal": goals if len(goals) > 1 else goals[0],
        }


def far(d):
    """An object beyond the longest tool, to be pushed on or pulled back."""
    x, y = d.u(1.17, 1.32), d.u(0.0, 0.1)
    d.rng.choice([lambda: d.can(x, y, d.u(0.03, 0.05)), lambda: d.box(x, y, d.u(0.06, 0.1))])()
    return d.task(0.5, ("can", x + d.rng.choice([-1, 1]) * d.u(0.08, 0.16), y))


def around(d):
    """An object behind the middle of a wide wall, to be pulled to it or to its end."""
    x, half = d.u(0.72, 0.8), d.u(0.24, 0.3)
    d.wall(x, 0.0, 0.03, 2 * half, 0.2)
    radius = d.u(0.03, 0.04)
    at = x + d.u(0.2, 0.26), d.u(-0.05, 0.05)
    d.can(*at, radius)
    d.wall(at[0] + d.u(0.16, 0.22), 0.0, 0.03, 2 * half + 0.2, 0.2)
    way = d.rng.choice([(-d.u(0.08, 0.12), 0.0), (0.0, d.u(0.08, 0.15))])
    return d.task(0.62, ("can", at[0] + way[0], at[1] + way[1]))


def slot(d):
    """An object behind a wall with a slot too narrow for a shipped handle, to be pushed on."""
    x, y, width = d.u(0.72, 0.8), d.u(0.0, 0.1), d.u(0.024, 0.037)
    d.slot(x, y, width, 0.15)
    at = x + d.u(0.1, 0.2)
    d.can(at, y + d.u(-0.005, 0.005), d.u(0.03, 0.05))
    return d.task(0.65, ("can", at + d.u(0.08, 0.15), y))


def pocket(d):
    """An object in a pocket with little room around it, to be pulled out."""
    radius, x, y = d.u(0.028, 0.04), d.u(0.8, 0.9), d.u(-0.1, 0.1)
    beside, behind, deep = d.u(0.022, 0.034), d.u(0.024, 0.037), d.u(0.0, 0.03)
    back = x + radius + behind
    front = x - radius - deep
    for sign in (-1, 1):
        d.wall((front + back) / 2, y + sign * (radius + beside + 0.015), back - front, 0.03, 0.2)
    d.wall(back + 0.015, y, 0.03, 2 * (radius + beside) + 0.06, 0.2)
    d.can(x, y, radius)
    return d.task(0.6, ("can", x - d.u(0.1, 0.16), y))


def together(d):
    """Two or three cans far apart, to be pushed on together by one push."""
    x, apart, way = d.u(0.45, 0.6), d.u(0.6, 0.74), d.u(0.1, 0.15)
    places = [-apart / 2, apart / 2] + ([0.0] if d.rng.random() < 0.3 else [])
    radius = d.u(0.03, 0.04)
    for k, y in enumerate(places):
        d.can(x, y, radius, f"can-{k}")
    return d.task(0.8, *((f"can-{k}", x + way, y) for k, y in enumerate(places)), max_count=1)


def walls(d):
    """An object behind two walls whose gaps are not in line, to be pushed on."""
    x, apart, aside = d.u(0.66, 0.72), d.u(0.2, 0.26), d.u(0.1, 0.2)
    d.slot(x, aside, d.u(0.05, 0.08), 0.2)
    d.slot(x + apart, 0.0, d.u(0.05, 0.08), 0.2)
    at = x + apart + d.u(0.09, 0.12)
    d.can(at, d.u(-0.01, 0.01), d.u(0.03, 0.045))
    return d.task(0.62, ("can", at + d.u(0.06, 0.1), 0.0))


def gap(d):
    """An object deep in a gap too narrow for the hand, to be pushed on or pulled back."""
    x, width, deep = d.u(0.5, 0.56), d.u(0.09, 0.115), d.u(0.64, 0.72)
    for sign in (-1, 1):
        d.wall(x + 0.5, sign * (width / 2 + 0.02), 1.0, 0.04, 0.25)
    d.can(x + deep, 0.0, d.u(0.024, 0.03))
    return d.task(0.7, ("can", x + deep + d.rng.choice([-1, 1]) * d.u(0.08, 0.14), 0.0))


def beside(d):
    """An object next to a long wall, beyond the hand's reach, to be pushed away from it."""
    radius, x, y = d.u(0.03, 0.04), d.u(0.75, 0.9), d.u(0.0, 0.1)
    d.wall(x, y + radius + d.u(0.024, 0.03) + 0.015, 0.8, 0.03, 0.2)
    d.can(x, y, radius)
    return d.task(0.5, ("can", x, y - d.u(0.08, 0.14)), max_count=1)


KINDS = {
    "far": far,
    "around": around,
    "slot": slot,
    "pocket": pocket,
    "together": together,
    "walls": walls,
    "gap": gap,
    "beside": beside,
}


def unsolved(arguments, kind):
    """Returns up to `--count` tasks of a kind that no shipped tool solves."""
    kept = []
    for k in range(8 * arguments.count):
        if len(kept) == arguments.count:
            break
        path = arguments.out / f"{kind}-{k:02}.yaml"
        if not path.exists():
            path.write_text(json.dumps(KINDS[kind](Draw(f"{arguments.seed} {kind} {k}")), indent=1))
            command = [arguments.solve, "solve", path, "--quiet", "--out", arguments.out / "known"]
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode not in (NO_PLAN, FAILED, PARTIAL):
                path.write_text("")  # It is not drawn again.
                if done.returncode == 3:
                    raise SystemExit(done.stderr)
        if path.stat().st_size > 0:
            kept.append(path)
    return kept


def designed(arguments, name, candidates, at_random):
    """Designs a tool for every task, and returns a record of each."""
    records = []
    for kind in arguments.kind or KINDS:
        for path in unsolved(arguments, kind):
            command = [arguments.solve, "design", path, "--quiet", "--json"]
            command += ["--out", arguments.out / name, "--parts", str(arguments.parts)]
            command += ["--candidates", str(candidates), *(["--random"] if at_random else [])]
            done = subprocess.run(command, capture_output=True, text=True)
            found = json.loads(done.stdout)
            plans, tool = found["solution"]["plans"], found["tool"]
            verdict = plans[0]["verdict"] if plans else None
            records.append(
                {
                    "task": path.stem,
                    "kind": kind,
                    "solved": done.returncode == 0,
                    "status": found["status"],
                    "tool": tool and tool["name"],
                    "parts": tool and len(tool["parts"]),
                    "robustness": verdict and verdict["robustness"],
                    "spent": found["spent"],
                }
            )
            print(json.dumps(records[-1]), file=sys.stderr, flush=True)
    (arguments.out / f"{name}.json").write_text(json.dumps(records, indent=1))
    return records


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--out", type=Path, required=True, help="folder of the tasks")
    parser.add_argument("--solve", required=True, help="path of the program")
    parser.add_argument("--count", type=int, default=5, help="tasks of each kind; default 5")
    parser.add_argument("--seed", type=int, default=1, help="seed of all random draws; default 1")
    parser.add_argument(
        "--kind", action="append", choices=KINDS, help="only this kind, repeatable; default all"
    )
    parser.add_argument(
        "--candidates", type=int, default=1000, help="number of candidate tools; default 1000"
    )
    parser.add_argument(
        "--parts", type=int, default=3, help="maximum number of parts of a tool; default 3"
    )
    parser.add_argument("--mujoco", metavar="PYTHON", help="a Python with MuJoCo, to replay plans")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    count = arguments.candidates
    few = max(count // 10, 1)
    ways = {
        f"best of {count}": designed(arguments, "plans", count, False),
        f"best of {few}": designed(arguments, "few", few, False),
        f"best of {count} random tools": designed(arguments, "random", count, True),
    }
    print("| kind | tasks | " + " | ".join(ways) + " |\n| --- |" + " --: |" * (1 + len(ways)))
    for kind in [*(arguments.kind or KINDS), None]:
        own = [[r for r in of if kind in (r["kind"], None)] for of in ways.values()]
        solved = [str(sum(record["solved"] for record in of)) for of in own]
        print(f"| {kind or 'all'} | {len(own[0])} | " + " | ".join(solved) + " |")
    rollouts = [sum(record["spent"]["rollouts"] for record in of) for of in ways.values()]
    print("| rollouts | | " + " | ".join(f"{number:,}" for number in rollouts) + " |")
    parts = [[r["parts"] for r in of if r["solved"]] for of in ways.values()]
    means = [f"{sum(of) / len(of):.1f}" if of else "" for of in parts]
    print("| parts of a tool, mean | | " + " | ".join(means) + " |")
    if arguments.mujoco:
        solved = [record for record in ways[f"best of {count}"] if record["solved"]]
        plans = [arguments.out / f"plans/{record['tool']}.plan.json" for record in solved]
        out = arguments.out / "mjcf"
        works = replayed(arguments.mujoco, arguments.solve, plans, out) if plans else []
        version = version_of_mujoco(arguments.mujoco)
        print(f"| works in MuJoCo {version} | | {len(works)} | | |")


if __name__ == "__main__":
    main()
