"""Inputs of calls: tasks, tools and plans, as texts or as JSON objects.

No input names a file. `robot.urdf`, the only reference of a task to a file, is refused before the
package reads the task, and meshes are named by such files only.
"""

from __future__ import annotations

import difflib
import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any, Generic, Optional, TypeVar

from pushplan import FileError, Plan, Task, Tool, ToolLibrary

from .yaml_text import UnreadableText, loaded

__all__ = ["DEPTH", "Given", "InputError", "fault", "library_of", "plan_of", "task_of", "tool_of"]

#: Maximum nesting of lists and maps, as for the files of the package.
DEPTH = 32
#: Keys whose values name files.
REFERENCES = ("urdf",)

_T = TypeVar("_T")


class InputError(ValueError):
    """Argument of a call that is of the wrong type or out of range; the message has a remedy."""


@dataclass
class Given(Generic[_T]):
    """Input with its value or its faults."""

    #: Checked value; `None` with faults.
    value: Optional[_T]
    #: Mapping that was checked; `None` if the text has none.
    mapping: Optional[dict[str, Any]]
    #: Faults, each with line, column, key, message and remedy.
    faults: list[dict[str, Any]] = field(default_factory=list)


def task_of(given: object, library: Optional[ToolLibrary] = None) -> Given[Task]:
    """Reads a task, and checks the names of its tools against a library."""
    found = _read(given, "task", Task.parse, Task.from_dict)
    if library is not None and found.mapping is not None:
        found.faults += _unknown_tools(found.mapping.get("tools"), library)
        if found.faults:
            found.value = None
    return found


def _unknown_tools(tools: object, library: ToolLibrary) -> list[dict[str, Any]]:
    faults = []
    for k, one in enumerate(tools if isinstance(tools, list) else []):
        costed = isinstance(one, dict)
        name = one.get("name") if costed else one
        if isinstance(name, str) and name not in library:
            near = difflib.get_close_matches(name, library.names, 1)
            names = ", ".join(f"`{one}`" for one in library.names)
            remedy = f"did you mean `{near[0]}`?" if near else f"use one of {names}"
            key = f"tools[{k}].name" if costed else f"tools[{k}]"
            faults.append(fault(f"unknown tool `{name}`", remedy, key))
    return faults


def tool_of(given: object, name: str = "tool") -> Given[Tool]:
    """Reads a tool."""
    return _read(given, name, Tool.parse, Tool.from_dict)


def plan_of(given: object) -> Given[Plan]:
    """Reads a plan, a JSON object or its text."""
    if isinstance(given, str):
        try:
            given = json.loads(given)
        except (ValueError, RecursionError) as error:
            return Given(None, None, [fault(f"not valid JSON: {error}", "pass `plan` of `solve`")])
    # The text is written again, so that no key hides behind a repeated one.
    return _read(given, "plan", Plan.parse, lambda mapping: Plan.parse(json.dumps(mapping)))


def library_of(tools: object) -> ToolLibrary:
    """Returns the shipped tools and the given ones."""
    library = ToolLibrary.shipped()
    if tools is None:
        return library
    if not isinstance(tools, list):
        raise InputError(f"`tools` must be a list of tools, found {_kind(tools)}")
    for k, one in enumerate(tools):
        given = tool_of(one, f"tools[{k}]")
        if given.value is None:
            first = given.faults[0]
            raise InputError(f"`tools[{k}]`: {first['message']}; {first['remedy']}".rstrip("; "))
        library = library.with_tool(given.value)
    return library


def fault(message: str, remedy: str = "", key: Optional[str] = None) -> dict[str, Any]:
    """Returns a fault without a place in a text."""
    return {"line": None, "column": None, "key": key, "message": message, "remedy": remedy}


def _read(
    given: object,
    name: str,
    parse: Callable[[str, str], _T],
    build: Callable[[Any], _T],
) -> Given[_T]:
    if isinstance(given, dict):
        mapping: Optional[dict[str, Any]] = given
        refused = _refused(given)
        return Given(None, None, refused) if refused else _checked(given, lambda: build(given))
    if not isinstance(given, str):
        raise InputError(
            f"`{name}` must be a text (YAML) or an object with the keys of its file, found "
            f"{_kind(given)}; see the resource pushplan://schema/task"
        )
    reason = ""
    try:
        mapping = loaded(given)
    except UnreadableText as error:
        mapping, reason = None, str(error)
    if mapping is not None:
        refused = _refused(mapping)
        if refused:
            return Given(None, None, refused)
        if "\\" in given:
            # An escape could hide a key from the reader above but not from the one below.
            return _checked(mapping, lambda: build(mapping))
    elif "urdf" in given or "\\" in given:
        return Given(None, None, [fault(reason, "write plain YAML without aliases and escapes")])
    return _checked(mapping, lambda: parse(given, name))


def _checked(mapping: Optional[dict[str, Any]], read: Callable[[], _T]) -> Given[_T]:
    try:
        return Given(read(), mapping)
    except FileError as error:
        return Given(None, mapping, [_plain(one) for one in error.faults])
    except (TypeError, ValueError, OverflowError, RecursionError) as error:
        return Given(None, None, [fault(str(error), "see the resource pushplan://schema/task")])


def _plain(one: Any) -> dict[str, Any]:
    return {
        "line": one.line,
        "column": one.column,
        "key": one.key,
        "message": one.message,
        "remedy": one.advice,
    }


def _refused(mapping: dict[str, Any]) -> list[dict[str, Any]]:
    """Returns faults for references to files and for nesting that is too deep."""
    try:
        found = list(_references(mapping, "", 0))
    except InputError as error:
        return [fault(str(error), "look for brackets that are never closed")]
    remedy = (
        "state the arm itself as `robot.arm`: `pushplan.Task.load(FILE).to_dict()` on your machine "
        "writes it"
    )
    message = "this server reads no files that a task names"
    return [fault(message, remedy, key) for key in found]


def _references(value: object, path: str, depth: int) -> Iterator[str]:
    if depth > DEPTH:
        raise InputError(f"lists and maps are nested too deeply: more than {DEPTH} levels")
    if isinstance(value, dict):
        for key, inner in value.items():
            inside = f"{path}.{key}" if path else str(key)
            if key in REFERENCES:
                yield inside
            yield from _references(inner, inside, depth + 1)
    elif isinstance(value, list):
        for k, inner in enumerate(value):
            yield from _references(inner, f"{path}[{k}]", depth + 1)


def _kind(value: object) -> str:
    names = {dict: "an object", list: "a list", str: "a text", bool: "true or false"}
    if value is None:
        return "nothing"
    return names.get(type(value), f"the number {value}"[:60])
