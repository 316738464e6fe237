"""Geometry of tags, and OpenCV, which detects them."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]


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
