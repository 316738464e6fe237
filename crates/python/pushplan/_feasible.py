"""Feasible push nearest to a requested one, for actions of an environment."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from . import ActionError, Plan, Push, Task, Tool

__all__ = ["Request", "nearest"]

#: Step between tried directions, radians: 24 directions.
STEP = math.pi / 12
#: Shortest tried length relative to the requested one.
SHORTEST = 0.25
#: Number of halvings of the interval of lengths, to 5 % of the requested length.
HALVINGS = 4


class Request(NamedTuple):
    """Requested push of an object."""

    tool: int
    #: Index of the grip yaw.
    grip: int
    #: Direction, radians from world +x.
    direction: float
    #: Lateral offset of the object, metres.
    offset: float
    #: Travel, metres.
    length: float


def nearest(task: Task, tools: Sequence[Tool], target: str, request: Request) -> Plan:
    """Returns the plan of the feasible push of ``target`` that is nearest to the request.

    The requested push is taken if it violates no rule. Otherwise the tried changes are, in this
    order: a shorter push, another grip yaw, another direction, no offset, another tool.

    Raises
    ------
    ActionError
        If no push is feasible; the text is the fault of the request.
    """
    fault: str | None = None
    for tool, offset, direction, grip_yaw in _tried(task, tools, request):

        def plan(length: float) -> Plan | str:
            push = Push.before(target, direction, offset, length)
            try:
                made = Plan.of(task, tool, [push], grip_yaw=grip_yaw)
            except ActionError as error:
                return str(error)
            return made.violations[0] if made.violations else made

        whole = plan(request.length)
        if isinstance(whole, Plan):
            return whole
        fault = fault or whole
        low, high = SHORTEST * request.length, request.length
        best = plan(low)
        if isinstance(best, Plan):
            for _ in range(HALVINGS):
                middle = 0.5 * (low + high)
                longer = plan(middle)
                if isinstance(longer, Plan):
                    low, best = middle, longer
                else:
                    high = middle
            return best
    raise ActionError(fault or "the task has no tool; name one or more in `tools`")


def _tried(
    task: Task, tools: Sequence[Tool], request: Request
) -> Iterator[tuple[Tool, float, float, float]]:
    """Yields tools, offsets, directions and grip yaws, nearest first."""
    yaws = task.grip_yaws[request.grip :] + task.grip_yaws[: request.grip]
    turns = sorted(range(-11, 13), key=abs)
    offsets = [request.offset] if request.offset == 0.0 else [request.offset, 0.0]
    for tool in [*tools[request.tool :], *tools[: request.tool]]:
        for offset in offsets:
            for turn in turns:
                direction = math.remainder(request.direction + turn * STEP, math.tau)
                for grip_yaw in yaws:
                    yield tool, offset, direction, grip_yaw
