"""The board of tool tasks: its frozen list, proofs, judge and protocol."""

from __future__ import annotations

import copy
import json
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

import pushplan
from pushplan.board import board, impossible
from pushplan.board.__main__ import main
from pushplan.board.board import FROZEN, KINDS, BoardTask, load
from pushplan.board.construct import construct
from pushplan.board.draw import Draw
from pushplan.board.judge import broken_rule, plan_of, worlds
from pushplan.board.protocol import Program, schema
from pushplan.board.report import page, played, summary

BUDGET: dict[str, float | None] = {"seconds": 20.0, "rollouts": None}
TASKS = load()
SOLVABLE = [one for one in TASKS if one.possible]
TWINS = [one for one in TASKS if not one.possible]


def first(kind: str, possible: bool = True) -> BoardTask:
    return next(one for one in TASKS if one.kind == kind and one.possible == possible)


def test_the_board_has_200_tasks_of_16_kinds_and_60_twins() -> None:
    assert (len(SOLVABLE), len(TWINS)) == (200, 60)
    assert set(Counter(one.kind for one in SOLVABLE)) == set(KINDS)
    assert min(Counter(one.kind for one in SOLVABLE).values()) >= 12
    assert set(Counter(one.kind for one in TWINS).values()) == {5}
    assert len({one.id for one in TASKS}) == 260


def test_a_changed_task_or_version_is_refused(tmp_path: Path) -> None:
    lines = FROZEN.read_text().splitlines()
    changed = json.loads(lines[1])
    changed["goals"][0]["position"][0] += 0.001
    other = tmp_path / "list.jsonl"
    other.write_text("\n".join([lines[0], json.dumps(changed), *lines[2:]]))
    with pytest.raises(pushplan.PushplanError, match="raise the version"):
        load(other)
    head = json.loads(lines[0]) | {"board": board.VERSION + 1}
    other.write_text("\n".join([json.dumps(head), *lines[1:]]))
    with pytest.raises(pushplan.PushplanError, match=f"version {board.VERSION + 1}"):
        load(other)


@pytest.mark.parametrize("kind", KINDS)
def test_witnesses_keep_the_rules(kind: str) -> None:
    for one in SOLVABLE:
        if one.kind == kind:
            task = pushplan.Task.from_dict(one.file())
            assert broken_rule(plan_of(task, one.steps, one.own_tools)) is None
            # No task is solved at the start.
            assert not one.steps or not all(task.reached(task.start)) or kind == "lever"


def test_all_proofs_hold_and_false_ones_do_not() -> None:
    for one in TWINS:
        pushplan.Task.from_dict(one.file())
        assert one.proof and all(statement.holds for statement in one.proof)
    assert not impossible.Inequality(0.05, 0.05, "equal").holds
    # With a heavy robot arm's force the proof of a heavy object fails.
    twin = first("sweep", possible=False)
    assert twin.task["robot"]["max_force"] < twin.proof[0].right


def test_twins_of_tasks_without_room_for_the_proof_are_discarded() -> None:
    task = copy.deepcopy(first("several-goals").task)
    for goal in task["goal"]:
        goal["tolerance"] = 0.2
    assert impossible.twin(Draw("any"), "several-goals", task) is None


def test_requests_hide_the_kind_and_hold_all_that_a_program_needs() -> None:
    for one in (first("gap"), first("gap", possible=False)):
        request = one.request(BUDGET)
        assert set(request) == {"protocol", "id", "task", "tools", "budget"}
        assert "gap" not in request["id"] + request["task"]["name"]
        assert set(request) <= set(schema()["request"]["properties"])
    assert first("design").request(BUDGET)["new_tools"]["count"] == 1


def test_hidden_worlds_differ_and_repeat() -> None:
    one = first("unknown")
    task = pushplan.Task.from_dict(one.file())
    found = [world.to_dict()["scene"]["objects"][0]["mass"] for world in worlds(task, one.hidden)]
    again = [world.to_dict()["scene"]["objects"][0]["mass"] for world in worlds(task, one.hidden)]
    assert len(set(found)) == len(found) == 5
    assert found == again


@pytest.mark.parametrize("kind", ["hook", "several-goals", "design", "lever", "unknown"])
def test_witnesses_work_in_mujoco(kind: str) -> None:
    pytest.importorskip("mujoco")
    assert first(kind).judge(first(kind).witness()) is None


def test_construction_repeats_the_draw_and_its_goals() -> None:
    pytest.importorskip("mujoco")
    one = next(o for o in SOLVABLE if o.kind == "door" and o.number == 0)
    made = construct(KINDS["door"], "board", board.VERSION, 1, "door", 0)
    assert made.goals == [one.task["goal"]]
    assert [list(step) for step in made.steps] == [list(step) for step in one.steps]


def judged_without_replay(one: BoardTask, plan: object) -> str:
    fault = one.judge(plan)
    assert fault is not None
    return fault


def test_the_judge_rejects_wrong_plans() -> None:
    one = first("reach")
    assert "no plan" in judged_without_replay(one, None)
    assert "invalid plan" in judged_without_replay(one, {"plan": {}})
    unknown = copy.deepcopy(one.witness())
    unknown["plan"]["steps"][0]["push"]["tool"] = "crane"
    assert "`crane`" in judged_without_replay(one, unknown)
    far = copy.deepcopy(one.witness())
    far["plan"]["steps"][0]["push"]["start"] = [3.0, 0.0]
    assert "reach" in judged_without_replay(one, far)


def test_new_tools_are_limited() -> None:
    own = first("design").witness()
    stranger = copy.deepcopy(first("reach").witness())
    stranger["tools"] = own["tools"]
    assert "0 allowed" in judged_without_replay(first("reach"), stranger)
    long = copy.deepcopy(own)
    long["tools"][0]["parts"][0]["size"][0] = 0.8
    assert "at most 0.5 m" in judged_without_replay(first("design"), long)


def test_the_judge_ignores_the_task_of_a_plan_file_and_replays_the_push() -> None:
    pytest.importorskip("mujoco")
    one = first("reach")
    short = copy.deepcopy(one.witness())
    short["plan"]["steps"][0]["push"]["length"] *= 0.3
    easy = one.file()
    short["task"] = {**easy, "goal": {"object": "object", "off_table": "any"}}
    assert one.judge(short) == "misses the goal"


#: Program that submits a given plan for one task, and calls all others impossible.
CHEAT = """
import json, sys
known = json.loads(sys.argv[1])
for line in sys.stdin:
    request = json.loads(line)
    own = known.get(request["id"])
    answer = {"id": request["id"], "status": "solved" if own else "impossible", "plan": own}
    print(json.dumps(answer | {"cost": {"tries": 2}}), flush=True)
"""


def test_false_claims_are_counted_and_a_run_resumes(tmp_path: Path) -> None:
    pytest.importorskip("mujoco")
    good, other, twin = first("drawer"), first("door"), first("gap", possible=False)
    wrong = first("gap")
    known = {good.id: good.witness(), wrong.id: {"plan": {"steps": []}}, twin.id: {"plan": {}}}
    command = [sys.executable, "-c", CHEAT, json.dumps(known)]
    asked: list[str] = []
    tasks = [good, other, twin, wrong]
    records = played(tasks, command, tmp_path, BUDGET, asked.append)
    found = summary(records)
    assert (found["solved"], found["false"], found["cost"]) == (1, 3, {"tries": 8})
    text = page(records, "Cheat", BUDGET)
    assert "| all with a witness | 3 | 1 | 0 | 2 |" in text
    assert "the task has a witness" in text
    assert "the task is impossible" in text
    assert played(tasks, ["/no/such/program"], tmp_path, BUDGET, asked.append) == records
    assert len(asked) == 4


@pytest.mark.parametrize(
    ("code", "note"),
    [
        ("print('hello', flush=True); import time; time.sleep(9)", "no line of JSON"),
        ('print(\'{"id": "other"}\', flush=True); input()', "has not the `id`"),
        ("import time; time.sleep(9)", "no answer within"),
        ("pass", "the program ended"),
    ],
)
def test_faulty_programs_answer_unknown(code: str, note: str) -> None:
    program = Program([sys.executable, "-c", code])
    answer = program.ask({"id": "one"}, 2.0)
    assert answer.status == "unknown"
    assert note in answer.note
    program.close()


def test_programs_that_do_not_exist_are_errors() -> None:
    with pytest.raises(pushplan.PushplanError, match="/no/such/program"):
        Program(["/no/such/program"]).ask({"id": "one"}, 1.0)


def test_our_planner_plays(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    pytest.importorskip("mujoco")
    program = f"{sys.executable} -m pushplan.board player --effort draft"
    words = ["board", "run", "--kind", "lever", "--out", str(tmp_path), "--program", program]
    monkeypatch.setattr(sys, "argv", words)
    assert main() == 0
    answers = [json.loads(line) for line in (tmp_path / "answers.jsonl").read_text().splitlines()]
    assert len(answers) == 12
    assert sum(one["status"] == "solved" for one in answers) >= 10
    assert "| lever | 12 |" in (tmp_path / "board.md").read_text()


def test_the_command_prints_proofs_and_schemas(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    def run(*words: str) -> tuple[int, str]:
        monkeypatch.setattr(sys, "argv", ["board", *words])
        code = main()
        read = capsys.readouterr()
        return code, read.out + read.err

    code, text = run("proofs", "--kind", "gap")
    assert code == 0
    assert text.count("diameter of the can") == 5
    code, text = run("schema")
    whole: dict[str, Any] = json.loads(text)
    assert whole["answer"]["properties"]["status"]["enum"] == ["solved", "impossible", "unknown"]
    code, text = run("tasks", "--kind", "door", "--out", str(tmp_path))
    assert code == 0
    assert len(list(tmp_path.glob("*.yaml"))) == 18
    code, text = run("judge", "nothing", "plan.json")
    assert code == 1
    assert "no task `nothing`" in text
