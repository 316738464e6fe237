"""Joint trajectories of arms, checked by Pinocchio with the URDF file."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("pinocchio")
yaml = pytest.importorskip("yaml")
LAB = Path(__file__).resolve().parents[3] / "crates/lab/benches"


@pytest.mark.parametrize("arm", ["panda", "ur5", "xarm7"])
def test_pinocchio_finds_the_tool_where_the_plan_has_it(
    arm: str, tmp_path: Path, command: Any
) -> None:
    sys.path.insert(0, str(LAB))
    arms: Any = pytest.importorskip("arms")
    found = arms.robots()
    if found is None:
        pytest.skip("needs example-robot-data")
    urdf, flange = found / arms.ARMS[arm][0], arms.ARMS[arm][1]
    task = {
        "name": "push",
        "scene": {"objects": [{
            "name": "can", "shape": {"cylinder": {"radius": 0.04, "height": 0.1}},
            "mass": 0.4, "friction": 0.4, "position": [0.45, 0.1],
        }]},
        "robot": {"urdf": str(urdf), "flange": flange, "tool_mount": {"length": 0.2}},
        "tools": ["stick", "paddle"],
        "goal": {"object": "can", "position": [0.55, 0.1], "tolerance": 0.02},
    }
    path = tmp_path / "push.yaml"
    path.write_text(json.dumps(task))
    root = urdf.parents[4]
    done = command(
        "solve", path, "--out", tmp_path, "--effort", "draft", "--quiet", "--root", root
    )
    assert done.returncode == 0, done.stderr
    plan = json.loads((tmp_path / "push.plan.json").read_text())
    faults, worst = arms.Judge(urdf, flange).faults(plan, 0.2)
    assert faults == []
    # Joints follow quintics between points a centimetre apart; at the points both kinematics agree.
    assert worst < 2e-4
