"""Impossible twins: solvable tasks of the board with one change that no plan can overcome.

Every change comes with inequalities that prove it. The generator checks them, and they hold for
any plan of pushes. The judge tolerates two millimetres of penetration, which all of them include.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from .. import ToolLibrary
from .draw import Draw

__all__ = ["TWINS", "Inequality", "Twin", "twin"]

#: Penetration that the judge tolerates, metres.
SLACK = 0.002
#: Acceleration of gravity, m/s².
GRAVITY = 9.81
#: Lower bound of the force that moves a disc or a rectangle, over its weight times friction. A push
#: at most R from the centre feeds F (v + w R), and friction takes at least max(v, w d) times weight
#: times friction, with the mean distance d of the support. R / d is at most 2 sqrt 2.
EASIEST = 0.25


@dataclass(frozen=True)
class Inequality:
    """Statement that `left` is less than `right`."""

    left: float
    right: float
    #: The quantities in words.
    words: str

    @property
    def holds(self) -> bool:
        """Whether the statement is true."""
        return self.left < self.right

    def __str__(self) -> str:
        return f"{self.left:.4f} < {self.right:.4f}: {self.words}"


@dataclass(frozen=True)
class Twin:
    """Changed task with its proof."""

    task: dict[str, Any]
    proof: list[Inequality]


def _inner(thing: dict[str, Any]) -> float:
    """Returns the radius of the largest disc in a can or a box."""
    [(kind, shape)] = thing["shape"].items()
    return float(shape["radius"] if kind == "cylinder" else min(shape["size"][:2]) / 2)


def _outer(thing: dict[str, Any]) -> float:
    """Returns the radius of the smallest disc around the middle of a can or a box."""
    [(kind, shape)] = thing["shape"].items()
    return float(shape["radius"] if kind == "cylinder" else math.hypot(*shape["size"][:2]) / 2)


def _block(
    task: dict[str, Any], at: list[float], size: list[float], yaw: float = 0.0, height: float = 0.1
) -> None:
    """Adds a fixed cuboid to a task."""
    obstacles = task["scene"]["obstacles"]
    block = {"name": f"block-{len(obstacles)}", "size": [*(round(x, 4) for x in size), height]}
    placed = {"position": [round(x, 4) for x in at], "yaw_deg": round(yaw, 4)}
    obstacles.append(block | placed)


def _pen(
    task: dict[str, Any], at: list[float], half: tuple[float, float], yaw: float = 0.0
) -> None:
    """Adds four walls around a rectangle, which overlap at the corners."""
    thick = 0.02
    cos, sin = math.cos(math.radians(yaw)), math.sin(math.radians(yaw))
    for sign in (-1, 1):
        out = sign * (half[0] + thick / 2)
        there = [at[0] + cos * out, at[1] + sin * out]
        _block(task, there, [thick, 2 * half[1] + 2 * thick], yaw)
        out = sign * (half[1] + thick / 2)
        there = [at[0] - sin * out, at[1] + cos * out]
        _block(task, there, [2 * half[0] + 2 * thick, thick], yaw)


def _longest() -> float:
    """Returns the largest distance of a shipped tool's corner from its grip, metres."""
    found = 0.0
    shipped = ToolLibrary.shipped()
    for name in shipped.names:
        for part in shipped[name].to_dict().get("parts", []):
            half = math.hypot(*part.get("size", [0, 0])[:2]) / 2
            found = max(found, math.hypot(*part["position"][:2]) + half)
    return found


def moved_away(draw: Draw, task: dict[str, Any]) -> Twin | None:
    """Moves the object and its goal outwards, beyond the reach of the longest tool."""
    [thing] = task["scene"]["objects"]
    far = math.hypot(*thing["position"])
    limit = task["robot"]["reach"]["max"] + _longest()
    by = (limit + _outer(thing) + draw.number(0.02, 0.1)) / far - 1
    shift = [round(by * x, 4) for x in thing["position"]]
    for place in (thing, task["goal"]):
        place["position"] = [round(x + dx, 4) for x, dx in zip(place["position"], shift)]
    nearest = math.hypot(*thing["position"]) - _outer(thing)
    words = "reach of the hand and the longest tool, distance of the object's nearest point"
    return Twin(task, [Inequality(limit, nearest, words)])


def object_walled_in(draw: Draw, task: dict[str, Any]) -> Twin | None:
    """Encloses the object with walls that have no opening; the goal is outside."""
    [thing] = task["scene"]["objects"]
    at, goal = thing["position"], task["goal"]
    half = round(_outer(thing) + draw.number(0.012, 0.02), 4)
    _pen(task, at, (half, half))
    off = max(abs(g - x) for g, x in zip(goal["position"], at)) - goal["tolerance"]
    inside = half - _inner(thing) + SLACK
    words = "way of the object's centre within closed walls, way to the goal along one axis"
    return Twin(task, [Inequality(inside, off, words)])


def too_heavy(draw: Draw, task: dict[str, Any]) -> Twin | None:
    """Makes an object too heavy for the robot's largest force."""
    [thing] = task["scene"]["objects"]
    thing["mass"] = draw.number(20, 40, 1)
    friction = (thing["friction"] + task["scene"]["table"]["friction"]) / 2
    least = EASIEST * friction * thing["mass"] * GRAVITY
    task["robot"]["max_force"] = round(least * draw.number(0.2, 0.5), 1)
    words = "largest force, least force that moves the object, newtons"
    return Twin(task, [Inequality(task["robot"]["max_force"], least, words)])


def crate_kept(draw: Draw, task: dict[str, Any]) -> Twin | None:
    """Forbids to move the crate that stands at the goal."""
    can, crate = task["scene"]["objects"]
    within = 0.003
    task["keep"] = {"objects": [crate["name"]], "within": within}
    goal = task["goal"]
    near = math.dist(goal["position"], crate["position"]) + goal["tolerance"] + within
    words = "largest distance of can and crate at the goal, sum of their inner radii"
    return Twin(task, [Inequality(near, _inner(can) + _inner(crate) - SLACK, words)])


def same_place(draw: Draw, task: dict[str, Any]) -> Twin | None:
    """Gives two objects the same goal."""
    first, second = task["scene"]["objects"][:2]
    one, other = task["goal"][:2]
    other["position"] = list(one["position"])
    apart = one["tolerance"] + other["tolerance"]
    words = "largest distance of two objects at the goal, sum of their inner radii"
    return Twin(task, [Inequality(apart, _inner(first) + _inner(second) - SLACK, words)])


def small_region(draw: Draw, task: dict[str, Any]) -> Twin | None:
    """Shrinks the region of a group, until two centres do not fit."""
    first, second = task["scene"]["objects"][:2]
    radius = draw.number(0.006, 0.012)
    task["goal"]["region"]["area"] = {"circle": {"radius": radius}}
    words = "diameter of the region, sum of two inner radii"
    return Twin(task, [Inequality(2 * radius, _inner(first) + _inner(second) - SLACK, words)])


def door_stopped(draw: Draw, task: dict[str, Any]) -> Twin | None:
    """Places a post in the way of the door."""
    [door] = task["scene"]["objects"]
    [hinge] = task["scene"]["joints"]
    width, thick = door["shape"]["cuboid"]["size"][:2]
    swing, share = task["goal"]["joint_deg"], draw.number(0.5, 0.65, 2)
    side, out = 0.03, 0.7 * width
    # The door extends from the hinge; its heading there is the direction of its centre.
    along = math.atan2(*(door["position"][k] - hinge["at"][k] for k in (1, 0)))
    turn = along + math.radians(share * swing)
    at = [hinge["at"][0] + out * math.cos(turn), hinge["at"][1] + out * math.sin(turn)]
    clear = out * abs(math.sin(math.radians(share * swing))) - thick / 2 - side / math.sqrt(2)
    if clear < 0.004:
        return None
    _block(task, at, [side, side], math.degrees(turn))
    least = abs(swing) - task["goal"]["heading_tolerance_deg"]
    words = "rotation at which the door would hold the post's centre, least rotation, degrees"
    long = "distance of the post's centre from the hinge, length of the door"
    depth = "tolerated penetration, depth of the post's centre in the post"
    proof = [Inequality(share * abs(swing), least, words), Inequality(out, width, long)]
    return Twin(task, [*proof, Inequality(SLACK, side / 2, depth)])


def drawer_stopped(draw: Draw, task: dict[str, Any]) -> Twin | None:
    """Places a block before the bar of the drawer."""
    [drawer] = task["scene"]["objects"]
    bar = drawer["parts"][1]
    wide = bar["shape"]["cuboid"]["size"][1]
    x, y = drawer["position"]
    least = task["goal"]["joint"] - task["goal"]["tolerance"]
    free = round(draw.number(0.2, 0.6, 2) * least, 4)
    front = x + bar["position"][0] - 0.01
    _block(task, [front - free - 0.02, y], [0.04, round(0.5 * wide, 3)])
    words = "way of the drawer to the block, least way to the goal"
    return Twin(task, [Inequality(free + SLACK, least, words)])


def gap_narrowed(draw: Draw, task: dict[str, Any]) -> Twin | None:
    """Narrows the only gap of a wall across the table."""
    [thing] = task["scene"]["objects"]
    radius = _inner(thing)
    left, right = task["scene"]["obstacles"]
    lower, upper = (
        wall["position"][1] + sign * wall["size"][1] / 2 for wall, sign in ((right, 1), (left, -1))
    )
    middle, half = (lower + upper) / 2, round(draw.number(0.6, 0.9, 2) * radius, 4)
    top = task["scene"]["table"]["size"][1] / 2
    for wall, sign in ((left, 1), (right, -1)):
        inner, outer = round(middle + sign * half, 4), sign * top
        wall["position"][1] = round((inner + outer) / 2, 5)
        wall["size"][1] = round(abs(outer - inner), 5)
    ends = min(abs(w["position"][1]) + w["size"][1] / 2 for w in (left, right))
    words = "width of the gap, diameter of the can"
    around = "distance of the wall's ends from the edges of the table, radius of the can"
    through = Inequality(2 * half + 2 * SLACK + 2e-5, 2 * radius, words)
    return Twin(task, [through, Inequality(top - ends + SLACK, radius, around)])


def goal_off_the_table(draw: Draw, task: dict[str, Any]) -> Twin | None:
    """Ends the table between the object and its region."""
    [thing] = task["scene"]["objects"]
    region = task["goal"]["region"]
    extent = _extent(region["area"])
    for axis in (0, 1):
        for sign in (1, -1):
            near = sign * region["position"][axis] - extent
            room = near - (sign * thing["position"][axis] + _outer(thing))
            if room < 0.012:
                continue
            edge = near - draw.number(0.2, 0.8, 2) * (room - 0.01) - 0.002
            middle = [0.5, 0.0]
            middle[axis] = round(sign * (edge - 1.0), 4)
            task["scene"]["table"] |= {"size": [2.0, 2.0], "position": middle}
            words = "edge of the table, nearest point of the region along the same axis"
            return Twin(task, [Inequality(sign * middle[axis] + 1.0, near, words)])
    return None


def _extent(area: dict[str, Any]) -> float:
    """Returns the largest distance of a region's points from its position, metres."""
    if "circle" in area:
        return float(area["circle"]["radius"])
    if "rectangle" in area:
        return math.hypot(*area["rectangle"]["size"]) / 2
    return max(math.hypot(*corner) for corner in area["polygon"]["corners"])


def no_room_to_turn(draw: Draw, task: dict[str, Any]) -> Twin | None:
    """Encloses a cuboid with walls between which its goal heading does not fit."""
    [thing] = task["scene"]["objects"]
    long, wide = thing["shape"]["cuboid"]["size"][:2]
    goal = task["goal"]
    turn = math.remainder(goal["heading_deg"] - thing["yaw_deg"], 180)
    least, most = (abs(turn) + sign * goal["heading_tolerance_deg"] for sign in (-1, 1))
    # The extent is concave between multiples of 90 degrees.
    ends = [math.radians(one) for one in (least, most, 90) if least <= one <= most]
    across = min(long * abs(math.sin(a)) + wide * abs(math.cos(a)) for a in ends)
    lane = round(wide + draw.number(0.3, 0.6, 2) * (across - 2 * SLACK - wide), 4)
    if least <= 0 or lane < wide + 0.003:
        return None
    _pen(task, thing["position"], (long / 2 + 0.02, lane / 2), thing["yaw_deg"])
    del goal["position"], goal["tolerance"]
    words = "width between the walls, extent of the cuboid across them at the goal heading"
    return Twin(task, [Inequality(lane + 2 * SLACK, across, words)])


Change = Callable[[Draw, dict[str, Any]], "Twin | None"]

#: Changes by the kind of task that they make impossible.
TWINS: dict[str, Change] = {
    "reach": moved_away,
    "hook": object_walled_in,
    "sweep": too_heavy,
    "clear": crate_kept,
    "several-goals": same_place,
    "group": small_region,
    "door": door_stopped,
    "drawer": drawer_stopped,
    "gap": gap_narrowed,
    "region": goal_off_the_table,
    "heading": no_room_to_turn,
    "design": object_walled_in,
}


def twin(draw: Draw, kind: str, task: dict[str, Any]) -> Twin | None:
    """Returns the impossible twin of a task; `None` if the proof does not hold for this task."""
    found = TWINS[kind](draw, copy.deepcopy(task))
    if found is not None and not all(one.holds for one in found.proof):
        return None
    return found
