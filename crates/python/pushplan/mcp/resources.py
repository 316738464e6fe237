"""Resources of the server: schemas, shipped tasks and tools, and the book's page about tasks."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from importlib import resources as packaged

from pushplan import Task, ToolLibrary, recording_schema, task_schema, tool_schema

__all__ = ["Resource", "listed", "text_of"]

#: Copy of `book/src/tasks.md`, which a test compares.
PAGE = "tasks.txt"

#: Address, name, description, MIME type, and the function that returns the text.
Resource = tuple[str, str, str, str, Callable[[], str]]


def listed() -> Iterator[Resource]:
    """Yields all resources."""
    schemas = {"task": task_schema, "tool": tool_schema, "recording": recording_schema}
    for kind, schema in schemas.items():
        words = f"JSON schema of {kind} files, with the meaning of every key"
        address = f"pushplan://schema/{kind}"
        yield address, f"schema of {kind}s", words, "application/json", _json(schema)
    yield "pushplan://book/tasks", "book: tasks", "How a task is written", "text/markdown", _page
    for name in Task.examples():
        description = Task.example(name).description or "shipped task"
        yield f"pushplan://tasks/{name}", name, description, "application/yaml", _task(name)
    library = ToolLibrary.shipped()
    for name in library.names:
        description = library[name].description or "shipped tool"
        yield f"pushplan://tools/{name}", name, description, "application/json", _tool(name)


def text_of(address: str) -> tuple[str, str]:
    """Returns the text and the MIME type of a resource, or raises `KeyError`."""
    for found, _, _, kind, text in listed():
        if found == address:
            return text(), kind
    raise KeyError(address)


def _json(schema: Callable[[], object]) -> Callable[[], str]:
    return lambda: json.dumps(schema(), indent=1)


def _task(name: str) -> Callable[[], str]:
    return lambda: Task.example(name).to_yaml()


def _tool(name: str) -> Callable[[], str]:
    return lambda: json.dumps(ToolLibrary.shipped()[name].to_dict(), indent=1)


def _page() -> str:
    return packaged.files("pushplan.mcp").joinpath(PAGE).read_text(encoding="utf-8")
