"""Kinds of tasks that move free objects.

Each function draws a table, the pushes of the witness, and the rule that turns the simulated end
into goals. A draw that does not fit is discarded, so that the functions need not be careful.
"""

from __future__ import annotations

import math
from typing import Any

from .draw import Draw, Table, polar
from .sketch import Ends, Rule, Sketch, Stroke, way

__all__ = [
    "PULLING",
    "PUSHING",
    "angle_between",
    "beside",
    "clear",
    "gap",
    "group",
    "heading",
    "hook",
    "place",
    "reach",
    "region",
    "several_goals",
    "sweep",
    "turned",
]

PUSHING = ["stick", "t-head", "paddle", "finger", "spatula", "rake", "fork", "hook"]
PULLING = ["hook", "l-hook", "inverse-l", "rake"]
WIDE = ["rake", "t-head", "spatula", "paddle"]
YAWS = [0.0, 90.0, -90.0]
TOLERANCE = 0.02


def place(name: str, ends: Ends, tolerance: float = TOLERANCE) -> dict[str, Any]:
    """Returns a goal at the end of an object, rounded to millimetres."""
    x, y, _ = ends[name]
    return {"object": name, "position": [round(x, 3), round(y, 3)], "tolerance": tolerance}


def turned(start: Ends, ends: Ends, name: str) -> float:
    """Returns the rotation of an object, degrees, -180 to 180."""
    return math.degrees(math.remainder(ends[name][2] - start[name][2], math.tau))


def angle_between(one: tuple[float, float], other: tuple[float, float]) -> float:
    """Returns the angle between two vectors, degrees, 0 to 180."""
    apart = math.atan2(one[1], one[0]) - math.atan2(other[1], other[0])
    return abs(math.degrees(math.remainder(apart, math.tau)))


def _stroke(
    draw: Draw,
    name: str,
    tools: list[str],
    direction: float,
    lengths: tuple[float, float] = (0.10, 0.25),
    offset: float = 0.015,
) -> Stroke:
    """Draws a push of an object about a direction."""
    return Stroke(
        object=name,
        tool=draw.choice(tools),
        grip_yaw=draw.choice(YAWS),
        direction=direction,
        offset=draw.number(-offset, offset),
        length=draw.number(*lengths),
    )


def _moved(name: str, least: float) -> Rule:
    """Returns the rule of one object that must move by a distance."""

    def rule(start: Ends, ends: Ends) -> list[dict[str, Any]] | None:
        far = math.hypot(*way(start, ends, name)) >= least
        return [place(name, ends)] if far else None

    return rule


def reach(draw: Draw) -> Sketch:
    """Draws an object beyond the reach of the end effector, which must go no nearer."""
    table = Table(draw, reach=0.6)
    angle = draw.number(-40, 40, 1)
    table.solid("object", polar(draw.number(0.66, 0.88), angle))
    stroke = _stroke(draw, "object", PUSHING, angle + draw.number(-80, 80, 1))

    def rule(start: Ends, ends: Ends) -> list[dict[str, Any]] | None:
        before, after = math.hypot(*start["object"][:2]), math.hypot(*ends["object"][:2])
        far = math.hypot(*way(start, ends, "object")) >= 0.08
        return [place("object", ends)] if far and after >= before else None

    return Sketch(table.task(), [stroke], rule)


def hook(draw: Draw) -> Sketch:
    """Draws an object that must come nearer, within 30 degrees of straight inwards."""
    table = Table(draw, reach=0.65)
    angle = draw.number(-45, 45, 1)
    table.solid("object", polar(draw.number(0.58, 0.85), angle))
    stroke = _stroke(draw, "object", PULLING, angle + 180 + draw.number(-30, 30, 1))

    def rule(start: Ends, ends: Ends) -> list[dict[str, Any]] | None:
        moved = way(start, ends, "object")
        inwards = -start["object"][0], -start["object"][1]
        fits = math.hypot(*moved) >= 0.08 and angle_between(moved, inwards) <= 30
        return [place("object", ends)] if fits else None

    return Sketch(table.task(), [stroke], rule)


def sweep(draw: Draw) -> Sketch:
    """Draws an object that must go sideways, within 30 degrees, by at least 12 cm."""
    table = Table(draw)
    angle = draw.number(-40, 40, 1)
    table.solid("object", polar(draw.number(0.45, 0.7), angle))
    across = angle + 90 * draw.sign() + draw.number(-25, 25, 1)
    stroke = _stroke(draw, "object", PUSHING + PULLING, across, (0.16, 0.28))

    def rule(start: Ends, ends: Ends) -> list[dict[str, Any]] | None:
        moved = way(start, ends, "object")
        aside = abs(angle_between(moved, start["object"][:2]) - 90) <= 30
        return [place("object", ends)] if math.hypot(*moved) >= 0.12 and aside else None

    return Sketch(table.task(), [stroke], rule)


def heading(draw: Draw) -> Sketch:
    """Draws a cuboid that must reach a position and a heading 15 degrees or more from its own."""
    table = Table(draw)
    size = draw.number(0.09, 0.15), draw.number(0.05, 0.07)
    at = polar(draw.number(0.42, 0.7), draw.number(-40, 40, 1))
    table.box("object", at, size, yaw_deg=draw.number(-180, 180, 0))
    direction = draw.number(-180, 180, 1)
    stroke = _stroke(draw, "object", PUSHING, direction, (0.1, 0.2), 0.05)

    def rule(start: Ends, ends: Ends) -> list[dict[str, Any]] | None:
        rotation = abs(turned(start, ends, "object"))
        if math.hypot(*way(start, ends, "object")) < 0.05 or not 15 <= rotation <= 90:
            return None
        end = round(math.degrees(ends["object"][2]), 0)
        facing = {"heading_deg": end, "heading_tolerance_deg": 10}
        return [place("object", ends) | facing]

    return Sketch(table.task(), [stroke], rule)


def region(draw: Draw) -> Sketch:
    """Draws an object that must come anywhere into a circle, a rectangle or a triangle."""
    table = Table(draw)
    angle = draw.number(-40, 40, 1)
    table.solid("object", polar(draw.number(0.42, 0.7), angle))
    stroke = _stroke(draw, "object", PUSHING + PULLING, draw.number(-180, 180, 1))
    area: dict[str, Any] = draw.choice(
        [
            {"circle": {"radius": draw.number(0.03, 0.05)}},
            {"rectangle": {"size": [draw.number(0.06, 0.12), draw.number(0.05, 0.08)]}},
            {"polygon": {"corners": [[-0.06, -0.04], [0.06, -0.04], [0.0, 0.07]]}},
        ]
    )
    aside = draw.number(-0.01, 0.01), draw.number(-0.01, 0.01)
    yaw = draw.number(-90, 90, 0)

    def rule(start: Ends, ends: Ends) -> list[dict[str, Any]] | None:
        if math.hypot(*way(start, ends, "object")) < 0.12:
            return None
        x, y, _ = ends["object"]
        middle = [round(x + aside[0], 3), round(y + aside[1], 3)]
        return [{"object": "object", "region": {"area": area, "position": middle, "yaw_deg": yaw}}]

    return Sketch(table.task(), [stroke], rule)


def beside(draw: Draw) -> Sketch:
    """Draws an object with a goal relative to another one, which a plan may also move."""
    table = Table(draw)
    at = polar(draw.number(0.45, 0.65), draw.number(-30, 30, 1))
    table.can("plate", at, draw.number(0.06, 0.08))
    across = draw.number(-180, 180, 0)
    off = draw.number(0.2, 0.3)
    corner = polar(off, across)
    table.solid("object", (at[0] + corner[0], at[1] + corner[1]))
    back = across + 180 + draw.number(-25, 25, 1)
    stroke = _stroke(draw, "object", PUSHING + PULLING, back, (0.08, 0.16))

    def rule(start: Ends, ends: Ends) -> list[dict[str, Any]] | None:
        still = math.hypot(*way(start, ends, "plate")) < 0.005
        if math.hypot(*way(start, ends, "object")) < 0.07 or not still:
            return None
        x, y, turn = ends["plate"]
        dx, dy = ends["object"][0] - x, ends["object"][1] - y
        cos, sin = math.cos(turn), math.sin(turn)
        position = [round(cos * dx + sin * dy, 3), round(cos * dy - sin * dx, 3)]
        goal = {"object": "object", "position": position, "tolerance": 0.015}
        return [goal | {"relative_to": "plate"}]

    return Sketch(table.task(), [stroke], rule)


def several_goals(draw: Draw) -> Sketch:
    """Draws two or three objects with a goal each."""
    count = draw.choice([2, 2, 3])
    table = Table(draw, pushes=count + 1)
    names = [f"object-{k + 1}" for k in range(count)]
    strokes = []
    for k, name in enumerate(names):
        angle = 55.0 * (k - (count - 1) / 2) / (count - 1) + draw.number(-6, 6, 1)
        table.solid(name, polar(draw.number(0.42, 0.66), angle))
        direction = angle + draw.number(-180, 180, 1)
        strokes.append(_stroke(draw, name, PUSHING + PULLING, direction, (0.09, 0.16)))

    def rule(start: Ends, ends: Ends) -> list[dict[str, Any]] | None:
        far = all(math.hypot(*way(start, ends, name)) >= 0.06 for name in names)
        return [place(name, ends) for name in names] if far else None

    return Sketch(table.task(), strokes, rule)


def group(draw: Draw) -> Sketch:
    """Draws two to four blocks that one push can sweep into a rectangle."""
    count = draw.choice([2, 3, 4])
    table = Table(draw, pushes=3)
    angle = draw.number(-30, 30, 1)
    middle = polar(draw.number(0.45, 0.6), angle)
    names = [f"block-{k + 1}" for k in range(count)]
    direction = angle + draw.number(-90, 90, 1)
    for k, name in enumerate(names):
        aside = polar(0.06 * (k - (count - 1) / 2), direction + 90)
        along = polar(draw.number(-0.015, 0.015), direction)
        at = middle[0] + aside[0] + along[0], middle[1] + aside[1] + along[1]
        side = draw.number(0.03, 0.04)
        table.box(name, at, (side, side), mass=0.1, yaw_deg=draw.number(-45, 45, 0))
    stroke = _stroke(draw, names[count // 2], WIDE, direction, (0.16, 0.26), 0.02)

    def rule(start: Ends, ends: Ends) -> list[dict[str, Any]] | None:
        if any(math.hypot(*way(start, ends, name)) < 0.10 for name in names):
            return None
        xs, ys = ([ends[name][k] for name in names] for k in (0, 1))
        size = [round(max(one) - min(one) + 0.05, 3) for one in (xs, ys)]
        centre = [round((max(one) + min(one)) / 2, 3) for one in (xs, ys)]
        area = {"rectangle": {"size": size}}
        inside = [
            all(abs(start[name][k] - centre[k]) <= size[k] / 2 for k in (0, 1)) for name in names
        ]
        goal = {"objects": names, "region": {"area": area, "position": centre}}
        return None if any(inside) else [goal]

    return Sketch(table.task(), [stroke], rule)


def clear(draw: Draw) -> Sketch:
    """Draws a goal before a wall, where a crate stands that must be moved aside first."""
    table = Table(draw, pushes=4)
    far, y = draw.number(0.68, 0.78), draw.number(-0.15, 0.15)
    radius, side = draw.number(0.03, 0.04), draw.number(0.06, 0.08)
    table.can("can", (draw.number(0.42, 0.5), y + draw.number(-0.02, 0.02)), radius)
    table.box("crate", (far, y), (side, side))
    table.wall("wall", (far + side / 2 + draw.number(0.012, 0.02) + 0.01, y), (0.02, 0.34))
    across = draw.sign()
    first = _stroke(draw, "crate", PUSHING + PULLING, 90 * across, (0.13, 0.2))
    second = _stroke(draw, "can", PUSHING, draw.number(-6, 6, 1), (0.16, 0.26))

    def rule(start: Ends, ends: Ends) -> list[dict[str, Any]] | None:
        apart = math.dist(ends["can"][:2], start["crate"][:2])
        # The can overlaps the place of the crate, and the wall leaves no room to push it ahead.
        taken = apart + TOLERANCE < radius + side / 2
        return [place("can", ends)] if taken else None

    return Sketch(table.task(), [first, second], rule)


def gap(draw: Draw) -> Sketch:
    """Draws a wall across the table with one gap, and a goal behind it."""
    table = Table(draw, pushes=3)
    radius, y = draw.number(0.025, 0.04), draw.number(-0.12, 0.12)
    at = draw.number(0.55, 0.6)
    width = round(2 * radius + draw.number(0.02, 0.05), 4)
    table.scene["table"] |= {"size": [1.1, 1.0], "position": [0.5, 0.0]}
    for name, sign in (("left", 1.0), ("right", -1.0)):
        inner, outer = y + sign * width / 2, sign * 0.5
        table.wall(name, (at, (inner + outer) / 2), (0.03, abs(outer - inner)))
    before = at - 0.015 - radius - draw.number(0.02, 0.08)
    table.can("object", (before, y + draw.number(-0.01, 0.01)), radius)
    stroke = _stroke(draw, "object", PUSHING, draw.number(-4, 4, 1), (0.18, 0.3))

    def rule(start: Ends, ends: Ends) -> list[dict[str, Any]] | None:
        through = ends["object"][0] - TOLERANCE >= at + 0.015 + radius
        return [place("object", ends)] if through else None

    return Sketch(table.task(), [stroke], rule)
