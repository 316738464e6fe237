"""The server of the Model Context Protocol, called by the client of the SDK over stdio."""

from __future__ import annotations

import base64
import copy
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any, Optional
from xml.etree import ElementTree

import pytest

import pushplan

pytest.importorskip("mcp_types")
pytest.importorskip("yaml")

import anyio  # noqa: E402
import mcp_fuzz  # noqa: E402
from mcp import Client, MCPError, StdioServerParameters  # noqa: E402

from pushplan.mcp.edits import Edit, applied  # noqa: E402

TASK = """
scene:
  objects:
    - name: can
      shape: {cylinder: {radius: 0.05, height: 0.10}}
      mass: 0.4
      friction: 0.4
      position: [0.62, 0.10]
robot: {reach: {min: 0.1, max: 0.7}}
tools: all
goal: {object: can, position: [0.45, 0.10], tolerance: 0.02}
"""

Ask = Callable[..., Awaitable[Any]]


def served(
    work: Callable[[Client, Ask], Awaitable[None]],
    *words: str,
    cwd: Optional[Path] = None,
) -> None:
    """Runs `work` with a client of a server, and a function that returns structured answers."""

    async def run() -> None:
        args = ["-m", "pushplan", "mcp", "--threads", "1", *words]
        server = StdioServerParameters(command=sys.executable, args=args, cwd=cwd)
        async with Client(server, read_timeout_seconds=120.0) as client:

            async def ask(tool: str, **arguments: Any) -> Any:
                return (await client.call_tool(tool, arguments)).structured_content

            await work(client, ask)

    anyio.run(run)


def test_every_tool_answers_with_status_evidence_cause_and_repairs() -> None:
    async def work(client: Client, ask: Ask) -> None:
        tools = [tool.name for tool in (await client.list_tools()).tools]
        checked = await ask("check", task=TASK)
        assert checked == {
            "status": "valid", "evidence": {"faults": []}, "cause": None, "repairs": [],
        }  # fmt: skip
        solved = await ask("solve", task=TASK, effort="draft")
        assert solved["status"] == "solved" and solved["evidence"]["passed"]
        verified = await ask("verify", plan=solved["plan"])
        assert verified["status"] == "passed" and verified["evidence"]["violations"] == []
        drawn = await client.call_tool("draw", {"plan": solved["plan"], "size": 100})
        picture = ElementTree.fromstring(drawn.structured_content["svg"])
        assert any(one.get("data-push") for one in picture.iter())
        image: Any = drawn.content[1]
        assert base64.b64decode(image.data).startswith(b"\x89PNG")
        far = await ask("why", task=TASK.replace("0.45", "1.55"))
        assert far["status"] == "no_plan" and "robot.reach.max" in far["cause"]
        designed = await ask("design", task=TASK, candidates=10, effort="draft")
        assert designed["status"] == "solved" and designed["known_tools"] == "solved"
        step = await ask("run_step", task=TASK)
        assert step["status"] == "push" and step["push"]["strokes"]
        answers = [checked, solved, verified, drawn.structured_content, far, designed, step]
        assert len(answers) == len(tools)
        for answer in answers:
            assert {"status", "evidence", "cause", "repairs"} <= set(answer)

    served(work)


def test_repairs_of_faults_restore_the_task() -> None:
    broken = TASK.replace("friction", "fricton").replace("object: can", "object: cna")
    broken = broken.replace("0.62", "620").replace("tools: all", "tools: [stik, finger]")

    async def work(_: Client, ask: Ask) -> None:
        answer = await ask("check", task=broken)
        assert answer["status"] == "invalid"
        assert answer["evidence"]["faults"][0]["line"] == 7
        repair = answer["repairs"][0]
        assert repair["verified"]["faults_after"] == 0 and repair["changes"] == "text"
        edits = {(one["action"], one["path"]): one["to"] for one in repair["edits"]}
        assert edits == {
            ("rename", "scene.objects[0].fricton"): "friction",
            ("set", "goal.object"): "can",
            ("set", "tools[0]"): "stick",
            ("set", "scene.objects[0].position[0]"): 0.62,
        }
        meant = pushplan.Task.parse(TASK.replace("tools: all", "tools: [stick, finger]"))
        assert pushplan.Task.from_dict(repair["task"]) == meant

    served(work)


@pytest.mark.parametrize(
    ("old", "new", "path", "changes"),
    [
        ("max: 0.7}", "max: 0.7}, max_force: 0.3", "robot.max_force", "robot"),
        ("[0.45, 0.10]", "[1.3, 0.10]", "robot.reach.max", "robot"),
        ("tools: all", "tools: [stick]\npushes: {max_count: 1}", "tools", "plan"),
    ],
)
def test_repairs_of_causes_lead_to_a_plan(old: str, new: str, path: str, changes: str) -> None:
    async def work(_: Client, ask: Ask) -> None:
        answer = await ask("solve", task=TASK.replace(old, new), effort="draft")
        assert answer["status"] != "solved" and answer["cause"]
        repair = answer["repairs"][0]
        assert [edit["path"] for edit in repair["edits"]] == [path]
        assert repair["changes"] == changes and repair["verified"]["status"] == "solved"
        again = await ask("solve", task=repair["task"], effort="draft")
        assert again["status"] == "solved"

    served(work)


def test_the_example_of_the_book_is_the_conversation(root: Path) -> None:
    page = (root / "book/src/agents.md").read_text().split("## Example")[1]
    broken = page.split("```text\n")[1].split("```")[0]
    stated = [json.loads(block.split("```")[0]) for block in page.split("```json\n")[1:]]
    assert len(stated) == 3

    async def work(_: Client, ask: Ask) -> None:
        checked = await ask("check", task=broken)
        weak = await ask("solve", task=checked["repairs"][0]["task"])
        solved = await ask("solve", task=weak["repairs"][0]["task"])
        for answer, shown in zip([checked, weak, solved], stated):
            assert contains(answer, shown), json.dumps(answer, indent=1)

    served(work)


def contains(whole: Any, part: Any) -> bool:
    """Returns `True` if `whole` has all keys and items of `part`, with equal values."""
    if isinstance(part, dict):
        return all(key in whole and contains(whole[key], part[key]) for key in part)
    if isinstance(part, list):
        return len(whole) == len(part) and all(map(contains, whole, part))
    return bool(whole == part)


def test_edits_apply_to_the_given_task() -> None:
    task = {"a": [1, 2, 3], "b": {"c": 1}}
    before = copy.deepcopy(task)
    edits = [
        Edit("remove", "a[0]", 1, None), Edit("rename", "b.c", "c", "d"),
        Edit("set", "e.f", None, 2), Edit("remove", "a[2]", 3, None),
    ]  # fmt: skip
    assert applied(task, edits) == {"a": [2], "b": {"d": 1}, "e": {"f": 2}}
    assert task == before
    assert Edit.of_json(edits[1].to_json()) == edits[1]


def test_a_closed_loop_reaches_its_goal_step_by_step() -> None:
    task = pushplan.Task.example("pull-back")

    async def work(_: Client, ask: Ask) -> None:
        observations, answer = [task.start.tolist()], None
        for _push in range(4):
            answer = await ask("run_step", task=task.to_yaml(), observations=observations)
            if answer["status"] != "push":
                break
            seen = answer["evidence"]["predicted_poses"]
            observations.append(dict(zip(task.objects, seen)))
        assert answer and answer["status"] == "reached" and len(observations) > 1

    served(work)


def test_resources_are_schemas_tasks_tools_and_the_page_of_the_book(root: Path) -> None:
    async def work(client: Client, _: Ask) -> None:
        async def text(address: str) -> str:
            contents: Any = (await client.read_resource(address)).contents[0]
            return str(contents.text)

        found = [str(one.uri) for one in (await client.list_resources()).resources]
        assert json.loads(await text("pushplan://schema/task")) == pushplan.task_schema()
        assert await text("pushplan://book/tasks") == (root / "book/src/tasks.md").read_text()
        for name in pushplan.Task.examples():
            assert f"pushplan://tasks/{name}" in found
        hook = pushplan.Tool.from_dict(json.loads(await text("pushplan://tools/hook")))
        assert hook == pushplan.ToolLibrary.shipped()["hook"]
        with pytest.raises(MCPError, match="list the resources"):
            await client.read_resource("pushplan://tasks/../../etc/passwd")

    served(work)


def test_long_calls_report_progress_and_can_be_cancelled() -> None:
    task = pushplan.Task.example("everything-hidden").to_yaml()

    async def work(client: Client, ask: Ask) -> None:
        seen: list[tuple[float, Optional[float], Optional[str]]] = []
        with anyio.CancelScope() as scope:

            async def report(
                progress: float, total: Optional[float], message: Optional[str]
            ) -> None:
                seen.append((progress, total, message))
                if len(seen) == 2:
                    scope.cancel()

            arguments = {"task": task, "effort": "thorough"}
            await client.call_tool("solve", arguments, progress_callback=report)
        assert scope.cancelled_caught and seen[0][0] < seen[1][0] and seen[0][1] == 60.0
        # The next call does not wait for the cancelled one.
        begin = time.monotonic()
        assert (await ask("check", task=TASK))["status"] == "valid"
        assert time.monotonic() - begin < 10.0

    served(work)


def test_limits_hold() -> None:
    hidden = pushplan.Task.example("everything-hidden").to_yaml()

    async def work(_: Client, ask: Ask) -> None:
        long = await ask("check", task="x" * 20_000)
        assert long["status"] == "invalid" and "--size" in long["cause"]
        begin = time.monotonic()
        slow = await ask("solve", task=hidden, effort="thorough", time_limit=1)
        assert slow["status"] != "solved" and time.monotonic() - begin < 20.0

    served(work, "--size", "16", "--time-limit", "2")

    async def small(_: Client, ask: Ask) -> None:
        # The worker cannot even load its libraries.
        assert (await ask("check", task=TASK))["status"] == "error"

    if sys.platform == "linux":
        served(small, "--memory", "64")


def test_a_verification_that_the_time_limit_ends_is_not_solved() -> None:
    from pushplan.mcp import calls

    task = pushplan.Task.example("unknown-slide")
    context = calls.Context(60.0, 1, lambda now: None)
    statuses = set()
    for limit in (0.3, 0.6, 0.9, 1.2):
        given = {"task": task.to_dict(), "effort": "draft", "repair": False, "time_limit": limit}
        answer = calls.answer("solve", given, context)
        statuses.add(answer["status"])
        if answer["status"] == "solved":
            assert calls.answer("verify", {"plan": answer["plan"]}, context)["status"] == "passed"
        else:
            assert answer["cause"]
    assert statuses <= {"solved", "fragile", "failed_verification", "no_plan"}


def test_files_are_read_and_written_in_the_folder_only(tmp_path: Path) -> None:
    folder = mcp_fuzz.prepared(tmp_path)
    before = mcp_fuzz.state(tmp_path)

    async def work(_: Client, ask: Ask) -> None:
        assert (await ask("check", task_file="inner/task.yaml"))["status"] == "valid"
        for trick in mcp_fuzz.TRICKS:
            answer = await ask("check", task_file=trick)
            assert answer["status"] == "invalid", trick
            assert mcp_fuzz.SECRET not in json.dumps(answer), trick
        saved = await ask("draw", task=TASK, save_as="inner/can.svg")
        assert saved["saved_as"] == "inner/can.svg"
        again = await ask("draw", task=TASK, save_as="inner/can.svg")
        assert again["status"] == "invalid" and "exists" in again["cause"]
        for name in ("links/x.svg", "../x.svg", "/tmp/x.svg", "x.py", "link.yaml"):
            assert (await ask("draw", task=TASK, save_as=name))["status"] == "invalid", name
        for urdf in ("arm.urdf", "../secret.urdf", str(tmp_path / "secret.urdf")):
            text = TASK.replace("robot: {", f"robot: {{flange: f, urdf: {urdf}, ")
            hidden = text.replace("urdf:", '"\\x75rdf":')
            for given in (text, hidden):
                faults = (await ask("check", task=given))["evidence"]["faults"]
                assert faults[0]["message"] == "this server reads no files that a task names"

    served(work, "--folder", str(folder), cwd=tmp_path)
    assert mcp_fuzz.state(tmp_path) == before
    assert ElementTree.parse(folder / "inner/can.svg").getroot().tag.endswith("svg")


def test_without_a_folder_no_file_is_read_or_written(tmp_path: Path) -> None:
    (tmp_path / "task.yaml").write_text(TASK)

    async def work(_: Client, ask: Ask) -> None:
        for arguments in ({"task_file": "task.yaml"}, {"task": TASK, "save_as": "a.svg"}):
            answer = await ask("draw", **arguments)
            assert answer["status"] == "invalid" and "--folder" in answer["cause"]

    served(work, cwd=tmp_path)
    assert os.listdir(tmp_path) == ["task.yaml"]


def test_fuzzed_calls_neither_crash_nor_claim_a_plan_nor_leave_the_folder() -> None:
    counts = anyio.run(mcp_fuzz.fuzz, 50, 7, 0.4)
    assert counts.calls == 50 and counts.verified > 0
    assert not counts.crashes and not counts.false_solved and not counts.outside


def started() -> subprocess.Popen[str]:
    """Starts a server whose pipes the test reads and writes itself."""
    words = [sys.executable, "-m", "pushplan", "mcp"]
    return subprocess.Popen(words, text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE)


def test_malformed_messages_do_not_end_the_server() -> None:
    ping = '{"jsonrpc": "2.0", "id": 7, "method": "ping"}'
    long = '{"jsonrpc": "2.0", "id": 6, "method": "' + "x" * 9_000_000 + '"}'
    with started() as server:
        assert server.stdin and server.stdout
        server.stdin.write("\n".join(["{", "[]", "\x00", '{"id": 1}', long, ping]) + "\n")
        server.stdin.flush()
        answers: list[Any] = []
        while not answers or answers[-1].get("id") != 7:
            answers.append(json.loads(server.stdout.readline()))
        assert any(one.get("id") == 6 and "error" in one for one in answers)
        server.stdin.close()
        assert server.wait(timeout=10.0) == 0


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signals")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_signals_end_the_server(number: int) -> None:
    with started() as server:
        assert server.stdin and server.stdout
        server.stdin.write('{"jsonrpc": "2.0", "id": 1, "method": "ping"}\n')
        server.stdin.flush()
        assert server.stdout.readline()
        server.send_signal(number)
        assert server.wait(timeout=10.0) == 0


def test_a_missing_extra_is_an_error_with_the_remedy() -> None:
    hide = "import sys; sys.modules['mcp_types'] = None; "
    hide += "from pushplan.mcp import main; sys.exit(main([]))"
    ran = subprocess.run(
        [sys.executable, "-c", hide], text=True, capture_output=True, check=False, timeout=60
    )
    assert ran.returncode == 1 and "pip install 'pushplan[mcp]'" in ran.stderr
