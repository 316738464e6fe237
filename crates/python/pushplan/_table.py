"""Base class of the Gymnasium environments."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

import gymnasium
import numpy as np
import numpy.typing as npt

from . import ActionError, FileError, Plan, Task, Tool, predict
from ._picture import Picture

__all__ = ["Action", "TableEnv"]

#: Maximum distance of an object from the robot, metres, as in files.
FAR = 20.0

#: Maximum number of draws of starts and goals until nothing overlaps.
TRIES = 100

Action = npt.NDArray[np.float32]


class TableEnv(gymnasium.Env[Action, Action]):
    """Base class of the environments: random starts and goals, observations and images.

    :class:`PushEnv` describes the parameters; ``steps`` is the maximum number of steps, and
    ``more`` the number of additional observations.
    """

    # A page shows one push, and so does a frame.
    metadata: ClassVar[dict[str, Any]] = {"render_modes": ["rgb_array", "html"], "render_fps": 10}  # type: ignore[misc]

    def __init__(
        self,
        task: Task,
        model: str,
        steps: int,
        spread: float,
        goal_spread: float,
        render_mode: str | None,
        more: int = 0,
    ) -> None:
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ValueError(
                f'`render_mode` must be "rgb_array", "html" or None, found {render_mode!r}'
            )
        goal: Any = task.to_dict()["goal"]
        if goal_spread > 0.0 and not (isinstance(goal, dict) and "position" in goal):
            raise ValueError(
                "`goal_spread` needs a task with one goal that has a `position`; set it to 0 for "
                "other tasks"
            )
        #: Task of this episode, with the drawn goal.
        self.task = task
        self.model, self.steps = model, steps
        self.spread, self.goal_spread = spread, goal_spread
        self.render_mode = render_mode
        self._given = task
        self._joined = bool(task.to_dict()["scene"].get("joints"))
        self._picture = Picture(task) if render_mode == "rgb_array" else None
        most = np.array(
            [FAR, FAR, 1.0, 1.0] * len(task.objects) + [FAR] * (5 * len(task.goal_objects) + more),
            dtype=np.float32,
        )
        self.observation_space = gymnasium.spaces.Box(-most, most, dtype=np.float32)
        self._poses = task.start
        self._first = task.score(self._poses)
        self._made = 0
        self._last: Plan | None = None
        #: Plan of this step; ``None`` if nothing moved.
        self._executed: Plan | None = None
        self._tool_pose: npt.NDArray[np.float64] | None = None

    @property
    def poses(self) -> npt.NDArray[np.float64]:
        """Poses of the objects, ``[objects, 3]``: x and y in metres, heading in radians."""
        return self._poses.copy()

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Action, dict[str, Any]]:
        """Resets the objects to the start, shifted by up to ``spread``, and draws the goal.

        Parameters
        ----------
        seed : int, optional
            Seed of the draws; without one, they continue.
        options : dict, optional
            Ignored.

        Returns
        -------
        tuple of ndarray and dict
            Observation, and ``info`` with the keys of :meth:`step`.
        """
        super().reset(seed=seed, options=options)
        self.task = self._drawn()
        self._poses = self.task.start
        self._first = self.task.score(self._poses)
        self._made = 0
        self._last, self._executed, self._tool_pose = None, None, None
        return self._seen(), self._info(None)

    def render(self) -> Any:
        """Returns the image, ``[256, 256, 3]``, the report of the last push, or ``None``."""
        if self.render_mode == "html":
            return None if self._last is None else self._last.page()
        if self._picture is None:
            return None
        return self._picture.of(
            self._poses, self.task.goal_position, self.task.tolerance, self._held()
        )

    def _held(self) -> tuple[Tool, npt.NDArray[np.float64]] | None:
        """Returns the tool on the table and its pose, or ``None``: by default, at the last end."""
        if self._last is None or self._tool_pose is None:
            return None
        return self._last.tool, self._tool_pose

    def _carried_out(self, planned: Callable[[], Plan]) -> tuple[float, bool, str | None]:
        """Returns the reward, whether the goal is reached, and the reason if nothing moved."""
        before = self.task.score(self._poses)
        self._made += 1
        refused, reached = None, False
        self._executed = None
        try:
            plan = planned()
            if plan.violations:
                refused = plan.violations[0]
            else:
                trajectory = predict(plan, self.model)
                self._last, self._executed = plan, plan
                self._tool_pose = trajectory.tool_poses[-1]
                self._poses, reached = self._within(trajectory.poses[-1]), trajectory.reached
        except ActionError as error:
            refused = str(error)
        gained = (before - self.task.score(self._poses)) / max(self._first, 1.0)
        return gained + float(reached), reached, refused

    def _drawn(self) -> Task:
        """Draws a start and a goal without overlaps; joined objects are shifted together."""
        if self.spread <= 0.0 and self.goal_spread <= 0.0:
            return self._given
        start = self._given.start
        for _ in range(TRIES):
            poses = start.copy()
            if self.spread > 0.0:
                shift = self.np_random.uniform(-self.spread, self.spread, (len(start), 2))
                poses[:, :2] += shift[:1] if self._joined else shift
            mapping: Any = self._given.at(poses).to_dict()
            if self.goal_spread > 0.0:
                x, y = mapping["goal"]["position"]
                aside = self.np_random.uniform(-self.goal_spread, self.goal_spread, 2)
                mapping["goal"]["position"] = [float(x + aside[0]), float(y + aside[1])]
            try:
                # The rules of task files decide which placements are valid.
                return Task.from_dict(mapping)
            except FileError:
                continue
        return self._given

    def _seen(self) -> Action:
        x, y, heading = self._poses.T
        objects = np.stack([x, y, np.cos(heading), np.sin(heading)], axis=1)
        names = self.task.objects
        own = self._poses[[names.index(name) for name in self.task.goal_subjects(self._poses)], :2]
        off = self.task.goal_offsets(self._poses)
        goals = np.concatenate([own - off[:, :2], -off[:, :2]], axis=1)
        return np.concatenate([objects.ravel(), -off[:, 2], goals.ravel()]).astype(np.float32)

    def _within(self, poses: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Returns the poses with headings from -pi to pi; joints count revolutions."""
        turns = np.zeros(len(poses)) if self._joined else np.round(poses[:, 2] / math.tau)
        return poses - math.tau * np.outer(turns, [0.0, 0.0, 1.0])

    def _info(self, refused: str | None) -> dict[str, Any]:
        score = self.task.score(self._poses)
        return {"score": score, "refused": refused, "plan": self._executed}
