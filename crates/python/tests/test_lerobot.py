"""LeRobot data sets are readable with pyarrow."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pushplan
from pushplan import lerobot

pyarrow: Any = pytest.importorskip("pyarrow")
parquet: Any = pytest.importorskip("pyarrow.parquet")


def episode(task: pushplan.Task, length: float) -> tuple[pushplan.Task, pushplan.Trajectory]:
    push = pushplan.Push((0.3, 0.1), 0.0, length, 0.1)
    plan = pushplan.Plan.of(task, "stick", [push])
    return task, pushplan.predict(plan, model="planar")


def test_pyarrow_reads_what_was_predicted(task: pushplan.Task, tmp_path: Path) -> None:
    episodes = [episode(task, 0.1), episode(task, 0.2)]
    folder = lerobot.save(tmp_path / "set", episodes, fps=20)
    info = json.loads((folder / "meta/info.json").read_text())
    data = parquet.read_table(folder / info["data_path"].format(chunk_index=0, file_index=0))
    rows = parquet.read_table(folder / "meta/episodes").to_pylist()
    assert info["codebase_version"] == "v3.0" and info["fps"] == 20
    assert set(data.column_names) == set(info["features"])
    assert data.num_rows == info["total_frames"] == rows[-1]["dataset_to_index"]
    assert len(rows) == info["total_episodes"] == 2
    objects = np.array(data["observation.environment_state"].to_pylist())
    tool = np.array(data["observation.state"].to_pylist())
    action = np.array(data["action"].to_pylist())
    for (_, trajectory), row in zip(episodes, rows):
        frames = slice(row["dataset_from_index"], row["dataset_to_index"])
        assert row["length"] == len(objects[frames])
        # Every frame matches the trajectory at its time; the last is its end.
        times = np.arange(row["length"]) / 20
        for column in range(objects.shape[1]):
            poses = trajectory.poses.reshape(len(trajectory), -1)[:, column]
            expected = np.interp(times, trajectory.times - trajectory.times[0], poses)
            assert objects[frames, column] == pytest.approx(expected, abs=1e-6)
        assert objects[frames][-1] == pytest.approx(trajectory.poses[-1].reshape(-1), abs=1e-6)
        assert action[frames][:-1] == pytest.approx(tool[frames][1:])
        done = data["next.done"].to_pylist()[frames]
        assert done.index(True) == row["length"] - 1
    assert data["index"].to_pylist() == list(range(data.num_rows))
    stats = json.loads((folder / "meta/stats.json").read_text())
    assert stats["action"]["min"] == pytest.approx(action.min(axis=0))
    assert stats["observation.state"]["count"] == [data.num_rows]
    tasks = parquet.read_table(folder / "meta/tasks.parquet")
    assert json.loads(tasks.schema.metadata[b"pandas"])["index_columns"] == ["task"]
    assert tasks.to_pylist() == [{"task_index": 0, "task": rows[0]["tasks"][0]}]
    assert [path.name for path in tmp_path.iterdir()] == ["set"]


def test_pyarrow_reads_what_runs_saw_and_did(tmp_path: Path) -> None:
    task = pushplan.Task.example("coupled-or-not")
    runs = [pushplan.run(task, world) for world in (2, 3)]
    folder = lerobot.save(tmp_path / "runs", runs, fps=20)
    data = parquet.read_table(folder / "data/chunk-000/file-000.parquet")
    rows = parquet.read_table(folder / "meta/episodes").to_pylist()
    objects = np.array(data["observation.environment_state"].to_pylist()).reshape(
        data.num_rows, -1, 3
    )
    tool = np.array(data["observation.state"].to_pylist())
    assert np.isfinite(objects).all() and len(rows) == 2
    for run, row in zip(runs, rows):
        frames = slice(row["dataset_from_index"], row["dataset_to_index"])
        assert row["tasks"] == [task.description]
        assert data["next.success"].to_pylist()[frames][-1] == run.reached
        trace = run.to_dict()
        last = trace["steps"][-1]["looks"][-1]["seen"]
        assert objects[frames][-1, :, :2] == pytest.approx(
            np.array([sight["position"] for sight in last]), abs=1e-6
        )
        first = trace["first"]["seen"]
        assert objects[frames][0, :, :2] == pytest.approx(
            np.array([sight["position"] for sight in first]), abs=1e-6
        )
        # The tool follows all its paths at their speed, and is lifted between them.
        ways = np.linalg.norm(np.diff(tool[frames][:, :2], axis=0), axis=1)
        lifted = ways > task.push_speed * 1.5 / 20
        assert ways[~lifted].sum() == pytest.approx(
            sum(push.length or 0.0 for push in run.pushes), rel=0.05
        )
        assert np.count_nonzero(lifted) <= len(trace["steps"]) - 1
    # Runs and trajectories of the same objects can be combined.
    push = pushplan.Push((0.3, 0.1), 0.0, 0.1, 0.1)
    predicted = pushplan.predict(pushplan.Plan.of(task, "finger", [push]), "planar")
    lerobot.save(tmp_path / "both", [(task, predicted), runs[0]])


def test_what_is_no_data_set_is_refused(task: pushplan.Task, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="one episode or more"):
        lerobot.save(tmp_path / "set", [])
    with pytest.raises(ValueError, match="whole number"):
        lerobot.save(tmp_path / "set", [episode(task, 0.1)], fps=0)
    with pytest.raises(FileExistsError):
        lerobot.save(tmp_path, [episode(task, 0.1)])
    pair = [episode(task, 0.1), episode(pushplan.Task.example("jointed-pair"), 0.1)]
    with pytest.raises(ValueError, match="the same objects"):
        lerobot.save(tmp_path / "set", pair)
    assert list(tmp_path.iterdir()) == []
