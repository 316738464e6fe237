"""Tasks of a board: drawn from its version and seed, and checked against its frozen list.

The list holds, for each task, the number of its draw, the goals that MuJoCo's replay has set, the
witness, and a fingerprint. A task is therefore the same bit for bit with any version of MuJoCo.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, cast

from .. import PushplanError, Task, ToolLibrary
from ..files import TaskFile, ToolFile
from . import furniture, kinds
from .construct import Made, construct, with_goals
from .draw import Draw
from .impossible import TWINS, Inequality, twin
from .judge import NEW_TOOL, judged, worlds
from .sketch import Sketch

__all__ = ["FROZEN", "KINDS", "VERSION", "BoardTask", "fingerprint", "load", "make"]

#: Version of the generator: another version has other tasks.
VERSION = 1
#: Frozen list of the tasks of version 1 with seed 1.
FROZEN = Path(__file__).with_name("frozen.jsonl")
#: Number of solvable and impossible tasks.
SOLVABLE, IMPOSSIBLE = 200, 60

#: Shipped tools that lever, which a library does not list with the tools that push.
BLADES = ("scraper", "screwdriver")

#: Kinds of solvable tasks, in turn.
KINDS: dict[str, Callable[[Draw], Sketch]] = {
    "reach": kinds.reach,
    "hook": kinds.hook,
    "sweep": kinds.sweep,
    "clear": kinds.clear,
    "several-goals": kinds.several_goals,
    "group": kinds.group,
    "door": furniture.door,
    "drawer": furniture.drawer,
    "gap": kinds.gap,
    "region": kinds.region,
    "heading": kinds.heading,
    "design": furniture.design,
    "beside": kinds.beside,
    "joined": furniture.joined,
    "lever": furniture.lever,
    "unknown": furniture.unknown,
}


@dataclass(frozen=True)
class BoardTask:
    """Task of a board."""

    kind: str
    #: Number within its kind, or of its twin.
    number: int
    #: Task with the keys of a task file.
    task: dict[str, Any]
    #: Steps of the witness with the keys of a plan file; empty for impossible tasks.
    steps: list[dict[str, Any]] = field(default_factory=list)
    #: Tools of the witness that the task does not offer.
    own_tools: list[ToolFile] = field(default_factory=list)
    #: Proof of impossibility; empty for solvable tasks.
    proof: list[Inequality] = field(default_factory=list)
    #: Key of the hidden worlds; empty if the physics is known.
    hidden: str = ""
    #: Number of tools of its own that a plan may use.
    new_tools: int = 0

    @property
    def possible(self) -> bool:
        """Whether the task has a witness."""
        return not self.proof

    @property
    def id(self) -> str:
        """Name in requests, which does not show the kind."""
        return fingerprint(self.task)[:8]

    def file(self) -> TaskFile:
        """Returns the task with the keys of a task file, under its id."""
        return cast(TaskFile, {"name": f"board-{self.id}"} | self.task)

    def request(self, budget: dict[str, float | None]) -> dict[str, Any]:
        """Returns the request that a program receives."""
        shipped = ToolLibrary.shipped()
        tools = [shipped[name].to_dict() for name in (*shipped.names, *BLADES)]
        own = {"new_tools": {"count": self.new_tools, **NEW_TOOL}} if self.new_tools else {}
        whole = {"protocol": 1, "id": self.id, "task": self.file(), "tools": tools}
        return whole | own | {"budget": budget}

    def judge(self, plan: object) -> str | None:
        """Returns the reason why a plan fails in MuJoCo, or `None` if it works.

        Raises
        ------
        PushplanError
            If MuJoCo is missing.
        """
        task = Task.from_dict(self.file())
        hidden = worlds(task, self.hidden) if self.hidden else []
        return judged(task, hidden, plan, self.new_tools)

    def witness(self) -> dict[str, Any]:
        """Returns the plan that solves the task, in the form of a submission."""
        return {"plan": {"steps": self.steps}, "tools": list(self.own_tools)}


def fingerprint(task: dict[str, Any]) -> str:
    """Returns 16 hexadecimal digits of a task's content."""
    text = json.dumps(task, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def load(path: Path = FROZEN) -> list[BoardTask]:
    """Returns the tasks of a list in the order of their ids.

    Raises
    ------
    PushplanError
        If the list has another version, or a task another fingerprint.
    """
    head, *lines = (json.loads(line) for line in path.read_text().splitlines())
    if head["board"] != VERSION:
        raise PushplanError(
            f"{path} is of version {head['board']} of the board; this package has version "
            f"{VERSION}. Install the package of that version, or `make` a list"
        )
    found: dict[tuple[str, int], BoardTask] = {}
    tasks = []
    for line in lines:
        kind, number = line["kind"], line["number"]
        if "twin" in line:
            one = _twin(head["seed"], number, found[kind, line["twin"]])
        else:
            steps = [_unpacked(step) for step in line["steps"]]
            made = Made(line["draw"], line["goals"], steps)
            one = found[kind, number] = _solvable(head["seed"], kind, number, made)
        if one is None or fingerprint(one.task) != line["sha256"]:
            raise PushplanError(
                f"{path}: {kind} {number} is not the task of this list; `make` a new list, and "
                "raise the version of the board"
            )
        tasks.append(one)
    return sorted(tasks, key=lambda one: one.id)


def make(seed: int, solvable: int = SOLVABLE, impossible: int = IMPOSSIBLE) -> Iterator[str]:
    """Constructs a board, and yields the lines of its list.

    Raises
    ------
    PushplanError
        If a task cannot be constructed, or MuJoCo is missing.
    """
    yield json.dumps({"board": VERSION, "seed": seed})
    found: dict[str, list[BoardTask]] = {}
    for index in range(solvable):
        kind = list(KINDS)[index % len(KINDS)]
        number = index // len(KINDS)
        made = construct(KINDS[kind], *_key(seed, kind, number))
        one = _solvable(seed, kind, number, made)
        found.setdefault(kind, []).append(one)
        steps = [_packed(step) for step in made.steps]
        own = {"draw": made.draw, "goals": made.goals, "steps": steps}
        yield _line(kind, number, one, own)
    yield from _twins(seed, found, impossible)


def _twins(seed: int, found: dict[str, list[BoardTask]], count: int) -> Iterator[str]:
    """Yields the lines of impossible twins."""
    spare = {kind: iter(tasks) for kind, tasks in found.items()}
    for index in range(count):
        kind = list(TWINS)[index % len(TWINS)]
        number = index // len(TWINS)
        for base in spare[kind]:
            one_twin = _twin(seed, number, base)
            if one_twin and _is_posed(one_twin) and _stops(one_twin, base):
                yield _line(kind, number, one_twin, {"twin": base.number})
                break
        else:
            raise PushplanError(f"too few tasks of kind {kind} have a twin; make more tasks")


def _key(seed: int, kind: str, number: int) -> tuple[object, ...]:
    """Returns the key of a task's draws."""
    return "board", VERSION, seed, kind, number


def _solvable(seed: int, kind: str, number: int, made: Made) -> BoardTask:
    """Returns a task from its draw and its goals."""
    key = _key(seed, kind, number)
    sketch = KINDS[kind](Draw(*key, made.draw))
    task = cast(dict[str, Any], with_goals(sketch.task, made.goals))
    hidden = " ".join(map(str, key)) if sketch.hidden else ""
    own = sketch.new_tools
    return BoardTask(kind, number, task, made.steps, own, hidden=hidden, new_tools=min(len(own), 1))


def _twin(seed: int, number: int, base: BoardTask) -> BoardTask | None:
    """Returns the impossible twin of a task."""
    draw = Draw("twin", *_key(seed, base.kind, base.number))
    found = twin(draw, base.kind, base.task)
    if found is None:
        return None
    return BoardTask(base.kind, number, found.task, proof=found.proof, new_tools=base.new_tools)


def _stops(one: BoardTask, base: BoardTask) -> bool:
    """Returns `True` if the witness of a task fails for its twin.

    The judge measures no forces, so that it cannot judge a twin with a weak robot."""
    return "max_force" in one.task["robot"] or one.judge(base.witness()) is not None


def _is_posed(one: BoardTask) -> bool:
    """Returns `True` if the task file of a twin is valid."""
    try:
        Task.from_dict(one.file())
    except PushplanError:
        return False
    return True


def _packed(step: dict[str, Any]) -> Any:
    """Returns a push as a short list, and other steps unchanged."""
    if "push" not in step:
        return step
    push = step["push"]
    return [push["tool"], push["grip_yaw"], *push["start"], push["direction"], push["length"]]


def _unpacked(step: Any) -> dict[str, Any]:
    """Returns the step of a short list."""
    if isinstance(step, dict):
        return step
    tool, grip_yaw, x, y, direction, length = step
    place = {"start": [x, y], "direction": direction, "length": length, "speed": 0.1}
    return {"push": {"tool": tool, "grip_yaw": grip_yaw, "form": "placed", "lift": 0.002, **place}}


def _line(kind: str, number: int, one: BoardTask, own: dict[str, Any]) -> str:
    """Returns a line of the list."""
    line = {"kind": kind, "number": number, **own, "sha256": fingerprint(one.task)}
    return json.dumps(line, separators=(",", ":"))
