"""The environment keeps Gymnasium's rules, and ours."""

from __future__ import annotations

import math
from pathlib import Path

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import pushplan
import pushplan.env


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    ("name", "spread"), [("pull-back-behind-wall", 0.01), ("jointed-pair", 0.02), ("crowd", 0.0)]
)
def test_gymnasium_accepts_it(root: Path, name: str, spread: float) -> None:
    task = pushplan.Task.load(root / f"tasks/{name}.yaml")
    check_env(gymnasium.make("pushplan/Push-v0", task=task, spread=spread).unwrapped)


def test_a_good_push_reaches_the_goal(task: pushplan.Task) -> None:
    env = pushplan.env.PushEnv(task, render_mode="html")
    env.reset(seed=0)
    action = env.action("l-hook", math.pi, offset=0.0, length=0.165)
    seen, reward, reached, truncated, info = env.step(action)
    assert reached and not truncated and info == {"score": info["score"], "refused": None}
    assert info["score"] < 1.0 and reward > 1.5
    assert np.linalg.norm(seen[-2:]) < task.tolerance
    assert env.render().startswith("<!DOCTYPE html>")


def test_a_model_that_does_not_exist_is_found_out_at_once(task: pushplan.Task) -> None:
    with pytest.raises(pushplan.ModelError, match="nope"):
        pushplan.env.PushEnv(task, model="nope")


def test_its_physics_are_those_of_predict(task: pushplan.Task) -> None:
    env = pushplan.env.PushEnv(task, model="prior")
    env.reset()
    env.step(env.action("l-hook", math.pi, length=0.15))
    push = pushplan.Push.before("can", math.pi, length=0.15)
    plan = pushplan.Plan.of(task, "l-hook", [push], grip_yaw=0.0)
    # Actions are of single precision.
    assert np.allclose(env.poses, pushplan.predict(plan, "prior").poses[-1], atol=1e-4)


def test_a_push_that_cannot_be_made_moves_nothing(task: pushplan.Task) -> None:
    env = pushplan.env.PushEnv(task, pushes=2)
    env.reset()
    # Away from the robot the wall is in the way.
    for last in (False, True):
        _, reward, reached, truncated, info = env.step(env.action("stick", 0.0))
        assert info["refused"] and (env.poses == task.start).all()
        assert reward == -pushplan.env.COST and not reached and truncated == last


def test_seeds_shift_starts_alike(root: Path) -> None:
    task = pushplan.Task.load(root / "tasks/jointed-pair.yaml")
    env = pushplan.env.PushEnv(task, spread=0.02)
    shifts = []
    for seed in (1, 1, 2):
        env.reset(seed=seed)
        shifts.append(env.poses - task.start)
    assert (shifts[0] == shifts[1]).all() and (shifts[0] != shifts[2]).any()
    assert 0.0 < np.abs(shifts[0]).max() <= 0.02
    # What hangs together goes together.
    assert np.allclose(shifts[0][0], shifts[0][1])


# A joint that slides within limits, and joints that turn.
@pytest.mark.parametrize("name", ["drawer", "hinged-train"])
def test_a_moved_task_goes_on_where_it_was(root: Path, name: str) -> None:
    task = pushplan.Task.load(root / f"tasks/{name}.yaml")
    solution = pushplan.solve(task, effort="draft")
    assert solution.best is not None
    [push] = solution.best.pushes
    assert push.start is not None and push.length is not None
    half = pushplan.Push(push.start, push.direction, push.length / 2)
    tool, yaw = solution.best.tool, solution.best.grip_yaw
    whole = pushplan.predict(pushplan.Plan.of(task, tool, [push], grip_yaw=yaw), "planar")
    first = pushplan.predict(pushplan.Plan.of(task, tool, [half], grip_yaw=yaw), "planar")
    now = task.at(first.poses[-1])
    x, y = first.tool_poses[-1, :2] - first.tool_poses[0, :2] + push.start
    rest = pushplan.Push([x, y], push.direction, push.length / 2)
    second = pushplan.predict(pushplan.Plan.of(now, tool, [rest], grip_yaw=yaw), "planar")
    assert np.allclose(second.poses[-1], whole.poses[-1], atol=2e-3)
    assert now.score(first.poses[-1]) == pytest.approx(first.error / task.tolerance)
