"""Edits of a mapping: the machine-readable part of a repair, and their application.

A path is written like the keys in error messages: ``scene.objects[0].friction``.
"""

from __future__ import annotations

import copy
import re
from dataclasses import asdict, dataclass
from typing import Any, Literal, Union

__all__ = ["MISSING", "Edit", "Step", "applied", "joined", "leaves", "split", "value_at"]

Step = Union[str, int]
_PART = re.compile(r"([^.\[\]]+)|\[(\d+)\]")


class _Missing:
    """Value of a path that leads nowhere."""


MISSING = _Missing()


@dataclass(frozen=True)
class Edit:
    """Single change of a task."""

    #: `rename`: the key at the path; `set`: the value at the path, which may be new; `remove`: the
    #: item of a list at the path.
    action: Literal["rename", "set", "remove"]
    #: Path of the key, value or item.
    path: str
    #: Old key or value; `None` if the path is new.
    old: Any
    #: New key or value; `None` for `remove`.
    new: Any

    def to_json(self) -> dict[str, Any]:
        """Returns the edit with the keys of an answer."""
        found = asdict(self)
        return {"action": self.action, "path": self.path, "from": found["old"], "to": found["new"]}

    @staticmethod
    def of_json(given: dict[str, Any]) -> Edit:
        """Returns the edit of an answer."""
        return Edit(given["action"], given["path"], given["from"], given["to"])


def split(path: str) -> list[Step]:
    """Returns the keys and indices of a path."""
    steps: list[Step] = []
    for key, index in _PART.findall(path):
        steps.append(int(index) if index else key)
    return steps


def joined(steps: list[Step]) -> str:
    """Returns the path of keys and indices."""
    text = ""
    for step in steps:
        text += f"[{step}]" if isinstance(step, int) else f".{step}" if text else step
    return text


def value_at(mapping: Any, path: str) -> Any:
    """Returns the value at a path, or `MISSING`."""
    for step in split(path):
        if isinstance(mapping, dict) and step in mapping:
            mapping = mapping[step]
        elif isinstance(mapping, list) and isinstance(step, int) and step < len(mapping):
            mapping = mapping[step]
        else:
            return MISSING
    return mapping


def leaves(mapping: Any, steps: tuple[Step, ...] = ()) -> list[tuple[list[Step], Any]]:
    """Returns all numbers and texts of a mapping with their paths."""
    if isinstance(mapping, dict):
        return [leaf for key, one in mapping.items() for leaf in leaves(one, (*steps, str(key)))]
    if isinstance(mapping, list):
        return [leaf for k, one in enumerate(mapping) for leaf in leaves(one, (*steps, k))]
    return [(list(steps), mapping)]


def applied(mapping: dict[str, Any], edits: list[Edit]) -> dict[str, Any]:
    """Returns a copy of a mapping after edits. Items are removed last, from the end."""
    changed = copy.deepcopy(mapping)
    removals = [edit for edit in edits if edit.action == "remove"]
    for edit in [edit for edit in edits if edit.action != "remove"]:
        *above, last = split(edit.path)
        inner: Any = changed
        for step in above:
            if isinstance(inner, dict) and step not in inner:
                inner[step] = {}
            inner = inner[step]
        if edit.action == "set":
            inner[last] = copy.deepcopy(edit.new)
        else:
            # A renamed key keeps its place.
            items = [(edit.new if key == last else key, value) for key, value in inner.items()]
            inner.clear()
            inner.update(items)
    for edit in sorted(removals, key=lambda edit: split(edit.path)[-1], reverse=True):
        *above, last = split(edit.path)
        inner = changed
        for step in above:
            inner = inner[step]
        del inner[last]
    return changed
