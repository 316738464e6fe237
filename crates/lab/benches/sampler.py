#!/usr/bin/env python3
"""Compares `pushplan solve` with a sampling search in MuJoCo: cost, and errors of both plans.

    crates/lab/benches/sampler.py [--seed 1]

The sampler has the same tools, grips and kinds of pushes. It rolls out 500 random pushes with a
step of 4 ms and the usual contacts of MuJoCo, then 96 pushes around the best eight. Its plan is the
push nearest to the goal, without verification. Its time contains only the rollouts, without the
compilation of models. The time of `pushplan solve` contains verification and the page. Both plans
are evaluated in the exported scene with a step of 0.25 ms. The requirements are the same as for
`python.py rollout`.
"""

import argparse
import math
import statistics
import tempfile
import time

import numpy as np
import pushplan
from python import COMMAND, ROOT, processor, theirs

TASKS = ["pull-back", "narrow-gap", "wide-sweep", "diagonal", "turn-the-box"]
FIRST, AROUND, NEXT = 500, 8, 96
STEP, EXACT = 4e-3, 2.5e-4


class Draw:
    """Sampler of feasible pushes."""

    def __init__(self, task, seed):
        self.task, self.rng = task, np.random.default_rng(seed)
        library = pushplan.ToolLibrary.shipped()
        self.tools = task.tools or list(library.names)
        wanted = task.to_dict().get("pushes", {}).get("directions", "principal")
        count = 4 if wanted == "principal" else wanted
        even = isinstance(count, int)
        self.directions = (
            [math.tau * k / count for k in range(count)]
            if even
            else [math.radians(one) for one in wanted]
        )

    def first(self):
        direction = float(self.rng.choice(self.directions))
        grip = [str(self.rng.choice(self.tools)), float(self.rng.choice(self.task.grip_yaws))]
        return [
            *grip,
            direction,
            self.rng.uniform(-0.06, 0.06),
            self.rng.uniform(0.03, self.task.push_length),
        ]

    def near(self, words):
        tool, yaw, direction, offset, length = words
        length = np.clip(length + self.rng.normal(0, 0.01), 0.01, self.task.push_length)
        return [
            tool,
            yaw,
            direction + self.rng.normal(0, 0.05),
            offset + self.rng.normal(0, 0.01),
            length,
        ]

    def plans(self, draw, count):
        """Draws feasible pushes, and returns them with their parameters."""
        made = []
        while len(made) < count:
            words = draw()
            tool, yaw, direction, offset, length = words
            push = pushplan.Push.before(
                self.task.goal_object, float(direction), float(offset), float(length)
            )
            try:
                made.append((words, pushplan.Plan.of(self.task, tool, [push], grip_yaw=yaw)))
            except pushplan.PushplanError:
                continue
        return made


def rolled(made, **settings):
    """Returns the final errors in tolerances, metres and radians, and the seconds of the
    rollouts."""
    off, seconds = np.empty((len(made), 3)), 0.0
    grips = {}
    for k, (words, _) in enumerate(made):
        grips.setdefault(tuple(words[:2]), []).append(k)
    for own in grips.values():
        plan = made[own[0]][1]
        pushes = [made[k][1].pushes[0] for k in own]
        pushes = np.array(
            [[*push.start, push.direction, push.length, push.speed] for push in pushes]
        )
        began = time.process_time()
        ends = theirs(plan, pushes, **settings)
        seconds += time.process_time() - began
        off[own] = [missed(plan.task, end) for end in ends]
    return off, seconds


def missed(task, end):
    away, turned = math.dist(end[:2], task.goal_position), 0.0
    score = away / task.tolerance
    if task.goal_heading is not None:
        turned = abs(math.remainder(end[2] - task.goal_heading, math.tau))
        score = max(score, turned / task.heading_tolerance)
    return score, away, turned


def sampled(task, seed):
    draw = Draw(task, seed)
    made = draw.plans(draw.first, FIRST)
    off, seconds = rolled(made, step=STEP, usual=True)
    best = [made[k][0] for k in np.argsort(off[:, 0])[:AROUND]]
    around = [draw.plans(lambda words=words: draw.near(words), NEXT // AROUND) for words in best]
    more = [one for some in around for one in some]
    further, extra = rolled(more, step=STEP, usual=True)
    made, off = made + more, np.concatenate([off, further])
    nearest = int(np.argmin(off[:, 0]))
    return made[nearest], off[nearest], seconds + extra


def formatted(off):
    turned = f", {math.degrees(off[2]):.1f} degrees" if off[2] > 0 else ""
    return f"{1e3 * off[1]:.1f} mm{turned}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    print(
        "| task | sampler | solve | factor | error of the sampler, predicted "
        "| with exact contacts | error of `solve` |"
    )
    print("| --- | --: | --: | --: | --: | --: | --: |")
    ratios = []
    for name in TASKS:
        path = ROOT / f"tasks/{name}.yaml"
        task = pushplan.Task.load(path)
        best, thinks, seconds = sampled(task, arguments.seed)
        with tempfile.TemporaryDirectory() as out:
            words = [COMMAND, "solve", str(path), "--threads", "1", "--quiet", "--out", out]
            own = statistics.median(processor(words) for _ in range(5))
            plan = pushplan.Plan.load(f"{out}/{name}.plan.json")
        ratios.append(seconds / own)
        ours = ((plan.tool.name, plan.grip_yaw), plan)
        exact = [rolled([one], step=EXACT)[0][0] for one in (best, ours)]
        numbers = [
            f"{seconds:.2f} s",
            f"{own:.3f} s",
            f"{ratios[-1]:.0f}",
            *map(formatted, [thinks, *exact]),
        ]
        print(f"| {name} | " + " | ".join(numbers) + " |", flush=True)
    print(f"\nMedian factor {statistics.median(ratios):.0f}.")


if __name__ == "__main__":
    main()
