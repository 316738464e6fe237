"""Exceptions of the package, with the common base class :class:`PushplanError`.

A missing plan is not an error: see :attr:`pushplan.Solution.status`.
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
    "UnknownToolError",
]


@dataclass(frozen=True)
class Fault:
    """Fault in a file, a text or a mapping, with its location."""

    #: File name as given by the user.
    file: str
    #: Line number, from 1; ``None`` if the fault concerns the whole file or a mapping.
    line: int | None
    #: Column in characters, from 1; ``None`` if the fault concerns the whole file or a mapping.
    column: int | None
    #: Key in a mapping, such as ``scene.objects[0].mass``; ``None`` in files and texts.
    key: str | None
    #: Description of the fault, with the expected and the found content.
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
    """Base class of the exceptions of this package."""


class FileError(PushplanError, ValueError):
    """Invalid tool, task, plan or recording, or a file that cannot be read or written.

    Parameters
    ----------
    faults : iterable of Fault
        Faults; at least one.
    """

    #: Faults; at least one.
    faults: tuple[Fault, ...]

    def __init__(self, faults: Iterable[Fault]) -> None:
        self.faults = tuple(faults)
        super().__init__(self.faults)

    def __str__(self) -> str:
        return "\n".join(map(str, self.faults))


class ModelError(PushplanError, ValueError):
    """Unknown name of an effect model, or unusable weights."""


class TaskError(PushplanError, ValueError):
    """Task that the planner cannot attempt because one of its values is invalid."""


class ActionError(PushplanError, ValueError):
    """Infeasible pushes, such as a push in a direction in which the tool cannot push."""


class UnknownToolError(ActionError, KeyError):
    """Unknown name of a tool; a `KeyError`, because a library maps names to tools."""

    def __str__(self) -> str:
        # A KeyError shows its text in quotes.
        return str(self.args[0])


class RefusedError(PushplanError):
    """Input outside the model's validity range, with ``out_of_range="refuse"``.

    Parameters
    ----------
    message : str
        Text of the error.
    warnings : iterable of str
        Reasons why the input is outside the model's validity range.
    """

    #: Reasons why the input is outside the model's validity range.
    warnings: tuple[str, ...]

    def __init__(self, message: str, warnings: Iterable[str]) -> None:
        self.warnings = tuple(warnings)
        super().__init__(message, self.warnings)

    def __str__(self) -> str:
        return str(self.args[0])
