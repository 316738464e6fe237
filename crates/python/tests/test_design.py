"""Python and the command propose the same tools."""

from __future__ import annotations

import json
from typing import Any

import pytest

import pushplan

# The narrowest shipped handle needs a slot of 4 cm.
SLOT = """
scene:
  objects:
    - {name: can, shape: {cylinder: {radius: 0.04, height: 0.1}}, mass: 0.3, friction: 0.4, position: [0.9, 0]}
  obstacles:
    - {name: left, size: [0.03, 1.0, 0.15], position: [0.76, 0.515]}
    - {name: right, size: [0.03, 1.0, 0.15], position: [0.76, -0.515]}
robot: {reach: {min: 0.25, max: 0.6}}
tools: all
pushes: {max_count: 1}
goal: {object: can, position: [1.0, 0.0], tolerance: 0.02}
"""


def test_the_tool_is_that_of_the_command(command: Any, tmp_path: Any) -> None:
    path = tmp_path / "slot.yaml"
    path.write_text(SLOT)
    options = ["--candidates", 40, "--effort", "draft", "--out", tmp_path]
    ran = command("design", path, "--json", *options)
    expected = json.loads(ran.stdout)
    task = pushplan.Task.load(path)
    design = pushplan.design(task, candidates=40, effort="draft", threads=1)
    assert design.status == expected["status"] == "solved"
    assert design.known.status == expected["known"]["status"] == "no_plan"
    assert design.tool is not None and design.tool.to_dict() == expected["tool"]
    assert design.to_dict()["spent"] == expected["spent"]
    assert design.solution is not None and design.solution.solved
    # The tool can be used like any other.
    tools = pushplan.ToolLibrary.shipped().with_tool(design.tool)
    best = pushplan.solve(task, tools).best
    assert best is not None and best.tool == design.tool
    assert design.tool.name in str(design) and design.tool.name in repr(design)


def test_a_time_limit_returns_the_best_so_far(tmp_path: Any) -> None:
    path = tmp_path / "slot.yaml"
    path.write_text(SLOT)
    design = pushplan.design(pushplan.Task.load(path), candidates=1000000, time_limit=1.0)
    assert design.to_dict()["stopped"]
    with pytest.raises(ValueError, match="time_limit"):
        pushplan.design(pushplan.Task.load(path), time_limit=0.0)


def test_numbers_out_of_range_are_reported(task: pushplan.Task) -> None:
    for parts, candidates, name in [(0, 1000, "parts"), (99, 1000, "parts"), (3, 0, "candidates")]:
        with pytest.raises(ValueError, match=f"`{name}` must be a whole number from 1"):
            pushplan.design(task, parts=parts, candidates=candidates)
