"""Joints are inferred from motion, with equal results in Python and in the command."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pushplan


def recorded(task: pushplan.Task) -> dict[str, Any]:
    """Returns a recording of a push of two cans with a fixed joint.

    It states the joint because the rules of recordings otherwise find no cause for the motion of
    the second can. `infer` does not read the joint.
    """
    keys: Any = task.to_dict()
    push = pushplan.Push.before(task.goal_object, 0.0, offset=0.01)
    plan = pushplan.Plan.of(task, "finger", [push])
    seen = pushplan.predict(plan, "planar")
    tool = pushplan.ToolLibrary.shipped()["finger"].to_dict()
    degrees = np.array([1.0, 1.0, 180.0 / np.pi])
    for one in keys["scene"]["objects"]:
        del one["position"]
    return {
        "schema_version": 1,
        "kind": "recording",
        "scene": keys["scene"],
        "pusher": {"tool": tool, "lift": 0.002},
        "times": seen.times,
        "frames": [
            {"pusher": pusher, "objects": list(objects)}
            for pusher, objects in zip(
                seen.tool_poses * degrees, seen.poses * degrees
            )
        ],
    }


def test_a_joint_is_found(root: Path, command: Any, tmp_path: Path) -> None:
    task = pushplan.Task.load(root / "tasks/jointed-pair.yaml")
    recording = pushplan.Recording.from_dict(recorded(task))
    assert recording.objects == task.objects and len(recording) == len(recording.times)
    assert np.allclose(recording.poses[0], task.start)
    belief = pushplan.infer(recording)
    [pair] = belief.pairs
    [stated] = task.to_dict()["scene"]["joints"]
    assert set(pair) == set(stated["between"])
    likeliest = belief.joint_types[int(np.argmax(belief.probabilities[0]))]
    assert likeliest == stated["kind"]
    assert belief.probabilities.sum(axis=1) == pytest.approx(1.0)
    [found] = belief.scene()["joints"]
    assert found["kind"] == stated["kind"]
    # The believed scene can be used for planning.
    keys: Any = {**task.to_dict(), "scene": belief.scene()}
    assert pushplan.Task.from_dict(keys).objects == task.objects


def test_beliefs_are_those_of_the_command(root: Path, command: Any, tmp_path: Path) -> None:
    path = root / "tests/it/assets/push.recording.json"
    ran = command("infer", path, "--json", "--noise", 0.002)
    assert ran.returncode == 0, ran.stderr
    one, three = (
        pushplan.infer(pushplan.Recording.load(path), noise=0.002, threads=n) for n in (1, 3)
    )
    assert one.to_dict() == three.to_dict() == json.loads(ran.stdout)


def test_a_regulated_belief_and_masses_are_those_of_the_command(
    root: Path, command: Any, tmp_path: Path
) -> None:
    keys = recorded(pushplan.Task.load(root / "tasks/jointed-pair.yaml"))
    path = tmp_path / "pair.recording.json"
    path.write_text(json.dumps(keys, default=lambda array: array.tolist()), encoding="utf-8")
    ran = command("infer", path, "--json", "--mass-ranges", "0.2-0.5", "1-2")
    assert ran.returncode == 0, ran.stderr
    ranges = [(0.2, 0.5), (1.0, 2.0)]
    found = pushplan.infer(pushplan.Recording.load(path), mass_ranges=ranges).to_dict()
    assert found == json.loads(ran.stdout)
    assert found["masses"]["ranges"] == [[0.2, 0.5], [1.0, 2.0]]
    assert len(found["masses"]["objects"]) == len(found["objects"])
    with pytest.raises(ValueError, match="mass_ranges"):
        pushplan.infer(pushplan.Recording.load(path), mass_ranges=[(2.0, 1.0)])


def test_faults_of_recordings_name_their_keys(root: Path) -> None:
    keys = recorded(pushplan.Task.load(root / "tasks/jointed-pair.yaml"))
    keys["frames"][3]["objects"] = keys["frames"][3]["objects"][:1]
    with pytest.raises(pushplan.FileError) as raised:
        pushplan.Recording.from_dict(keys)
    assert raised.value.faults[0].key is not None
    assert raised.value.faults[0].key.startswith("frames[3].objects")
    with pytest.raises(ValueError, match="0 to 0.5"):
        recording = pushplan.Recording.load(root / "tests/it/assets/push.recording.json")
        pushplan.infer(recording, noise=-1.0)
