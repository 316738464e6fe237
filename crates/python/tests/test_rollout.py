"""Rollouts into arrays equal the single predictions."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import pushplan

PUSHES = np.array(
    [
        [0.47, 0.02, 3.14, 0.20, 0.10],
        [0.47, 0.02, 3.14, 0.05, 0.20],
        [0.45, 0.03, 3.00, 0.15, 0.10],
    ]
)


@pytest.mark.parametrize("model", ["prior", "network", "planar"])
def test_every_candidate_is_its_prediction(task: pushplan.Task, model: str) -> None:
    rolled = pushplan.rollout(task, "l-hook", PUSHES, model=model)
    assert len(rolled) == 3
    assert rolled.poses.shape == (3, rolled.frames.max(), 1, 3)
    assert rolled.tool_poses.shape == (3, rolled.frames.max(), 3)
    for k, (x, y, direction, length, speed) in enumerate(PUSHES):
        push = pushplan.Push([x, y], direction, length, speed)
        plan = pushplan.Plan.of(task, "l-hook", [push], grip_yaw=0.0)
        predicted = pushplan.predict(plan, model)
        count = rolled.frames[k]
        assert count == len(predicted)
        assert (rolled.poses[k, :count] == predicted.poses).all()
        assert (rolled.tool_poses[k, :count] == predicted.tool_poses).all()
        assert (rolled.times[k, :count] == predicted.times).all()
        # A finished candidate repeats its last frame.
        assert (rolled.poses[k, count:] == predicted.poses[-1]).all()
        assert rolled.errors[k] == predicted.error
        assert rolled.reached[k] == predicted.reached
        assert np.isnan(rolled.heading_errors[k]) and predicted.heading_error is None
    # The hook pulls the can.
    assert rolled.poses[0, -1, 0, 0] < task.start[0, 0] - 0.1


def test_predictions_are_those_of_the_command(
    task: pushplan.Task, command: object, tmp_path: Path
) -> None:
    path = tmp_path / "poses.csv"
    ran = command(  # type: ignore[operator]
        "predict", "tasks/pull-back-behind-wall.yaml", "--model", "prior", "--tool", "l-hook",
        "--push", "can:180", "--export", path,
    )  # fmt: skip
    assert ran.returncode == 0, ran.stderr
    rows = [line.split(",") for line in path.read_text().splitlines()[1:]]
    expected = [[float(word) for word in row[-4:]] for row in rows if row[1] == "prior"]
    plan = pushplan.Plan.of(task, "l-hook", [pushplan.Push.before("can", np.pi)])
    found = pushplan.predict(plan, "prior")
    assert np.array_equal(np.column_stack([found.times, found.poses[:, 0]]), expected)


def test_threads_and_company_change_nothing(task: pushplan.Task) -> None:
    rng = np.random.default_rng(5)
    many = np.repeat(PUSHES, 200, axis=0)
    many[:, :2] += rng.uniform(-0.02, 0.02, (600, 2))
    one, three = (pushplan.rollout(task, "l-hook", many, threads=n) for n in (1, 3))
    assert np.array_equal(one.poses, three.poses) and np.array_equal(one.errors, three.errors)
    few = pushplan.rollout(task, "l-hook", many[300:303])
    assert np.array_equal(few.poses[:, -1], one.poses[300:303, -1])
    last = pushplan.rollout(task, "l-hook", many, record="outcome")
    assert last.poses.shape == (600, 1, 1, 3)
    assert np.array_equal(last.errors, one.errors)


def test_starts_and_grip_yaws_are_one_for_all_or_one_for_each(task: pushplan.Task) -> None:
    starts = np.repeat(task.start[None], 3, axis=0)
    starts[1, 0, 1] += 0.01
    rolled = pushplan.rollout(task, "l-hook", PUSHES, start=starts, grip_yaw=[0.0, 0.0, 0.1])
    assert np.array_equal(rolled.poses[:, 0], starts)
    alone = pushplan.rollout(task, "l-hook", PUSHES[1:2], start=starts[1])
    assert np.array_equal(alone.poses[0, -1], rolled.poses[1, -1])
    turned = pushplan.rollout(task, "l-hook", PUSHES[2:], grip_yaw=0.1)
    assert np.array_equal(turned.poses[0, -1], rolled.poses[2, -1])
    assert rolled.tool_poses[2, 0, 2] == pytest.approx(0.1)


def test_sequences_of_pushes_go_on_where_the_last_one_left_things(task: pushplan.Task) -> None:
    pairs = np.stack([PUSHES, PUSHES + [-0.02, 0.0, 0.0, 0.0, 0.0]], axis=1)
    rolled = pushplan.rollout(task, "l-hook", pairs)
    first = pushplan.rollout(task, "l-hook", pairs[:, 0])
    second = pushplan.rollout(task, "l-hook", pairs[:, 1], start=first.poses[:, -1])
    # Within a sequence, corrections of a push do not change the contacts of the next one.
    assert np.allclose(rolled.poses[:, -1], second.poses[:, -1], atol=1e-3)


@pytest.mark.parametrize(
    ("pushes", "message"),
    [
        (np.zeros((2, 4)), "pushes.*found"),
        (np.zeros((2, 0, 5)), "pushes.*found"),
        (np.full((1, 5), np.nan), "finite"),
        ([[0.4, 0.0, 0.0, -0.1, 0.1]], "lengths"),
        ([[0.4, 0.0, 0.0, 0.1, 0.0]], "speeds"),
        ([[0.4, 0.0, 0.0, 1e9, 0.1]], "lengths"),
    ],
)
def test_what_is_no_push_is_refused(task: pushplan.Task, pushes: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        pushplan.rollout(task, "l-hook", pushes)  # type: ignore[arg-type]


def test_other_mistakes_are_refused(task: pushplan.Task) -> None:
    with pytest.raises(pushplan.ActionError, match="no tool is called `spoon`; use one of"):
        pushplan.rollout(task, "spoon", PUSHES)
    with pytest.raises(TypeError, match="name of one"):
        pushplan.rollout(task, 3, PUSHES)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="start"):
        pushplan.rollout(task, "l-hook", PUSHES, start=np.zeros((2, 3)))
    with pytest.raises(ValueError, match="grip_yaw"):
        pushplan.rollout(task, "l-hook", PUSHES, grip_yaw=[0.0, 1.0])
    with pytest.raises(ValueError, match="from 0 to 1024"):
        pushplan.rollout(task, "l-hook", PUSHES, threads=5000)
    with pytest.raises(ValueError, match="`length` must be"):
        pushplan.Push([0.0, 0.0], 0.0, length=-1.0)
    with pytest.raises(pushplan.ActionError, match="no object is called"):
        pushplan.Plan.of(task, "stick", [pushplan.Push.before("cup", 0.0)])


def test_no_candidates_are_no_rollouts(task: pushplan.Task) -> None:
    rolled = pushplan.rollout(task, "l-hook", np.zeros((0, 5)))
    assert len(rolled) == 0 and rolled.errors.shape == (0,)


def test_wild_numbers_do_no_harm(task: pushplan.Task) -> None:
    rng = np.random.default_rng(11)
    pushes = rng.normal(0.0, 1.0, (200, 5)) * 10.0 ** rng.uniform(-6, 6, (200, 5))
    # An angle beyond two revolutions is an error.
    pushes[:, 2] = np.remainder(pushes[:, 2], 2.0 * np.pi)
    pushes[:, 3:] = np.clip(np.abs(pushes[:, 3:]), 1e-6, 2.0)
    starts = rng.normal(0.5, 0.3, (200, 1, 3)) * 10.0 ** rng.uniform(-3, 6, (200, 1, 3))
    rolled = pushplan.rollout(task, "rake", pushes, start=starts, record="outcome")
    assert rolled.errors.shape == (200,)


def test_a_broken_rule_is_reported_and_a_plan_is_still_returned(
    task: pushplan.Task, tmp_path: Path
) -> None:
    far = pushplan.Push([2.0, 0.0], 0.0, 0.1)
    plan = pushplan.Plan.of(task, "stick", [far])
    assert plan.violations and plan.violations[0].startswith("push 1: ")
    allowed = pushplan.solve(task).best
    assert allowed
    for one in (plan, allowed):
        one.save(tmp_path / "plan.json")
        assert bool(pushplan.Plan.load(tmp_path / "plan.json").violations) == (one is plan)
    assert not pushplan.verify(plan, replays=0).passed
