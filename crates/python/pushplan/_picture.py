"""Images of the table from above as arrays of pixels, with NumPy only."""

from __future__ import annotations

import math
from typing import Any, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from ._native import Task, Tool

__all__ = ["Picture", "about_centre", "placed"]

_Floats = npt.NDArray[np.float64]
_Pose = Union[Sequence[float], _Floats]

#: Factor of supersampling, for smooth edges.
_FINER = 2
#: Margin around the scene, metres.
_MARGIN = 0.12
#: Mark of a robot without a column, metres.
_MARK = [0.03, 0.03]
_PAPER, _REACH, _GOAL = (255, 255, 255), (243, 245, 247), (120, 190, 120)
_BASE = (50, 60, 80)
_OBSTACLE, _TOOL, _WANTED, _OTHER = (90, 90, 90), (70, 120, 200), (205, 85, 60), (225, 175, 120)


class Picture:
    """Images of a task with the same extent: x up and y left, as seen from behind the robot.

    They show the reach, the robot's base, the goal, obstacles, objects, and the tool.
    """

    def __init__(self, task: Task, size: int = 256) -> None:
        mapping: Any = task.to_dict()
        self.scene, self.names = mapping["scene"], list(task.objects)
        base = mapping["robot"].get("base")
        #: Column of the robot, or a mark of its place.
        self.base = {"cuboid": {"size": [2.0 * base] * 2 if isinstance(base, float) else _MARK}}
        self.reach, self.wanted, self.size = task.reach, self.names.index(task.goal_object), size
        places = [*task.start[:, :2], np.array(task.goal_position), np.zeros(2)]
        places += [np.array(thing["position"][:2]) for thing in self.scene.get("obstacles", [])]
        low, high = np.min(places, axis=0) - _MARGIN, np.max(places, axis=0) + _MARGIN
        middle, half = (low + high) / 2, float((high - low).max()) / 2
        steps = (np.arange(size * _FINER) + 0.5) / (size * _FINER) * 2 * half - half
        self.x = np.broadcast_to(middle[0] - steps[:, None], (len(steps), len(steps)))
        self.y = np.broadcast_to(middle[1] - steps[None, :], (len(steps), len(steps)))

    def of(
        self,
        poses: _Floats,
        goal: Sequence[float],
        tolerance: float,
        tool: Optional[tuple[Tool, _Pose]] = None,
    ) -> npt.NDArray[np.uint8]:
        """Returns the image ``[size, size, 3]`` with the objects, and the tool if given, at these
        poses (x, y, heading)."""
        pixels = np.empty((*self.x.shape, 3), np.uint8)
        pixels[:] = _PAPER
        out = np.hypot(self.x, self.y)
        pixels[(out >= self.reach[0]) & (out <= self.reach[1])] = _REACH
        # A goal smaller than a few pixels would be invisible.
        least = 6 * abs(float(self.x[0, 0] - self.x[1, 0]))
        pixels[np.hypot(self.x - goal[0], self.y - goal[1]) <= max(tolerance, least)] = _GOAL
        self._fill(pixels, (0.0, 0.0, 0.0), self.base, _BASE)
        for wall in self.scene.get("obstacles", []):
            pose = (*wall["position"][:2], math.radians(wall.get("yaw_deg", 0.0)))
            self._fill(pixels, pose, {"cuboid": wall}, _OBSTACLE)
        for k, pose in enumerate(poses):
            thing = self.scene["objects"][k]
            for part in (thing, *thing.get("parts", [])):
                at = pose if part is thing else placed(pose, part)
                self._fill(pixels, at, part["shape"], _WANTED if k == self.wanted else _OTHER)
            # Mark of the heading.
            self._fill(
                pixels,
                placed(pose, {"position": [0.012, 0.0]}),
                {"cuboid": {"size": [0.024, 0.005]}},
                _PAPER,
            )
        if tool is not None:
            parts: Any = tool[0].to_dict()["parts"]
            for part in parts:
                shape = part.get("shape") or {"cuboid": part}
                self._fill(pixels, placed(tool[1], part), shape, _TOOL)
        fine = pixels.reshape(self.size, _FINER, self.size, _FINER, 3)
        return np.asarray(fine.mean(axis=(1, 3)).round(), np.uint8)

    def _fill(
        self, pixels: npt.NDArray[np.uint8], pose: _Pose, shape: Any, colour: Sequence[int]
    ) -> None:
        c, s = math.cos(pose[2]), math.sin(pose[2])
        x = c * (self.x - pose[0]) + s * (self.y - pose[1])
        y = c * (self.y - pose[1]) - s * (self.x - pose[0])
        if "cylinder" in shape:
            inside = np.hypot(x, y) <= shape["cylinder"]["radius"]
        elif "cuboid" in shape:
            size = shape["cuboid"]["size"]
            inside = (np.abs(x) <= size[0] / 2) & (np.abs(y) <= size[1] / 2)
        else:
            corners = about_centre(shape["prism"])
            ahead = np.roll(corners, -1, axis=0) - corners
            turns = [e[0] * (y - p[1]) - e[1] * (x - p[0]) for p, e in zip(corners, ahead)]
            inside = np.all(np.array(turns) >= 0, axis=0) | np.all(np.array(turns) <= 0, axis=0)
        pixels[inside] = colour


def placed(pose: _Pose, part: Any) -> tuple[float, float, float]:
    """Returns the pose of a part of a body with this pose."""
    x, y = part["position"][:2]
    c, s = math.cos(pose[2]), math.sin(pose[2])
    return (
        pose[0] + c * x - s * y,
        pose[1] + s * x + c * y,
        pose[2] + math.radians(part.get("yaw_deg", 0.0)),
    )


def about_centre(prism: Any) -> _Floats:
    """Returns the corners of a prism relative to its centre of mass, which is its position."""
    corners = np.array(prism["corners"], float)
    if "centre_of_mass" in prism:
        return np.asarray(corners - np.array(prism["centre_of_mass"], float))
    after = np.roll(corners, -1, axis=0)
    doubled = corners[:, 0] * after[:, 1] - corners[:, 1] * after[:, 0]
    return np.asarray(corners - ((corners + after) * doubled[:, None]).sum(0) / (3 * doubled.sum()))
