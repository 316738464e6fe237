"""Sketch of a task: its table, the pushes that will define its goals, and the rule for them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from ..files import TaskFile, ToolFile

__all__ = ["Ends", "Sketch", "Stroke", "way"]

#: Final poses by name of the object: x, y in metres, heading in radians.
Ends = dict[str, tuple[float, float, float]]

#: Returns the goals for final poses, or `None` if these do not fit the kind.
Rule = Callable[[Ends, Ends], "list[dict[str, Any]] | None"]


@dataclass(frozen=True)
class Stroke:
    """Push of a witness, relative to the pose of its object at that time."""

    object: str
    tool: str
    #: Rotation of the end effector, degrees.
    grip_yaw: float
    #: Direction of travel, degrees.
    direction: float
    #: Lateral offset, metres.
    offset: float
    #: Travel, metres.
    length: float


@dataclass(frozen=True)
class Sketch:
    """Table with strokes whose simulated end defines the goals."""

    task: TaskFile
    strokes: list[Stroke]
    #: Goals from the start and the end; `None` if the plan is searched for instead (levering).
    rule: Rule
    #: Additional tools, which only the witness knows.
    new_tools: list[ToolFile] = field(default_factory=list)
    #: Fixed goals of a task whose plan is searched for instead of drawn.
    goals: list[dict[str, Any]] | None = None
    #: Whether masses and frictions are hidden.
    hidden: bool = False


def way(start: Ends, ends: Ends, name: str) -> tuple[float, float]:
    """Returns the displacement of an object, metres."""
    return ends[name][0] - start[name][0], ends[name][1] - start[name][1]
