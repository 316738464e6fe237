#!/usr/bin/env python3
"""Measures this planner and the sampling search in MuJoCo on the board of tool tasks.

    python crates/lab/benches/board.py --out runs/board     # about an hour; resumes

Needs the packages `pushplan` and `mujoco`. Everything runs on one thread; answers are kept in the
folder `--out`. Prints Markdown: a row per program, and the number of solved tasks by kind.
"""

import argparse
import statistics
import sys
from pathlib import Path

from pushplan.board.board import load
from pushplan.board.report import page, played, summary

SAMPLER = str(Path(__file__).with_name("board_sampler.py"))
OURS = [sys.executable, "-m", "pushplan.board", "player", "--effort"]
#: Name, command and limits of each program. Ours has no limit of rollouts.
PROGRAMS = [
    ("draft", [*OURS, "draft"], {"seconds": 300.0, "rollouts": None}),
    ("standard", [*OURS, "standard"], {"seconds": 300.0, "rollouts": None}),
    ("sampler", [sys.executable, SAMPLER], {"seconds": 300.0, "rollouts": 1200.0}),
]


def row(name, records):
    """Returns the row of a program."""
    possible = summary(one for one in records if one.possible)
    twins = summary(one for one in records if not one.possible)
    times = [one.cost.get("processor_s", one.seconds) for one in records]
    rollouts = statistics.median(one.cost.get("rollouts", 0) for one in records)
    cells = [
        f"{possible['solved']} of {possible['tasks']}",
        possible["false"],
        f"{twins['false']} of {twins['tasks']}",
        twins["impossible"],
        f"{statistics.median(times):.2f} s",
        f"{sum(times) / 60:.1f} min",
        f"{rollouts:.0f}",
    ]
    return f"| {name} | " + " | ".join(map(str, cells)) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--out", type=Path, required=True, help="folder of answers and pages")
    parser.add_argument("--only", action="append", help="only this program, repeatable")
    arguments = parser.parse_args()
    tasks, found = load(), {}
    for name, command, budget in PROGRAMS:
        if arguments.only and name not in arguments.only:
            continue
        out = arguments.out / name

        def progress(text, name=name):
            print(f"{name}: {text}", file=sys.stderr, flush=True)

        found[name] = played(tasks, command, out, budget, progress)
        (out / "board.md").write_text(page(found[name], name, budget))
    print("Programs:\n")
    print(
        "| program | solved | plans that fail | twins called solved | twins called impossible "
        "| processor time, median | sum | rollouts, median |"
    )
    print("| --- |" + " --: |" * 7)
    for name, records in found.items():
        print(row(name, records))
    print("\nKinds:\n\n| kind | tasks | " + " | ".join(found) + " |")
    print("| --- | --: |" + " --: |" * len(found))
    for kind in sorted({one.kind for one in tasks}):
        own = [[r for r in records if r.possible and r.kind == kind] for records in found.values()]
        solved = [str(sum(one.solved for one in records)) for records in own]
        print(f"| {kind} | {len(own[0])} | " + " | ".join(solved) + " |")


if __name__ == "__main__":
    main()
