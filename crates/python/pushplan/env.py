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
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt

from . import ActionError, Plan, Push, Task, Tool, ToolLibrary, UnknownToolError, predict
from ._feasible import Request, nearest
from ._table import Action, TableEnv

__all__ = ["PushEnv", "SteerEnv"]

#: Cost of a push, so that fewer pushes are better; reaching the goal is worth one.
COST = 0.02

#: Minimum length of a move, metres.
LEAST = 1e-4


class PushEnv(TableEnv):
    """Environment with one push per step, with the tools, rules and goal of a task.

    The tool is set down just before the object of the first unreached goal and pushes it. An action
    has five numbers from -1 to 1, which :meth:`action` computes from metres and radians:

    - tool, in equal intervals in the order of ``tools``;
    - grip yaw, in equal intervals in the order of ``task.grip_yaws``;
    - direction, in units of pi radians from world +x;
    - lateral offset of the object, in units of ``most_offset``;
    - length, with 0 for the task's length and 1 for 50 % more.

    If the task does not allow this push, for example because it would leave the reach, the nearest
    allowed one is executed: shorter, with another grip yaw, in another direction, without offset,
    or with another tool. ``info["plan"]`` is the executed push. The episode is also terminated if
    no further push is allowed, for example because the object is out of reach. If that is already
    true before the push, nothing moves, and ``info["refused"]`` states the reason.

    An observation has, in this order,

    - x and y (metres), cosine and sine of the heading of every object;
    - rotation to the goal heading (radians) of every goal;
    - position of every goal, and offset from the object to it, x and y in metres.

    The reward is the gained share of the distance to the goal, plus 1 for reaching it, minus 0.02
    per push.

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

    Examples
    --------
    >>> env = pushplan.env.PushEnv(pushplan.Task.example("pull-back"))
    >>> seen, info = env.reset(seed=0)
    >>> seen, reward, reached, truncated, info = env.step(env.action_space.sample())
    >>> print(info["plan"].pushes, reward)
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

        Parameters
        ----------
        tool : str
            Name of one of ``tools``.
        direction : float
            Direction of travel, radians from world +x.
        grip_yaw : float, optional
            Rotation of the end effector, radians; by default the first grip yaw of the task. The
            action has the nearest grip yaw of the task.
        offset : float, default 0
            Lateral offset of the object, metres.
        length : float, optional
            Travel, metres; by default the push length of the task.

        Returns
        -------
        ndarray of float32, ``[5]``
            Action for :meth:`step`.

        Raises
        ------
        UnknownToolError or ValueError
            If the environment has no such tool, or ``offset`` or ``length`` is out of range.

        Examples
        --------
        >>> action = env.action("l-hook", math.pi, length=0.15)
        """
        names = [one.name for one in self.tools]
        if tool not in names:
            raise UnknownToolError(f"no tool is called `{tool}`; use one of {', '.join(names)}")
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

    def step(self, action: Action) -> tuple[Action, float, bool, bool, dict[str, Any]]:
        """Executes one push.

        Parameters
        ----------
        action : array_like, ``[5]``
            Numbers from -1 to 1; others are clipped.

        Returns
        -------
        tuple of ndarray, float, bool, bool and dict
            Observation, reward, whether the goal is reached or no further push is allowed, whether
            the pushes are used up, and ``info`` with ``score``, ``refused`` and ``plan``.
        """
        gained, reached, refused = self._carried_out(lambda: self._plan(action))
        terminated = reached or refused is not None or self._stuck()
        truncated = self._made >= self.steps and not terminated
        return self._seen(), gained - COST, terminated, truncated, self._info(refused)

    def _stuck(self) -> bool:
        """Returns whether no push of the target is allowed."""
        request = Request(0, 0, 0.0, 0.0, self.task.push_length)
        try:
            nearest(self.task.at(self._poses), self.tools, self._target(), request)
        except ActionError:
            return True
        return False

    def _target(self) -> str:
        """Returns the object of the first unreached goal."""
        goals = zip(
            self.task.goal_subjects(self._poses), self.task.reached(self._poses), strict=True
        )
        return next((name for name, reached in goals if not reached), self.task.goal_object)

    def _plan(self, action: Action) -> Plan:
        tool, grip, half, offset, longer = (float(number) for number in np.clip(action, -1.0, 1.0))
        request = Request(
            _index(tool, len(self.tools)),
            _index(grip, len(self.task.grip_yaws)),
            math.pi * half,
            offset * self.most_offset,
            self.task.push_length * (1.0 + 0.5 * longer),
        )
        return nearest(self.task.at(self._poses), self.tools, self._target(), request)


class SteerEnv(TableEnv):
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

    Raises
    ------
    ModelError, UnknownToolError or ValueError
        If ``model`` or ``tool`` is unknown, or another argument is invalid.

    Examples
    --------
    >>> env = pushplan.env.SteerEnv(pushplan.Task.example("pull-back"), tool="l-hook")
    >>> seen, info = env.reset(seed=0)
    >>> seen, reward, reached, truncated, info = env.step([0.5, 0.0])
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
    ) -> tuple[Action, dict[str, Any]]:
        """Resets the objects and the tool to the start, and draws the goal.

        Parameters
        ----------
        seed, options
            See :meth:`PushEnv.reset`.

        Returns
        -------
        tuple of ndarray and dict
            Observation, and ``info`` with the keys of :meth:`step`.
        """
        self._hand = self._begin
        return super().reset(seed=seed, options=options)

    def step(self, action: Action) -> tuple[Action, float, bool, bool, dict[str, Any]]:
        """Moves the tool by one action.

        Parameters
        ----------
        action : array_like, ``[2]``
            Motion along x and y in units of ``stride``, from -1 to 1; others are clipped.

        Returns
        -------
        tuple of ndarray, float, bool, bool and dict
            Observation, reward, whether the goal is reached, whether the steps are used up, and
            ``info`` with ``score``, ``refused`` and ``plan``.
        """
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
            self._executed = None
        truncated = self._made >= self.steps and not reached
        return self._seen(), gained - COST * length, reached, truncated, self._info(refused)

    def _held(self) -> tuple[Tool, npt.NDArray[np.float64]]:
        x, y, turn = self.tool.grip
        heading = self.grip_yaw - turn
        c, s = math.cos(heading), math.sin(heading)
        at = self._hand - np.array([c * x - s * y, s * x + c * y])
        return self.tool, np.array([*at, heading])

    def _seen(self) -> Action:
        return np.concatenate([super()._seen(), self._hand]).astype(np.float32)


def _index(number: float, count: int) -> int:
    """Returns the index of the interval with a number, of ``count`` equal intervals of -1 to 1."""
    return min(int(0.5 * (number + 1.0) * count), count - 1)


def _share(index: int, count: int) -> float:
    """Returns the middle of such an interval."""
    return (2.0 * index + 1.0) / count - 1.0


gymnasium.register(id="pushplan/Push-v0", entry_point="pushplan.env:PushEnv")
gymnasium.register(id="pushplan/Steer-v0", entry_point="pushplan.env:SteerEnv")
