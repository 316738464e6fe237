"""Logs of trackers as recordings: CSV with stated columns and units, and MCAP.

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

What a log cannot be is an error that says where: wrong units, times that go back, seconds that are lost,
poses that stand still while others move on.
"""

from __future__ import annotations

import csv
import json
import math
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from . import _bags
from ._native import Recording

__all__ = ["read_csv", "read_mcap", "write_json"]

_LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "in": 0.0254}
_TIMES = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
_PUSHER = "pusher"
#: Maximum distance of an object on a table from its first pose, metres.
_FAR = 5.0
#: Displacement below which an object did not move in a whole log, metres.
_STILL = 2e-3
#: Factor relative to the usual time step above which a step is a gap.
_GAP = 2.5
#: Half width of the interval for fitting velocities at the cut of a log, seconds.
_NEAR = 0.05
#: Duration for which a pose may be identical bit for bit before it is stale, if the object moves before and
#: after, seconds.
_STALE = 0.25

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
    """The recording in a CSV file with a line of column names.

    ``scene`` and ``pusher`` are those of a recording file. ``poses`` names for the pusher and for every
    object the columns of x, y and, if it is known, heading. ``length``, ``angle`` and ``clock`` are the
    units of the columns. ``start`` and ``end`` cut out a part, seconds since the first line; what moves
    by more than 2 mm within 50 ms of ``start`` begins with that velocity, all else at rest. Raises `ValueError` for what a log cannot be and `FileError` for what a
    recording cannot be.
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
    """The recording in an MCAP file: one of `pushplan export --format mcap`, which needs nothing else, or a
    bag of ROS 2.

    Of a bag ``topics`` names for the pusher and for every object where its poses are, in the frame of the
    table: messages `PoseStamped`, `PoseWithCovarianceStamped` or `TransformStamped` of geometry_msgs, `Odometry`
    of nav_msgs, or `TFMessage` of tf2_msgs, of which ``"/tf#box"`` takes the child frame ``box``. Times are
    those of the pusher's stamps, from when all are seen on; between two of its poses an object is on the
    straight line. ``scene``, ``pusher``, ``start`` and ``end`` are as in `read_csv`. Needs the package ``mcap``
    (``pip install 'pushplan[mcap]'``). Raises `ValueError` for what a log cannot be and `FileError` for what a
    recording cannot be.
    """
    path = Path(path)
    if topics is None:
        if scene is not None or pusher is not None:
            raise ValueError("a bag needs `topics`, and a file of pushplan neither `scene` nor `pusher`")
        return Recording.from_dict(_bags.own(path))
    if scene is None or pusher is None:
        raise ValueError("a bag holds poses alone: state `scene` and `pusher`")
    names = [_PUSHER, *(str(thing["name"]) for thing in scene["objects"])]
    if set(topics) != set(names):
        raise ValueError(f"`topics` names those of {', '.join(names)}, not of {', '.join(topics)}")
    seen = _bags.poses_of(path, topics)
    first, last = max(times[0] for times, _ in seen.values()), min(times[-1] for times, _ in seen.values())
    stamps = seen[_PUSHER][0]
    stamps = stamps[(stamps >= first) & (stamps <= last)]
    if len(stamps) < 2:
        raise ValueError(f"{path}: the poses of {', '.join(names)} are not of the same time")
    bodies = {}
    for name in names:
        times, poses = seen[name]
        poses = np.column_stack([poses[:, :2], np.degrees(np.unwrap(poses[:, 2]))])
        bodies[name] = np.column_stack([np.interp(stamps, times, column) for column in poses.T])
    times, lines = stamps - stamps[0], np.arange(1, len(stamps) + 1)
    return Recording.from_dict(_recorded(path, (scene, pusher), (times, lines), bodies, "m", (start, end)))


def write_json(path: str | Path, csv_path: str | Path, **stated: Any) -> None:
    """Writes the recording of `read_csv` as a file for the command."""
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
            f"units are length {'/'.join(_LENGTHS)}, angle deg/rad, clock {'/'.join(_TIMES)}"
        )
    names = [_PUSHER, *(str(thing["name"]) for thing in scene["objects"])]
    if set(poses) != set(names):
        raise ValueError(f"`poses` names columns of {', '.join(names)}, not of {', '.join(poses)}")
    wanted = [time, *(column for name in names for column in poses[name])]
    lines, table = _columns(Path(path), wanted)
    times = table[time] * _TIMES[clock]
    bodies = {}
    for name in names:
        columns = poses[name]
        if len(columns) not in (2, 3):
            raise ValueError(f"the columns of `{name}` are those of x, y and perhaps heading")
        raw = np.stack([table[column] for column in columns], axis=1)
        place = raw[:, :2] * _LENGTHS[length]
        if len(columns) == 3:
            place = np.column_stack([place, _degrees(path, name, raw[:, 2], angle)])
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
    """A recording of poses in metres and degrees, at times with the lines that they stand in."""
    times, lines = clock
    _check_times(path, times, lines)
    begin, stop = cut[0] or 0.0, math.inf if cut[1] is None else cut[1]
    kept = (times >= begin) & (times <= stop)
    if kept.sum() < 2:
        raise ValueError(f"{path}: fewer than two lines from {begin} to {stop} s")
    velocities = {name: _velocity(times, place, int(np.argmax(kept))) for name, place in bodies.items()}
    bodies = {name: place[kept] for name, place in bodies.items()}
    for name, place in bodies.items():
        _check_length(path, name, place[:, :2], length)
    times, lines = times[kept], lines[kept]
    _check_gaps(path, times, lines, bodies)
    _check_stale(path, times, lines, bodies)
    moved = max(float(np.ptp(place[:, :2], axis=0).max()) for place in bodies.values())
    if moved < _STILL:
        raise ValueError(
            f"{path}: nothing moves by more than {1e3 * moved:.3f} mm: is `{length}` the unit of "
            "length?"
        )
    objects = [place for name, place in bodies.items() if name != _PUSHER]
    frames = [
        {"pusher": bodies[_PUSHER][k].tolist(), "objects": [place[k].tolist() for place in objects]}
        for k in range(len(times))
    ]
    scene, pusher = stated
    return {
        "schema_version": 1,
        "kind": "recording",
        "name": Path(path).stem,
        "scene": {**scene, "objects": [{**velocities[str(one["name"])], **one} for one in scene["objects"]]},
        "pusher": dict(pusher),
        "times": (times - times[0]).tolist(),
        "frames": frames,
    }


def _velocity(times: _Floats, place: _Floats, first: int) -> dict[str, Any]:
    """How a body moves at line ``first``, as a scene states it; nothing where it hardly does."""
    if first == 0:
        return {}
    near = np.abs(times - times[first]) <= _NEAR
    near[first - 1 : first + 2] = True
    if np.ptp(place[near, :2], axis=0).max() < _STILL:
        return {}
    x, y, *spin = np.polyfit(times[near] - times[first], place[near], 1)[0].tolist()
    return {"velocity": [x, y], **({"spin_deg": spin[0]} if spin else {})}


def _columns(path: Path, wanted: Sequence[str]) -> tuple[npt.NDArray[np.int64], dict[str, _Floats]]:
    """Numbers of lines, and columns as numbers."""
    with path.open(newline="", encoding="utf-8-sig") as file:
        rows = csv.DictReader(file, skipinitialspace=True)
        known = rows.fieldnames or []
        missing = [name for name in dict.fromkeys(wanted) if name not in known]
        if missing:
            raise ValueError(f"{path}: no column {', '.join(missing)}; there are {', '.join(known)}")
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
                        f"{path}:{rows.line_num}: `{name}` is {row[name]!r}, not a number"
                    )
                found[name].append(value)
    if len(lines) < 2:
        raise ValueError(f"{path}: a log has two lines of numbers or more")
    return np.array(lines), {name: np.array(values) for name, values in found.items()}


def _check_times(path: str | Path, times: _Floats, lines: npt.NDArray[np.int64]) -> None:
    back = np.flatnonzero(np.diff(times) <= 0)
    if len(back):
        raise ValueError(
            f"{path}:{lines[back[0] + 1]}: the time does not go on: sort the lines, and leave doubled "
            "ones out"
        )
    usual = float(np.median(np.diff(times)))
    if not 1e-4 <= usual <= 2.0:
        raise ValueError(f"{path}: {usual:g} s between two lines: is `clock` its unit of time?")


def _check_length(path: str | Path, name: str, place: _Floats, length: str) -> None:
    away = float(np.abs(place - place[0]).max())
    if away > _FAR:
        raise ValueError(
            f"{path}: `{name}` moves by {away:.1f} m: is `{length}` the unit of length?"
        )


def _degrees(path: str | Path, name: str, heading: _Floats, angle: str) -> _Floats:
    """Headings in degrees, all turns counted."""
    turn = 360.0 if angle == "deg" else math.tau
    steps = np.abs(np.diff(heading))
    if angle == "deg":
        # Headings in radians are recognised: they wrap at pi or stay within pi.
        wraps = bool((np.abs(steps - math.tau) < 0.3).any())
        if wraps and np.abs(heading).max() <= math.tau + 1e-6:
            raise ValueError(f"{path}: the heading of `{name}` wraps at pi: its unit is `rad`")
        if 0.05 < float(np.ptp(heading)) and np.abs(heading).max() <= math.pi:
            warnings.warn(
                f"{path}: all headings of `{name}` lie within 3.15 degrees: are they radians?",
                stacklevel=4,
            )
    elif np.abs(heading).max() > 4 * math.tau or bool((np.abs(steps - 360.0) < 20.0).any()):
        raise ValueError(f"{path}: the heading of `{name}` is {np.abs(heading).max():.0f}: its unit is `deg`")
    return np.asarray(np.unwrap(heading, period=turn) * (360.0 / turn), dtype=np.float64)


def _check_gaps(
    path: str | Path, times: _Floats, lines: npt.NDArray[np.int64], bodies: Mapping[str, _Floats]
) -> None:
    steps = np.diff(times)
    for k in np.flatnonzero(steps > _GAP * np.median(steps)):
        for name, place in bodies.items():
            if np.abs(place[k + 1, :2] - place[k, :2]).max() > _STILL:
                raise ValueError(
                    f"{path}:{lines[k + 1]}: {steps[k]:.2f} s are missing before this line, in which "
                    f"`{name}` moves: cut the log there with `start` or `end`"
                )


def _check_stale(
    path: str | Path, times: _Floats, lines: npt.NDArray[np.int64], bodies: Mapping[str, _Floats]
) -> None:
    pusher = bodies[_PUSHER][:, :2]
    for name, place in bodies.items():
        same = (np.diff(place, axis=0) == 0.0).all(axis=1)
        speed = np.abs(np.diff(place[:, :2], axis=0)).max(axis=1)
        k = 0
        while k < len(same):
            first = k
            while k < len(same) and same[k]:
                k += 1
            if k == first:
                k += 1
                continue
            # Stale during motion: the object moves right before and right after, and so does the pusher.
            if first == 0 or k == len(same) or times[k] - times[first] < _STALE:
                continue
            jumps = min(speed[first - 1], speed[k]) > 1e-4
            goes = np.abs(pusher[k] - pusher[first]).max() > _STILL or name == _PUSHER
            if jumps and goes:
                raise ValueError(
                    f"{path}:{lines[first]}: `{name}` stands still to the bit for "
                    f"{times[k] - times[first]:.2f} s on its way: the tracker lost it"
                )
