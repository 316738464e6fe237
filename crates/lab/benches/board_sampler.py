#!/usr/bin/env python3
"""Plays the board of tool tasks with the sampling search in MuJoCo of `sampler.py`.

    python -m pushplan.board run --out sampler \\
        --program "python crates/lab/benches/board_sampler.py"

Needs the packages `pushplan` and `mujoco`. One search looks for one push of one object to a place
or into a region. Goals of several objects are taken in their order. If no push reaches a goal, the
best one is made in MuJoCo, and the next search begins at its end. A plan counts only if it keeps
the rules and works in the exported scene at 0.25 ms too. Joint goals, levers and new tools are
beyond it: the answer is then `unknown`, as after the last allowed push. It measures no forces and
claims no impossibility. The only budget is a number of rollouts, each of which tries all lengths of
a push.
"""

import argparse
import json
import math
import sys
import time

import numpy as np
import pushplan
from pushplan.board.judge import broken_rule, plan_of
from pushplan.board.replay import replayed
from sampler import FIRST, NEXT, STEP, Sampler

#: Share of the error that a push must remove to be made without reaching the goal.
GAIN = 0.2


def simplified(goal, poses):
    """Returns goals of one object each with a position; `None` for other goals."""
    if "objects" in goal:
        names = goal["objects"][: goal.get("at_least")]
        each = [{key: goal[key] for key in goal if key not in ("objects", "at_least")}] * len(names)
        found = [simplified(one | {"object": name}, poses) for one, name in zip(each, names)]
        return None if None in found else sum(found, [])
    if region := goal.get("region"):
        area = region["area"]
        if circle := area.get("circle"):
            radius = circle["radius"]
        elif rectangle := area.get("rectangle"):
            radius = min(rectangle["size"]) / 2
        else:
            corners = np.array(area["polygon"]["corners"])
            sides = np.roll(corners, -1, axis=0) - corners
            across = corners[:, 0] * sides[:, 1] - corners[:, 1] * sides[:, 0]
            radius = float(np.min(np.abs(across) / np.hypot(*sides.T)))
        place = {"position": region["position"], "tolerance": radius}
        return [{"object": goal["object"], **place}]
    if "position" not in goal:
        return None
    goal = dict(goal)
    if other := goal.pop("relative_to", None):
        x, y, turn = poses[other]
        cos, sin = math.cos(turn), math.sin(turn)
        dx, dy = goal["position"]
        goal["position"] = [x + cos * dx - sin * dy, y + sin * dx + cos * dy]
    return [goal]


def step(words, push, stop):
    """Returns the step of a sampled push that ends at a stop."""
    made = {"tool": words[0], "grip_yaw": words[1], "form": "placed", "lift": 0.002}
    place = {"start": list(push[:2]), "direction": push[2], "speed": push[4]}
    return {"push": made | place | {"length": int(stop) * STEP * push[4]}}


def searched(task, most, seed):
    """Returns steps that reach all goals of a task, or `None`, and the number of rollouts."""
    poses, steps, spent = task.start, [], 0
    whole = task.to_dict()
    goals = whole["goal"] if isinstance(whole["goal"], list) else [whole["goal"]]
    named = dict(zip(task.objects, poses))
    waiting = [simplified(goal, named) for goal in goals]
    if None in waiting:
        return None, 0
    for goal in sum(waiting, []):
        error = math.inf
        while True:
            single = pushplan.Task.from_dict(whole | {"goal": goal}).at(poses)
            sampler = Sampler(single, seed)
            if spent + FIRST + NEXT > most or len(steps) == task.max_pushes:
                return None, spent
            sampler.search(True)
            spent += sampler.rollouts
            if sampler.plan is None:
                if not sampler.results or sampler.results[0][0] > (1 - GAIN) * error:
                    return None, spent
                error, *best = sampler.results[0]
            made = step(*(sampler.plan or best))
            end = replayed(plan_of(single, [made]))
            if not end.is_sound or (sampler.plan and end.failure):
                return None, spent
            steps.append(made)
            poses = np.array([end.ends[name] for name in task.objects])
            if sampler.plan:
                break
    # A later push may have moved an earlier object away.
    whole = plan_of(task, steps)
    return None if broken_rule(whole) or replayed(whole).failure else steps, spent


def answered(request, seed):
    """Returns the answer to a request."""
    began = time.process_time()
    most = request["budget"].get("rollouts") or math.inf
    found = {"id": request["id"], "status": "unknown"}
    spent = 0
    try:
        task = pushplan.Task.from_dict(request["task"])
        steps, spent = searched(task, most, seed)
        if steps:
            found |= {"status": "solved", "plan": {"plan": {"steps": steps}}}
    except (pushplan.PushplanError, ValueError, KeyError, IndexError) as error:
        found["note"] = f"{type(error).__name__}: {error}"[:200]
    return found | {"cost": {"processor_s": time.process_time() - began, "rollouts": spent}}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--seed", type=int, default=1, help="seed of the draws; default 1")
    arguments = parser.parse_args()
    for line in sys.stdin:
        print(json.dumps(answered(json.loads(line), arguments.seed)), flush=True)


if __name__ == "__main__":
    main()
