"""What can go wrong, as exceptions; all of them are a :class:`PushplanError`.

Not finding a plan is no error: see :attr:`pushplan.Solution.status`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

__all__ = [
    "ActionError",
    "Fault",
    "FileError",
    "ModelError",
    "PushplanError",
    "RefusedError",
    "TaskError",
]


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong with a file, a text or a mapping."""

    #: File name as given by the user.
    file: str
    #: Line number, from 1; ``None`` if the fault concerns the whole file or a mapping.
    line: int | None
    #: Column in characters, from 1; ``None`` if the fault concerns the whole file or a mapping.
    column: int | None
    #: Key in a mapping, such as ``scene.objects[0].mass``; ``None`` in files and texts.
    key: str | None
    #: Expected and found content.
    message: str
    #: Suggested fix; may be empty.
    advice: str

    def __str__(self) -> str:
        place = self.file if self.line is None else f"{self.file}:{self.line}:{self.column}"
        if self.key:
            place = f"{place}: {self.key}"
        advice = f"\n  help: {self.advice}" if self.advice else ""
        return f"{place}: error: {self.message}{advice}"


class PushplanError(Exception):
    """Any error of this package."""


class FileError(PushplanError, ValueError):
    """Everything that is wrong with tools, tasks, plans or recordings, or with their files."""

    #: Faults; at least one.
    faults: tuple[Fault, ...]

    def __init__(self, faults: Iterable[Fault]) -> None:
        self.faults = tuple(faults)
        super().__init__(self.faults)

    def __str__(self) -> str:
        return "\n".join(map(str, self.faults))


class ModelError(PushplanError, ValueError):
    """A text that names no effect model, or weights that cannot be used."""


class TaskError(PushplanError, ValueError):
    """A task that cannot even be tried."""


class ActionError(PushplanError, ValueError):
    """Pushes that cannot be made, such as one of an object that the tool cannot push that way."""


class RefusedError(PushplanError):
    """The model should not be trusted with this, and was told to refuse then."""

    #: Reasons why the case is outside the model's validity range.
    warnings: tuple[str, ...]

    def __init__(self, message: str, warnings: Iterable[str]) -> None:
        self.warnings = tuple(warnings)
        super().__init__(message, self.warnings)

    def __str__(self) -> str:
        return str(self.args[0])
