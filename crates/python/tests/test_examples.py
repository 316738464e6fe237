"""The examples and the Python blocks of the README run unchanged."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

os.environ.setdefault("MUJOCO_GL", "egl")
ROOT = Path(__file__).resolve().parents[3]
# Scripts; modules that they share begin with an underscore.
EXAMPLES = sorted(ROOT.glob("examples/[!_]*.py"))
NEEDS = {"push_t": "gym_pusht", "kinder_2d": "kinder"}


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_run(path: Path, tmp_path: Path) -> None:
    if path.stem in NEEDS:
        pytest.importorskip(NEEDS[path.stem])
    ran = subprocess.run(
        [sys.executable, path], cwd=tmp_path, text=True, capture_output=True, check=False
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert ran.stdout


def test_the_readme_runs(root: Path) -> None:
    blocks = (root / "README.md").read_text().split("```python\n")[1:]
    assert blocks
    for block in blocks:
        code = block.split("```")[0]
        ran = subprocess.run(
            [sys.executable, "-c", code], cwd=root, text=True, capture_output=True, check=False
        )
        assert ran.returncode == 0, ran.stderr


def test_the_notebook_runs_and_shows_pages(root: Path) -> None:
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    notebook = nbformat.read(root / "examples/can_behind_wall.ipynb", as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells), "kept without its outputs"
    nbclient.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": root}}).execute()
    shown = [
        output["data"]["text/html"]
        for cell in notebook.cells
        for output in cell.get("outputs", [])
        if "text/html" in output.get("data", {})
    ]
    assert len(shown) == 2 and all(page.startswith("<iframe srcdoc=") for page in shown)


def test_a_robot_pushes_what_it_sees(root: Path, tmp_path: Path) -> None:
    pytest.importorskip("cv2")
    mujoco = pytest.importorskip("mujoco")
    try:
        mujoco.Renderer(mujoco.MjModel.from_xml_string("<mujoco/>"), 8, 8).close()
    except Exception as error:  # noqa: BLE001 - whatever a machine without graphics raises
        pytest.skip(f"MuJoCo cannot render here: {error}")
    ran = subprocess.run(
        [sys.executable, root / "examples/robot/run.py", "--scenes", "2", "--seed", "3"],
        cwd=tmp_path, text=True, capture_output=True, check=False,
    )
    assert ran.returncode == 0, ran.stderr
    *scenes, all_of_them = map(json.loads, ran.stdout.splitlines())
    assert all_of_them == {"scenes": 2, "reached": 2, "falsely_reached": 0}, scenes
    # The camera locates the goods to within 2 mm.
    assert all(abs(scene["seen_mm"] - scene["truly_mm"]) < 2.0 for scene in scenes), scenes
