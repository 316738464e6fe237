"""Repairs of a task: edits that were applied, checked and, for causes, solved.

Faults are repaired from the remedies of their messages, lengths in other units by conversion, and
missing plans by the stated cause. A proposal that does not help is dropped.
"""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional

from pushplan import PushplanError, Solution, Task, ToolLibrary

from .causes import Proposal, by_cause, general
from .edits import MISSING, Edit, applied, split, value_at
from .inputs import InputError, task_of
from .units import HUGE, LARGE, scalings

if TYPE_CHECKING:
    from .causes import _Changes

__all__ = ["Repair", "Trial", "of_faults", "of_solution"]

#: Order of statuses, worst first.
ORDER = ["no_plan", "failed_verification", "partial", "fragile", "solved"]
#: Maximum number of rounds of corrections of faults.
ROUNDS = 6

#: Maximum duration of the trial of a repair, seconds.
TRIAL = 6.0
#: Maximum number of alternatives in an answer.
ALTERNATIVES = 2


@dataclass(frozen=True)
class Trial:
    """Means to verify repairs."""

    library: ToolLibrary
    #: Returns the status of solving a task within seconds; `None` if repairs are only checked.
    solve: Optional[Callable[[Task, float], str]]
    #: End of the time for trials, on the clock `time.monotonic`.
    until: float

    def faults(self, mapping: dict[str, Any]) -> list[dict[str, Any]]:
        """Returns the faults of a task."""
        try:
            return task_of(mapping, self.library).faults
        except InputError as error:
            return [{"key": None, "message": str(error), "remedy": ""}]

    def left(self) -> float:
        """Returns the remaining seconds."""
        return self.until - time.monotonic()

    def status(self, mapping: dict[str, Any]) -> Optional[str]:
        """Returns the status of a valid task, or `None` without an answer in time."""
        task = task_of(mapping, self.library).value
        if self.solve is None or task is None or self.left() <= 0:
            return None
        try:
            return self.solve(task, min(self.left(), TRIAL))
        except (PushplanError, ValueError):
            return None


@dataclass(frozen=True)
class Repair:
    """Repair that was verified."""

    edits: list[Edit]
    changes: _Changes
    reason: str
    #: Number of faults before and after.
    faults: tuple[int, int]
    #: Status of solving the repaired task; `None` if it was only checked.
    status: Optional[str]
    #: Task after the edits, with the keys of a task file.
    task: dict[str, Any]

    def to_json(self) -> dict[str, Any]:
        """Returns the repair with the keys of an answer."""
        return {
            "edits": [edit.to_json() for edit in self.edits],
            "changes": self.changes,
            "reason": self.reason,
            "verified": {
                "faults_before": self.faults[0],
                "faults_after": self.faults[1],
                "status": self.status,
            },
            "task": self.task,
        }


def of_faults(mapping: dict[str, Any], trial: Trial) -> list[Repair]:
    """Returns repairs of an invalid task; those that lead to a plan come first."""
    before = trial.faults(mapping)
    if not before:
        return []
    corrected, edits, reason = _corrected(mapping, trial)
    left = trial.faults(corrected)
    options: list[tuple[list[Edit], str]] = []
    if left:
        faulty = {one["key"] for one in left if one["key"]}
        for unit, scaled in scalings(corrected, faulty):
            text = f"lengths are metres, but these are probably {unit}"
            options.append((edits + scaled, f"{reason}; {text}" if edits else text))
    if edits:
        options.append((edits, reason))
    found: list[Repair] = []
    for option, text in options:
        changed = applied(mapping, option)
        after = trial.faults(changed)
        if len(after) >= len(before) or (found and after):
            continue
        status = None if after else trial.status(changed)
        counts = (len(before), len(after))
        found.append(Repair(option, "text", text, counts, status, changed))
        if status == "solved" or (trial.solve is None and not after):
            break
    return _best(found)


def of_solution(
    mapping: dict[str, Any], before: str, solution: Solution, trial: Trial
) -> list[Repair]:
    """Returns repairs of a valid task without a plan; each has a better status than `before`."""
    certain, likely = [_in_units(mapping, above) for above in (HUGE, LARGE)]
    verdict = solution.best.verdict if solution.best is not None else None
    cause = solution.cause or (verdict.reason if verdict is not None else "")
    options = certain + by_cause(cause, mapping)
    options += [option for option in likely if option not in certain] + general(mapping)
    found: list[Repair] = []
    for option in options:
        if trial.left() <= 0:
            break
        changed = applied(mapping, option.edits)
        if trial.faults(changed):
            continue
        status = trial.status(changed)
        if status and ORDER.index(status) > ORDER.index(before):
            counts = (0, 0)
            repair = Repair(option.edits, option.changes, option.reason, counts, status, changed)
            found.append(repair)
            if status == "solved":
                break
    return _best(found)


def _in_units(mapping: dict[str, Any], above: float) -> list[Proposal]:
    return [
        Proposal(edits, "text", f"lengths are metres, but these are probably {unit}")
        for unit, edits in scalings(mapping, set(), above)
    ]


def _best(found: list[Repair]) -> list[Repair]:
    """Returns the best repairs: fewest faults, then the best status."""
    rank = {status: k for k, status in enumerate([None, *ORDER])}
    found = sorted(found, key=lambda one: (one.faults[1], -rank[one.status]))
    solved = [one for one in found if one.status == "solved"]
    return (solved or found)[:ALTERNATIVES]


def _corrected(
    mapping: dict[str, Any], trial: Trial
) -> tuple[dict[str, Any], list[Edit], str]:
    """Returns the mapping after corrections of names and keys, these corrections and a reason."""
    edits: list[Edit] = []
    faults = trial.faults(mapping)
    for _ in range(ROUNDS):
        proposed = [edit for one in faults for edit in _of_fault(one, faults, mapping)]
        kept = _unique(proposed)
        changed = applied(mapping, kept)
        after = trial.faults(changed)
        if len(after) >= len(faults):
            # One of them may be wrong.
            single = [[edit] for edit in kept]
            count = len(faults)
            better = [one for one in single if len(trial.faults(applied(mapping, one))) < count]
            if not better:
                break
            kept = better[0]
            changed = applied(mapping, kept)
            after = trial.faults(changed)
        edits += kept
        mapping, faults = changed, after
        if not faults:
            break
    words = [f"`{edit.old}` is misspelt" for edit in edits]
    return mapping, edits, ", ".join(words)


def _unique(edits: list[Edit]) -> list[Edit]:
    """Returns at most one edit for each path."""
    return list({edit.path: edit for edit in edits}.values())


def _of_fault(
    one: dict[str, Any], faults: list[dict[str, Any]], mapping: dict[str, Any]
) -> list[Edit]:
    key, remedy = one["key"], one["remedy"]
    if not key:
        return []
    here = value_at(mapping, key)
    meant = re.fullmatch(r"did you mean `(.+)`\?", remedy)
    if one["message"].startswith("unknown key"):
        name = str(split(key)[-1])
        new = meant[1] if meant else _missing_beside(key, faults)
        # A path of an odd key leads nowhere.
        if new is None or here is MISSING:
            return []
        above = value_at(mapping, ".".join(key.split(".")[:-1])) if "." in key else mapping
        taken = isinstance(above, dict) and new in above
        return [] if taken else [Edit("rename", key, name, new)]
    if meant and isinstance(here, str):
        return [Edit("set", key, here, meant[1])]
    return []


def _missing_beside(key: str, faults: list[dict[str, Any]]) -> Optional[str]:
    """Returns the only key that is missing in the same map."""
    above = key.rpartition(".")[0]
    missing = [
        found[1]
        for one in faults
        if (one["key"] or "") == above
        and (found := re.match(r"missing key `([^`]+)`", one["message"]))
    ]
    return missing[0] if len(missing) == 1 else None
