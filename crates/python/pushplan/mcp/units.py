"""Repairs of lengths in millimetres or centimetres: keys that are lengths, and scaled copies."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from pushplan import task_schema

from .edits import Edit, Step, joined, leaves, split

__all__ = ["HUGE", "LARGE", "SCALES", "is_length", "scalings"]

_SCHEMA: dict[str, Any] = task_schema()

#: Units in metres that people write instead of metres.
SCALES = {"millimetres": 0.001, "centimetres": 0.01}
#: Length on a table above which a unit is in doubt, metres.
LARGE = 1.5
#: Length above which the unit is certainly another one, metres.
HUGE = 3.0
#: Usual lengths in metres by the last key of their path; otherwise `USUAL`.
TYPICAL = {
    "position": 0.5, "home": 0.3, "max": 0.7, "min": 0.2, "tolerance": 0.02, "radius": 0.04,
    "height": 0.08, "size": 0.1, "corners": 0.05, "length": 0.2, "speed": 0.1, "travel": 0.3,
    "lift": 0.002,
}  # fmt: skip
USUAL = 0.1
#: Last keys of the paths of places.
PLACES = ("position", "home", "at", "between")


def _inside(schemas: list[dict[str, Any]], step: Step) -> Iterator[dict[str, Any]]:
    for schema in schemas:
        yield from _inside(schema.get("anyOf", []) + schema.get("oneOf", []), step)
        if isinstance(step, int):
            if isinstance(schema.get("items"), dict):
                # The description of a list holds for its items.
                yield {"description": schema.get("description", ""), **schema["items"]}
        elif step in schema.get("properties", {}):
            yield schema["properties"][step]


def is_length(steps: list[Step]) -> bool:
    """Returns `True` if the value at a path of a task is a length or a speed."""
    schemas = [_SCHEMA]
    texts: list[str] = []
    for step in steps:
        schemas = list(_inside(schemas, step))
        if not schemas:
            return False
        found = [schema.get("description", "") for schema in schemas]
        texts = [*texts, *found] if isinstance(step, int) else found
    last = str(steps[-1])
    if last.endswith("_deg") or last in ("friction", "mass", "max_force"):
        return False
    return any("metre" in text or "m/s" in text for text in texts)


def scalings(
    mapping: dict[str, Any], faulty: set[str], above: float = LARGE
) -> list[tuple[str, list[Edit]]]:
    """Returns edits that convert lengths, each with its unit, the most plausible ones first.

    Candidates convert all lengths, the large or faulty lengths with their neighbours in a list or
    map, and these lengths alone.
    """
    lengths: dict[str, float] = {
        joined(steps): value
        for steps, value in leaves(mapping)
        if isinstance(value, (int, float)) and not isinstance(value, bool)
        and math.isfinite(value) and is_length(steps)
    }  # fmt: skip
    large = {path for path, value in lengths.items() if _in_doubt(path, value, above)} | faulty
    large &= set(lengths)
    if not large:
        return []
    groups = [large, _beside(large, lengths), set(lengths)]
    found: list[tuple[float, str, list[Edit]]] = []
    seen: set[tuple[frozenset[str], float]] = set()
    for rank, group in enumerate(groups):
        for unit, scale in SCALES.items():
            if (frozenset(group), scale) in seen:
                continue
            seen.add((frozenset(group), scale))
            edits = [
                Edit("set", path, lengths[path], _scaled(lengths[path], scale))
                for path in lengths
                if path in group and lengths[path] != 0
            ]
            after = {**lengths, **{edit.path: edit.new for edit in edits}}
            found.append((_strangeness(after) + 0.1 * rank, unit, edits))
    found.sort(key=lambda one: one[0])
    return [(unit, edits) for _, unit, edits in found]


def _in_doubt(path: str, value: float, above: float) -> bool:
    """Returns `True` if a length is too large; a place may be far away on purpose."""
    names = [step for step in split(path) if isinstance(step, str)]
    return abs(value) > (HUGE if names[-1] in PLACES else above)


def _beside(paths: set[str], lengths: dict[str, float]) -> set[str]:
    """Returns paths with the other lengths of the same list, or of the same shape."""
    above = {joined(split(path)[:-1]) for path in paths}
    return {path for path in lengths if joined(split(path)[:-1]) in above} | paths


def _scaled(value: float, scale: float) -> float:
    return float(f"{value * scale:.6g}")


def _strangeness(lengths: dict[str, float]) -> float:
    """Returns the mean distance of lengths from usual ones, in powers of ten beyond the first."""
    total = 0.0
    for path, value in lengths.items():
        names = [step for step in split(path) if isinstance(step, str)]
        usual = TYPICAL.get(names[-1], USUAL)
        if value != 0:
            off = abs(math.log10(abs(value) / usual))
            # Positions may be near an axis; only large ones are strange.
            near = names[-1] in ("position", "corners", "home") and abs(value) < usual
            total += 0.0 if near else max(off - 0.5, 0.0)
    return total / max(len(lengths), 1) * 10.0

