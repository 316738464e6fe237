"""Protocol between the board and a program: one line of JSON per task to its standard input, one
line per answer from its standard output."""

from __future__ import annotations

import json
import queue
import subprocess
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from .. import PushplanError, task_schema, tool_schema

__all__ = ["STATUSES", "Answer", "Program", "schema"]

#: Claims of a program about a task.
STATUSES = ("solved", "impossible", "unknown")


@dataclass(frozen=True)
class Answer:
    """Answer of a program to a request."""

    status: str
    plan: Any = None
    #: Stated costs, such as numbers of rollouts or seconds of processor time.
    cost: dict[str, float] = field(default_factory=dict)
    note: str = ""
    #: Wall-clock time of the answer, seconds.
    seconds: float = 0.0


class Program:
    """Running program that answers requests."""

    def __init__(self, command: Sequence[str]) -> None:
        self._command = list(command)
        self._process: subprocess.Popen[str] | None = None
        self._lines: queue.Queue[str | None] = queue.Queue()

    def ask(self, request: dict[str, Any], limit: float) -> Answer:
        """Sends a request and returns the answer, within a limit in seconds.

        A program that exceeds the limit, ends or answers another request is started again for the
        next one; the answer is then `unknown` with a note.

        Raises
        ------
        PushplanError
            If the program cannot be started.
        """
        if self._process is None:
            self._start()
        began = time.monotonic()
        line: str | None = None
        note = f"no answer within {limit:g} s"
        try:
            self._write(json.dumps(request) + "\n")
            line = self._lines.get(timeout=limit)
            note = "the program ended" if line is None else ""
        except queue.Empty:
            pass
        except OSError:
            note = "the program ended"
        seconds = time.monotonic() - began
        answer = _parsed(line, str(request["id"]), seconds) if line is not None else note
        if isinstance(answer, Answer):
            return answer
        self.close()
        return Answer("unknown", note=answer, seconds=seconds)

    def close(self) -> None:
        """Ends the program."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            self._process = None

    def _start(self) -> None:
        try:
            self._process = subprocess.Popen(
                self._command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
            )
        except OSError as error:
            raise PushplanError(f"{self._command[0]} cannot be started: {error}") from None
        lines: queue.Queue[str | None] = queue.Queue()
        self._lines = lines
        output = self._process.stdout
        assert output is not None

        def read() -> None:
            for line in output:
                lines.put(line)
            lines.put(None)

        threading.Thread(target=read, daemon=True).start()

    def _write(self, text: str) -> None:
        assert self._process is not None and self._process.stdin is not None
        self._process.stdin.write(text)
        self._process.stdin.flush()


def _parsed(line: str, id: str, seconds: float) -> Answer | str:
    """Returns the answer of a line, or the fault of the line."""
    try:
        found = json.loads(line)
    except ValueError:
        return f"the answer is no line of JSON: {line.strip()[:80]}"
    if not isinstance(found, dict) or found.get("id") != id:
        return f"the answer has not the `id` of the request, {id}"
    status, cost = found.get("status"), found.get("cost", {})
    if status not in STATUSES:
        return f"`status` is {status!r}; it must be one of {', '.join(STATUSES)}"
    numbers = isinstance(cost, dict) and all(isinstance(x, (int, float)) for x in cost.values())
    if not numbers:
        return "`cost` must be a mapping of names to numbers"
    return Answer(status, found.get("plan"), cost, str(found.get("note", "")), seconds)


def schema() -> dict[str, Any]:
    """Returns the JSON schemas of a request and of an answer."""
    number = {"type": ["number", "null"]}
    text = {"type": "string"}
    request = {
        "type": "object",
        "required": ["protocol", "id", "task", "tools", "budget"],
        "properties": {
            "protocol": {"const": 1},
            "id": text | {"description": "Name of the request, to be repeated in the answer."},
            "task": task_schema(),
            "tools": {"type": "array", "items": tool_schema()},
            "new_tools": {
                "type": "object",
                "description": "Tools that a plan may add: number, parts of each, extent of a part "
                "in metres. By default none.",
                "properties": {"count": number, "parts": number, "extent": number},
            },
            "budget": {
                "type": "object",
                "description": "Limits; null is none. After `seconds` an answer counts as unknown.",
                "properties": {"seconds": number, "rollouts": number},
            },
        },
    }
    answer = {
        "type": "object",
        "required": ["id", "status"],
        "properties": {
            "id": text,
            "status": {
                "enum": list(STATUSES),
                "description": "`impossible` claims that no plan exists; `unknown` claims nothing.",
            },
            "plan": {
                "type": ["object", "null"],
                "description": "Content of a plan file (`Plan.to_dict`): `plan.steps`, and new "
                "`tools`. Required if solved.",
            },
            "cost": {"type": "object", "additionalProperties": {"type": "number"}},
            "note": text,
        },
    }
    return {"request": request, "answer": answer}
