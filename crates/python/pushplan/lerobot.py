"""LeRobot data sets (format v3.0) from trajectories and runs.

The packages ``lerobot``, ``datasets`` and ``pyarrow`` read them.

    import pushplan
    from pushplan import lerobot

    plan = pushplan.solve(pushplan.Task.example("pull-back-behind-wall")).best
    lerobot.save("demonstrations", [(plan.task, pushplan.predict(plan, "3d"))])
    task = pushplan.Task.example("coupled-or-not")
    lerobot.save("runs", [pushplan.run(task, world) for world in range(20)])

The module needs ``pyarrow`` (``pip install 'pushplan[lerobot]'``). A frame holds

- ``observation.state``: pose of the tool frame, x and y in metres, heading in radians;
- ``observation.environment_state``: pose of every object, in the order of the task;
- ``action``: commanded pose of the tool frame at the next frame;
- ``next.done`` and ``next.success``: whether the episode ends, and whether its goal is reached.

In a run, poses of objects are observations, and poses of the tool are commands. A run is one
episode of all its pushes, without the time for lifting, moving and changing the tool between them.

There are no images. Headings are continuous, without wrapping at pi.
"""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from ._native import Plan, Run, Task, Trajectory

__all__ = ["save"]

_VERSION = "v3.0"
_DATA = "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet"
_EPISODES = "meta/episodes/chunk-000/file-000.parquet"
_AXES = ("x", "y", "heading")

_Floats = npt.NDArray[np.float64]


def save(
    folder: str | Path, episodes: Iterable[Union[tuple[Task, Trajectory], Run]], *, fps: int = 20
) -> Path:
    """Writes a data set with one episode for every trajectory or run.

    The folder appears as a whole, so that no partial data set remains after an error. Poses between
    the frames of a trajectory are interpolated linearly.

    Parameters
    ----------
    folder : str or Path
        New folder; an existing one is an error.
    episodes : iterable of (Task, Trajectory) or Run
        Episodes. All tasks must have objects of the same names, in the same order.
    fps : int, default 20
        Number of frames per second, 1 to 1000.

    Returns
    -------
    Path
        The folder.

    Raises
    ------
    FileExistsError
        If the folder exists.
    ImportError
        If ``pyarrow`` is missing.
    TypeError
        If an episode is neither a run nor a pair of a task and a trajectory.
    ValueError
        If there is no episode, the objects differ, or ``fps`` is out of range.

    Examples
    --------
    >>> lerobot.save("demonstrations", [(task, pushplan.predict(plan, "3d"))])
    """
    parquet, arrow = _pyarrow()
    folder = Path(folder)
    if folder.exists():
        raise FileExistsError(f"{folder} exists already; choose a new folder")
    if not (isinstance(fps, int) and 1 <= fps <= 1000):
        raise ValueError(f"`fps` must be a whole number from 1 to 1000, found {fps!r}")
    if isinstance(episodes, Run):
        raise TypeError("`episodes` must be a list, found one Run; pass it as [run]")
    taken = [_taken(number, one, fps) for number, one in enumerate(episodes)]
    if not taken:
        raise ValueError("`episodes` is empty; a data set needs one episode or more")
    names = taken[0].names
    for one in taken:
        if one.names != names:
            raise ValueError(
                f"all episodes must have the same objects, found {names} and {one.names}; write "
                "one data set for each"
            )
    words = list(dict.fromkeys(one.words for one in taken))
    features = _features(names)
    columns: dict[str, list[Any]] = {name: [] for name in features}
    rows: list[dict[str, Any]] = []
    first = 0
    for number, one in enumerate(taken):
        tool, length = one.tool, len(one.tool)
        done = np.arange(length) == length - 1
        episode: dict[str, npt.NDArray[Any]] = {
            "observation.state": tool.astype(np.float32),
            "observation.environment_state": one.objects.astype(np.float32),
            # At the end the tool stays in place.
            "action": np.concatenate([tool[1:], tool[-1:]]).astype(np.float32),
            "next.done": done,
            "next.success": done & one.reached,
            "timestamp": (np.arange(length) / fps).astype(np.float32),
            "frame_index": np.arange(length),
            "episode_index": np.full(length, number),
            "index": first + np.arange(length),
            "task_index": np.full(length, words.index(one.words)),
        }
        for name, values in episode.items():
            columns[name].append(values)
        row: dict[str, Any] = {
            "episode_index": number,
            "tasks": [one.words],
            "length": length,
            "data/chunk_index": 0,
            "data/file_index": 0,
            "dataset_from_index": first,
            "dataset_to_index": first + length,
            "meta/episodes/chunk_index": 0,
            "meta/episodes/file_index": 0,
        }
        for name, values in episode.items():
            row |= {f"stats/{name}/{key}": value for key, value in _stats(values).items()}
        rows.append(row)
        first += length
    whole = {name: np.concatenate(values) for name, values in columns.items()}
    folder.parent.mkdir(parents=True, exist_ok=True)
    # Written beside the target and then moved, so that an existing data set is always complete.
    made = Path(tempfile.mkdtemp(prefix=f".{folder.name}.", dir=folder.parent))
    try:
        for path in (_DATA.format(chunk_index=0, file_index=0), _EPISODES):
            (made / path).parent.mkdir(parents=True)
        table = {name: _column(arrow, values) for name, values in whole.items()}
        parquet.write_table(arrow.table(table), made / _DATA.format(chunk_index=0, file_index=0))
        parquet.write_table(arrow.Table.from_pylist(rows), made / _EPISODES)
        parquet.write_table(_tasks(arrow, words), made / "meta/tasks.parquet")
        stats = {name: _stats(values) for name, values in whole.items()}
        (made / "meta/stats.json").write_text(json.dumps(stats, indent=4))
        info = {
            "codebase_version": _VERSION,
            "robot_type": "pushplan",
            "total_episodes": len(rows),
            "total_frames": first,
            "total_tasks": len(words),
            "chunks_size": 1000,
            "data_files_size_in_mb": 100,
            "video_files_size_in_mb": 200,
            "fps": fps,
            "splits": {"train": f"0:{len(rows)}"},
            "data_path": _DATA,
            "video_path": None,
            "features": features,
        }
        (made / "meta/info.json").write_text(json.dumps(info, indent=4))
        # Permissions for other readers, because temporary files are private.
        made.chmod(0o755)
        made.rename(folder)
    except BaseException:
        shutil.rmtree(made, ignore_errors=True)
        raise
    return folder


def _pyarrow() -> tuple[Any, Any]:
    try:
        import pyarrow  # type: ignore[import-not-found,import-untyped,unused-ignore]
        import pyarrow.parquet  # type: ignore[import-not-found,import-untyped,unused-ignore]
    except ImportError as error:
        raise ImportError(
            "LeRobot data sets need the package pyarrow: pip install 'pushplan[lerobot]'"
        ) from error
    return pyarrow.parquet, pyarrow


@dataclass
class _Episode:
    """Poses of the tool, ``[frames, 3]``, and of all objects, ``[frames, objects * 3]``."""

    words: str
    names: list[str]
    tool: _Floats
    objects: _Floats
    reached: bool


def _taken(number: int, episode: Any, fps: int) -> _Episode:
    if isinstance(episode, Run):
        return _of_run(episode, fps)
    pair = episode if isinstance(episode, (tuple, list)) else ()
    if len(pair) == 2 and isinstance(pair[0], Task) and isinstance(pair[1], Trajectory):
        return _of_trajectory(pair[0], pair[1], fps)
    remedy = ""
    if isinstance(episode, Plan):
        remedy = '; use (plan.task, pushplan.predict(plan, "3d"))'
    elif isinstance(episode, Trajectory):
        remedy = "; use (task, trajectory)"
    kinds = f"({', '.join(type(part).__name__ for part in pair)})" if pair else ""
    raise TypeError(
        f"episode {number} must be a Run or a pair (Task, Trajectory), found "
        f"{kinds or type(episode).__name__}{remedy}"
    )


def _of_trajectory(task: Task, trajectory: Trajectory, fps: int) -> _Episode:
    times = trajectory.times - trajectory.times[0]
    steps = _steps(float(times[-1]), fps)
    tool = trajectory.tool_poses.copy()
    tool[:, 2] = np.unwrap(tool[:, 2])
    poses = trajectory.poses.reshape(len(times), -1)
    mapping: Any = task.to_dict()
    return _Episode(
        _words(mapping),
        trajectory.objects,
        _at(steps, times, tool),
        _at(steps, times, poses),
        trajectory.reached,
    )


def _of_run(run: Run, fps: int) -> _Episode:
    trace = run.to_dict()
    names = [thing["name"] for thing in trace["task"]["scene"]["objects"]]
    tools, objects = [], []
    seen = _seen(trace["first"]["seen"]) if trace["first"] else np.full((len(names), 3), np.nan)
    for step in trace["steps"]:
        way = step["predicted"]
        times = np.array([0.0] + [look["time"] for look in step["looks"]])
        sights = np.array([seen] + [_seen(look["seen"]) for look in step["looks"]])
        # An unobserved object keeps its last observed pose.
        for before, after in zip(sights, sights[1:]):
            np.copyto(after, before, where=np.isnan(after))
        seen = sights[-1]
        steps = _steps(max(float(times[-1]), way[-1]["time"]), fps)
        tool = np.array([_pose(frame["tool"]) for frame in way])
        tools.append(_at(steps, np.array([frame["time"] for frame in way]), tool))
        objects.append(_at(steps, times, sights.reshape(len(times), -1)))
    if not tools:
        raise ValueError(f"the run of `{trace['task']['name']}` has no pushes; leave it out")
    tool, poses = np.concatenate(tools), np.concatenate(objects).reshape(-1, len(names), 3)
    tool[:, 2], poses[:, :, 2] = np.unwrap(tool[:, 2]), np.unwrap(poses[:, :, 2], axis=0)
    return _Episode(_words(trace["task"]), names, tool, poses.reshape(len(poses), -1), run.reached)


def _pose(pose: Any) -> list[float]:
    return [*pose["position"], pose["heading"]]


def _seen(sights: Any) -> _Floats:
    """Returns the observed pose of every object, NaN for missing values."""
    rows = [
        [np.nan] * 3
        if sight is None
        else [*sight["position"], np.nan if sight["heading"] is None else sight["heading"]]
        for sight in sights
    ]
    return np.array(rows)


def _words(mapping: Any) -> str:
    """Returns the description of a task, or its name."""
    return str(mapping.get("description") or mapping["name"])


def _steps(duration: float, fps: int) -> _Floats:
    return np.arange(int(np.ceil(duration * fps - 1e-9)) + 1) / fps


def _at(steps: _Floats, times: _Floats, values: _Floats) -> _Floats:
    """Interpolates columns of numbers linearly at other times."""
    return np.stack([np.interp(steps, times, column) for column in values.T], axis=1)


def _features(names: list[str]) -> dict[str, Any]:
    def numbers(of: list[str]) -> dict[str, Any]:
        return {"dtype": "float32", "shape": [len(of)], "names": of}

    def one(dtype: str) -> dict[str, Any]:
        return {"dtype": dtype, "shape": [1], "names": None}

    tool = [f"tool.{axis}" for axis in _AXES]
    return {
        "observation.state": numbers(tool),
        "observation.environment_state": numbers(
            [f"{name}.{axis}" for name in names for axis in _AXES]
        ),
        "action": numbers(tool),
        "next.done": one("bool"),
        "next.success": one("bool"),
        "timestamp": one("float32"),
        "frame_index": one("int64"),
        "episode_index": one("int64"),
        "index": one("int64"),
        "task_index": one("int64"),
    }


def _stats(values: npt.NDArray[Any]) -> dict[str, list[float]]:
    numbers = values.reshape(len(values), -1).astype(np.float64)
    quantiles = {
        f"q{share:02d}": np.quantile(numbers, share / 100, axis=0) for share in (1, 10, 50, 90, 99)
    }
    found = {
        "min": numbers.min(axis=0),
        "max": numbers.max(axis=0),
        "mean": numbers.mean(axis=0),
        "std": numbers.std(axis=0),
        **quantiles,
    }
    return {key: value.tolist() for key, value in found.items()} | {"count": [len(values)]}


def _column(arrow: Any, values: npt.NDArray[Any]) -> Any:
    if values.ndim == 1:
        return arrow.array(values)
    flat = arrow.array(values.reshape(-1))
    return arrow.FixedSizeListArray.from_arrays(flat, values.shape[1])


def _tasks(arrow: Any, words: list[str]) -> Any:
    """Returns the table of tasks, with their descriptions as the index for pandas."""

    def column(name: str, kind: str, numpy: str) -> dict[str, Any]:
        return {
            "name": name,
            "field_name": name,
            "pandas_type": kind,
            "numpy_type": numpy,
            "metadata": None,
        }

    index = {
        "index_columns": ["task"],
        "column_indexes": [],
        "columns": [column("task_index", "int64", "int64"), column("task", "unicode", "object")],
        "creator": {"library": "pyarrow", "version": arrow.__version__},
        "pandas_version": "2.0.0",
    }
    table = arrow.table({"task_index": list(range(len(words))), "task": words})
    return table.replace_schema_metadata({"pandas": json.dumps(index)})
