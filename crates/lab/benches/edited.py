#!/usr/bin/env python3
"""Edits working plans so that they break a rule or miss the goal, and counts the edited plans that
pass.

    for task in tasks/*.yaml tasks/levers/*.yaml ARM_TASKS/*.yaml; do
      target/release/pushplan solve "$task" --quiet --out OUT/plans
    done
    python3 crates/lab/benches/edited.py OUT/plans --out OUT/edited --verify target/release/pushplan

Every edit is wrong by construction, so `verify` must reject it or refuse the file. Each field of a
push, of a lever-up and of a joint trajectory has its edits, which take turns until there are enough
edited plans. Joints are edited in plans of tasks with an arm. Only Python is needed. The exit code
is 0 if none passes.
"""

import argparse
import json
import random
import subprocess
import sys
from pathlib import Path

from drawn import table
from edits import LEVERS, PUSHES
from edits_of_joints import JOINTS

EDITS = [("push", PUSHES), ("lever_up", LEVERS), ("push", JOINTS)]


def edited(path, kind, edit):
    """Returns a plan after an edit of one of its steps; `None` if the edit does not apply."""
    file = json.loads(path.read_text())
    steps = [step[kind] for step in file["plan"]["steps"] if kind in step]
    if not steps:
        return None
    step = random.Random(path.name).choice(steps)
    return None if edit(file, step) is False else file


def verdict(arguments, file, name):
    at = arguments.out / f"{name}.plan.json"
    at.write_text(json.dumps(file))
    done = subprocess.run([arguments.verify, "verify", at, "--quiet"], capture_output=True)
    return {0: "pass", 3: "refused", 5: "fail", 7: "fragile"}.get(done.returncode, "error")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("plans", type=Path, help="folder of working plans")
    parser.add_argument("--out", type=Path, required=True, help="folder of the edited plans")
    parser.add_argument("--verify", required=True, help="path of the program")
    parser.add_argument("--count", type=int, default=300, help="number of edited plans")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    # Names like `NAME.failed.plan.json` are unsolved plans.
    plans = sorted(arguments.plans.glob("*.plan.json"))
    plans = [path for path in plans if path.name.count(".") == 2]
    random.Random(7).shuffle(plans)
    edits = [(kind, name, edit) for kind, all in EDITS for name, edit in all.items()]
    found, left = {}, [list(plans) for _ in edits]
    total = wrong = 0
    while total < arguments.count and any(left):
        for (kind, name, edit), paths in zip(edits, left):
            file = None
            while paths and file is None:
                path = paths.pop()
                file = edited(path, kind, edit)
            if file is None or total == arguments.count:
                continue
            answer = verdict(arguments, file, f"{name}-{path.name.split('.')[0]}")
            found.setdefault(name, []).append(answer)
            total += 1
            if answer in ("pass", "error"):
                wrong += 1
                print(f"  {name} of {path.name}: {answer}", flush=True)
    answers = ["pass", "refused", "fail", "fragile", "error"]
    shown = table(found, "edited plans", {answer: answer for answer in answers})
    print(f"{wrong} of {total} pass\n\n{shown}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
