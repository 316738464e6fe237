"""Gymnasium environments that push an object to its goal: a whole push or a part of one per step.

    import gymnasium
    import pushplan.env

    task = pushplan.Task.example("pull-back")
    env = gymnasium.make("pushplan/Push-v0", task=task)
    env = gymnasium.make("pushplan/Steer-v0", task=task, tool="l-hook")

The environments need the package ``gymnasium``: ``pip install 'pushplan[gym]'``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

import gymnasium
import numpy as np
import numpy.typing as npt

from . import ActionError, FileError, Plan, Push, Task, Tool, ToolLibrary, predict
from ._picture import Picture

__all__ = ["PushEnv", "SteerEnv"]

#: Cost of a push, so that fewer pushes are better; reaching the goal is worth one.
COST = 0.02

#: Maximum distance of an object from the robot, metres, as in files.
FAR = 20.0

#: Maximum number of draws of starts and goals until nothing overlaps.
TRIES = 100

#: Minimum length of a move, metres.
LEAST = 1e-4

_Action = npt.NDArray[np.float32]


class _TableEnv(gymnasium.Env[_Action, _Action]):
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

    @property
    def poses(self) -> npt.NDArray[np.float64]:
        """Poses of the objects, ``[objects, 3]``: x and y in metres, heading in radians."""
        return self._poses.copy()

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[_Action, dict[str, Any]]:
        """Resets the objects to the start, shifted by up to ``spread``, and draws the goal."""
        super().reset(seed=seed, options=options)
        self.task = self._drawn()
        self._poses = self.task.start
        self._first = self.task.score(self._poses)
        self._made = 0
        self._last = None
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
        """Returns the tool on the table and its pose, or ``None``."""
        return None

    def _carried_out(self, planned: Callable[[], Plan]) -> tuple[float, bool, str | None]:
        """Returns the reward, whether the goal is reached, and the reason if nothing moved."""
        before = self.task.score(self._poses)
        self._made += 1
        refused, reached = None, False
        try:
            plan = planned()
            if plan.violations:
                refused = plan.violations[0]
            else:
                trajectory = predict(plan, self.model)
                self._last = plan
                self._poses, reached = trajectory.poses[-1], trajectory.reached
        except ActionError as error:
            refused = str(error)
        gained = (before - self.task.score(self._poses)) / max(self._first, 1.0)
        return gained + float(reached), reached, refused

    def _drawn(self) -> Task:
        """Draws a start and a goal without overlaps; joined objects are shifted together."""
        if self.spread <= 0.0 and self.goal_spread <= 0.0:
            return self._given
        start = self._given.start
        joined = bool(self._given.to_dict()["scene"].get("joints"))
        for _ in range(TRIES):
            poses = start.copy()
            if self.spread > 0.0:
                shift = self.np_random.uniform(-self.spread, self.spread, (len(start), 2))
                poses[:, :2] += shift[:1] if joined else shift
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

    def _seen(self) -> _Action:
        x, y, heading = self._poses.T
        objects = np.stack([x, y, np.cos(heading), np.sin(heading)], axis=1)
        names = self.task.objects
        own = self._poses[[names.index(name) for name in self.task.goal_subjects(self._poses)], :2]
        off = self.task.goal_offsets(self._poses)
        goals = np.concatenate([own - off[:, :2], -off[:, :2]], axis=1)
        return np.concatenate([objects.ravel(), -off[:, 2], goals.ravel()]).astype(np.float32)

    def _info(self, refused: str | None) -> dict[str, Any]:
        return {"score": self.task.score(self._poses), "refused": refused}


class PushEnv(_TableEnv):
    """Environment with one push per step, with the tools, rules and goal of a task.

    The tool is set down just before the object of the first unreached goal and pushes it. An action
    has five numbers from -1 to 1, which :meth:`action` computes from metres and radians:

    - tool, in equal intervals in the order of ``tools``;
    - grip yaw, in equal intervals in the order of ``task.grip_yaws``;
    - direction, in units of pi radians from world +x;
    - lateral offset of the object, in units of ``most_offset``;
    - length, with 0 for the task's length and 1 for 50 % more.

    An observation has, in this order,

    - x and y (metres), cosine and sine of the heading of every object;
    - rotation to the goal heading (radians) of every goal;
    - position of every goal, and offset from the object to it, x and y in metres.

    The reward is the gained share of the distance to the goal, plus 1 for reaching it, minus 0.02
    per push. An infeasible push, or one that violates a rule of the task, moves nothing;
    ``info["refused"]`` states the reason.

    Parameters
    ----------
    task : Task
        Task of the environment.
    tools : ToolLibrary, optional
        Tools from which the task chooses; by default the tools shipped with the package.
    model : str, default "planar"
        Model of the physics, such as "planar", "3d" or "prior", see ``pushplan.predict``.
    pushes : int, optional
        Maximum number of pushes; by default twice the maximum of a plan of the task.
    spread, goal_spread : float, default 0
        Maximum random shift of the objects at the start and of the goal, along x and y, metres.
    most_offset : float, default 0.06
        Maximum lateral offset, metres.
    render_mode : {"rgb_array", "html", None}, default None
        Image of the table from above, or interactive report of the last push.

    Raises
    ------
    ModelError or ValueError
        If ``model`` is unknown, or another argument is invalid.
    """

    def __init__(
        self,
        task: Task,
        *,
        tools: ToolLibrary | None = None,
        model: str = "planar",
        pushes: int | None = None,
        spread: float = 0.0,
        goal_spread: float = 0.0,
        most_offset: float = 0.06,
        render_mode: str | None = None,
    ) -> None:
        library = tools if tools is not None else ToolLibrary.shipped()
        #: Tools, in the order of the action's first number.
        self.tools = [library[name] for name in task.tools or library.names]
        # An unknown model is reported now, not at the first push.
        predict(Plan.of(task, self.tools[0], []), model)
        self.pushes = 2 * task.max_pushes if pushes is None else pushes
        super().__init__(task, model, self.pushes, spread, goal_spread, render_mode)
        self.most_offset = most_offset
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (5,), np.float32)

    def action(
        self,
        tool: str,
        direction: float,
        *,
        grip_yaw: float | None = None,
        offset: float = 0.0,
        length: float | None = None,
    ) -> npt.NDArray[np.float32]:
        """Returns the action of a push; angles in radians, lengths in metres.

        By default it has the first grip yaw and the push length of the task. Raises ``ValueError``
        for an unknown tool, offset or length.
        """
        names = [one.name for one in self.tools]
        if tool not in names:
            raise ValueError(f"no tool is called `{tool}`; there are {', '.join(names)}")
        yaws = self.task.grip_yaws
        nearest = 0 if grip_yaw is None else int(np.argmin(np.abs(np.array(yaws) - grip_yaw)))
        usual = self.task.push_length
        half = math.remainder(direction, 2.0 * math.pi) / math.pi
        longer = 0.0 if length is None else 2.0 * (length / usual - 1.0)
        which, grip = _share(names.index(tool), len(names)), _share(nearest, len(yaws))
        numbers = [which, grip, half, offset / self.most_offset, longer]
        if not all(-1.0 <= number <= 1.0 for number in numbers):
            raise ValueError(
                f"`offset` must be {-self.most_offset:g} to {self.most_offset:g} m and `length` "
                f"{0.5 * usual:g} to {1.5 * usual:g} m, found offset={offset}, length={length}"
            )
        return np.array(numbers, dtype=np.float32)

    def step(self, action: _Action) -> tuple[_Action, float, bool, bool, dict[str, Any]]:
        """Executes one push."""
        gained, reached, refused = self._carried_out(lambda: self._plan(action))
        truncated = self._made >= self.steps and not reached
        return self._seen(), gained - COST, reached, truncated, self._info(refused)

    def _target(self) -> str:
        """Returns the object of the first unreached goal."""
        goals = zip(
            self.task.goal_subjects(self._poses), self.task.reached(self._poses), strict=True
        )
        return next((name for name, reached in goals if not reached), self.task.goal_object)

    def _plan(self, action: _Action) -> Plan:
        tool, grip, half, offset, longer = (float(number) for number in np.clip(action, -1.0, 1.0))
        yaws = self.task.grip_yaws
        length = self.task.push_length * (1.0 + 0.5 * longer)
        push = Push.before(self._target(), math.pi * half, offset * self.most_offset, length)
        yaw = yaws[_index(grip, len(yaws))]
        chosen = self.tools[_index(tool, len(self.tools))]
        return Plan.of(self.task.at(self._poses), chosen, [push], grip_yaw=yaw)


class SteerEnv(_TableEnv):
    """Environment with a short straight motion of the tool per step; the tool stays on the table.

    An action has two numbers from -1 to 1: the motion of the end effector along x and y in units of
    ``stride``, at the speed of the task. The step ends when all objects rest. Tool and grip yaw are
    constant. A step that violates a rule of the task (reach, obstacles) moves nothing;
    ``info["refused"]`` states the reason.

    An observation is an observation of :class:`PushEnv`, followed by x and y of the end effector,
    metres. The reward is the gained share of the distance to the goal, plus 1 for reaching it,
    minus 0.02 per metre of travel.

    Parameters
    ----------
    task : Task
        Task of the environment.
    tool : Tool or str, optional
        Tool or its name; by default the first tool of the task.
    hand : tuple of float, optional
        Position of the end effector at the start, metres; by default the home of the robot.
    grip_yaw : float, optional
        Rotation of the end effector, radians; by default the first grip yaw of the task.
    stride : float, default 0.02
        Maximum motion per step along x and y, metres.
    steps : int, default 200
        Maximum number of steps.
    model, spread, goal_spread, render_mode
        See :class:`PushEnv`.
    """

    def __init__(
        self,
        task: Task,
        *,
        tool: Tool | str | None = None,
        hand: tuple[float, float] | None = None,
        grip_yaw: float | None = None,
        model: str = "planar",
        stride: float = 0.02,
        steps: int = 200,
        spread: float = 0.0,
        goal_spread: float = 0.0,
        render_mode: str | None = None,
    ) -> None:
        library = ToolLibrary.shipped()
        named = (task.tools or library.names)[0] if tool is None else tool
        #: Tool in the hand.
        self.tool = library[named] if isinstance(named, str) else named
        predict(Plan.of(task, self.tool, []), model)
        super().__init__(task, model, steps, spread, goal_spread, render_mode, more=2)
        home: Any = task.to_dict()["robot"].get("home", (0.0, 0.0))
        self._begin = np.array(home if hand is None else hand, float)[:2]
        self._hand = self._begin
        self.grip_yaw = task.grip_yaws[0] if grip_yaw is None else grip_yaw
        self.stride = stride
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (2,), np.float32)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[_Action, dict[str, Any]]:
        """Resets the objects and the tool to the start, and draws the goal."""
        self._hand = self._begin
        return super().reset(seed=seed, options=options)

    def step(self, action: _Action) -> tuple[_Action, float, bool, bool, dict[str, Any]]:
        """Moves the tool by one action."""
        way = self.stride * np.clip(np.asarray(action, float), -1.0, 1.0)
        length = float(np.hypot(*way))
        gained, reached, refused = 0.0, False, None
        if length > LEAST:
            push = Push(self._hand, math.atan2(way[1], way[0]), length)
            now = self.task.at(self._poses)
            gained, reached, refused = self._carried_out(
                lambda: Plan.of(now, self.tool, [push], grip_yaw=self.grip_yaw)
            )
            if refused is None:
                self._hand = self._hand + way
        else:
            self._made += 1
        truncated = self._made >= self.steps and not reached
        return self._seen(), gained - COST * length, reached, truncated, self._info(refused)

    def _held(self) -> tuple[Tool, npt.NDArray[np.float64]]:
        x, y, turn = self.tool.grip
        heading = self.grip_yaw - turn
        c, s = math.cos(heading), math.sin(heading)
        at = self._hand - np.array([c * x - s * y, s * x + c * y])
        return self.tool, np.array([*at, heading])

    def _seen(self) -> _Action:
        return np.concatenate([super()._seen(), self._hand]).astype(np.float32)


def _index(number: float, count: int) -> int:
    """Returns the index of the interval with a number, of ``count`` equal intervals of -1 to 1."""
    return min(int(0.5 * (number + 1.0) * count), count - 1)


def _share(index: int, count: int) -> float:
    """Returns the middle of such an interval."""
    return (2.0 * index + 1.0) / count - 1.0


gymnasium.register(id="pushplan/Push-v0", entry_point="pushplan.env:PushEnv")
gymnasium.register(id="pushplan/Steer-v0", entry_point="pushplan.env:SteerEnv")
