"""Proposals that remove the stated cause of a missing plan.

Causes are sentences of `pushplan.Solution.cause`; each pattern below is one of them. A proposal is
not yet a repair: the server applies it and solves the task again.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from .edits import MISSING, Edit, value_at

__all__ = ["Proposal", "by_cause", "general"]

if TYPE_CHECKING:
    #: Subject of a change. `text`: the task was written wrongly; `plan`: limits of the plan;
    #: `robot`: abilities of the robot; `scene`: bodies on the table.
    _Changes = Literal["text", "plan", "robot", "scene"]

#: Factors of a force, a reach or a length, because the stated values are rounded.
_FACTORS = (1.0, 1.5, 2.5)
#: Reach beyond the farthest goal that usually suffices, metres.
_BEYOND = 0.5
#: Factors of the robot's force if the needed force is unknown.
_STRONGER = (4.0, 16.0)
#: Number of directions that is usually enough.
_DIRECTIONS = 16
#: Radii of slender hands, metres.
_SLENDER = (0.03, 0.02)


@dataclass(frozen=True)
class Proposal:
    """Edits that may repair a task."""

    edits: list[Edit]
    changes: _Changes
    #: Reason for the edits, one sentence.
    reason: str


_Mapping = dict[str, Any]
_Found = re.Match[str]


def by_cause(cause: str, mapping: _Mapping) -> list[Proposal]:
    """Returns proposals for a cause, those that change least first."""
    found = []
    for pattern, proposals in _CAUSES:
        match = re.search(pattern, cause)
        if match:
            found += proposals(match, mapping)
    order = ["text", "plan", "robot", "scene"]
    found.sort(key=lambda one: order.index(one.changes))
    return [one for one in found if one.edits]


def general(mapping: _Mapping) -> list[Proposal]:
    """Returns proposals that relax the limits of plan and robot, for causes that name none."""
    edits = []
    found = _farther(mapping)
    if isinstance(mapping.get("tools"), list):
        edits.append(_set(mapping, "tools", "all"))
    count = value_at(mapping, "pushes.max_count")
    more = (count if isinstance(count, int) else 3) + 2
    edits.append(_set(mapping, "pushes.max_count", more))
    directions = value_at(mapping, "pushes.directions")
    if not isinstance(directions, int) or directions < _DIRECTIONS:
        edits.append(_set(mapping, "pushes.directions", _DIRECTIONS))
    found += [Proposal([edit], "plan", f"`{edit.path}` is too narrow") for edit in edits]
    found.append(Proposal(edits, "plan", "several limits of the plan are too narrow"))
    force = value_at(mapping, "robot.max_force")
    if isinstance(force, (int, float)) and not isinstance(force, bool):
        for factor in _STRONGER:
            edit = _set(mapping, "robot.max_force", _round(force * factor))
            found.append(Proposal([edit], "robot", "the robot may be too weak"))
    return found


def _farther(mapping: _Mapping) -> list[Proposal]:
    """Returns the proposal of a reach, and of pushes, up to the farthest object and goal."""
    goal = mapping.get("goal")
    bodies = [*mapping["scene"]["objects"], *(goal if isinstance(goal, list) else [goal])]
    distances = [math.hypot(*body["position"][:2]) for body in bodies if "position" in body]
    reach = value_at(mapping, "robot.reach.max")
    farthest = max(distances, default=0.0)
    if not isinstance(reach, (int, float)) or farthest <= reach:
        return []
    count = value_at(mapping, "pushes.max_count")
    length = farthest / (count if isinstance(count, int) and count else 3)
    edits = [
        _set(mapping, "robot.reach.max", _round(farthest + _BEYOND)),
        _set(mapping, "pushes.length", _round(length)),
    ]
    return [Proposal(edits, "robot", "objects or goals are out of reach")]


def _set(mapping: _Mapping, path: str, new: Any) -> Edit:
    old = value_at(mapping, path)
    return Edit("set", path, None if old is MISSING else old, new)


def _round(value: float) -> float:
    return float(f"{value:.4g}")


def _reach(match: _Found, mapping: _Mapping) -> list[Proposal]:
    reach, length = float(match[1]), match[2]
    found = []
    for factor in _FACTORS[:2]:
        edits = [_set(mapping, "robot.reach.max", _round(reach * factor))]
        if length:
            edits.append(_set(mapping, "pushes.length", _round(float(length) * factor)))
        found.append(Proposal(edits, "robot", "the object or its goal is out of reach"))
    return found


def _more_or_longer(match: _Found, mapping: _Mapping) -> list[Proposal]:
    more = [_set(mapping, "pushes.max_count", int(match[2]) + k) for k in range(2)]
    longer = [_set(mapping, "pushes.length", _round(float(match[1]) * k)) for k in _FACTORS[:2]]
    reason = "the allowed pushes together are too short"
    return [Proposal([edit], "plan", reason) for edit in [*more, *longer]]


def _force(match: _Found, mapping: _Mapping) -> list[Proposal]:
    needed, owner = float(match[1]), match[2]
    path = "robot.max_force"
    if owner:
        names = [one.get("name") for one in mapping["scene"]["objects"]]
        if owner not in names:
            return []
        path = f"scene.objects[{names.index(owner)}].max_force"
    changes: _Changes = "scene" if owner else "robot"
    reason = "pushing takes more force than is allowed"
    edits = [_set(mapping, path, _round(needed * factor)) for factor in _FACTORS]
    return [Proposal([edit], changes, reason) for edit in edits]


def _force_of_replay(match: _Found, mapping: _Mapping) -> list[Proposal]:
    edits = [
        _set(mapping, "robot.max_force", math.ceil(float(match[1]) * factor))
        for factor in _FACTORS[1:]
    ]
    reason = "pushing takes more force than is allowed"
    return [Proposal([edit], "robot", reason) for edit in edits]


def _count(match: _Found, mapping: _Mapping) -> list[Proposal]:
    edits = [_set(mapping, "pushes.max_count", int(match[1]) + k) for k in range(3)]
    return [Proposal([edit], "plan", "the task needs more pushes") for edit in edits]


def _value(path: str, changes: _Changes, reason: str) -> Callable[..., list[Proposal]]:
    """Returns the proposal to set a number, and larger ones if the first does not suffice."""

    def proposals(match: _Found, mapping: _Mapping) -> list[Proposal]:
        edits = [_set(mapping, path, _round(float(match[1]) * factor)) for factor in _FACTORS]
        return [Proposal([edit], changes, reason) for edit in edits]

    return proposals


def _near(match: _Found, mapping: _Mapping) -> list[Proposal]:
    needed = float(match[1])
    edits = [_set(mapping, "robot.reach.min", value) for value in (needed, max(needed - 0.02, 0.0))]
    return [Proposal([edit], "robot", "the pushes are too near the base") for edit in edits]


def _lift(match: _Found, mapping: _Mapping) -> list[Proposal]:
    edit = _set(mapping, "pushes.lift", float(match[1]))
    return [Proposal([edit], "plan", "the tool must be held at another height")]


def _directions(match: _Found, mapping: _Mapping) -> list[Proposal]:
    edit = _set(mapping, "pushes.directions", int(match[1]))
    return [Proposal([edit], "plan", "no allowed direction leads to the goal")]


def _grip_yaws(match: _Found, mapping: _Mapping) -> list[Proposal]:
    old = value_at(mapping, "pushes.grip_yaws_deg")
    yaws = old if isinstance(old, list) else [0, 90, -90]
    edit = _set(mapping, "pushes.grip_yaws_deg", [*yaws, float(match[1])])
    return [Proposal([edit], "plan", "no allowed grip yaw works")]


def _tool(match: _Found, mapping: _Mapping) -> list[Proposal]:
    tools = mapping.get("tools")
    named = tools if isinstance(tools, list) else []
    reason = f"no allowed tool works, but `{match[1]}` does"
    return [Proposal([_set(mapping, "tools", [*named, match[1]])], "plan", reason)]


def _removed(match: _Found, mapping: _Mapping) -> list[Proposal]:
    names = set(re.findall(r"`([^`]+)`", match[1]))
    edits = []
    for kind in ("scene.obstacles", "scene.objects", "keep_out"):
        bodies = value_at(mapping, kind)
        if isinstance(bodies, list):
            for k, body in enumerate(bodies):
                if isinstance(body, dict) and body.get("name") in names:
                    edits.append(Edit("remove", f"{kind}[{k}]", body, None))
                    names.discard(body["name"])
    # Names of generated bodies, such as the base, cannot be removed.
    reason = "bodies obstruct every plan"
    return [Proposal(edits, "scene", reason)] if edits and not names else []


def _kept(match: _Found, mapping: _Mapping) -> list[Proposal]:
    names = re.findall(r"`([^`]+)`", match[1])
    kept = value_at(mapping, "keep.objects")
    edits = [edit for one in _removed(match, mapping) for edit in one.edits]
    edits = [edit for edit in edits if edit.path.startswith("keep_out")]
    if isinstance(kept, list):
        for k, name in enumerate(kept):
            if name in names:
                edits.append(Edit("remove", f"keep.objects[{k}]", name, None))
        if len([edit for edit in edits if edit.path.startswith("keep.objects")]) == len(kept):
            # A list without names is a fault.
            edits = [edit for edit in edits if not edit.path.startswith("keep.objects")]
            edits.append(Edit("remove", "keep", mapping["keep"], None))
    return [Proposal(edits, "plan", "protected bodies obstruct every plan")]


def _hand(_: _Found, mapping: _Mapping) -> list[Proposal]:
    old = value_at(mapping, "robot.hand.radius")
    wide = old if isinstance(old, float) else 0.05
    edits = [_set(mapping, "robot.hand.radius", value) for value in _SLENDER if value < wide]
    return [Proposal([edit], "robot", "the hand collides with bodies") for edit in edits]


_NUMBER = r"(-?[0-9.]+(?:e-?[0-9]+)?)"
_NAMES = r"((?:`[^`]+`|, | and )+)"

#: Pattern of a cause and its proposals.
_CAUSES: list[tuple[str, Callable[[_Found, _Mapping], list[Proposal]]]] = [
    (rf"raise `robot\.reach\.max` to {_NUMBER} m(?: and `pushes\.length` to {_NUMBER} m)?", _reach),
    (rf"raise `pushes\.length` to {_NUMBER} m or `pushes\.max_count` to (\d+)", _more_or_longer),
    (rf"takes about {_NUMBER} N, but `(?:robot\.)?max_force`(?: of `([^`]+)`)?", _force),
    (rf"takes about {_NUMBER} N for longer than an impact; `robot\.max_force`", _force_of_replay),
    (r"the task needs (\d+) pushes, but `pushes\.max_count`", _count),
    (
        rf"raise `pushes\.length` from {_NUMBER[1:-1]} m to {_NUMBER} m",
        _value("pushes.length", "plan", "the pushes are too short"),
    ),
    (
        rf"would have to reach {_NUMBER} m, but `robot\.reach\.max`",
        _value("robot.reach.max", "robot", "the pushes are too far away"),
    ),
    (rf"come within {_NUMBER} m of the base, but `robot\.reach\.min`", _near),
    (rf"but at {_NUMBER} m; change `pushes\.lift`", _lift),
    (
        rf"but at {_NUMBER} m; raise `robot\.travel`",
        _value("robot.travel", "robot", "the lifted tool collides with a body"),
    ),
    (r"widen `pushes\.directions`, for example to (\d+)", _directions),
    (rf"but {_NUMBER} degrees would; add it to `pushes\.grip_yaws_deg`", _grip_yaws),
    (r"no allowed tool works, but `([^`]+)` does", _tool),
    (rf"is enclosed by .*; remove {_NAMES}", _removed),
    (rf"{_NAMES} obstructs? every plan; move or remove", _removed),
    (r"(`.*) must be cleared first, which `pushes\.max_count` \d+ does not suffice", _removed),
    (rf"{_NAMES}, protected by `keep` or `keep_out`, obstructs", _kept),
    (r"the hand or the handle of the tool collides", _hand),
]
