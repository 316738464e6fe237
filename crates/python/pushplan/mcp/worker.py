"""Worker process: answers calls one by one, within limits on memory and without writing files.

Each line of stdin is a call, and each line of stdout progress or an answer, in JSON. The server
ends the process after the time limit or a cancellation, and starts another one.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import time
from typing import Any, Optional, TextIO

from pushplan import Progress

__all__ = ["main"]

#: Minimum interval between two reports of progress, seconds.
INTERVAL = 0.2


def main(memory: int, threads: int) -> None:
    """Answers calls until stdin ends; `memory` is the limit in MiB, 0 for none."""
    # The server ends the worker, also after Ctrl-C in their terminal.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    wire = os.fdopen(os.dup(1), "w", encoding="utf-8")
    # Stray output of libraries must not mix with answers.
    os.dup2(2, 1)
    _limit(memory)
    # Imported late, so that a limit that is too low is an error of the call.
    from .calls import Context, answer

    for line in sys.stdin:
        call = json.loads(line)
        reported = _Reporter(wire)
        context = Context(call["time_limit"], threads, reported)
        try:
            found = answer(call["name"], call["arguments"], context)
        except MemoryError:
            found = stopped("memory", f"the call needs more than {memory} MiB; use a smaller task")
        except Exception as error:  # noqa: BLE001 - a fault of the package must not end the server
            found = stopped("error", f"internal error: {type(error).__name__}: {error}")
        _write(wire, {"answer": found})


def stopped(status: str, cause: str) -> dict[str, Any]:
    """Returns the answer of a call without a result."""
    return {"status": status, "evidence": {}, "cause": cause, "repairs": []}


class _Reporter:
    """Writes progress, at most a few times a second."""

    def __init__(self, wire: TextIO) -> None:
        self.wire = wire
        self.begin = time.monotonic()
        self.last: Optional[float] = None

    def __call__(self, now: Progress) -> None:
        seconds = time.monotonic() - self.begin
        if self.last is None or seconds - self.last >= INTERVAL:
            self.last = seconds
            _write(self.wire, {"progress": seconds, "message": str(now)})


def _write(wire: TextIO, document: dict[str, Any]) -> None:
    wire.write(json.dumps(document) + "\n")
    wire.flush()


def _limit(memory: int) -> None:
    try:
        import resource
    except ImportError:
        # Windows has no such limits.
        return
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    # The worker writes to pipes only.
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))
    if memory:
        try:
            resource.setrlimit(resource.RLIMIT_AS, (memory << 20, memory << 20))
        except (OSError, ValueError):
            # Some systems do not support the limit.
            pass
