"""Geometry of tags, and OpenCV, which detects them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]

#: Range of the edge of a tag, metres.
EDGES = (0.002, 0.5)
#: Maximum distance of a tag or a camera from an origin along an axis, metres, as in files.
FAR = 20.0


def square(size: float) -> Floats:
    """Returns the corners of a tag about its centre, metres, ``[4, 3]``."""
    half = size / 2
    return np.array(
        [[-half, half, 0.0], [half, half, 0.0], [half, -half, 0.0], [-half, -half, 0.0]]
    )


def about_z(angle: float) -> Floats:
    """Returns the matrix of a rotation about z, ``[3, 3]``; the angle is in radians."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def coefficients(values: npt.ArrayLike) -> Floats:
    """Returns distortion coefficients in OpenCV's order, zeros for none."""
    found = np.ravel(np.asarray(values, float))
    return found if len(found) else np.zeros(5)


def opencv() -> Any:
    """Returns the module of OpenCV; raises ImportError with the remedy where it is missing."""
    try:
        import cv2
    except ImportError as error:
        raise ImportError("detecting tags needs OpenCV: pip install 'pushplan[camera]'") from error
    return cv2


def check_edge(name: str, edge: float) -> None:
    """Raises ValueError unless the edge of a tag is in metres."""
    if not EDGES[0] <= edge <= EDGES[1]:
        raise ValueError(
            f"`{name}` is the edge of the black square and must be {EDGES[0]:g} to {EDGES[1]:g} m, "
            f"found {edge:g}; convert millimetres to metres"
        )


def check_place(name: str, place: Sequence[float], count: int) -> None:
    """Raises ValueError unless a position has this number of coordinates, in metres."""
    numbers = np.asarray(place, float)
    if numbers.shape != (count,) or not (np.abs(numbers) <= FAR).all():
        raise ValueError(
            f"`{name}` must be {count} coordinates from -{FAR:g} to {FAR:g} m, found "
            f"{numbers.tolist()}; convert millimetres to metres"
        )


def check_angle(name: str, angle: float) -> None:
    """Raises ValueError unless an angle is within one revolution, in radians."""
    if not abs(angle) <= math.tau + 1e-6:
        raise ValueError(
            f"`{name}` must be an angle from -2 pi to 2 pi radians, found {angle:g}; convert "
            "degrees with `math.radians`"
        )
