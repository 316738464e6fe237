"""Answers of a program to a board, and the page about them."""

from __future__ import annotations

import hashlib
import json
import statistics
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from .. import __version__
from .board import VERSION, BoardTask
from .protocol import Answer, Program

__all__ = ["Record", "page", "played", "summary"]

#: Time of a program beyond its budget before it is ended, seconds.
GRACE = 10.0


@dataclass(frozen=True)
class Record:
    """Answer to a task, and its judgement."""

    id: str
    kind: str
    possible: bool
    status: str
    #: Whether the claim is false: a plan that fails, or a wrong `impossible`.
    false: bool
    #: Reason why the plan fails, or the program's note.
    note: str
    seconds: float
    cost: dict[str, float]

    @property
    def solved(self) -> bool:
        """Whether a plan works."""
        return self.status == "solved" and not self.false


def played(
    tasks: Sequence[BoardTask],
    command: Sequence[str],
    out: Path,
    budget: dict[str, float | None],
    progress: Callable[[str], None] = print,
) -> list[Record]:
    """Asks a program for every task, judges its plans, and returns the records.

    Every record is appended to `answers.jsonl` in the folder `out`. Tasks that the file already
    holds are not asked again.

    Raises
    ------
    PushplanError
        If the program cannot be started, or MuJoCo is missing.
    """
    out.mkdir(parents=True, exist_ok=True)
    file = out / "answers.jsonl"
    lines = file.read_text().splitlines() if file.exists() else []
    done = {record.id: record for record in (Record(**json.loads(line)) for line in lines)}
    program = Program(command)
    limit = (budget.get("seconds") or 3600.0) + GRACE
    try:
        for count, task in enumerate(tasks, 1):
            if task.id in done:
                continue
            record = _judged(task, program.ask(task.request(budget), limit))
            done[task.id] = record
            with file.open("a") as answers:
                answers.write(json.dumps(asdict(record)) + "\n")
            progress(f"{count} of {len(tasks)}: {record.status}{', false' * record.false}")
    finally:
        program.close()
    return [done[task.id] for task in tasks]


def _judged(task: BoardTask, answer: Answer) -> Record:
    """Returns the record of an answer."""
    false, note = False, answer.note
    if answer.status == "solved":
        fault = task.judge(answer.plan) if task.possible else "the task is impossible"
        false, note = fault is not None, fault or ""
    if answer.status == "impossible" and task.possible:
        false, note = True, "the task has a witness"
    seconds = round(answer.seconds, 3)
    cost = answer.cost
    return Record(task.id, task.kind, task.possible, answer.status, false, note, seconds, cost)


def summary(records: Iterable[Record]) -> dict[str, Any]:
    """Returns the counts of some records, and their costs."""
    found = list(records)
    seconds = sorted(one.seconds for one in found)
    costs = sorted({name for one in found for name in one.cost})
    return {
        "tasks": len(found),
        "solved": sum(one.solved for one in found),
        "impossible": sum(one.status == "impossible" and not one.false for one in found),
        "unknown": sum(one.status == "unknown" for one in found),
        "false": sum(one.false for one in found),
        "median_s": statistics.median(seconds) if seconds else 0.0,
        "sum_s": round(sum(seconds), 1),
        "cost": {name: round(sum(one.cost.get(name, 0.0) for one in found), 1) for name in costs},
    }


def page(records: Sequence[Record], title: str, budget: dict[str, float | None]) -> str:
    """Returns the page about some records, in Markdown."""
    possible = [one for one in records if one.possible]
    twins = [one for one in records if not one.possible]
    kinds = dict.fromkeys(one.kind for one in sorted(records, key=lambda one: one.kind))
    digits = hashlib.sha256(" ".join(sorted(one.id for one in records)).encode()).hexdigest()[:8]
    limits = [f"{value:g} {name}" for name, value in budget.items() if value is not None]
    about = (
        f"Board of tool tasks, version {VERSION}, {len(records)} tasks ({digits}), pushplan "
        f"{__version__}. Budget of a task: {', '.join(limits) or 'none'}."
    )
    times = "seconds, median | seconds, sum"
    lines = [
        f"# {title}",
        "",
        about,
        "",
        f"| tasks | number | solved | unknown | false claims | {times} |",
        "| --- | --: | --: | --: | --: | --: | --: |",
        *(_row(kind, [one for one in possible if one.kind == kind]) for kind in kinds),
        _row("all with a witness", possible),
        "",
        f"| twins | number | called impossible | unknown | false claims | {times} |",
        "| --- | --: | --: | --: | --: | --: | --: |",
        *(_row(kind, own, True) for kind in kinds if (own := _of(twins, kind))),
        _row("all impossible", twins, True),
        "",
    ]
    costs = summary(records)["cost"]
    lines += [f"Stated cost, sum of `{name}`: {value:g}." for name, value in costs.items()]
    wrong = [one for one in records if one.false]
    lines += ["", *(f"- false: {one.kind}, {one.id}: {one.note}" for one in wrong)]
    return "\n".join(lines).rstrip() + "\n"


def _of(records: Sequence[Record], kind: str) -> list[Record]:
    """Returns the records of a kind."""
    return [one for one in records if one.kind == kind]


def _row(name: str, records: Sequence[Record], twins: bool = False) -> str:
    """Returns a row of a table."""
    own = summary(records)
    right = own["impossible"] if twins else own["solved"]
    cells = [own["tasks"], right, own["unknown"], own["false"]]
    times = [f"{own['median_s']:.2f}", f"{own['sum_s']:.0f}"]
    return f"| {name} | " + " | ".join([*map(str, cells), *times]) + " |"
