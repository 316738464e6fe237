"""Kinds of tasks with joints, levers, new tools and hidden masses."""

from __future__ import annotations

import math
from typing import Any, cast

from ..files import ToolFile
from .draw import Draw, Table, polar
from .kinds import PULLING, PUSHING, YAWS, place, turned
from .sketch import Ends, Sketch, Stroke, way

__all__ = ["design", "door", "drawer", "joined", "lever", "unknown"]


def door(draw: Draw) -> Sketch:
    """Draws a door that stands ajar before its cabinet, and must be opened or shut farther."""
    table = Table(draw, pushes=3)
    width, front = draw.number(0.2, 0.34, 2), draw.number(0.6, 0.7)
    middle, side = draw.number(-0.12, 0.12), draw.sign()
    ajar = draw.number(20, 45, 0)
    hinge = front, round(middle - side * width / 2, 4)
    yaw = side * (90 + ajar)
    out = polar(width / 2, yaw)
    table.thing(
        "door",
        {"cuboid": {"size": [width, 0.02, 0.15]}},
        (hinge[0] + out[0], hinge[1] + out[1]),
        yaw_deg=yaw,
        mass=draw.number(0.8, 2.5, 2),
        friction=draw.number(0.1, 0.35, 2),
    )
    limits = sorted([-side * (ajar - 1), side * (105 - ajar)])
    hung = {"between": ["door", "cabinet"], "kind": "revolute", "at": [*hinge]}
    table.joints.append(hung | {"limits_deg": limits})
    table.wall("cabinet", (front + 0.13, middle), (0.2, round(width + 0.06, 3)), 0.15)
    opens = draw.chance(0.7)
    direction = yaw + 90 * side * (1 if opens else -1) + draw.number(-30, 30, 1)
    stroke = Stroke(
        "door",
        draw.choice(PUSHING + PULLING),
        draw.choice(YAWS),
        direction,
        draw.number(-0.3 * width, 0.3 * width),
        draw.number(0.08, 0.2),
    )

    def rule(start: Ends, ends: Ends) -> list[dict[str, Any]] | None:
        swung = turned(start, ends, "door")
        if abs(swung) < 15:
            return None
        return [{"object": "door", "joint_deg": round(swung, 0), "heading_tolerance_deg": 5}]

    return Sketch(table.task(), [stroke], rule)


def drawer(draw: Draw) -> Sketch:
    """Draws a shut drawer between walls, with a bar on a post by which it can be pulled out."""
    table = Table(draw, pushes=3)
    width, depth = draw.number(0.14, 0.26, 2), draw.number(0.15, 0.2, 2)
    x, y = draw.number(0.66, 0.74), draw.number(-0.15, 0.15)
    bar = round(0.8 * width, 3)
    parts = [("post", 0.10, 0.02, 0.05), ("bar", 0.02, bar, 0.11)]
    table.thing(
        "drawer",
        {"cuboid": {"size": [depth, width, 0.1]}},
        (x, y),
        mass=draw.number(0.5, 2.0, 2),
        friction=draw.number(0.1, 0.3, 2),
        parts=[
            {
                "name": name,
                "shape": {"cuboid": {"size": [long, wide, 0.1]}},
                "position": [round(-depth / 2 - by, 4), 0],
            }
            for name, long, wide, by in parts
        ],
    )
    slide = {"between": ["drawer", "world"], "kind": "prismatic", "axis": [-1, 0]}
    table.joints.append(slide | {"limits": [0, round(0.8 * depth, 3)]})
    for name, sign in (("left", 1.0), ("right", -1.0)):
        table.wall(name, (x + 0.01, y + sign * (width / 2 + 0.015)), (depth - 0.02, 0.02), 0.12)
    stroke = Stroke(
        "drawer",
        draw.choice([*PULLING, "finger", "fork"]),
        draw.choice(YAWS),
        180.0,
        draw.number(-0.45 * width, 0.45 * width),
        draw.number(0.06, 0.2),
    )

    def rule(start: Ends, ends: Ends) -> list[dict[str, Any]] | None:
        out = -way(start, ends, "drawer")[0]
        if out < 0.04:
            return None
        return [{"object": "drawer", "joint": round(out, 3), "tolerance": 0.015}]

    return Sketch(table.task(), [stroke], rule)


def joined(draw: Draw) -> Sketch:
    """Draws two joined objects, one of which has a goal."""
    table = Table(draw)
    at = polar(draw.number(0.45, 0.65), draw.number(-30, 30, 1))
    sizes = [draw.number(0.03, 0.045) for _ in range(2)]
    line = draw.number(-180, 180, 0)
    off = polar(sizes[0] + sizes[1] + 0.01, line)
    names = ["object", "partner"]
    for name, half, shift in zip(names, sizes, [(0.0, 0.0), off]):
        mass = draw.number(0.2, 0.6, 2)
        centre = at[0] + shift[0], at[1] + shift[1]
        if draw.chance():
            table.can(name, centre, half, mass=mass)
        else:
            table.box(name, centre, (2 * half, 2 * half), mass=mass, yaw_deg=line)
    middle = [round(at[k] + off[k] * sizes[0] / sum(sizes), 4) for k in (0, 1)]
    unit = [round(math.cos(math.radians(line)), 6), round(math.sin(math.radians(line)), 6)]
    choices: list[dict[str, Any]] = [
        {"kind": "fixed"},
        {"kind": "revolute", "at": middle},
        {"kind": "prismatic", "axis": unit, "limits": [0, 0.06]},
    ]
    joint = draw.choice(choices)
    table.joints.append({"between": names} | joint)
    stroke = Stroke(
        draw.choice(names),
        draw.choice(PUSHING + PULLING),
        draw.choice(YAWS),
        draw.number(-180, 180, 1),
        draw.number(-0.015, 0.015),
        draw.number(0.1, 0.22),
    )

    def rule(start: Ends, ends: Ends) -> list[dict[str, Any]] | None:
        far = math.hypot(*way(start, ends, "object")) >= 0.07
        return [place("object", ends)] if far else None

    return Sketch(table.task(), [stroke], rule)


def lever(draw: Draw) -> Sketch:
    """Draws a plate on feet that must be raised at an edge, or turned over."""
    table = Table(draw, reach=0.85)
    long, wide = draw.number(0.1, 0.16, 2), draw.number(0.08, 0.12, 2)
    # A cuboid or a prism with five corners.
    corners = [[-long / 2, -wide / 2], [long / 2, -wide / 2], [long / 2, wide / 2]]
    corners += [[0.0, wide / 2 + draw.number(0.01, 0.03)], [-long / 2, wide / 2]]
    rounded = [[round(x, 4), round(y, 4)] for x, y in corners]
    shapes: list[dict[str, Any]] = [
        {"cuboid": {"size": [long, wide, 0.008]}},
        {"prism": {"corners": rounded, "height": 0.008}},
    ]
    shape = draw.choice(shapes)
    at = polar(draw.number(0.42, 0.58), draw.number(-30, 30, 1))
    mass, clearance = draw.number(0.08, 0.2, 2), draw.number(0.005, 0.007)
    yaw = draw.number(-90, 90, 0)
    table.thing("plate", shape, at, mass=mass, clearance=clearance, yaw_deg=yaw)
    goal: dict[str, Any] = {"object": "plate", "raised": draw.number(0.015, 0.03)}
    if draw.chance(0.3):
        goal = {"object": "plate", "flipped": True}
        table.more["levers"] = {"angle_deg": [40, 120], "pivot": "auto"}
    else:
        table.more["levers"] = {"angle_deg": [10, 40]}
    table.pushes.clear()
    return Sketch(table.task(), [], lambda start, ends: None, goals=[goal])


def design(draw: Draw) -> Sketch:
    """Draws an object beyond every shipped tool, or behind a slot narrower than all of them.

    The witness uses a bar of its own with a head or a hook.
    """
    table = Table(draw, reach=0.5)
    parts: list[dict[str, Any]] = [
        {"name": "handle", "size": [0.48, 0.03, 0.05], "position": [0.26, 0]}
    ]
    if draw.chance():
        angle, at = draw.number(-15, 15, 1), draw.number(1.24, 1.32)
        table.solid("object", polar(at, angle))
        parts.append({"name": "arm", "size": [0.48, 0.03, 0.05], "position": [0.72, 0]})
        parts.append({"name": "head", "size": [0.03, 0.12, 0.05], "position": [0.945, 0]})
        direction = angle + draw.number(-40, 40, 1)
    else:
        y, width = draw.number(-0.08, 0.08), draw.number(0.026, 0.029, 4)
        wall = draw.number(0.66, 0.72)
        table.robot["reach"]["max"] = 0.6
        for name, sign in (("left", 1.0), ("right", -1.0)):
            table.wall(name, (wall, y + sign * (width / 2 + 0.7)), (0.03, 1.4), 0.15)
        offset = draw.number(-0.004, 0.004)
        table.can("object", (wall + draw.number(0.13, 0.2), y + offset), draw.number(0.03, 0.045))
        parts[0]["size"] = [0.48, 0.014, 0.05]
        direction = 0.0
    tool = cast(ToolFile, {"name": "own", "friction": 0.4, "parts": parts})
    length = draw.number(0.1, 0.2)
    stroke = Stroke("object", "own", 0.0, direction, draw.number(-0.003, 0.003), length)

    def rule(start: Ends, ends: Ends) -> list[dict[str, Any]] | None:
        far = math.hypot(*way(start, ends, "object")) >= 0.08
        return [place("object", ends)] if far else None

    return Sketch(table.task(), [stroke], rule, new_tools=[tool])


def unknown(draw: Draw) -> Sketch:
    """Draws an object whose mass and friction are hidden, as is the friction of the table."""
    table = Table(draw)
    angle = draw.number(-40, 40, 1)
    table.solid("object", polar(draw.number(0.42, 0.75), angle))
    table.more["unknown"] = ["masses", "frictions"]
    stroke = Stroke(
        "object",
        draw.choice(PUSHING + PULLING),
        draw.choice(YAWS),
        draw.number(-180, 180, 1),
        draw.number(-0.01, 0.01),
        draw.number(0.1, 0.22),
    )

    def rule(start: Ends, ends: Ends) -> list[dict[str, Any]] | None:
        far = math.hypot(*way(start, ends, "object")) >= 0.08
        return [place("object", ends)] if far else None

    return Sketch(table.task(), [stroke], rule, hidden=True)
