"""Seeded fuzz of the server: malformed, huge and mutated calls, and tricks with paths.

    python crates/python/tests/mcp_fuzz.py --count 1000 --seed 1

Counts crashes, wrong answers `solved` (each is verified again, and its plan must be for the given
task), and files outside the folder of the server that were read or written.
"""

from __future__ import annotations

import argparse
import copy
import json
import random
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Callable

import anyio
from mcp import Client, MCPError, StdioServerParameters

import pushplan

#: Text of the files that no answer may contain.
SECRET = "keep-this-secret-7f3a"
#: Time limit of a fuzzed call, seconds.
SHORT = 1.0
#: Time limit of the second verification, seconds.
LONG = 30.0
JUNK: list[Any] = [
    None, True, False, 0, -1, 1e300, -1e300, 10**30, 0.1, "", "x", "\x00", "../x", [], {}, [[]],
    {"": 0}, "\ud7ff\u202e", [None] * 3, {"urdf": "/etc/passwd"}, "none", "all", 2**63,
]  # fmt: skip
TRICKS = [
    "../secret.yaml", "/etc/passwd", "link.yaml", "inner/../../secret.yaml", "links/secret.yaml",
    "..\\secret.yaml", "C:\\secret.yaml", "inner/./task.yaml", "./task.yaml", "inner//task.yaml",
    "\x00task.yaml", "pipe", "inner", "", " ", "task.yaml ", "/proc/self/environ", "~/.profile",
    "file:///etc/passwd", "a" * 300, "loop/loop/task.yaml", "hard/../link.yaml", ".", "..", "nul:",
]  # fmt: skip
TOOLS = ["check", "why", "solve", "verify", "design", "draw", "run_step"]

Call = tuple[str, dict[str, Any]]


@dataclass
class Counts:
    """Results of a fuzz."""

    calls: int = 0
    crashes: list[str] = field(default_factory=list)
    false_solved: list[str] = field(default_factory=list)
    outside: list[str] = field(default_factory=list)
    verified: int = 0

    def __str__(self) -> str:
        found = [
            self.calls, len(self.crashes), len(self.outside), self.verified, len(self.false_solved)
        ]
        return (
            "|calls|crashes|files outside|plans verified again|called solved in error|\n"
            f"|--:|--:|--:|--:|--:|\n|{'|'.join(map(str, found))}|"
        )


class Fuzz:
    """Generator of calls."""

    def __init__(self, seed: int, limit: float) -> None:
        self.rng = random.Random(seed)
        #: Time limit of a call, seconds.
        self.limit = limit
        names = [name for name in pushplan.Task.examples() if name != "everything-hidden"]
        self.tasks = [pushplan.Task.example(name).to_dict() for name in names]
        task = pushplan.Task.example("pull-back")
        best = pushplan.solve(task, effort="draft", threads=1).best
        assert best is not None
        self.plan: Any = {**best.to_dict(), "verdict": None}

    def call(self) -> Call:
        kinds: list[Callable[[], Call]] = [
            self.malformed, self.huge, self.junk, self.mutated, self.mutated, self.mutated,
            self.misspelt, self.paths, self.observed, self.planned,
        ]  # fmt: skip
        return self.rng.choice(kinds)()

    def task(self) -> Any:
        return copy.deepcopy(self.rng.choice(self.tasks))

    def limited(self, tool: str, **arguments: Any) -> Call:
        more: dict[str, Any] = {"time_limit": self.limit}
        if tool in ("solve", "design"):
            more["effort"] = "draft"
        if tool == "design":
            more["candidates"] = 5
        return tool, {**more, **arguments}

    def malformed(self) -> Call:
        keys = ["task", "plan", "tool", "tools", "effort", "seed", "time_limit", "size", "repair"]
        keys += ["observations", "replays", "kind", "parts", "candidates", "max_pushes", "x"]
        tool = self.rng.choice(TOOLS)
        given = {key: self.rng.choice(JUNK) for key in self.rng.sample(keys, 3)}
        return tool, {"time_limit": self.limit, **given}

    def huge(self) -> Call:
        tool = self.rng.choice(["check", "solve", "draw"])
        kind = self.rng.randrange(6)
        if kind == 0:
            return self.limited(tool, task="x" * self.rng.choice([10**5, 10**6]))
        if kind == 1:
            return self.limited(tool, task="[" * 10**5)
        if kind == 2:
            deep: Any = []
            for _ in range(self.rng.choice([30, 60, 150])):
                deep = [deep]
            return self.limited(tool, task={"scene": deep})
        if kind == 3:
            bomb = "a: &a [x,x,x,x,x,x,x,x,x]\n"
            for k in range(1, 12):
                name, inner = "a" * (k + 1), ",".join([f"*{'a' * k}"] * 9)
                bomb += f"{name}: &{name} [{inner}]\n"
            return self.limited(tool, task=bomb)
        task = self.task()
        objects = task["scene"]["objects"]
        count = self.rng.choice([20, 300])
        for k in range(count):
            objects.append({**objects[0], "name": f"more-{k}", "position": [0.1 * k, 2.0]})
        return self.limited(tool, task=task)

    def leaf(self, task: Any) -> tuple[Any, Any]:
        """Returns a container in a task and one of its keys."""
        inner: Any = task
        while True:
            key = self.rng.choice(list(inner) if isinstance(inner, dict) else range(len(inner)))
            below = inner[key]
            if not isinstance(below, (dict, list)) or not below or self.rng.random() < 0.1:
                return inner, key
            inner = below

    def junk(self) -> Call:
        task = self.task()
        inner, key = self.leaf(task)
        inner[key] = self.rng.choice(JUNK)
        tool = self.rng.choice(["check", "solve", "why", "draw", "run_step"])
        return self.limited(tool, task=task)

    def mutated(self) -> Call:
        task = self.task()
        for _ in range(self.rng.randint(1, 3)):
            inner, key = self.leaf(task)
            if isinstance(inner[key], (int, float)) and not isinstance(inner[key], bool):
                wild = [-1, 0.001, 0.01, 0.5, 2, 10, 100, 1000]
                gentle = self.rng.random() < 0.7
                factor = self.rng.uniform(0.8, 1.25) if gentle else self.rng.choice(wild)
                whole = isinstance(inner[key], int)
                inner[key] = round(inner[key] * factor) if whole else inner[key] * factor
            elif isinstance(inner, dict) and self.rng.random() < 0.3:
                del inner[key]
        tool = self.rng.choice(["solve", "solve", "solve", "why", "design", "draw", "run_step"])
        return self.limited(tool, task=task)

    def misspelt(self) -> Call:
        text = pushplan.Task.from_dict(self.task()).to_yaml()
        for _ in range(self.rng.randint(1, 4)):
            at = self.rng.randrange(len(text))
            letter = self.rng.choice("abexyz019.:-[]{}#&*!|>'\"%@` \n\t\\")
            text = text[:at] + self.rng.choice(["", letter, letter + text[at]]) + text[at + 1 :]
        return self.limited(self.rng.choice(["check", "solve"]), task=text)

    def paths(self) -> Call:
        trick = self.rng.choice(TRICKS)
        kind = self.rng.randrange(6)
        if kind == 0:
            tool = self.rng.choice(["check", "solve", "draw", "why", "run_step", "design"])
            return self.limited(tool, task_file=trick)
        if kind == 1:
            return "verify", {"plan_file": trick}
        if kind == 2:
            return self.limited("solve", task=self.tasks[0], save_as=trick + ".json")
        if kind == 3:
            return "draw", {"task": self.tasks[0], "save_as": trick}
        task = self.task()
        task["robot"] = {"urdf": self.rng.choice([trick, "secret.urdf", "arm.urdf"]), "flange": "f"}
        if kind == 4:
            return self.limited("check", task=task)
        text = json.dumps(task)
        keys = ['"\\u0075rdf"', '"urdf"', "? urdf\n", "!!str urdf", '"ur\\\n  df"']
        hidden = self.rng.choice(keys)
        return self.limited("check", task=text.replace('"urdf"', hidden))

    def observed(self) -> Call:
        example = pushplan.Task.example(self.rng.choice(["coupled-or-not", "pull-back"]))
        start = example.start.tolist()
        observations: list[Any] = []
        for _ in range(self.rng.randint(0, 3)):
            seen = [[value + self.rng.uniform(-0.05, 0.05) for value in row] for row in start]
            named = dict(zip(example.objects, seen))
            observations.append(named if self.rng.random() < 0.3 else seen)
        if observations and self.rng.random() < 0.5:
            observations[-1] = self.rng.choice([*JUNK, [[None] * 3], [[1e9, 0, 0]], [["x", 0, 0]]])
        return self.limited("run_step", task=example.to_dict(), observations=observations)

    def planned(self) -> Call:
        plan = copy.deepcopy(self.plan)
        inner, key = self.leaf(plan)
        inner[key] = self.rng.choice([*JUNK, inner[key]])
        given = json.dumps(plan) if self.rng.random() < 0.3 else plan
        if self.rng.random() < 0.2:
            return "draw", {"plan": given}
        return "verify", {"plan": given, "time_limit": 5.0, "replays": 2}


def prepared(above: Path) -> Path:
    """Creates a folder for the server with links and files that lead out of it."""
    folder = above / "folder"
    (folder / "inner").mkdir(parents=True)
    (above / "elsewhere").mkdir()
    task = pushplan.Task.example("pull-back").to_yaml()
    for path in (folder / "task.yaml", folder / "inner/task.yaml"):
        path.write_text(task)
    secret = task.replace("description: ", f"description: {SECRET} ")
    for path in (above / "secret.yaml", above / "elsewhere/secret.yaml"):
        path.write_text(secret)
    (above / "secret.urdf").write_text(f"<robot name='{SECRET}'/>")
    (folder / "arm.urdf").write_text(f"<robot name='{SECRET}'/>")
    (folder / "link.yaml").symlink_to(above / "secret.yaml")
    (folder / "links").symlink_to(above / "elsewhere")
    (folder / "loop").symlink_to(folder)
    return folder


def state(above: Path) -> dict[str, str]:
    """Returns all files outside the folder with their content."""
    folder = above / "folder"
    return {
        str(path): path.read_text() if path.is_file() else "folder"
        for path in sorted(above.rglob("*"))
        if folder not in path.parents
    }


async def fuzz(count: int, seed: int, limit: float = SHORT, verbose: bool = False) -> Counts:
    """Calls the server `count` times and returns the results."""
    counts, made = Counts(), Fuzz(seed, limit)
    with tempfile.TemporaryDirectory() as name:
        above = Path(name).resolve()
        folder = prepared(above)
        before = state(above)
        words = ["-m", "pushplan", "mcp", "--threads", "1", "--folder", str(folder)]
        server = StdioServerParameters(command=sys.executable, args=words, cwd=above)
        async with Client(server, read_timeout_seconds=120.0) as client:
            for k in range(count):
                # The first call has a plan, so that at least one answer is verified again.
                first: Call = ("solve", {"task": made.plan["task"], "effort": "draft"})
                tool, arguments = made.call() if k else first
                if verbose:
                    print(k, tool, json.dumps(arguments)[:150], file=sys.stderr)
                await _call(client, tool, arguments, counts)
        after = state(above)
        changed = [path for path in {*before, *after} if before.get(path) != after.get(path)]
        counts.outside += [f"changed: {path}" for path in changed]
    return counts


async def _call(client: Client, tool: str, arguments: dict[str, Any], counts: Counts) -> None:
    counts.calls += 1
    shown = f"{tool} {json.dumps(arguments)[:400]}"
    try:
        found = await client.call_tool(tool, arguments)
    except MCPError as error:
        # The SDK refuses a call that is no valid message.
        if "internal" in str(error).lower() or "closed" in str(error).lower():
            counts.crashes.append(f"{shown}: {error}")
        return
    answer = found.structured_content
    if answer["status"] in ("error", "memory"):
        counts.crashes.append(f"{shown}: {answer['cause']}")
    if SECRET in json.dumps(answer):
        counts.outside.append(f"{shown}: read")
    if answer["status"] == "solved" and tool in ("solve", "design"):
        await _verify(client, arguments, answer, shown, counts)
    for repair in answer["repairs"]:
        if repair["verified"]["status"] == "solved":
            again = {"task": repair["task"], "effort": "draft", "repair": False}
            solved = (await client.call_tool("solve", again)).structured_content
            if solved["status"] == "solved":
                await _verify(client, again, solved, shown, counts)


async def _verify(
    client: Client, arguments: dict[str, Any], answer: Any, shown: str, counts: Counts
) -> None:
    counts.verified += 1
    again = {"plan": answer["plan"], "time_limit": LONG}
    verdict = (await client.call_tool("verify", again)).structured_content
    if verdict["status"] != "passed":
        counts.false_solved.append(f"{shown}: {verdict['cause']}")
    task = arguments.get("task")
    if isinstance(task, dict) and "known_tools" not in answer:
        planned = pushplan.Plan.parse(json.dumps(answer["plan"])).task
        if planned != pushplan.Task.from_dict(task):  # type: ignore[arg-type]
            counts.false_solved.append(f"{shown}: the plan is for another task")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    counts = anyio.run(fuzz, options.count, options.seed, SHORT, options.verbose)
    print(counts)
    for line in [*counts.crashes, *counts.false_solved, *counts.outside]:
        print(line)
    return int(bool(counts.crashes or counts.false_solved or counts.outside))


if __name__ == "__main__":
    sys.exit(main())
