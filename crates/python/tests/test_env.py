"""The environments satisfy the rules of Gymnasium and of tasks."""

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
    assert reached and not truncated and info["refused"] is None
    [push] = info["plan"].pushes
    assert info["plan"].tool.name == "l-hook" and push.length == pytest.approx(0.165)
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
    # Actions have single precision.
    assert np.allclose(env.poses, pushplan.predict(plan, "prior").poses[-1], atol=1e-4)


@pytest.mark.parametrize("name", ["pull-back", "pull-back-behind-wall", "crowd", "turn-the-box"])
def test_random_actions_move_something(name: str) -> None:
    env = pushplan.env.PushEnv(pushplan.Task.example(name))
    env.reset(seed=0)
    env.action_space.seed(0)
    refused = 0
    for _ in range(60):
        _, _, terminated, truncated, info = env.step(env.action_space.sample())
        refused += info["refused"] is not None
        assert (info["plan"] is None) == (info["refused"] is not None)
        if info["plan"] is not None:
            # The executed push violates no rule of the task.
            assert info["plan"].violations == []
        if terminated or truncated:
            env.reset()
    assert refused <= 6


def test_the_nearest_allowed_push_replaces_a_forbidden_one(task: pushplan.Task) -> None:
    env = pushplan.env.PushEnv(task)
    env.reset()
    # The arm cannot reach that far.
    _, _, _, _, info = env.step(env.action("l-hook", math.pi, length=0.1))
    assert info["plan"].pushes[0].direction == pytest.approx(math.pi)
    env.reset()
    # Away from the robot, the wall obstructs the push.
    _, _, _, _, info = env.step(env.action("stick", 0.0))
    [push] = info["plan"].pushes
    assert info["refused"] is None and info["plan"].violations == []
    assert push.direction != 0.0 or push.length < task.push_length


def test_a_push_that_cannot_be_made_moves_nothing(task: pushplan.Task) -> None:
    keys = task.to_dict()
    # The hand can be only at a distance at which no tool is at the can.
    keys["robot"]["reach"] = {"min": 0.3, "max": 0.31}
    task = pushplan.Task.from_dict(keys)
    env = pushplan.env.PushEnv(task, pushes=2)
    env.reset()
    for _ in range(2):
        _, reward, terminated, truncated, info = env.step(env.action("stick", 0.0))
        assert info["refused"] and info["plan"] is None and (env.poses == task.start).all()
        assert reward == -pushplan.env.COST and terminated and not truncated


def test_seeds_shift_starts_alike(root: Path) -> None:
    task = pushplan.Task.load(root / "tasks/jointed-pair.yaml")
    env = pushplan.env.PushEnv(task, spread=0.02)
    shifts = []
    for seed in (1, 1, 2):
        env.reset(seed=seed)
        shifts.append(env.poses - task.start)
    assert (shifts[0] == shifts[1]).all() and (shifts[0] != shifts[2]).any()
    assert 0.0 < np.abs(shifts[0]).max() <= 0.02
    # Jointed objects move together.
    assert np.allclose(shifts[0][0], shifts[0][1])


# Prismatic joint with limits, and revolute joints.
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


def test_goals_are_drawn_and_pictures_show_what_moved(task: pushplan.Task) -> None:
    env = pushplan.env.PushEnv(task, goal_spread=0.03, render_mode="rgb_array")
    goals = []
    for seed in (1, 1, 2):
        seen, _ = env.reset(seed=seed)
        goals.append(env.task.goal_position)
        assert seen[-4:-2] == pytest.approx(goals[-1]) and (env.poses == task.start).all()
    assert goals[0] == goals[1] != goals[2]
    assert 0.0 < np.abs(np.subtract(goals, task.goal_position)).max() <= 0.03
    before = env.render()
    assert before.shape == (256, 256, 3) and before.dtype == np.uint8
    env.step(env.action("l-hook", math.pi, length=0.1))
    after = env.render()
    # Column of the robot, and tool at the end of the push.
    base, tool = np.array([50, 60, 80]), np.array([70, 120, 200])
    assert (before == base).all(axis=2).any() and not (before == tool).all(axis=2).any()
    assert (after == base).all(axis=2).any() and (after == tool).all(axis=2).any()
    # Seen from behind the robot: x is up, and the can was pulled down.
    wanted = np.array([205, 85, 60])
    rows = [np.nonzero((picture == wanted).all(axis=2))[0].mean() for picture in (before, after)]
    assert rows[1] > rows[0] + 10
    two = pushplan.Task.example("two-places")
    with pytest.raises(ValueError, match="one goal"):
        pushplan.env.PushEnv(two, goal_spread=0.01)


def test_with_one_of_two_goals_met_nothing_is_reached() -> None:
    task = pushplan.Task.example("two-places")
    poses = task.start
    off = task.goal_offsets(poses)
    assert off.shape == (2, 3) and task.goal_objects[0] == task.goal_object
    poses[task.objects.index(task.goal_objects[0]), :2] -= off[0, :2]
    poses[task.objects.index(task.goal_objects[0]), 2] -= off[0, 2]
    assert task.reached(poses) == [True, False] and task.score(poses) > 1.0
    env = pushplan.env.PushEnv(task.at(poses))
    seen, info = env.reset(seed=0)
    assert info["score"] > 1.0 and seen.shape == env.observation_space.shape
    assert np.linalg.norm(seen[-2:]) > task.tolerance
    # A push beside the object, which touches nothing.
    _, reward, reached, _, _ = env.step(
        env.action(env.tools[0].name, math.pi, length=0.5 * task.push_length)
    )
    assert not reached and reward < 1.0


@pytest.mark.filterwarnings("error")
def test_a_push_is_steered_piece_by_piece(task: pushplan.Task) -> None:
    check_env(gymnasium.make("pushplan/Steer-v0", task=task, hand=(0.3, -0.1)).unwrapped)
    best = pushplan.solve(task, effort="draft").best
    assert best is not None
    [push] = best.pushes
    assert push.start is not None and push.length is not None
    env = pushplan.env.SteerEnv(task, tool=best.tool, hand=push.start, grip_yaw=best.grip_yaw)
    env.reset()
    way = np.array([math.cos(push.direction), math.sin(push.direction)], dtype=np.float32)
    for made in range(20):
        seen, _, reached, truncated, info = env.step(way)
        assert info["refused"] is None and not truncated
        if reached:
            break
    assert reached and (made + 1) * env.stride == pytest.approx(push.length, abs=0.04)
    assert seen[-2:] == pytest.approx(
        np.array(push.start) + (made + 1) * env.stride * way, abs=1e-5
    )
    # The whole push gives the same result, except that objects do not rest in between.
    whole = pushplan.predict(best, "planar").poses[-1]
    assert np.linalg.norm(env.poses[0, :2] - whole[0, :2]) < 0.03
    # Out of reach, nothing moves.
    env.reset()
    poses, away = env.poses, np.array([-1.0, 0.0], dtype=np.float32)
    infos = [env.step(away)[-1] for _ in range(30)]
    assert infos[-1]["refused"] is not None
    assert np.linalg.norm(env.step(away)[0][-2:]) >= task.reach[0] - 1e-6
