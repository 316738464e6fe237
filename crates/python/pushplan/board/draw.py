"""Random numbers of the board, and the table of a task while it is drawn.

Only ``random.Random.random`` is used, whose sequence Python guarantees for a seed. All numbers are
rounded, so that last digits of sines do not matter. Lengths are metres, angles degrees.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from typing import Any, TypeVar, cast

from ..files import TaskFile

__all__ = ["Draw", "Table", "polar"]

One = TypeVar("One")


class Draw:
    """Random numbers of one draw, a function of its key alone."""

    def __init__(self, *key: object) -> None:
        self._random = random.Random(" ".join(str(word) for word in key))

    def number(self, low: float, high: float, digits: int = 3) -> float:
        """Returns a rounded number in a range."""
        return round(low + (high - low) * self._random.random(), digits)

    def chance(self, share: float = 0.5) -> bool:
        """Returns `True` in this share of the draws."""
        return self._random.random() < share

    def choice(self, items: Sequence[One]) -> One:
        """Returns one of the items."""
        return items[int(self._random.random() * len(items))]

    def sign(self) -> float:
        """Returns 1 or -1."""
        return 1.0 if self.chance() else -1.0


def polar(distance: float, angle: float) -> tuple[float, float]:
    """Returns the point at a distance and an angle in degrees from the base, rounded."""
    turn = math.radians(angle)
    return round(distance * math.cos(turn), 4), round(distance * math.sin(turn), 4)


class Table:
    """Table of a task while it is drawn; every object starts as its own goal."""

    def __init__(self, draw: Draw, reach: float = 0.9, pushes: int = 2) -> None:
        self.draw = draw
        self.objects: list[dict[str, Any]] = []
        self.obstacles: list[dict[str, Any]] = []
        self.joints: list[dict[str, Any]] = []
        self.scene: dict[str, Any] = {"table": {"friction": draw.number(0.3, 0.6, 2)}}
        self.more: dict[str, Any] = {}
        self.robot: dict[str, Any] = {"reach": {"min": 0.1, "max": reach}}
        self.pushes: dict[str, Any] = {"directions": 8, "max_count": pushes}

    def thing(self, name: str, shape: dict[str, Any], at: tuple[float, float], **more: Any) -> None:
        """Adds an object with a random mass and friction value."""
        own = {
            "name": name,
            "shape": shape,
            "mass": self.draw.number(0.15, 1.0, 2),
            "friction": self.draw.number(0.3, 0.6, 2),
            "position": [round(at[0], 4), round(at[1], 4)],
        }
        self.objects.append(own | more)

    def can(self, name: str, at: tuple[float, float], radius: float, **more: Any) -> None:
        """Adds an upright cylinder."""
        shape = {"cylinder": {"radius": radius, "height": self.draw.number(0.06, 0.1)}}
        self.thing(name, shape, at, **more)

    def box(
        self, name: str, at: tuple[float, float], size: tuple[float, float], **more: Any
    ) -> None:
        """Adds a cuboid."""
        shape = {"cuboid": {"size": [*size, self.draw.number(0.04, 0.08)]}}
        self.thing(name, shape, at, **more)

    def solid(self, name: str, at: tuple[float, float]) -> None:
        """Adds a cylinder or a cuboid of random size."""
        if self.draw.chance():
            self.can(name, at, self.draw.number(0.025, 0.05))
            return
        size = self.draw.number(0.06, 0.12), self.draw.number(0.05, 0.09)
        self.box(name, at, size, yaw_deg=self.draw.number(-180, 180, 0))

    def wall(
        self, name: str, at: tuple[float, float], size: tuple[float, float], height: float = 0.1
    ) -> None:
        """Adds a fixed cuboid along the axes."""
        self.obstacles.append(
            {
                "name": name,
                "size": [round(size[0], 4), round(size[1], 4), height],
                "position": [round(at[0], 4), round(at[1], 4)],
            }
        )

    def task(self) -> TaskFile:
        """Returns the task with a goal at the start of its first object."""
        scene = self.scene | {"objects": self.objects, "obstacles": self.obstacles}
        if self.joints:
            scene["joints"] = self.joints
        first = self.objects[0]
        goal = {"object": first["name"], "position": first["position"], "tolerance": 0.02}
        task = {
            "scene": scene,
            "robot": self.robot,
            "tools": "all",
            "goal": goal,
        }
        if self.pushes:
            task["pushes"] = self.pushes
        return cast(TaskFile, task | self.more)
