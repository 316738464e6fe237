"""Python and the command find bit-identical plans, for any number of threads."""

from __future__ import annotations

import copy
import json
import multiprocessing
import pickle
from pathlib import Path
from typing import Any, Literal

import pytest

import pushplan

# A task with one push, a task with two pushes among obstacles, and a task without a solution.
TASKS = ["pull-back-behind-wall", "pull-back-twice", "narrow-gap"]


def without_times(report: dict[str, Any]) -> dict[str, Any]:
    report["statistics"].pop("timing")
    return report


@pytest.mark.parametrize("name", TASKS)
def test_plans_are_those_of_the_command_to_the_bit(
    name: str, root: Path, command: Any, tmp_path: Path
) -> None:
    ran = command("solve", f"tasks/{name}.yaml", "--json", "--seed", 3, "--out", tmp_path)
    expected = without_times(json.loads(ran.stdout))
    # The list of written files exists only in the command's output.
    expected.pop("files", None)
    solution = pushplan.solve(pushplan.Task.load(root / f"tasks/{name}.yaml"), seed=3)
    assert without_times(solution.to_dict()) == expected
    assert solution.status == expected["status"]
    written = next(tmp_path.glob("*.plan.json"))
    assert solution.best is not None
    assert solution.best.to_dict() == json.loads(written.read_text())


def test_threads_seeds_and_company_change_nothing(task: pushplan.Task, root: Path) -> None:
    other = pushplan.Task.load(root / "tasks/pull-back.yaml")
    alone = without_times(pushplan.solve(task, threads=1).to_dict())
    assert without_times(pushplan.solve(task, threads=3).to_dict()) == alone
    together = pushplan.solve_all([other, task], threads=2)
    assert without_times(together[1].to_dict()) == alone
    assert without_times(pushplan.solve(task, seed=1).to_dict()) != alone


def test_five_lines_from_a_text_to_a_plan() -> None:
    task = pushplan.Task.parse(
        """
        scene: {objects: [{name: can, shape: {cylinder: {radius: 0.05, height: 0.1}}, mass: 0.4,
                           friction: 0.4, position: [0.62, 0.1]}]}
        robot: {reach: {min: 0.1, max: 0.7}}
        tools: all
        goal: {object: can, position: [0.45, 0.1], tolerance: 0.02}
        """
    )
    best = pushplan.solve(task).best
    assert best is not None and best.verdict is not None and best.verdict.passed
    [push] = best.pushes
    assert push.start is not None and push.length is not None
    # The push is directed towards the robot.
    assert abs(abs(push.direction) - 3.14159) < 0.2
    trajectory = best.trajectory
    assert trajectory is not None
    assert trajectory.error == best.error and trajectory.reached


def test_efforts_differ_and_unknown_words_are_refused(task: pushplan.Task) -> None:
    def replays(effort: Literal["standard", "thorough"]) -> int:
        plan = pushplan.solve(task, effort=effort).to_dict()["plans"][0]
        return len(plan["verdict"]["evidence"])

    assert replays("standard") < replays("thorough")
    with pytest.raises(ValueError, match='effort: unknown value "hard"; use "draft"'):
        pushplan.solve(task, effort="hard")  # type: ignore[arg-type]
    with pytest.raises(pushplan.ModelError, match="use network, prior, planar"):
        pushplan.solve(task, model="quasi-static")
    with pytest.raises(ValueError, match="share from 0 to 1"):
        pushplan.solve(task, robustness=2.0)


def test_a_time_limit_returns_the_best_so_far(root: Path) -> None:
    task = pushplan.Task.load(root / "tasks/narrow-gap.yaml")
    solution = pushplan.solve(task, effort="thorough", time_limit=0.05)
    assert solution.timed_out and not solution.solved


def test_a_model_can_refuse_on_request(task: pushplan.Task) -> None:
    keys = task.to_dict()
    # Far faster than any push on which the model was measured.
    fast = pushplan.Task.from_dict({**keys, "pushes": {"speed": 1.0}})
    assert pushplan.solve(fast, model="network", effort="draft").warnings
    with pytest.raises(pushplan.RefusedError) as refused:
        pushplan.solve(fast, model="network", out_of_range="refuse")
    assert any("speed" in warning for warning in refused.value.warnings)


def test_verdicts_are_those_of_the_command(
    task: pushplan.Task, command: Any, tmp_path: Path
) -> None:
    best = pushplan.solve(task).best
    assert best is not None
    path = tmp_path / "best.plan.json"
    best.save(path)
    ran = command("verify", path, "--replays", 5, "--seed", 2, "--json")
    verdict = pushplan.verify(pushplan.Plan.load(path), replays=5, seed=2)
    assert verdict.to_dict() == json.loads(ran.stdout)
    # At least five perturbed replays in each engine, and more until the verdict is clear.
    assert len(verdict.replays) >= 12 and verdict.passed and verdict.robustness == 1.0
    as_written = [replay for replay in verdict.replays if replay.draw is None]
    assert [replay.engine for replay in as_written] == ["planar", "3d"]
    for replay in as_written:
        assert replay.trajectory is not None
        assert (replay.trajectory.poses[-1] == replay.poses).all()


def test_plans_tasks_and_tools_can_be_pickled(task: pushplan.Task) -> None:
    best = pushplan.solve(task, effort="draft").best
    assert best is not None
    again = pickle.loads(pickle.dumps(best))
    assert again.to_dict() == best.to_dict()
    push = pushplan.Push((0.3, 0.0), 0.1, 0.1, 0.1)
    assert again == best != pushplan.Plan.of(task, "stick", [push])
    assert pickle.loads(pickle.dumps(task)) == task != pushplan.Task.example("pull-back")
    assert pickle.loads(pickle.dumps(best.tool)) == best.tool


def test_what_solving_gives_can_be_pickled(task: pushplan.Task) -> None:
    def again(value: Any) -> Any:
        return pickle.loads(pickle.dumps(value))

    solution = pushplan.solve(task, effort="draft")
    assert again(solution).to_dict() == solution.to_dict()
    assert solution.best is not None
    verdict = pushplan.verify(solution.best, replays=1)
    assert (again(verdict).passed, again(verdict).reason) == (verdict.passed, verdict.reason)
    trajectory = pushplan.predict(solution.best)
    assert (again(trajectory).poses == trajectory.poses).all()
    pushes = [pushplan.Push((0.1, 0.2), 1.0, 0.3), pushplan.Push.before("can", 0.5, speed=0.1)]
    assert [again(push) for push in pushes] == pushes
    library = pushplan.ToolLibrary.shipped()
    assert again(library).names == library.names


def test_what_is_the_same_compares_equal_and_what_is_not_does_not(task: pushplan.Task) -> None:
    solution, other = (pushplan.solve(task, effort="draft", seed=seed) for seed in (0, 1))
    best = solution.best
    assert best is not None
    push, shorter = (pushplan.Push((0.3, 0.0), 0.1, length, 0.1) for length in (0.2, 0.1))
    missed = pushplan.Plan.of(task, "stick", [push])
    library = pushplan.ToolLibrary.shipped()
    for value, another in [
        (task, pushplan.Task.example("pull-back")),
        (best, missed),
        (solution, other),
        (pushplan.verify(best, replays=1), pushplan.verify(missed, replays=0)),
        (push, shorter),
        (pushplan.predict(best), pushplan.predict(best, "planar")),
        (best.tool, missed.tool),
        (library, pushplan.ToolLibrary.of([best.tool])),
        (pushplan.run(task, 1, max_pushes=1), pushplan.run(task, 2, max_pushes=1)),
    ]:
        for same in (pickle.loads(pickle.dumps(value)), copy.copy(value), copy.deepcopy(value)):
            assert value == same and not value != same
        assert value != another and not value == another and value != "something else"
    # Apart from times, solving again gives identical results.
    assert pushplan.solve(task, effort="draft") == solution


def solved_draft(task: pushplan.Task) -> str:
    return pushplan.solve(task, effort="draft", threads=2).status


def test_a_forked_process_has_threads_of_its_own(task: pushplan.Task) -> None:
    # The parent's threads are running by now; the child has none of them.
    assert solved_draft(task) == "solved"
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map_async(solved_draft, [task] * 4).get(timeout=120) == ["solved"] * 4


def test_a_lever_up_is_solved_verified_and_written_like_a_push(tmp_path: Path) -> None:
    task = pushplan.Task.from_dict(
        {
            "name": "turn",
            "scene": {
                "objects": [
                    {
                        "name": "plate",
                        "shape": {"cuboid": {"size": [0.12, 0.08, 0.008]}},
                        "mass": 0.1,
                        "friction": 0.4,
                        "clearance": 0.006,
                        "position": [0.5, 0],
                    }
                ]
            },
            "robot": {"reach": {"min": 0.1, "max": 0.9}},
            "tools": ["screwdriver"],
            "levers": {"pivot": "auto"},
            "goal": {"object": "plate", "flipped": True},
        }
    )
    solution = pushplan.solve(task, effort="draft")
    assert solution.solved
    best = solution.best
    assert best is not None and best.levers
    assert [list(step) for step in best.steps] == [["lever_up"]]
    verdict = pushplan.verify(best, replays=2)
    assert verdict.passed
    [replay, *_] = verdict.replays
    trajectory = replay.trajectory
    assert trajectory is not None and trajectory.space is not None
    assert trajectory.space.shape[1:] == (1, 7)
    assert trajectory.raised[0] > 0.02
    predicted = pushplan.predict(best, "prior")
    assert predicted.reached and predicted.model == "prior"
    path = tmp_path / "turn.plan.json"
    best.save(path)
    assert pushplan.Plan.load(path).to_dict() == best.to_dict()
    assert "lever 0" in best.to_mjcf()
    assert "Edge raised" in solution.page()
