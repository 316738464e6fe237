"""A Gymnasium environment: bring an object to its goal, one push a step.

    import gymnasium
    import pushplan.env

    env = gymnasium.make("pushplan/Push-v0", task=pushplan.Task.example("pull-back"))

It needs the package ``gymnasium``: ``pip install 'pushplan[gym]'``.
"""

from __future__ import annotations

import math
from typing import Any, ClassVar

import gymnasium
import numpy as np
import numpy.typing as npt

from . import ActionError, FileError, Plan, Push, Task, ToolLibrary, predict

__all__ = ["PushEnv"]

#: What a push costs, so that fewer are better; reaching the goal is worth one.
COST = 0.02

#: Farther out nothing comes, metres: files place things up to 10 m from the robot.
FAR = 20.0

#: How often shifted starts are drawn until nothing overlaps.
TRIES = 100


class PushEnv(gymnasium.Env[npt.NDArray[np.float32], npt.NDArray[np.float32]]):
    """One push a step, with the tools, the rules and the goal of a task.

    The tool comes down just before the goal's object and pushes it. An action is five numbers from
    -1 to 1: which tool, which grip yaw (both cut into equal parts, in the order of ``tools`` and
    ``task.grip_yaws``), the direction (in half turns from world +x), the lateral offset of the object
    (in units of ``most_offset``), and the length (by how many halves of the task's it is longer).
    :meth:`action` makes one of metres and radians.

    An observation is, for every object, x and y in metres and cosine and sine of its heading, then
    the goal's x and y and the way from the object to the goal, in metres.

    The reward is the share of the way to the goal that a push gains, and one for reaching it, less
    0.02 for the push. A push that cannot be made, or breaks a rule of the task, moves nothing;
    ``info["refused"]`` says why.

    Parameters:
        task: What to do.
        tools: The tools that the task chooses from; by default those that come with the package.
        model: Whose physics: "planar", "3d", "prior" and so on, see ``pushplan.predict``.
        pushes: How many may be made; by default twice as many as the task allows a plan.
        spread: By how much starts are shifted along x and y at most, at random, metres.
        most_offset: The largest lateral offset, metres.
        render_mode: ``"html"`` for the page of the last push, or ``None``.
    """

    # A frame is a push; its page plays it.
    metadata: ClassVar[dict[str, Any]] = {"render_modes": ["html"], "render_fps": 1}  # type: ignore[misc]

    def __init__(
        self,
        task: Task,
        *,
        tools: ToolLibrary | None = None,
        model: str = "planar",
        pushes: int | None = None,
        spread: float = 0.0,
        most_offset: float = 0.06,
        render_mode: str | None = None,
    ) -> None:
        if render_mode not in (None, "html"):
            raise ValueError('`render_mode` is "html" or None')
        self.task = task
        library = tools if tools is not None else ToolLibrary.shipped()
        #: The tools, in the order of the action's first number.
        self.tools = [library[name] for name in task.tools or library.names]
        # A model that does not exist is found out now, not at the first push.
        predict(Plan.of(task, self.tools[0], []), model)
        self.model = model
        self.pushes = 2 * task.max_pushes if pushes is None else pushes
        self.spread = spread
        self.most_offset = most_offset
        self.render_mode = render_mode
        most = np.array([FAR, FAR, 1.0, 1.0] * len(task.objects) + [FAR] * 4, dtype=np.float32)
        self.observation_space = gymnasium.spaces.Box(-most, most, dtype=np.float32)
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (5,), np.float32)
        self._poses = task.start
        self._first = task.score(self._poses)
        self._made = 0
        self._last: Plan | None = None

    @property
    def poses(self) -> npt.NDArray[np.float64]:
        """Where the objects are, ``[objects, 3]``: x and y in metres, heading in radians."""
        return self._poses.copy()

    def action(
        self,
        tool: str,
        direction: float,
        *,
        grip_yaw: float | None = None,
        offset: float = 0.0,
        length: float | None = None,
    ) -> npt.NDArray[np.float32]:
        """The action of a push with the tool of this name; radians and metres, by default the first
        grip yaw and the length of the task."""
        names = [one.name for one in self.tools]
        if tool not in names:
            raise ValueError(f"no tool is called `{tool}`; there are {', '.join(names)}")
        yaws = self.task.grip_yaws
        nearest = 0 if grip_yaw is None else int(np.argmin(np.abs(np.array(yaws) - grip_yaw)))
        usual = self.task.push_length
        half = math.remainder(direction, 2.0 * math.pi) / math.pi
        longer = 0.0 if length is None else 2.0 * (length / usual - 1.0)
        numbers = [
            _share(names.index(tool), len(names)),
            _share(nearest, len(yaws)),
            half,
            offset / self.most_offset,
            longer,
        ]
        if not all(-1.0 <= number <= 1.0 for number in numbers):
            raise ValueError("the offset or the length is outside of what an action can say")
        return np.array(numbers, dtype=np.float32)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[npt.NDArray[np.float32], dict[str, Any]]:
        """Puts everything back to the start, or shifted by up to ``spread``."""
        super().reset(seed=seed, options=options)
        self._poses = self._drawn()
        self._first = self.task.score(self._poses)
        self._made = 0
        self._last = None
        return self._seen(), self._info(None)

    def step(
        self, action: npt.NDArray[np.float32]
    ) -> tuple[npt.NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Makes one push."""
        before = self.task.score(self._poses)
        refused, reached = None, False
        self._made += 1
        try:
            plan = self._plan(action)
            if plan.broken:
                refused = plan.broken[0]
            else:
                self._last = plan
                trajectory = predict(plan, self.model)
                self._poses, reached = trajectory.poses[-1], trajectory.reached
        except ActionError as error:
            refused = str(error)
        gained = (before - self.task.score(self._poses)) / max(self._first, 1.0)
        reward = gained + float(reached) - COST
        truncated = self._made >= self.pushes and not reached
        return self._seen(), reward, reached, truncated, self._info(refused)

    def render(self) -> Any:
        """The page of the last push that was made, or ``None``."""
        if self.render_mode != "html" or self._last is None:
            return None
        return self._last.page()

    def _plan(self, action: npt.NDArray[np.float32]) -> Plan:
        tool, grip, half, offset, longer = (float(number) for number in np.clip(action, -1.0, 1.0))
        yaws = self.task.grip_yaws
        push = Push.before(
            self.task.goal_object,
            math.pi * half,
            offset * self.most_offset,
            self.task.push_length * (1.0 + 0.5 * longer),
        )
        yaw = yaws[_index(grip, len(yaws))]
        chosen = self.tools[_index(tool, len(self.tools))]
        return Plan.of(self.task.at(self._poses), chosen, [push], grip_yaw=yaw)

    def _drawn(self) -> npt.NDArray[np.float64]:
        """A start at which nothing overlaps; joined objects are shifted together."""
        start = self.task.start
        if self.spread <= 0.0:
            return start
        joined = bool(self.task.to_dict()["scene"].get("joints"))
        for _ in range(TRIES):
            shift = self.np_random.uniform(-self.spread, self.spread, (len(start), 2))
            poses = start.copy()
            poses[:, :2] += shift[:1] if joined else shift
            try:
                # The rules of task files say what may stand where.
                Task.of(self.task.at(poses).to_dict())
            except FileError:
                continue
            return poses
        return start

    def _seen(self) -> npt.NDArray[np.float32]:
        x, y, heading = self._poses.T
        goal = np.array(self.task.goal_position)
        place = self._poses[self.task.objects.index(self.task.goal_object), :2]
        objects = np.stack([x, y, np.cos(heading), np.sin(heading)], axis=1)
        return np.concatenate([objects.ravel(), goal, goal - place]).astype(np.float32)

    def _info(self, refused: str | None) -> dict[str, Any]:
        return {"score": self.task.score(self._poses), "refused": refused}


def _index(number: float, count: int) -> int:
    """Which of ``count`` equal parts of -1 to 1 a number lies in."""
    return min(int(0.5 * (number + 1.0) * count), count - 1)


def _share(index: int, count: int) -> float:
    """The middle of such a part."""
    return (2.0 * index + 1.0) / count - 1.0


gymnasium.register(id="pushplan/Push-v0", entry_point="pushplan.env:PushEnv")
