"""Pictures of tasks and plans from above: SVG text and PNG bytes, x up and y left."""

from __future__ import annotations

import base64
import math
import struct
import zlib
from typing import Any, Optional
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from pushplan import Plan, Task

from .._picture import Picture, about_centre, placed

__all__ = ["png", "svg"]

#: Margin around the scene, metres.
MARGIN = 0.1
#: Size of letters as a share of the picture.
LETTER = 0.022
_COLOURS = {"object": "#e1af78", "obstacle": "#5a5a5a", "goal": "#3c8c3c", "tool": "#4678c8"}


def svg(task: Task, plan: Optional[Plan] = None, size: int = 512) -> str:
    """Returns a drawing of the start, the goals and, with a plan, its pushes and final poses."""
    mapping: Any = task.to_dict()
    bodies = [_body(one, "object") for one in mapping["scene"]["objects"]]
    walls = [_body(one, "obstacle") for one in mapping["scene"].get("obstacles", [])]
    goals = _goals(mapping["goal"])
    pushes = [] if plan is None else _pushes(plan)
    places = [(0.0, 0.0), *(place for _, places in [*bodies, *walls] for place in places)]
    places += [place for _, places in goals for place in places]
    places += [place for line in pushes for place in line[:2]]
    low = [min(place[k] for place in places) - MARGIN for k in range(2)]
    high = [max(place[k] for place in places) + MARGIN for k in range(2)]
    side = max(high[k] - low[k] for k in range(2))
    # World x points up and world y points left.
    corner = (-high[1] - (side - high[1] + low[1]) / 2, -high[0] - (side - high[0] + low[0]) / 2)
    view = " ".join(f"{value:.4f}" for value in (*corner, side, side))
    parts = ['<circle r="0.015" fill="#323c50"><title>base of the robot</title></circle>']
    parts += [text for text, _ in [*walls, *bodies]]
    parts += [text for text, _ in goals]
    for k, (start, end, name) in enumerate(pushes, 1):
        parts.append(_arrow(start, end, f"push {k}: {name}", side))
    letters = f'font-family="sans-serif" font-size="{LETTER * side:.4f}"'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{view}" width="{size}" height="{size}" '
        f"{letters}>\n<title>{escape(task.name)}</title>\n"
        f'<rect x="{corner[0]:.4f}" y="{corner[1]:.4f}" width="{side:.4f}" height="{side:.4f}" '
        'fill="#ffffff"/>\n' + "\n".join(parts) + "\n</svg>\n"
    )


def png(task: Task, plan: Optional[Plan] = None, size: int = 512) -> str:
    """Returns a PNG image of the start, with the tool at its first push, in base64."""
    tool = None
    if plan is not None and plan.pushes and plan.pushes[0].start:
        x, y = plan.pushes[0].start
        grip_x, grip_y, turned = plan.tool.grip
        yaw = plan.grip_yaw - turned
        cos, sin = math.cos(yaw), math.sin(yaw)
        pose = (x - cos * grip_x + sin * grip_y, y - sin * grip_x - cos * grip_y, yaw)
        tool = (plan.tool, pose)
    goal = list(task.goal_position)
    pixels = Picture(task, size).of(task.start, goal, max(task.tolerance, 0.005), tool)
    return base64.b64encode(_png(pixels)).decode()


def _png(pixels: Any) -> bytes:
    height, width, _ = pixels.shape
    rows = np.zeros((height, 1 + 3 * width), np.uint8)
    rows[:, 1:] = pixels.reshape(height, 3 * width)

    def chunk(kind: bytes, data: bytes) -> bytes:
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    data = zlib.compress(rows.tobytes(), 9)
    content = chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + content


_Places = list[tuple[float, float]]


def _at(pose: tuple[float, float, float], x: float, y: float) -> tuple[float, float]:
    cos, sin = math.cos(pose[2]), math.sin(pose[2])
    return pose[0] + cos * x - sin * y, pose[1] + sin * x + cos * y


def _body(one: dict[str, Any], kind: str) -> tuple[str, _Places]:
    """Returns the drawing of an object with its parts, or of an obstacle, and its corners."""
    pose = (*one["position"][:2], math.radians(one.get("yaw_deg", 0.0)))
    shapes = [(one, pose)]
    for part in one.get("parts", []):
        shapes.append((part, placed(pose, part)))
    texts, places = [], []
    for solid, at in shapes:
        text, corners = _solid(solid.get("shape", {"cuboid": {"size": solid.get("size")}}), at)
        texts.append(text)
        places += corners
    name = f"<title>{escape(one['name'])}</title>"
    x, y = -pose[1], -pose[0]
    label = f'<text x="{x:.4f}" y="{y:.4f}" text-anchor="middle">{escape(one["name"])}</text>'
    fill = f'fill="{_COLOURS[kind]}" fill-opacity="0.8"'
    label = label if kind == "object" else ""
    return f"<g>{name}<g {fill}>{''.join(texts)}</g>{label}</g>", places


def _solid(shape: dict[str, Any], pose: tuple[float, float, float]) -> tuple[str, _Places]:
    if "cylinder" in shape:
        radius = shape["cylinder"]["radius"]
        x, y = pose[:2]
        ends = [(x - radius, y - radius), (x + radius, y + radius)]
        return f'<circle cx="{-y:.4f}" cy="{-x:.4f}" r="{radius:.4f}"/>', ends
    if "prism" in shape:
        corners = [(x, y) for x, y in about_centre(shape["prism"]).tolist()]
    else:
        width, depth = shape["cuboid"]["size"][:2]
        signs = [(1, 1), (1, -1), (-1, -1), (-1, 1)]
        corners = [(x * width / 2, y * depth / 2) for x, y in signs]
    places = [_at(pose, *corner) for corner in corners]
    points = " ".join(f"{-y:.4f},{-x:.4f}" for x, y in places)
    return f'<polygon points="{points}"/>', places


def _goals(goal: Any) -> list[tuple[str, _Places]]:
    """Returns the drawings of goals with an absolute position."""
    found = []
    for one in goal if isinstance(goal, list) else [goal]:
        if "position" not in one or one.get("relative_to"):
            continue
        x, y = one["position"][:2]
        radius = max(one.get("tolerance") or 0.0, 0.005)
        name = one.get("object") or ", ".join(one.get("objects", []))
        line = f'fill="none" stroke="{_COLOURS["goal"]}" stroke-width="0.004"'
        title = f"<title>{escape(f'goal of {name}')}</title>"
        circle = f'<circle cx="{-y:.4f}" cy="{-x:.4f}" r="{radius:.4f}" {line}>{title}</circle>'
        found.append((circle, [(x - radius, y - radius), (x + radius, y + radius)]))
    return found


def _pushes(plan: Plan) -> list[tuple[Any, Any, str]]:
    """Returns start, end and tool of each push."""
    found = []
    for step in plan.steps:
        push = step.get("push")
        if push and push.get("start"):
            (x, y), turn, length = push["start"], push["direction"], push["length"]
            end = (x + length * math.cos(turn), y + length * math.sin(turn))
            found.append(((x, y), end, str(push["tool"])))
    return found


def _arrow(start: Any, end: Any, name: str, side: float) -> str:
    head = 0.02 * side
    turn = math.atan2(end[1] - start[1], end[0] - start[0])
    wings = [_at((*end, turn), -head, sign * head / 2) for sign in (1, -1)]
    points = " ".join(f"{-y:.4f},{-x:.4f}" for x, y in [end, *wings])
    line = f'x1="{-start[1]:.4f}" y1="{-start[0]:.4f}" x2="{-end[1]:.4f}" y2="{-end[0]:.4f}"'
    colour, wide = _COLOURS["tool"], f'stroke-width="{0.005 * side:.4f}"'
    return (
        f"<g data-push={quoteattr(name)}><title>{escape(name)}</title>"
        f'<line {line} stroke="{colour}" {wide}/><polygon points="{points}" fill="{colour}"/></g>'
    )
