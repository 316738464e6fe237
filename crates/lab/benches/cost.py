#!/usr/bin/env python3
"""Compares the cost and the plans of two `pushplan` commands on the same tasks, one thread.

    crates/lab/benches/cost.py BEFORE AFTER TASK... [--draws 32] [--scenes OUT] [-- OPTION...]
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

EPILOG = """
OPTIONs after `--` go to both `pushplan solve`, as in `-- --effort draft`.

Both commands solve each task in turn, in alternating order. The cost is processor time, user and
system, of the whole command. Of one command against itself, sums differ by about 2 %. The best
plans of both are then replayed by AFTER with perturbations that neither search has seen, and the
share that reaches the goal is compared. The table has a row per task; `a -> b` marks a changed
status or number of pushes. Below it are sums, medians and ninth deciles, and the robustness over
all tasks that both solve.

  git worktree add /tmp/old HEAD~1 && (cd /tmp/old && cargo build --release --locked)
  crates/lab/benches/cost.py {/tmp/old/,}target/release/pushplan tasks/*.yaml

Random tasks: `pushplan-lab random --count 64 --save-tasks FOLDER`. In MuJoCo, with OUT from
--scenes: `python3 OUT/before/replay.py OUT/before/*.xml`, and the same in OUT/after.
"""

# Seed of the new perturbations; solves use seed 0.
NEW = 4711


def main():
    words = sys.argv[1:]
    options = words[words.index("--") + 1 :] if "--" in words else []
    words = words[: words.index("--")] if "--" in words else words
    parser = argparse.ArgumentParser(
        description=__doc__.splitlines()[0],
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("before", type=Path, help="command of the earlier version")
    parser.add_argument("after", type=Path, help="command of the later version")
    parser.add_argument("tasks", type=Path, nargs="+", metavar="task", help="task files")
    draws = "new perturbed replays of each plan in each engine [default: 32]"
    parser.add_argument("--draws", type=int, default=32, help=draws)
    parser.add_argument("--scenes", type=Path, metavar="OUT", help="folder for MuJoCo scenes")
    asked = parser.parse_args(words)
    for file in [asked.before, asked.after, *asked.tasks]:
        if not file.is_file():
            parser.error(f"{file} is no file")
    if asked.draws < 1:
        parser.error("--draws must be at least 1")
    commands = [asked.before, asked.after]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        outs = [Path(folder) / "before", Path(folder) / "after"]
        print("| task | before | after | ratio | status | pushes | robustness |")
        print("| --- | ---: | ---: | ---: | --- | ---: | ---: |")
        for index, task in enumerate(asked.tasks):
            made = [None, None]
            for which in [0, 1] if index % 2 == 0 else [1, 0]:
                made[which] = solved(commands[which], task, outs[which], options)
            for one in made:
                one["robustness"] = replayed(asked.after, one["plan"], asked.draws)
            rows.append(made)
            print(row(task.stem, made), flush=True)
        summary(rows)
        if asked.scenes:
            export(asked.after, rows, asked.scenes)


def solved(command, task, out, options):
    """Solves a task; returns status, processor time, number of pushes and file of the best plan."""
    before = os.times()
    words = [command, "solve", task, "--threads", "1", "--quiet", "--json", "--out", out, *options]
    run = subprocess.run(words, capture_output=True, text=True, check=False)
    after = os.times()
    spent = sum(after[2:4]) - sum(before[2:4])
    if run.returncode not in (0, 4, 5, 7, 8):
        sys.exit(f"{task}: exit code {run.returncode}\n{run.stderr}")
    found = json.loads(run.stdout)
    plan = out / f"{task.stem}.plan.json"
    steps = found["plans"][0]["plan"]["steps"] if found["plans"] else []
    return {
        "status": found["status"],
        "spent": spent,
        "pushes": len(steps),
        "plan": plan if found["status"] == "solved" and plan.exists() else None,
    }


def replayed(command, plan, draws):
    """Returns the share of new perturbed replays that reach the goal, None without a plan."""
    if plan is None:
        return None
    words = [command, "verify", plan, "--replays", str(draws), "--seed", str(NEW), "--json"]
    run = subprocess.run([*words, "--quiet"], capture_output=True, text=True, check=False)
    made = json.loads(run.stdout)["verdict"]["evidence"]
    reached = [one["outcome"]["reached"] for one in made if one["perturbation"] != "nominal"]
    return sum(reached) / len(reached) if reached else None


def row(name, made):
    before, after = made
    ratio = after["spent"] / max(before["spent"], 1e-3)
    changed = [key for key in ("status", "pushes") if before[key] != after[key]]
    both = {key: f"{before[key]} -> {after[key]}" for key in changed}
    status, pushes = (both.get(key, after[key]) for key in ("status", "pushes"))
    shares = " -> ".join(
        "-" if one["robustness"] is None else f"{one['robustness']:.3f}" for one in made
    )
    spent = f"{before['spent']:.2f} s | {after['spent']:.2f} s"
    return f"| {name} | {spent} | {ratio:.2f} | {status} | {pushes} | {shares} |"


def summary(rows):
    spent = [[row[which]["spent"] for row in rows] for which in (0, 1)]
    measures = {
        "sum": sum,
        "median": statistics.median,
        "ninth decile": lambda all: sorted(all)[int(0.9 * (len(all) - 1))],
    }
    print(f"\n{len(rows)} tasks, processor time:\n\n| | before | after | ratio |")
    print("| --- | ---: | ---: | ---: |")
    for name, measure in measures.items():
        before, after = (measure(one) for one in spent)
        print(f"| {name} | {before:.2f} s | {after:.2f} s | {after / before:.3f} |")
    ratios = [row[1]["spent"] / max(row[0]["spent"], 1e-3) for row in rows]
    print(f"| ratio of a task, median | | | {statistics.median(ratios):.3f} |")
    both = [row for row in rows if all(one["robustness"] is not None for one in row)]
    if both:
        shares = [statistics.mean(row[which]["robustness"] for row in both) for which in (0, 1)]
        print(f"\nRobustness, {len(both)} tasks: {shares[0]:.4f} -> {shares[1]:.4f}")
    pushes = [sum(row[which]["pushes"] for row in both) for which in (0, 1)]
    print(f"Pushes: {pushes[0]} -> {pushes[1]}")
    solved = [sum(row[which]["status"] == "solved" for row in rows) for which in (0, 1)]
    print(f"Solved: {solved[0]} -> {solved[1]}")


def export(command, rows, out):
    for which, name in enumerate(("before", "after")):
        plans = [row[which]["plan"] for row in rows if row[which]["plan"]]
        words = [command, "export", *plans, "--out", out / name]
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    main()
