"""Camera with its pose, and detection of tags in its images."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Mapping, Sequence

import numpy as np
import numpy.typing as npt

from ._tags import Floats, about_z, coefficients, opencv, square
from ._tags import check_angle, check_edge, check_place

__all__ = ["PIXELS", "Camera", "detect"]

#: Default standard deviation of a detected corner, pixels, measured with tags of 40 to 90 pixels
#: that MuJoCo rendered.
PIXELS = 0.15


@dataclass(frozen=True)
class Camera:
    """Calibrated camera with its pose.

    Parameters
    ----------
    matrix : array_like, ``[3, 3]``
        Camera matrix, pixels.
    distortion : array_like, optional
        Distortion coefficients in OpenCV's order; by default none.
    turn : ndarray, ``[3, 3]``
        Rotation matrix from the table's frame to the camera's (x right, y down, z ahead).
    shift : ndarray, ``[3]``
        Translation from the table's frame to the camera's, metres.
    covariance : ndarray, ``[6, 6]``
        Covariance of small rotations (radians) and translations (metres) in the camera's frame.

    Examples
    --------
    >>> camera = Camera([[600.0, 0.0, 320.0], [0.0, 600.0, 240.0], [0.0, 0.0, 1.0]])
    >>> above = camera.at([0.5, 0.0, 1.0], [[0, -1, 0], [-1, 0, 0], [0, 0, -1]])
    """

    matrix: npt.ArrayLike
    distortion: npt.ArrayLike = ()
    turn: Floats = field(default_factory=lambda: np.eye(3))
    shift: Floats = field(default_factory=lambda: np.zeros(3))
    covariance: Floats = field(default_factory=lambda: np.zeros((6, 6)))

    def at(self, position: Sequence[float], turn: npt.ArrayLike) -> Camera:
        """Returns the camera at a position in the table's frame, metres.

        Parameters
        ----------
        position : sequence of float
            Position of the camera's centre, x, y and z in metres.
        turn : array_like, ``[3, 3]``
            Rotation matrix; its columns are the camera's axes in the table's frame (x right, y
            down, z ahead).

        Returns
        -------
        Camera
            Camera with this pose, without uncertainty.

        Raises
        ------
        ValueError
            If the position is not three numbers in metres.
        """
        check_place("position", position, 3)
        turn = np.asarray(turn, float).T
        return replace(
            self, turn=turn, shift=-turn @ np.asarray(position, float), covariance=np.zeros((6, 6))
        )

    def placed(
        self,
        image: npt.NDArray[np.uint8],
        tags: Mapping[int, Sequence[float]],
        size: float,
        *,
        family: str = "apriltag_36h11",
        pixels: float = PIXELS,
    ) -> Camera:
        """Returns the camera with its pose from an image of tags on the table.

        Parameters
        ----------
        image : ndarray of uint8
            Grey or colour image.
        tags : mapping of int to sequence of float
            Ids and centres of tags that lie flat on the table, x and y in metres, and optionally
            their rotation in radians. Several tags far apart give an accurate pose.
        size : float
            Edge of the black squares, metres.
        family, pixels
            Family of the tags and minimum standard deviation of a corner, see `look`.

        Returns
        -------
        Camera
            Camera with its pose and the covariance of the pose.

        Raises
        ------
        ValueError
            If the image shows none of the tags, or a length is not in metres.

        Examples
        --------
        >>> camera = camera.placed(image, {0: (0.2, -0.3), 1: (0.8, -0.3), 2: (0.5, 0.3)}, 0.06)
        """
        cv2 = opencv()
        check_edge("size", size)
        for tag, middle in tags.items():
            check_place(f"tags[{tag}]", middle[:2], 2)
            check_angle(f"rotation of tags[{tag}]", (*middle[2:], 0.0)[0])
        found = detect(image, family)
        known = [k for k in tags if k in found]
        if not known:
            wanted = ", ".join(map(str, sorted(tags)))
            seen = f"only the tags {', '.join(map(str, sorted(found)))}" if found else "no tag"
            remedy = "the ids" if found else "focus, light and distance of the camera"
            raise ValueError(
                f"the image shows {seen} of the family `{family}`, but a tag of {wanted} is "
                f"needed; check `family` and {remedy}"
            )
        middles = {k: (*tuple(tags[k]), 0.0)[:3] for k in known}
        points = np.concatenate(
            [
                np.array([x, y, 0.0]) + square(size) @ about_z(yaw).T
                for x, y, yaw in middles.values()
            ]
        )
        corners = np.concatenate([found[k] for k in known])
        matrix, distortion = np.asarray(self.matrix, float), coefficients(self.distortion)
        # Coplanar points have two solutions; the one that fits is refined.
        options = cv2.solvePnPGeneric(points, corners, matrix, distortion, flags=cv2.SOLVEPNP_IPPE)
        best = int(np.argmin(np.ravel(options[3])))
        turn, shift = cv2.solvePnPRefineLM(
            points, corners, matrix, distortion, options[1][best], options[2][best]
        )
        placed = replace(self, turn=cv2.Rodrigues(turn)[0], shift=np.ravel(shift))
        slopes = placed.slopes(points)[1]
        off = np.sqrt(np.mean((corners - placed.project(points)) ** 2))
        spread = max(pixels, float(off))
        covariance = np.asarray(spread**2 * np.linalg.inv(slopes.T @ slopes), dtype=np.float64)
        return replace(placed, covariance=covariance)

    def check_pose(self) -> None:
        """Raises ValueError for a camera without a pose, whose centre lies on the table."""
        if not np.any(self.shift):
            raise ValueError(
                "the camera has no pose; use the result of `camera.placed(image, tags, size)` or "
                "`camera.at(position, turn)`"
            )

    def project(self, points: Floats) -> Floats:
        """Projects points of the table's frame to pixels.

        Parameters
        ----------
        points : ndarray, ``[points, 3]``
            Points, metres.

        Returns
        -------
        ndarray, ``[points, 2]``
            Positions in the image, pixels.
        """
        cv2 = opencv()
        seen, _ = cv2.projectPoints(
            points @ self.turn.T + self.shift, np.zeros(3), np.zeros(3),
            np.asarray(self.matrix, float), coefficients(self.distortion),
        )
        return np.asarray(seen, float).reshape(-1, 2)

    def slopes(self, points: Floats) -> tuple[Floats, Floats]:
        """Returns the derivatives of the projection.

        Parameters
        ----------
        points : ndarray, ``[points, 3]``
            Points in the table's frame, metres.

        Returns
        -------
        tuple of ndarray
            Derivatives by the points, ``[points, 2, 3]``, and by a rotation and a translation of
            the camera in its frame, ``[2 points, 6]``; pixels per metre and per radian.
        """
        step = 1e-6
        by_point = np.empty((len(points), 2, 3))
        for k in range(3):
            shift = np.zeros(3)
            shift[k] = step
            ahead, behind = self.project(points + shift), self.project(points - shift)
            by_point[:, :, k] = (ahead - behind) / (2 * step)
        by_camera = np.empty((len(points), 2, 6))
        inside = points @ self.turn.T + self.shift
        for k in range(6):
            axis = np.zeros(3)
            axis[k % 3] = 1.0
            moved = np.cross(axis, inside) if k < 3 else np.broadcast_to(axis, inside.shape)
            # Relative to the table, the points moved in the opposite direction.
            by_camera[:, :, k] = np.einsum("nij,nj->ni", by_point, moved @ self.turn)
        return by_point, by_camera.reshape(-1, 6)


def detect(image: npt.NDArray[np.uint8], family: str = "apriltag_36h11") -> dict[int, Floats]:
    """Detects the tags in an image.

    Parameters
    ----------
    image : ndarray of uint8
        Grey or colour image.
    family : str, default "apriltag_36h11"
        Family of the tags, an OpenCV dictionary such as "apriltag_36h11" or "4x4_50".

    Returns
    -------
    dict of int to ndarray, ``[4, 2]``
        Corners of every tag by its id, pixels. A tag that appears twice is left out.

    Raises
    ------
    ValueError
        If OpenCV has no such family.

    Examples
    --------
    >>> corners = detect(image)
    """
    aruco = opencv().aruco
    name = "DICT_" + (
        family.upper().replace("H", "h") if family.startswith("apriltag") else family.upper()
    )
    if not hasattr(aruco, name):
        known = sorted(word[5:].lower() for word in dir(aruco) if word.startswith("DICT_"))
        raise ValueError(f"no family of tags is called {family!r}; use one of {', '.join(known)}")
    settings = aruco.DetectorParameters()
    settings.cornerRefinementMethod = aruco.CORNER_REFINE_SUBPIX
    # With these windows, corners of rendered tags have a mean error of 0.14 pixels; with OpenCV's
    # own windows, 0.38.
    settings.cornerRefinementWinSize = 7
    settings.relativeCornerRefinmentWinSize = 0.5
    detector = aruco.ArucoDetector(aruco.getPredefinedDictionary(getattr(aruco, name)), settings)
    corners, ids, _ = detector.detectMarkers(image)
    if ids is None:
        return {}
    found: dict[int, Floats] = {}
    for tag, four in zip(np.ravel(ids), corners):
        # A tag that appears twice is ambiguous, because a picture of it may be in the scene.
        found[int(tag)] = (
            np.full((4, 2), np.nan) if int(tag) in found else np.asarray(four, float).reshape(4, 2)
        )
    return {tag: four for tag, four in found.items() if np.isfinite(four).all()}
