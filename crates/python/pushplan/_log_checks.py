"""Checks of logs of trackers: units, gaps, and poses that are constant while others move."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import numpy.typing as npt

PUSHER = "pusher"
#: Maximum distance of an object on a table from its first pose, metres.
FAR = 5.0
#: Displacement below which an object did not move in a whole log, metres.
STILL = 2e-3
#: Factor relative to the usual time step above which a step is a gap.
GAP = 2.5
#: Duration for which a pose may be identical bit for bit before it is stale, if the object moves
#: before and after, seconds.
STALE = 0.25

_Floats = npt.NDArray[np.float64]


def check_times(path: str | Path, times: _Floats, lines: npt.NDArray[np.int64]) -> None:
    """Raises ValueError if the times do not increase, or if their step cannot be in seconds."""
    back = np.flatnonzero(np.diff(times) <= 0)
    if len(back):
        raise ValueError(
            f"{path}:{lines[back[0] + 1]}: the time does not increase: sort the lines and remove "
            "duplicates"
        )
    usual = float(np.median(np.diff(times)))
    if not 1e-4 <= usual <= 2.0:
        raise ValueError(f"{path}: the time step is {usual:g} s; check the unit of time, `clock`")


def check_length(path: str | Path, name: str, place: _Floats, length: str) -> None:
    """Raises ValueError if a body moves farther than a table is long."""
    away = float(np.abs(place - place[0]).max())
    if away > FAR:
        raise ValueError(f"{path}: `{name}` moves by {away:.1f} m; check `length`, here `{length}`")


def degrees(path: str | Path, name: str, heading: _Floats, angle: str) -> _Floats:
    """Returns continuous headings in degrees."""
    turn = 360.0 if angle == "deg" else math.tau
    steps = np.abs(np.diff(heading))
    if angle == "deg":
        # Headings in radians are recognised: they wrap at pi or stay within pi.
        wraps = bool((np.abs(steps - math.tau) < 0.3).any())
        if wraps and np.abs(heading).max() <= math.tau + 1e-6:
            raise ValueError(f"{path}: the heading of `{name}` wraps at pi; set `angle` to `rad`")
        if 0.05 < float(np.ptp(heading)) and np.abs(heading).max() <= math.pi:
            warnings.warn(
                f"{path}: all headings of `{name}` lie within 3.15 degrees; if they are radians, "
                "set `angle`",
                stacklevel=4,
            )
    elif np.abs(heading).max() > 4 * math.tau or bool((np.abs(steps - 360.0) < 20.0).any()):
        raise ValueError(
            f"{path}: the heading of `{name}` is {np.abs(heading).max():.0f}; set `angle` to `deg`"
        )
    return np.asarray(np.unwrap(heading, period=turn) * (360.0 / turn), dtype=np.float64)


def check_gaps(
    path: str | Path, times: _Floats, lines: npt.NDArray[np.int64], bodies: Mapping[str, _Floats]
) -> None:
    """Raises ValueError if lines are missing while a body moves."""
    steps = np.diff(times)
    for k in np.flatnonzero(steps > GAP * np.median(steps)):
        for name, place in bodies.items():
            if np.abs(place[k + 1, :2] - place[k, :2]).max() > STILL:
                raise ValueError(
                    f"{path}:{lines[k + 1]}: {steps[k]:.2f} s are missing before this line while "
                    f"`{name}` moves: cut the log there with `start` or `end`"
                )


def check_stale(
    path: str | Path, times: _Floats, lines: npt.NDArray[np.int64], bodies: Mapping[str, _Floats]
) -> None:
    """Raises ValueError if a pose is constant while its body moves."""
    pusher = bodies[PUSHER][:, :2]
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
            # Stale during motion: object and pusher move right before and right after.
            if first == 0 or k == len(same) or times[k] - times[first] < STALE:
                continue
            jumps = min(speed[first - 1], speed[k]) > 1e-4
            goes = np.abs(pusher[k] - pusher[first]).max() > STILL or name == PUSHER
            if jumps and goes:
                raise ValueError(
                    f"{path}:{lines[first]}: the pose of `{name}` is constant for "
                    f"{times[k] - times[first]:.2f} s during a motion, because the tracker lost "
                    "it: cut the log there with `start` or `end`"
                )
