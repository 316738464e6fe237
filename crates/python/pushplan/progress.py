"""Progress of long work: the argument of a callback, and a line on stderr.

    import pushplan

    task = pushplan.Task.example("pull-back-behind-wall")
    pushplan.solve(task, progress=True)
    pushplan.solve(task, progress=lambda now: print(now.stage, now.done, now.total))
"""

from __future__ import annotations

import shutil
import sys
from typing import NamedTuple

__all__ = ["Line", "Progress"]


class Progress(NamedTuple):
    """Progress of long work, the argument of the function `progress`.

    The calling thread calls the function at most 20 times a second, and once at the end. An
    exception of the function stops the work and is raised to the caller.
    """

    #: Current activity, such as "search"; may be empty.
    stage: str
    #: Number of finished units of the stage.
    done: int
    #: Number of all units of the stage; 0 if unknown.
    total: int
    #: Best plan so far, one line; empty without one.
    best: str

    def __str__(self) -> str:
        count = f" {self.done}/{self.total}" if self.total else ""
        best = f" (best so far: {self.best})" if self.best else ""
        return f"{self.stage or 'working'}{count}{best}"


class Line:
    """Line on stderr with the latest progress; it is empty unless stderr is a terminal."""

    def __init__(self) -> None:
        # Without a console, Python has no stderr.
        self._stream = sys.stderr if sys.stderr is not None and sys.stderr.isatty() else None

    def __call__(self, now: Progress) -> None:
        """Replaces the line."""
        self._write(str(now)[: shutil.get_terminal_size().columns - 1])

    def close(self) -> None:
        """Removes the line."""
        self._write("")

    def _write(self, text: str) -> None:
        if self._stream is not None:
            # The control sequence erases the rest of the old line.
            self._stream.write(f"\r{text}\x1b[K")
            self._stream.flush()
