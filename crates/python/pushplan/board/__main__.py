"""Command ``python -m pushplan.board``."""

from __future__ import annotations

import argparse
import json
import shlex
import sys
from pathlib import Path

from .. import PushplanError, Task
from .board import FROZEN, KINDS, BoardTask, load, make
from .player import play
from .protocol import schema
from .report import page, played, summary

EPILOG = """
Examples:
  python -m pushplan.board tasks --out tasks                 # task files, named after their ids
  python -m pushplan.board proofs                            # why the twins are impossible
  python -m pushplan.board check                             # witnesses in MuJoCo, proofs
  python -m pushplan.board run --out own --program "./planner --fast"
  python -m pushplan.board run --out ours --program "python -m pushplan.board player"

The program reads a request from each line of its standard input and writes a line with the answer;
`schema` prints their JSON schemas. Plans are judged in MuJoCo (`pip install 'pushplan[board]'`).
Exit codes: 0 done; 1 a check failed or the program made false claims; 2 wrong arguments.
"""


def parser() -> argparse.ArgumentParser:
    """Returns the parser of the command line."""
    whole = argparse.ArgumentParser(
        prog="python -m pushplan.board",
        description="Tool tasks with witnesses, impossible twins with proofs, and a judge.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    commands = whole.add_subparsers(dest="command", required=True)

    def add(name: str, text: str) -> argparse.ArgumentParser:
        own = commands.add_parser(name, help=text, description=text)
        if name in ("tasks", "proofs", "check", "run", "judge"):
            own.add_argument("--board", type=Path, default=FROZEN, help="list that `make` wrote")
            own.add_argument("--kind", action="append", choices=list(KINDS), help="only this kind")
        return own

    tasks = add("tasks", "Print the requests, or write the task files.")
    tasks.add_argument("--out", type=Path, help="folder for task files; by default requests")
    add("proofs", "Print the proofs of the impossible twins.")
    add("check", "Replay all witnesses in MuJoCo, and check all proofs.")
    run = add("run", "Run a program on the board, judge its plans, and write a page.")
    run.add_argument("--program", required=True, help="command that answers requests")
    run.add_argument("--out", type=Path, required=True, help="folder of answers and page")
    run.add_argument("--title", default="Board of tool tasks", help="title of the page")
    run.add_argument("--seconds", type=float, default=120.0, help="limit of a task; default 120")
    run.add_argument("--rollouts", type=float, help="rollouts of a task; by default no limit")
    judge = add("judge", "Judge a plan file for a task.")
    judge.add_argument("id", help="id of the task")
    judge.add_argument("plan", type=Path, help="plan file (JSON)")
    own = add("make", "Construct a board of another seed, and print its list.")
    own.add_argument("--seed", type=int, required=True, help="seed of all draws")
    add("schema", "Print the JSON schemas of requests and answers.")
    player = add("player", "Answer requests with the planner of this package, on one thread.")
    efforts = ["draft", "standard", "thorough"]
    player.add_argument("--effort", choices=efforts, default="standard", help="default standard")
    return whole


def main() -> int:
    """Runs the command line of this process and returns its exit code."""
    arguments = parser().parse_args()
    try:
        return _run(arguments)
    except PushplanError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1


def _run(arguments: argparse.Namespace) -> int:
    """Runs a command."""
    if arguments.command == "player":
        play(arguments.effort)
    elif arguments.command == "schema":
        print(json.dumps(schema(), indent=2))
    elif arguments.command == "make":
        for line in make(arguments.seed):
            print(line, flush=True)
    else:
        tasks = [
            one for one in load(arguments.board) if not arguments.kind or one.kind in arguments.kind
        ]
        return _with_tasks(arguments, tasks)
    return 0


def _with_tasks(arguments: argparse.Namespace, tasks: list[BoardTask]) -> int:
    """Runs a command that needs the tasks."""
    budget = {"seconds": 120.0, "rollouts": None}
    if arguments.command == "tasks":
        if arguments.out:
            arguments.out.mkdir(parents=True, exist_ok=True)
        for one in tasks:
            if arguments.out:
                text = Task.from_dict(one.file()).to_yaml()
                (arguments.out / f"{one.id}.yaml").write_text(text)
            else:
                print(json.dumps(one.request(budget)))
    elif arguments.command == "proofs":
        for one in tasks:
            for statement in one.proof:
                print(f"{one.id} {one.kind}: {statement}")
    elif arguments.command == "check":
        return _checked(tasks)
    elif arguments.command == "judge":
        return _judged(tasks, arguments.id, arguments.plan)
    else:
        budget = {"seconds": arguments.seconds, "rollouts": arguments.rollouts}
        command = shlex.split(arguments.program)
        records = played(tasks, command, arguments.out, budget, lambda text: print(text))
        text = page(records, arguments.title, budget)
        (arguments.out / "board.md").write_text(text)
        print(text)
        return 1 if summary(records)["false"] else 0
    return 0


def _checked(tasks: list[BoardTask]) -> int:
    """Checks witnesses and proofs, and returns the exit code."""
    wrong = 0
    for one in tasks:
        holds = all(statement.holds for statement in one.proof)
        fault = one.judge(one.witness()) if one.possible else None if holds else "false proof"
        wrong += fault is not None
        if fault is not None:
            print(f"{one.id} {one.kind}: {fault}", flush=True)
    print(f"{len(tasks) - wrong} of {len(tasks)} tasks hold")
    return 1 if wrong else 0


def _judged(tasks: list[BoardTask], id: str, path: Path) -> int:
    """Judges a plan file, and returns the exit code."""
    found = [one for one in tasks if one.id == id]
    if not found:
        raise PushplanError(f"the board has no task `{id}`; `tasks` prints all ids")
    try:
        plan = json.loads(path.read_text())
    except (OSError, ValueError) as error:
        raise PushplanError(f"{path}: {error}") from None
    fault = found[0].judge(plan)
    print("works" if fault is None else fault)
    return 0 if fault is None else 1


if __name__ == "__main__":
    sys.exit(main())
