"""Puzzles of PushWorld become tasks, cell by cell."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

import pytest

PUZZLE = """
 .  AW M1 M1 G0
 A  .  .  M1 W
 M0 .  .  .  W+G1
 .  .  .  .  G1
"""


@pytest.fixture
def pushworld(root: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location("pushworld", root / "examples/pushworld.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_cells_become_metres(pushworld: ModuleType) -> None:
    # A goal of one object alone, so that the other shape need not fit anywhere.
    task = pushworld.task_of(PUZZLE.replace("W+G1", "W").replace("G1", "."), "puzzle").to_dict()
    m0, m1 = task["scene"]["objects"]
    assert m0["position"] == pytest.approx([0.36 + 2.5 * 0.08, 0.16])
    assert m0["shape"]["cuboid"]["size"] == pytest.approx([0.064, 0.064, 0.05])
    # An L of three cells: two along the row, and two along the column that share one cell with them.
    assert m1["shape"]["cuboid"]["size"] == pytest.approx([0.064, 0.144, 0.05])
    assert m1["mass"] == pytest.approx(0.3)
    [part] = m1["parts"]
    assert part["shape"]["cuboid"]["size"] == pytest.approx([0.144, 0.064, 0.05])
    assert part["position"] == pytest.approx([0.04, -0.04])
    assert task["goal"]["object"] == "m0"
    assert task["goal"]["position"] == pytest.approx([0.40, -0.16])
    [closed] = task["keep_out"]
    assert closed["for"] == ["tool"] and closed["position"] == pytest.approx([0.40, 0.08])
    # Two wall cells are merged, and four walls surround the table.
    walls = task["scene"]["obstacles"]
    assert len(walls) == 5
    assert walls[0]["size"] == pytest.approx([0.16, 0.08, 0.10])


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        (" . .\n .", "of one length"),
        (" . X\n . .", "row 1, column 2: `X` is no cell"),
        (" . G0\n . .", "`G0` is the goal of no movable"),
        ("", "of one length"),
    ],
)
def test_what_is_no_puzzle_is_refused(pushworld: ModuleType, text: str, fault: str) -> None:
    with pytest.raises(ValueError, match=fault):
        pushworld.read(text)
