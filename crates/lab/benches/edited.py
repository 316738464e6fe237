#!/usr/bin/env python3
"""Edits working plans so that they break a rule or miss the goal, and counts the edited plans that
pass.

    crates/lab/benches/mujoco OUT 300 7
    python3 crates/lab/benches/edited.py OUT/plans --out edited --verify target/release/pushplan

Every edit is wrong by construction, so `verify` must reject it or refuse the file. Lengths are in
metres. Only Python is needed. The exit code is 0 if none passes.
"""

import argparse
import copy
import json
import math
import subprocess
import sys
from pathlib import Path


def end(push):
    return [
        s + push["length"] * f(push["direction"])
        for s, f in zip(push["start"], (math.cos, math.sin))
    ]


def longer(plan, task, push):
    """Keeps the end of a push, and starts farther back than refinement may."""
    at, length = end(push), 1.6 * task["pushes"]["length"]
    push["start"] = [e - length * f(push["direction"]) for e, f in zip(at, (math.cos, math.sin))]
    push["length"] = length


def blocked(plan, task, push):
    size = {"size": [0.01, 0.01, 0.4], "position": end(push)}
    task["scene"]["obstacles"].append({"name": "in-the-hand", **size})


def in_the_base(plan, task, push):
    task["robot"]["base"] = "none"
    push["start"] = [0.0, 0.0]


def split(plan, task, push):
    """Adds pushes of the last millimetre until there is one too many."""
    at = plan["steps"][-1]["push"]
    short = dict(
        at,
        start=[e - 0.001 * f(at["direction"]) for e, f in zip(end(at), (math.cos, math.sin))],
        length=0.001,
    )
    plan["steps"] += [
        {"push": dict(short)} for _ in range(task["pushes"]["max_count"] + 1 - len(plan["steps"]))
    ]


def goal(plan, task, push):
    for one in task["goal"] if isinstance(task["goal"], list) else [task["goal"]]:
        one["position"][0] += 3 * one["tolerance"]


EDITS = {
    "lift": lambda plan, task, push: push.update(lift=push["lift"] + 0.01),
    "lift-a-little": lambda plan, task, push: push.update(lift=push["lift"] + 0.0002),
    "form": lambda plan, task, push: push.update(form="chained"),
    "yaw": lambda plan, task, push: push.update(grip_yaw=push["grip_yaw"] + 0.02),
    "speed": lambda plan, task, push: push.update(speed=3 * push["speed"]),
    "turned-round": lambda plan, task, push: push.update(direction=push["direction"] + math.pi),
    "too-far": lambda plan, task, push: push.update(start=[2.0, 0.0]),
    "weak-arm": lambda plan, task, push: task["robot"].update(max_force=0.01),
    "heavy": lambda plan, task, push: (
        task["robot"].update(max_force=30.0),
        [thing.update(mass=500.0) for thing in task["scene"]["objects"]],
    ),
    "another-tool": lambda plan, task, push: task.update(tools=["no-such-tool"]),
    "nothing": lambda plan, task, push: plan.update(steps=[]),
    "longer": longer, "blocked": blocked, "in-the-base": in_the_base, "split": split, "goal": goal,
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("plans", type=Path, help="folder of working plans")
    parser.add_argument("--out", type=Path, required=True, help="folder of the edited plans")
    parser.add_argument("--verify", required=True, help="path of the program")
    parser.add_argument(
        "--count", type=int, default=20, help="number of plans for each edit; default 20"
    )
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    # Names like `NAME.failed.plan.json` are unsolved plans.
    plans = [
        path for path in sorted(arguments.plans.glob("*.plan.json")) if path.name.count(".") == 2
    ]
    plans = plans[:: max(1, len(plans) // arguments.count)][: arguments.count]
    wrong = 0
    for name, edit in EDITS.items():
        codes = {}
        for path in plans:
            document = json.loads(path.read_text())
            edited = copy.deepcopy(document)
            edit(edited["plan"], edited["task"], edited["plan"]["steps"][0]["push"])
            at = arguments.out / f"{name}-{path.name}"
            at.write_text(json.dumps(edited))
            done = subprocess.run(
                [arguments.verify, "verify", at, "--quiet"], capture_output=True, text=True
            )
            codes[done.returncode] = codes.get(done.returncode, 0) + 1
            if done.returncode == 0:
                wrong += 1
                print(f"  {at.name}: passes", flush=True)
        verdicts = {0: "pass", 3: "refused", 5: "fail", 7: "fragile"}
        counts = [f"{count} {verdicts.get(code, code)}" for code, count in sorted(codes.items())]
        print(f"{name}: {', '.join(counts)}", flush=True)
    print(f"{wrong} of {len(EDITS) * len(plans)} pass")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
