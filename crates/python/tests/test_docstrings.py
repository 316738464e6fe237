"""Docstrings state parameters, results and errors, and their examples run."""

from __future__ import annotations

import doctest
import inspect
import json
import math
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from stub_docs import STUBS, documented

import pushplan
import pushplan.env
from pushplan import lerobot, logs

POSES = pytest.importorskip("pushplan.poses")
MODULES = [pushplan, pushplan.env, lerobot, logs, POSES]


def described() -> Iterator[tuple[str, Any]]:
    """Yields the functions, classes with parameters, and methods that users call."""
    for module in MODULES:
        for name in module.__all__:
            found = getattr(module, name)
            if inspect.isroutine(found):
                yield f"{module.__name__}.{name}", found
            if not isinstance(found, type) or issubclass(found, Exception):
                continue
            yield f"{module.__name__}.{name}", found
            for key in vars(found):
                own = inspect.getattr_static(found, key)
                routine = inspect.isroutine(own) or isinstance(own, staticmethod)
                if routine and not key.startswith("_"):
                    yield f"{module.__name__}.{name}.{key}", getattr(found, key)


CALLED = dict(described())
EXAMPLES = [name for name, found in CALLED.items() if ">>>" in (found.__doc__ or "")]


def test_stubs_have_the_docstrings_of_the_module() -> None:
    text = STUBS.read_text()
    assert documented(text) == text, "run `python crates/python/tests/stub_docs.py`"
    assert "(function) -> method" not in text, "the docstring of a type"


@pytest.mark.parametrize("name", CALLED)
def test_calls_are_described(name: str) -> None:
    found = CALLED[name]
    doc = inspect.cleandoc(found.__doc__)
    if isinstance(found, type) or doc.startswith("Restores"):
        return
    try:
        parameters = [one for one in inspect.signature(found).parameters if one != "self"]
    except ValueError:
        parameters = []
    assert not parameters or "Parameters\n----------" in doc
    # A first line can state the result.
    results = "Returns\n-------" in doc or doc.startswith("Returns ")
    writes = doc.startswith(("Writes", "Allows", "Raises"))
    assert results or writes, doc
    # Methods are part of the example of their class or of the function that returns it.
    assert ">>>" in doc or "." in found.__qualname__


@pytest.fixture(scope="module")
def known() -> dict[str, Any]:
    """Returns the names that the examples use."""
    task = pushplan.Task.example("pull-back-behind-wall")
    solution = pushplan.solve(task, effort="draft")
    best = solution.best
    assert best is not None
    box = {"name": "box", "shape": {"cuboid": {"size": [0.1, 0.1, 0.05]}}, "mass": 0.5}
    box |= {"friction": 0.4, "position": [0.5, 0.0]}
    env = pushplan.env.PushEnv(task)
    env.reset(seed=0)
    table = {0: (0.2, -0.3), 1: (0.8, -0.3), 2: (0.5, 0.3)}
    camera = POSES.Camera(np.array([[600.0, 0.0, 320.0], [0.0, 600.0, 240.0], [0.0, 0.0, 1.0]]))
    above = camera.at([0.5, 0.0, 1.0], [[0, -1, 0], [-1, 0, 0], [0, 0, -1]])
    return {
        "np": np, "math": math, "pushplan": pushplan, "task": task, "solution": solution,
        "plan": best, "tool": best.tool, "lerobot": lerobot, "logs": logs, "box": box,
        "tip": {"cylinder": {"radius": 0.005, "height": 0.05}}, "env": env, "camera": above,
        "image": drawn(above, table), **{name: getattr(POSES, name) for name in POSES.__all__},
    }  # fmt: skip


def drawn(camera: Any, table: dict[int, tuple[float, float]]) -> Any:
    """Draws an image of tags on the table."""
    cv2 = pytest.importorskip("cv2")
    image = np.full((480, 640), 255, np.uint8)
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    for tag, (x, y) in table.items():
        side = cv2.aruco.generateImageMarker(dictionary, tag, 120)
        half = 0.03
        corners = np.array([[-half, half], [half, half], [half, -half], [-half, -half]])
        points = np.column_stack([corners + [x, y], np.zeros(4)])
        seen = camera.project(points).astype(np.float32)
        source = np.array([[0, 0], [120, 0], [120, 120], [0, 120]], np.float32)
        warp = cv2.getPerspectiveTransform(source, seen)
        cv2.warpPerspective(side, warp, (640, 480), image, borderMode=cv2.BORDER_TRANSPARENT)
    return image


@pytest.fixture
def folder(tmp_path: Path, root: Path, known: dict[str, Any], monkeypatch: Any) -> Path:
    """Folder with the files that the examples name."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "my-task.yaml").write_text(known["task"].to_yaml())
    hook = root / "tools/l-hook.yaml"
    (tmp_path / "my-tools").mkdir()
    (tmp_path / "ros/share").mkdir(parents=True)
    for path in ("my-hook.yaml", "my-tools/hook.yaml"):
        shutil.copy(hook, path)
    (tmp_path / "scene.xml").write_text(
        '<mujoco><worldbody><body name="can" pos="0.5 0 0.05"><freejoint/><geom type="cylinder" '
        'size="0.04 0.05" mass="0.3"/></body><body name="box" pos="0.5 0.3 0.05"><geom type="box" '
        'size="0.05 0.05 0.05" mass="0.3"/></body></worldbody></mujoco>'
    )
    (tmp_path / "hook.xml").write_text(
        '<mujoco><worldbody><body name="bar"><freejoint/><geom type="box" size="0.1 0.02 0.03" '
        'pos="0 0 0.03" mass="0.2"/></body></worldbody></mujoco>'
    )
    times = np.arange(41) / 20.0
    tip = 0.4 + 0.05 * times
    shift = np.maximum(tip + 0.055 - 0.5, 0.0)
    rows = [
        f"{t},{1e3 * a},0,{1e3 * (0.5 + b)},0,0" for t, a, b in zip(times, tip, shift, strict=True)
    ]
    (tmp_path / "vicon.csv").write_text("\n".join(["t,tip_x,tip_y,x,y,yaw", *rows]))
    poses = {"pusher": ("tip_x", "tip_y"), "box": ("x", "y", "yaw")}
    scene: Any = {"objects": [known["box"]]}
    logs.write_json(
        "pushes.json", "vicon.csv", scene=scene, pusher=known["tip"], time="t", poses=poses,
        length="mm",
    )  # fmt: skip
    assert json.loads((tmp_path / "pushes.json").read_text())["kind"] == "recording"
    pushplan.export_mcap(known["plan"], "best.mcap")
    return tmp_path


@pytest.mark.filterwarnings("ignore:.*:UserWarning")
@pytest.mark.parametrize("name", EXAMPLES)
def test_examples_run(name: str, folder: Path, known: dict[str, Any]) -> None:
    if name.startswith("pushplan.scene_from"):
        mujoco = pytest.importorskip("mujoco")
        known = {**known, "mujoco": mujoco}
    names = dict(known)
    for example in doctest.DocTestParser().get_examples(CALLED[name].__doc__):
        exec(compile(example.source, name, "exec"), names)
