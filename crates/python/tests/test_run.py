"""Closed loop in a simulated world and in a world implemented in Python."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pushplan


class Table:
    """World that this package simulates, in place of a robot and a camera."""

    def __init__(self, task: pushplan.Task) -> None:
        self.task = task
        self.poses = np.array(task.start)
        self.motions: list[pushplan.Motion] = []

    def look(self) -> Any:
        return self.poses

    def act(self, motion: pushplan.Motion) -> list[tuple[float, Any]]:
        self.motions.append(motion)
        [stroke] = motion.end_effector
        along = stroke[3:5] - stroke[:2]
        length = np.hypot(*along)
        push = [*stroke[:2], np.arctan2(along[1], along[0]), length, length / motion.durations[0]]
        rolled = pushplan.rollout(
            self.task, motion.tool, [push], grip_yaw=stroke[2], start=self.poses, model="planar"
        )
        self.poses = rolled.poses[0, -1]
        return list(zip(rolled.times[0][1:], rolled.poses[0][1:]))


def test_a_task_is_carried_out_in_a_world_of_python(task: pushplan.Task) -> None:
    table = Table(task)
    ran = pushplan.run(task, table)
    assert ran.reached and ran.end == "reached"
    assert task.score(table.poses) <= 1.0
    assert len(ran.pushes) == len(table.motions) >= 1
    assert ran.pushes[0].start == pytest.approx(tuple(table.motions[0].end_effector[0, :2]))
    assert ran.poses == pytest.approx(table.poses, abs=5e-3)
    assert "push" in str(ran) and ran.to_dict()["kind"] == "run"


def test_a_number_draws_a_reproducible_world(root: Path, tmp_path: Path) -> None:
    task = pushplan.Task.load(root / "tasks/hidden-hinge.yaml")
    once, again = (pushplan.run(task, 1, threads=threads) for threads in (1, 2))
    assert once.to_dict() == again.to_dict()
    once.save(tmp_path / "trace.run.json")
    assert (tmp_path / "trace.run.json").stat().st_size > 1000


def test_a_drawn_world_reports_where_the_arm_stopped(root: Path) -> None:
    text = (root / "tasks" / "pull-back.yaml").read_text()
    weak = pushplan.Task.parse(text.replace("robot: {", "robot: {max_force: 0.1, "), "weak")
    ran = pushplan.run(weak, 1, max_pushes=2)
    assert not ran.reached
    assert any("ended early" in note for note in ran.notes)


def test_what_a_world_raises_comes_back(task: pushplan.Task) -> None:
    class Broken(Table):
        def act(self, motion: pushplan.Motion) -> Any:
            raise ConnectionError("the arm is off")

    with pytest.raises(ConnectionError, match="the arm is off"):
        pushplan.run(task, Broken(task))

    class Elsewhere(Table):
        def look(self) -> Any:
            return np.zeros((7, 3))

    with pytest.raises(ValueError, match="7 objects were observed"):
        pushplan.run(task, Elsewhere(task))

    class Flat(Table):
        def look(self) -> Any:
            return [0.0, 1.0]

    with pytest.raises(ValueError, match=r"\[objects, 3\]"):
        pushplan.run(task, Flat(task))
    nothing: Any = object()
    with pytest.raises(TypeError, match="`look` and `act`"):
        pushplan.run(task, nothing)
