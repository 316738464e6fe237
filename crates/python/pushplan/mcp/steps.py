"""Next push of a closed loop from the observations so far.

The loop keeps no state between calls. It is run again from the first observation, with the recorded
observations as the world; equal observations give equal pushes. The first push without an
observation is the answer.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Any, NoReturn, Optional

import numpy as np
import numpy.typing as npt

import pushplan
from pushplan import Motion, Progress, Task, ToolLibrary

from .inputs import InputError

__all__ = ["next_push"]

_Floats = npt.NDArray[np.float64]

#: Maximum number of observations.
MOST = 50
#: Time after which objects rest, seconds; only the last pose of a motion is recorded.
REST = 1.0


class _Asked(Exception):
    """End of the recorded observations: the loop decided on a motion."""

    def __init__(self, motion: Motion) -> None:
        super().__init__("next motion")
        self.motion = motion


class _Recorded:
    """World that repeats recorded observations."""

    def __init__(self, observations: list[_Floats]) -> None:
        self.observations = observations
        self.made = 0

    def look(self) -> _Floats:
        return self.observations[self.made]

    def act(self, motion: Motion) -> Iterable[tuple[float, _Floats]]:
        if self.made + 1 >= len(self.observations):
            raise _Asked(motion)
        before = self.observations[self.made]
        self.made += 1
        duration = sum(motion.durations)
        return [(0.0, before), (duration + REST, self.observations[self.made])]


def next_push(
    task: Task,
    library: ToolLibrary,
    observations: object,
    *,
    seed: int,
    max_pushes: int,
    threads: int,
    progress: Callable[[Progress], object],
) -> tuple[str, Optional[str], dict[str, Any], dict[str, Any]]:
    """Returns status, cause, evidence and further keys of the next push.

    The status is `push` with a push, or the reason for the end of the loop.
    """
    poses = _poses(task, observations)
    world = _Recorded(poses)
    now = task.at(poses[-1])
    evidence: dict[str, Any] = {
        "observations": len(poses),
        "goals_reached": task.reached(poses[-1]),
        "score": task.score(poses[-1]),
    }
    try:
        run = pushplan.run(
            task, world, library, seed=seed, max_pushes=max_pushes, threads=threads,
            progress=progress,
        )  # fmt: skip
    except _Asked as asked:
        motion = asked.motion
        evidence |= _predicted(now, motion, threads)
        return "push", None, evidence, {"push": _written(motion)}
    evidence["notes"] = run.notes
    if world.made + 1 < len(poses):
        text = f"the loop ended after observation {world.made + 1} of {len(poses)}"
        evidence["notes"] = [*run.notes, text]
    if run.end == "reached":
        return "reached", None, evidence, {}
    return run.end, _REASONS[run.end], evidence, {}


_REASONS = {
    "budget_exhausted": "all allowed pushes are made; raise `max_pushes`",
    "no_improving_push": "no push brings the object nearer to the goal; call `why` for the cause",
    "rule_broken": "an object breaks `keep` or `keep_out`; the notes name it",
}


def _poses(task: Task, observations: object) -> list[_Floats]:
    names = task.objects
    if observations is None:
        return [np.asarray(task.start)]
    if not isinstance(observations, list) or not 1 <= len(observations) <= MOST:
        raise InputError(
            f"`observations` must be a list of 1 to {MOST} observations: before the first push, "
            "and after each push"
        )
    return [_pose(one, k, names, np.asarray(task.start)) for k, one in enumerate(observations)]


def _pose(one: object, k: int, names: list[str], start: _Floats) -> _Floats:
    """Reads an observation: a list of poses, or an object with a pose for each name."""
    rows: list[Any]
    if isinstance(one, dict):
        unknown = [name for name in one if name not in names]
        if unknown:
            _fail(k, f"names an unknown object `{unknown[0]}`; use {', '.join(names)}")
        rows = [one.get(name, [None] * 3) for name in names]
    elif isinstance(one, list) and len(one) == len(names):
        rows = one
    else:
        _fail(k, f"must have {len(names)} poses, of {', '.join(names)}")
    found = []
    for row in rows:
        if not isinstance(row, list) or len(row) != 3:
            _fail(k, "must have poses [x, y, heading], in metres and radians")
        numbers = [math.nan if value is None else value for value in row]
        if not all(isinstance(n, (int, float)) and not isinstance(n, bool) for n in numbers):
            _fail(k, "must have poses of numbers; null is a number that was not observed")
        found.append([float(n) for n in numbers])
    poses: _Floats = np.array(found)
    if np.isinf(poses).any() or np.nanmax(np.abs(poses), initial=0.0) > 100.0:
        _fail(k, "must have poses in metres and radians")
    return np.where(np.isnan(poses), start, poses)


def _fail(k: int, text: str) -> NoReturn:
    raise InputError(f"`observations[{k}]` {text}")


def _written(motion: Motion) -> dict[str, Any]:
    strokes = []
    for row, duration in zip(motion.end_effector.tolist(), motion.durations):
        strokes.append({"from": row[:3], "to": row[3:], "duration": duration})
    return {"tool": motion.tool.name, "lift": motion.lift, "strokes": strokes}


def _predicted(now: Task, motion: Motion, threads: int) -> dict[str, Any]:
    """Returns the predicted poses after a motion, with the values of the task."""
    pushes: list[list[float]] = []
    for x, y, _, to_x, to_y, _ in motion.end_effector.tolist():
        length = math.hypot(to_x - x, to_y - y)
        duration = motion.durations[len(pushes)]
        pushes.append([x, y, math.atan2(to_y - y, to_x - x), length, length / max(duration, 1e-9)])
    rolled = pushplan.rollout(
        now, motion.tool, [pushes], grip_yaw=float(motion.end_effector[0, 2]), record="outcome",
        threads=threads,
    )  # fmt: skip
    return {
        "predicted_poses": rolled.poses[0, -1].tolist(),
        "predicted_to_reach_goal": bool(rolled.reached[0]),
        "model": "network",
        "objects": rolled.objects,
    }
