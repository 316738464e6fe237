"""Logs of trackers: what they are, and what they cannot be."""

from __future__ import annotations

import math
import pickle
from pathlib import Path
from typing import Any, Callable

import numpy as np
import pytest

import pushplan
from pushplan import logs

BOX = {"name": "box", "shape": {"cuboid": {"size": [0.09, 0.09, 0.02]}}, "mass": 0.8}
STATED: dict[str, Any] = {
    "scene": {"objects": [BOX]},
    "pusher": {"cylinder": {"radius": 0.005, "height": 0.05}},
    "time": "t",
    "poses": {"pusher": ("tip_x", "tip_y"), "box": ("x", "y", "yaw")},
    "length": "mm",
    "angle": "rad",
}
Row = list[float]


def rows() -> list[Row]:
    """A finger pushes a box by 5 cm; it turns by 0.3 rad on the way, from half a turn on."""
    found = []
    for k in range(101):
        tip = 0.001 * k
        box = max(0.1, tip + 0.0505)
        turn = math.pi - 0.1 + 0.3 * max(0.0, box - 0.1) / 0.05
        wrapped = (turn + math.pi) % math.tau - math.pi
        found.append([0.02 * k, 1e3 * tip, 0.0, 1e3 * box, 0.0, wrapped])
    return found


def written(path: Path, table: list[Row]) -> Path:
    lines = ["t,tip_x,tip_y,x,y,yaw", *(",".join(map(repr, row)) for row in table)]
    path.write_text("\n".join(lines) + "\n")
    return path


def test_a_log_in_millimetres_and_radians_is_a_recording(tmp_path: Path) -> None:
    path = written(tmp_path / "log.csv", rows())
    recording = logs.read_csv(path, **STATED)
    assert (recording.name, recording.objects, len(recording)) == ("log", ["box"], 101)
    assert recording.poses[-1, 0, 0] == pytest.approx(0.1505)
    turned = recording.poses[:, 0, 2]
    assert np.abs(np.diff(turned)).max() < 0.1, "turns are counted"
    assert turned[-1] - turned[0] == pytest.approx(0.303, abs=1e-3)
    again = pickle.loads(pickle.dumps(recording))
    assert again.poses == pytest.approx(recording.poses, abs=1e-12)
    part = logs.read_csv(path, **STATED, end=1.0)
    assert len(part) == 51
    logs.write_json(tmp_path / "log.recording.json", path, **STATED)
    assert len(pushplan.Recording.load(tmp_path / "log.recording.json")) == 101


def edited(change: Callable[[int, Row], Row | None]) -> list[Row]:
    found = [change(k, list(row)) for k, row in enumerate(rows())]
    return [row for row in found if row is not None]


def set_at(column: int, value: Callable[[int, float], float]) -> list[Row]:
    def change(k: int, row: Row) -> Row:
        row[column] = value(k, row[column])
        return row

    return edited(change)


@pytest.mark.parametrize(
    ("table", "stated", "message"),
    [
        (rows(), {"length": "m"}, "is `m` the unit of length"),
        ([[a, b / 1e3, c, d / 1e3, e, f] for a, b, c, d, e, f in rows()], {}, "is `mm` the unit"),
        (rows(), {"angle": "deg"}, "wraps at pi: its unit is `rad`"),
        (set_at(5, lambda k, yaw: math.degrees(yaw)), {}, "its unit is `deg`"),
        (rows(), {"clock": "ns"}, "is `clock` its unit"),
        (edited(lambda k, row: None if 60 <= k < 80 else row), {}, ":62: 0.42 s are missing"),
        (set_at(0, lambda k, t: 0.0 if k == 50 else t), {}, ":52: the time does not go on"),
        (set_at(1, lambda k, x: math.nan if k == 3 else x), {}, ":5: `tip_x` is 'nan'"),
        (rows(), {"time": "time"}, "no column time; there are t, tip_x"),
        (rows(), {"poses": {"pusher": ("tip_x", "tip_y")}}, "names columns of pusher, box"),
    ],
)
def test_what_a_log_cannot_be_is_said(
    tmp_path: Path, table: list[Row], stated: dict[str, Any], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        logs.read_csv(written(tmp_path / "log.csv", table), **{**STATED, **stated})


def test_stale_poses_and_small_angles_are_said(tmp_path: Path) -> None:
    def frozen(k: int, row: Row) -> Row:
        return [*row[:3], *rows()[60][3:]] if 60 <= k < 80 else row

    with pytest.raises(ValueError, match="`box` stands still to the bit for 0.38 s"):
        logs.read_csv(written(tmp_path / "log.csv", edited(frozen)), **STATED)
    small = set_at(5, lambda k, yaw: 0.002 * k)
    with pytest.warns(UserWarning, match="are they radians"):
        logs.read_csv(written(tmp_path / "log.csv", small), **{**STATED, "angle": "deg"})
