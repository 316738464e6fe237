"""Construction of solvable tasks backwards: pushes are replayed, and goals are placed at the end.

The replay is MuJoCo's, which shares no code with the planner. Every witness also works with its
tool shifted by two millimetres to either side, so that no task needs a knife-edge.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from .. import ActionError, Plan, Push, PushplanError, Task, Tool, ToolLibrary, solve
from ..files import TaskFile, ToolFile
from .draw import Draw
from .judge import judged, plan_of, worlds
from .replay import replayed, require_mujoco
from .sketch import Ends, Sketch, Stroke

__all__ = ["DRAWS", "Made", "construct", "with_goals"]

#: Number of draws after which a task is given up.
DRAWS = 3000
#: Shifts of the tool across the push with which a witness must work, metres.
SHIFTS = (-0.002, 0.002)

Kind = Callable[[Draw], Sketch]


@dataclass(frozen=True)
class Made:
    """Task that was constructed, with its witness."""

    #: Number of the draw, which repeats the sketch.
    draw: int
    goals: list[dict[str, Any]]
    #: Steps of the witness with the keys of a plan file.
    steps: list[dict[str, Any]]


def with_goals(task: TaskFile, goals: list[dict[str, Any]]) -> TaskFile:
    """Returns the task with these goals."""
    found = cast(dict[str, Any], copy.deepcopy(task))
    found["goal"] = goals if len(goals) > 1 else goals[0]
    return cast(TaskFile, found)


def construct(kind: Kind, *key: object) -> Made:
    """Draws a task of a kind until one fits.

    Raises
    ------
    PushplanError
        If no draw fits, or MuJoCo is missing.
    """
    require_mujoco()
    for number in range(DRAWS):
        made = _attempt(kind(Draw(*key, number)), number, " ".join(map(str, key)))
        if made is not None:
            return made
    raise PushplanError(f"none of {DRAWS} draws of {key} is a task; this is a fault of the board")


def _attempt(sketch: Sketch, number: int, key: str) -> Made | None:
    """Returns the task of a sketch; `None` if the sketch does not fit."""
    try:
        task = Task.from_dict(sketch.task)
        if sketch.goals is not None:
            return _searched(sketch, number)
        start = _poses(task, task.start)
        steps: list[dict[str, Any]] = []
        ends = start
        for stroke in sketch.strokes:
            step = _step(task.at(_rows(task, ends)), stroke, sketch.new_tools)
            if step is None:
                return None
            now = task.at(_rows(task, ends))
            end = replayed(plan_of(now, [step], sketch.new_tools))
            if not end.is_sound:
                return None
            steps, ends = [*steps, step], end.ends
        goals = sketch.rule(start, ends)
        if goals is None:
            return None
        whole = Task.from_dict(with_goals(sketch.task, goals))
    except (ActionError, PushplanError):
        return None
    if whole.reached(whole.start) == [True] * len(goals):
        return None
    hidden = worlds(whole, key) if sketch.hidden else []
    for shift in (0.0, *SHIFTS):
        pushes = {"steps": [_shifted(one, shift) for one in steps]}
        moved = {"plan": pushes, "tools": sketch.new_tools}
        if judged(whole, hidden, moved, len(sketch.new_tools)) is not None:
            return None
    return Made(number, goals, steps)


def _searched(sketch: Sketch, number: int) -> Made | None:
    """Returns a task whose plan is the planner's, confirmed by MuJoCo."""
    assert sketch.goals is not None
    task = Task.from_dict(with_goals(sketch.task, sketch.goals))
    solution = solve(task, threads=1)
    if not solution.solved or solution.best is None:
        return None
    steps = solution.best.steps
    if judged(task, [], {"plan": {"steps": steps}}) is not None:
        return None
    return Made(number, sketch.goals, steps)


def _step(task: Task, stroke: Stroke, new_tools: list[ToolFile]) -> dict[str, Any] | None:
    """Returns the step of a stroke, rounded; `None` if it violates a rule."""
    own = {tool["name"]: tool for tool in new_tools}
    name = stroke.tool
    tool = Tool.from_dict(own[name]) if name in own else ToolLibrary.shipped()[name]
    direction = math.radians(stroke.direction)
    push = Push.before(stroke.object, direction, stroke.offset, stroke.length)
    plan = Plan.of(task, tool, [push], grip_yaw=math.radians(stroke.grip_yaw))
    if plan.violations:
        return None
    [step] = copy.deepcopy(plan.steps)
    details = step["push"]
    details["start"] = [round(x, 4) for x in details["start"]]
    for key in ("direction", "length", "grip_yaw"):
        details[key] = round(details[key], 6)
    return step


def _shifted(step: dict[str, Any], by: float) -> dict[str, Any]:
    """Returns a push that starts farther to its left."""
    found = copy.deepcopy(step)
    details = found["push"]
    x, y = details["start"]
    turn = details["direction"]
    details["start"] = [x - by * math.sin(turn), y + by * math.cos(turn)]
    return found


def _poses(task: Task, rows: Any) -> Ends:
    """Returns poses by name of the object."""
    return {
        name: (float(row[0]), float(row[1]), float(row[2])) for name, row in zip(task.objects, rows)
    }


def _rows(task: Task, poses: Ends) -> Any:
    """Returns poses in the order of the task's objects."""
    return np.array([poses[name] for name in task.objects])
