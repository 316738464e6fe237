"""Wrong arguments give errors that state the remedy."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pushplan
import pushplan.env
import pushplan.logs
from pushplan import lerobot

# Arguments are wrong on purpose, so that types are not checked.
pp: Any = pushplan
env: Any = pushplan.env
saved: Any = lerobot.save
logs: Any = pushplan.logs
BOX = {"name": "box", "shape": {"cuboid": {"size": [0.1, 0.1, 0.05]}}, "mass": 0.5}

#: Name, call with a task, and a text of the message that states what to do instead.
CALLS: dict[str, tuple[Callable[[Any], Any], type[Exception], str]] = {
    "no constructor of tasks": (lambda t: pp.Task(), TypeError, "Task.load(path)"),
    "task from a name": (lambda t: pp.Task("t.yaml"), TypeError, "Task.from_dict"),
    "no constructor of tools": (lambda t: pp.Tool(), TypeError, "Tool.load(path)"),
    "no constructor of plans": (lambda t: pp.Plan(t), TypeError, "Plan.of(task, tool"),
    "no constructor of libraries": (lambda t: pp.ToolLibrary([]), TypeError, "ToolLibrary.of("),
    "no constructor of recordings": (lambda t: pp.Recording(), TypeError, "Recording.load("),
    "solve a file": (lambda t: pp.solve("task.yaml"), TypeError, "Task.load(path)"),
    "solve a path": (lambda t: pp.solve(Path("task.yaml")), TypeError, "Task.load(path)"),
    "solve a mapping": (lambda t: pp.solve(t.to_dict()), TypeError, "Task.from_dict"),
    "solve a plan": (lambda t: pp.solve(plan(t)), TypeError, "attribute `task`"),
    "solve nothing": (lambda t: pp.solve(None), TypeError, "Task.example(name)"),
    "tools from a folder": (lambda t: pp.solve(t, "tools"), TypeError, "ToolLibrary.load(folder)"),
    "tools in a list": (lambda t: pp.solve(t, [hook()]), TypeError, "ToolLibrary.of(tools)"),
    "unknown effort": (lambda t: pp.solve(t, effort="hard"), ValueError, 'use "draft"'),
    "unknown model": (lambda t: pp.solve(t, model="mujoco"), ValueError, "use network, prior"),
    "fewer threads than one": (lambda t: pp.solve(t, threads=-1), ValueError, "0 to 1024"),
    "half a thread": (lambda t: pp.solve(t, threads=0.5), TypeError, "whole number"),
    "too many threads": (lambda t: pp.solve(t, threads=10**30), ValueError, "0 to 1024"),
    "negative seed": (lambda t: pp.solve(t, seed=-1), ValueError, "from 0 to"),
    "negative replays": (lambda t: pp.solve(t, replays=-1), ValueError, "0 to 100000"),
    "replays of a verdict": (lambda t: pp.verify(plan(t), replays=-1), ValueError, "0 to 100000"),
    "robustness in percent": (lambda t: pp.solve(t, robustness=75), ValueError, "75 % is 0.75"),
    "robustness as a text": (lambda t: pp.solve(t, robustness="high"), TypeError, "be a number"),
    "no time": (lambda t: pp.solve(t, time_limit=0), ValueError, "above 0 seconds"),
    "fit from a file": (lambda t: pp.solve(t, fit="fit.json"), TypeError, "TableFit.load(path)"),
    "progress to a file": (lambda t: pp.solve(t, progress="log"), TypeError, "True or a function"),
    "one task for many": (lambda t: pp.solve_all(t), TypeError, "a list of `pushplan.Task`"),
    "names of tasks": (lambda t: pp.solve_all(["a.yaml"]), TypeError, "Task.load(path)"),
    "verify a solution": (
        lambda t: pp.verify(pp.solve(t, effort="draft", time_limit=0.05)),
        TypeError,
        "solution.best",
    ),
    "verify nothing": (lambda t: pp.verify(None), TypeError, "solution.cause"),
    "verify a file": (lambda t: pp.verify("a.plan.json"), TypeError, "Plan.load(path)"),
    "predict a push": (lambda t: pp.predict(pp.Push([0, 0], 0)), TypeError, "pushplan.Plan.of"),
    "direction in degrees": (lambda t: pp.Push([0.4, 0], 180), ValueError, "math.radians"),
    "degrees before an object": (lambda t: pp.Push.before("can", 90), ValueError, "math.radians"),
    "start in space": (lambda t: pp.Push([0.4, 0, 0], 0), ValueError, "two finite numbers"),
    "length in millimetres": (lambda t: pp.Push([0.4, 0], 0, 150), ValueError, "give m"),
    "offset in millimetres": (lambda t: pp.Push.before("can", 0, 20), ValueError, "give metres"),
    "one push for many": (
        lambda t: pp.Plan.of(t, "stick", pp.Push([0.4, 0], 0)),
        TypeError,
        "pass one push as `[push]`",
    ),
    "numbers for a push": (
        lambda t: pp.Plan.of(t, "stick", [(0.4, 0, 0)]),
        TypeError,
        "pushplan.Push([x, y], direction",
    ),
    "grip yaw in degrees": (
        lambda t: pp.Plan.of(t, "stick", [], grip_yaw=90),
        ValueError,
        "math.radians",
    ),
    "unknown object of a push": (
        lambda t: pp.Plan.of(t, "stick", [pp.Push.before("cup", 0.0)]),
        pushplan.ActionError,
        "use one of can",
    ),
    "tool from a mapping": (
        lambda t: pp.Plan.of(t, hook().to_dict(), []),
        TypeError,
        "Tool.from_dict",
    ),
    "unknown tool of a plan": (
        lambda t: pp.Plan.of(t, "spoon", []),
        pushplan.UnknownToolError,
        "use one of",
    ),
    "unknown tool of a library": (
        lambda t: pp.ToolLibrary.shipped()["spoon"],
        pushplan.UnknownToolError,
        "use one of",
    ),
    "name of a tool to add": (
        lambda t: pp.ToolLibrary.shipped().with_tool("hook"),
        TypeError,
        "library[name]",
    ),
    "poses far away": (lambda t: t.at([[5.0, 0, 0]]), ValueError, "x and y in metres"),
    "poses in millimetres": (lambda t: t.at([[520, 20, 0]]), ValueError, "x and y in metres"),
    "headings in degrees": (lambda t: t.at([[0.5, 0.0, 90]]), ValueError, "np.radians"),
    "a pose without a row": (lambda t: t.at([0.5, 0.0, 0.1]), ValueError, "one row of x, y"),
    "poses as a text": (lambda t: t.at("start"), TypeError, "array of numbers of the shape"),
    "poses that are missing": (lambda t: t.at([[math.nan, 0, 0]]), ValueError, "replace them"),
    "pushes without speed": (
        lambda t: pp.rollout(t, "stick", [[0.4, 0, 0, 0.1]]),
        ValueError,
        "(x, y, direction, length, speed)",
    ),
    "pushes in degrees": (
        lambda t: pp.rollout(t, "stick", [[0.4, 0, 180, 0.1, 0.1]]),
        ValueError,
        "math.radians",
    ),
    "no world": (lambda t: pp.run(t, object()), TypeError, "`look` and `act`"),
    "negative world": (lambda t: pp.run(t, -1), TypeError, "a whole number from 0"),
    "negative pushes": (lambda t: pp.run(t, 1, max_pushes=-1), ValueError, "0 to 1000"),
    "no samples": (lambda t: pp.run(t, 1, samples=0), ValueError, "1 to 1000"),
    "noise of zero": (lambda t: pp.run(t, 1, noise=(0.0, 0.1)), ValueError, "metres and radians"),
    "no candidates": (lambda t: pp.design(t, candidates=0), ValueError, "1 to 1000000"),
    "one recording for many": (lambda t: pp.fit("a.json"), TypeError, "Recording.load(path)"),
    "infer a file": (lambda t: pp.infer("a.json"), TypeError, "Recording.load(path)"),
    "export to a missing folder": (
        lambda t: pp.export_mjcf(plan(t), "missing/a.xml"),
        pushplan.FileError,
        "create the folder",
    ),
    "save to a missing folder": (
        lambda t: plan(t).save("missing/a.plan.json"),
        pushplan.FileError,
        "create the folder",
    ),
    "export a task": (lambda t: pp.export_mjcf(t, "a.xml"), TypeError, "pushplan.Plan.of"),
    "data set of plans": (
        lambda t: saved("set", [plan(t)]),
        TypeError,
        "use (plan.task, pushplan.predict",
    ),
    "data set of a trajectory": (
        lambda t: saved("set", [pp.predict(plan(t), "planar")]),
        TypeError,
        "use (task, trajectory)",
    ),
    "unknown tool of an action": (
        lambda t: env.PushEnv(t).action("spoon", 0.0),
        pushplan.UnknownToolError,
        "use one of",
    ),
    "unknown unit of a log": (
        lambda t: logs.read_csv(
            "a.csv", scene={"objects": [BOX]}, pusher={}, time="t", poses={}, length="km"
        ),
        ValueError,
        "must be m/cm/mm/in",
    ),
}


def hook() -> pushplan.Tool:
    return pushplan.ToolLibrary.shipped()["l-hook"]


def plan(task: pushplan.Task) -> pushplan.Plan:
    return pushplan.Plan.of(task, "l-hook", [pushplan.Push([0.47, 0.02], math.pi, 0.1)])


@pytest.mark.parametrize("name", CALLS)
def test_a_wrong_call_states_the_remedy(
    name: str, task: pushplan.Task, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    call, kind, remedy = CALLS[name]
    with pytest.raises(kind) as raised:
        call(task)
    assert remedy in str(raised.value)
    # Neither names of temporary files nor conversions of PyO3.
    assert ".pushplan-" not in str(raised.value) and "cannot be cast" not in str(raised.value)
    assert list(tmp_path.iterdir()) == []


def test_unknown_tools_raise_one_error_everywhere(task: pushplan.Task) -> None:
    for call in (lambda: hooks()["spoon"], lambda: pushplan.Plan.of(task, "spoon", [])):
        with pytest.raises(pushplan.UnknownToolError) as raised:
            call()
        assert isinstance(raised.value, (KeyError, pushplan.ActionError, ValueError))
        # Without the quotes of a KeyError.
        assert str(raised.value).startswith("no tool is called `spoon`")


def hooks() -> Any:
    return pushplan.ToolLibrary.shipped()


# Calls of `pushplan.poses`, which needs OpenCV.
BLANK = np.full((480, 640), 255, np.uint8)
CAMERA = np.array([[600.0, 0.0, 320.0], [0.0, 600.0, 240.0], [0.0, 0.0, 1.0]])
DOWN = np.array([[0, -1, 0], [-1, 0, 0], [0, 0, -1]])
LOOKS: dict[str, tuple[Callable[[Any, Any], Any], str]] = {
    "camera without a pose": (
        lambda t, p: p.look(t, {7: np.zeros((4, 2))}, p.Camera(CAMERA), [p.Tag(7, "can", 0.04)]),
        "camera.placed(image",
    ),
    "tag in millimetres": (lambda t, p: p.Tag(7, "can", 40), "convert millimetres"),
    "tag in degrees": (lambda t, p: p.Tag(7, "can", 0.04, yaw=90), "math.radians"),
    "camera in millimetres": (lambda t, p: p.Camera(CAMERA).at([500, 0, 900], DOWN), "millimetres"),
    "table in millimetres": (
        lambda t, p: p.Camera(CAMERA).placed(BLANK, {0: (200, -300)}, 0.06),
        "convert millimetres",
    ),
    "edge in millimetres": (
        lambda t, p: p.Camera(CAMERA).placed(BLANK, {0: (0.2, -0.3)}, 60),
        "convert millimetres",
    ),
    "no tag in the image": (
        lambda t, p: p.Camera(CAMERA).placed(BLANK, {k: (0.1 * k, 0.0) for k in range(3)}, 0.06),
        "shows no tag of the family `apriltag_36h11`, but a tag of 0, 1, 2 is needed; check",
    ),
    "unknown family": (lambda t, p: p.detect(BLANK, "tag36"), "use one of"),
    "tag on nothing": (
        lambda t, p: p.look(
            t, {}, p.Camera(CAMERA).at([0.5, 0, 1], DOWN), [p.Tag(7, "cup", 0.04)]
        ),
        "it has can",
    ),
}


@pytest.mark.parametrize("name", LOOKS)
def test_a_wrong_look_states_the_remedy(name: str, task: pushplan.Task) -> None:
    pytest.importorskip("cv2")
    poses = pytest.importorskip("pushplan.poses")
    call, remedy = LOOKS[name]
    with pytest.raises(ValueError) as raised:
        call(task, poses)
    assert remedy in str(raised.value)
