"""Recordings from logs of trackers: CSV with stated columns and units, and MCAP.

    from pushplan import logs

    box = {"name": "box", "shape": {"cuboid": {"size": [0.09, 0.09, 0.02]}}, "mass": 0.8}
    recording = logs.read_csv(
        "vicon.csv",
        scene={"objects": [box]},
        pusher={"cylinder": {"radius": 0.005, "height": 0.05}},
        time="t", poses={"pusher": ("tip_x", "tip_y"), "box": ("x", "y", "yaw")},
        length="mm", angle="rad",
    )
    print(pushplan.infer(recording), pushplan.fit([recording]))

    recording = logs.read_mcap(
        "bag_0.mcap",
        scene={"objects": [box]},
        pusher={"cylinder": {"radius": 0.005, "height": 0.05}},
        topics={"pusher": "/tip/pose", "box": "/tf#box"},
    )

Invalid logs give an error with the line: wrong units, decreasing times, gaps, and poses that are
constant while others move.
"""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from . import _bags
from ._log_checks import PUSHER, STILL, check_gaps, check_length, check_stale, check_times, degrees
from ._native import Recording

__all__ = ["read_csv", "read_mcap", "write_json"]

_LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "in": 0.0254}
_TIMES = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
#: Half width of the interval for fitting velocities at the cut of a log, seconds.
_NEAR = 0.05

_Floats = npt.NDArray[np.float64]


def read_csv(
    path: str | Path,
    *,
    scene: Mapping[str, Any],
    pusher: Mapping[str, Any],
    time: str,
    poses: Mapping[str, Sequence[str]],
    length: Literal["m", "cm", "mm", "in"],
    angle: Literal["deg", "rad"] = "deg",
    clock: Literal["s", "ms", "us", "ns"] = "s",
    start: float | None = None,
    end: float | None = None,
) -> Recording:
    """Reads a recording from a CSV file with a header of column names.

    Parameters
    ----------
    path : str or Path
        CSV file.
    scene, pusher : mapping
        Scene and pusher, with the keys of a recording file.
    time : str
        Column of the time.
    poses : mapping of str to sequence of str
        Columns of x, y and optionally heading, for ``"pusher"`` and for every object.
    length : {"m", "cm", "mm", "in"}
        Unit of positions.
    angle : {"deg", "rad"}, default "deg"
        Unit of headings.
    clock : {"s", "ms", "us", "ns"}, default "s"
        Unit of times.
    start, end : float, optional
        Limits of the used part, seconds since the first line. A body that moves by more than 2 mm
        within 50 ms of ``start`` begins with its velocity there; other bodies begin at rest.

    Returns
    -------
    Recording
        Recording, with the file's name.

    Raises
    ------
    ValueError
        If the log is invalid; the message states file and line.
    FileError
        If the scene or the pusher is invalid.

    Examples
    --------
    >>> recording = logs.read_csv(
    ...     "vicon.csv", scene={"objects": [box]}, pusher=tip, time="t", length="mm",
    ...     poses={"pusher": ("tip_x", "tip_y"), "box": ("x", "y", "yaw")},
    ... )
    """
    return Recording.from_dict(
        _mapping(path, scene, pusher, time, poses, (length, angle, clock), (start, end))
    )


def read_mcap(
    path: str | Path,
    *,
    scene: Mapping[str, Any] | None = None,
    pusher: Mapping[str, Any] | None = None,
    topics: Mapping[str, str] | None = None,
    start: float | None = None,
    end: float | None = None,
) -> Recording:
    """Reads a recording from an MCAP file of `pushplan export --format mcap`, or from a ROS 2 bag.

    An exported file needs no further argument. A bag needs ``scene``, ``pusher`` and ``topics``.
    Its recording has a frame for every stamp of the pusher at which all objects are observed.
    Poses of objects between two stamps are interpolated linearly.

    Parameters
    ----------
    path : str or Path
        MCAP file.
    scene, pusher : mapping, optional
        Scene and pusher, with the keys of a recording file.
    topics : mapping of str to str, optional
        Topics of the poses in the frame of the table, for ``"pusher"`` and for every object.
        Types are `PoseStamped`, `PoseWithCovarianceStamped` and `TransformStamped` of
        geometry_msgs, `Odometry` of nav_msgs, and `TFMessage` of tf2_msgs. With the last type
        ``"/tf#box"`` selects the child frame ``box``.
    start, end : float, optional
        Limits of the used part, see `read_csv`.

    Returns
    -------
    Recording
        Recording, with the file's name.

    Raises
    ------
    ImportError
        If the packages of ``pip install 'pushplan[mcap]'`` are missing.
    ValueError
        If the log or an argument is invalid.
    FileError
        If the scene or the pusher is invalid.

    Examples
    --------
    >>> recording = logs.read_mcap("best.mcap")
    """
    path = Path(path)
    if topics is None:
        if scene is not None or pusher is not None:
            raise ValueError(
                "`scene` and `pusher` need `topics` (ROS 2 bag); leave them out for a file of "
                "`pushplan export`"
            )
        return Recording.from_dict(_bags.own(path))
    if scene is None or pusher is None:
        raise ValueError("a ROS 2 bag contains only poses: set `scene` and `pusher`")
    names = [PUSHER, *(str(thing["name"]) for thing in scene["objects"])]
    if set(topics) != set(names):
        raise ValueError(
            f"`topics` must have the keys {', '.join(names)}, found {', '.join(topics)}"
        )
    seen = _bags.poses_of(path, topics)
    first, last = (
        max(times[0] for times, _ in seen.values()),
        min(times[-1] for times, _ in seen.values()),
    )
    stamps = seen[PUSHER][0]
    stamps = stamps[(stamps >= first) & (stamps <= last)]
    if len(stamps) < 2:
        raise ValueError(
            f"{path}: the times of {', '.join(names)} do not overlap; check the topics and their "
            "stamps"
        )
    bodies = {}
    for name in names:
        times, poses = seen[name]
        poses = np.column_stack([poses[:, :2], np.degrees(np.unwrap(poses[:, 2]))])
        bodies[name] = np.column_stack([np.interp(stamps, times, column) for column in poses.T])
    times, lines = stamps - stamps[0], np.arange(1, len(stamps) + 1)
    return Recording.from_dict(
        _recorded(path, (scene, pusher), (times, lines), bodies, "m", (start, end))
    )


def write_json(path: str | Path, csv_path: str | Path, **stated: Any) -> None:
    """Writes the recording of a CSV file as JSON for the command.

    Parameters
    ----------
    path : str or Path
        File to write.
    csv_path : str or Path
        CSV file.
    **stated
        Other arguments of `read_csv`.

    Raises
    ------
    ValueError or FileError
        If `read_csv` raises it.

    Examples
    --------
    >>> logs.write_json(
    ...     "pushes.json", "vicon.csv", scene={"objects": [box]}, pusher=tip, time="t",
    ...     poses={"pusher": ("tip_x", "tip_y"), "box": ("x", "y", "yaw")}, length="mm",
    ... )
    """
    units = (stated.pop("length"), stated.pop("angle", "deg"), stated.pop("clock", "s"))
    cut = (stated.pop("start", None), stated.pop("end", None))
    mapping = _mapping(csv_path, units=units, cut=cut, **stated)
    Recording.from_dict(mapping)
    Path(path).write_text(json.dumps(mapping))


def _mapping(
    path: str | Path,
    scene: Mapping[str, Any],
    pusher: Mapping[str, Any],
    time: str,
    poses: Mapping[str, Sequence[str]],
    units: tuple[str, str, str],
    cut: tuple[float | None, float | None],
) -> dict[str, Any]:
    length, angle, clock = units
    if length not in _LENGTHS or angle not in ("deg", "rad") or clock not in _TIMES:
        raise ValueError(
            f"`length` must be {'/'.join(_LENGTHS)}, `angle` deg/rad and `clock` "
            f"{'/'.join(_TIMES)}, "
            f"found {length}, {angle} and {clock}"
        )
    names = [PUSHER, *(str(thing["name"]) for thing in scene["objects"])]
    if set(poses) != set(names):
        raise ValueError(f"`poses` must have the keys {', '.join(names)}, found {', '.join(poses)}")
    wanted = [time, *(column for name in names for column in poses[name])]
    lines, table = _columns(Path(path), wanted)
    times = table[time] * _TIMES[clock]
    bodies = {}
    for name in names:
        columns = poses[name]
        if len(columns) not in (2, 3):
            raise ValueError(f"`{name}` needs 2 or 3 columns (x, y, heading), found {len(columns)}")
        raw = np.stack([table[column] for column in columns], axis=1)
        place = raw[:, :2] * _LENGTHS[length]
        if len(columns) == 3:
            place = np.column_stack([place, degrees(path, name, raw[:, 2], angle)])
        bodies[name] = place
    return _recorded(path, (scene, pusher), (times - times[0], lines), bodies, length, cut)


def _recorded(
    path: str | Path,
    stated: tuple[Mapping[str, Any], Mapping[str, Any]],
    clock: tuple[_Floats, npt.NDArray[np.int64]],
    bodies: Mapping[str, _Floats],
    length: str,
    cut: tuple[float | None, float | None],
) -> dict[str, Any]:
    """Returns the recording of poses in metres and degrees, with their times and line numbers."""
    times, lines = clock
    check_times(path, times, lines)
    begin, stop = cut[0] or 0.0, math.inf if cut[1] is None else cut[1]
    kept = (times >= begin) & (times <= stop)
    if kept.sum() < 2:
        raise ValueError(
            f"{path}: fewer than two lines from {begin} to {stop} s; change `start` or `end`"
        )
    velocities = {
        name: _velocity(times, place, int(np.argmax(kept))) for name, place in bodies.items()
    }
    bodies = {name: place[kept] for name, place in bodies.items()}
    for name, place in bodies.items():
        check_length(path, name, place[:, :2], length)
    times, lines = times[kept], lines[kept]
    check_gaps(path, times, lines, bodies)
    check_stale(path, times, lines, bodies)
    moved = max(float(np.ptp(place[:, :2], axis=0).max()) for place in bodies.values())
    if moved < STILL:
        raise ValueError(
            f"{path}: nothing moves by more than {1e3 * moved:.3f} mm; check `length`, here "
            f"`{length}`"
        )
    objects = [place for name, place in bodies.items() if name != PUSHER]
    frames = [
        {"pusher": bodies[PUSHER][k].tolist(), "objects": [place[k].tolist() for place in objects]}
        for k in range(len(times))
    ]
    scene, pusher = stated
    return {
        "schema_version": 1,
        "kind": "recording",
        "name": Path(path).stem,
        "scene": {
            **scene,
            "objects": [{**velocities[str(one["name"])], **one} for one in scene["objects"]],
        },
        "pusher": dict(pusher),
        "times": (times - times[0]).tolist(),
        "frames": frames,
    }


def _velocity(times: _Floats, place: _Floats, first: int) -> dict[str, Any]:
    """Returns the velocity of a body at line ``first`` as keys of a scene; empty at rest."""
    if first == 0:
        return {}
    near = np.abs(times - times[first]) <= _NEAR
    near[first - 1 : first + 2] = True
    if np.ptp(place[near, :2], axis=0).max() < STILL:
        return {}
    x, y, *spin = np.polyfit(times[near] - times[first], place[near], 1)[0].tolist()
    return {"velocity": [x, y], **({"spin_deg": spin[0]} if spin else {})}


def _columns(path: Path, wanted: Sequence[str]) -> tuple[npt.NDArray[np.int64], dict[str, _Floats]]:
    """Returns line numbers, and columns as numbers."""
    with path.open(newline="", encoding="utf-8-sig") as file:
        rows = csv.DictReader(file, skipinitialspace=True)
        known = rows.fieldnames or []
        missing = [name for name in dict.fromkeys(wanted) if name not in known]
        if missing:
            raise ValueError(
                f"{path}: no column {', '.join(missing)}; the file has {', '.join(known)}"
            )
        lines: list[int] = []
        found: dict[str, list[float]] = {name: [] for name in wanted}
        for row in rows:
            lines.append(rows.line_num)
            for name in found:
                try:
                    value = float(row[name])
                except (TypeError, ValueError):
                    value = math.nan
                if not math.isfinite(value):
                    raise ValueError(
                        f"{path}:{rows.line_num}: `{name}` is {row[name]!r}; expected a finite "
                        "number"
                    )
                found[name].append(value)
    if len(lines) < 2:
        raise ValueError(f"{path}: a log needs two lines of numbers or more, found {len(lines)}")
    return np.array(lines), {name: np.array(values) for name, values in found.items()}
