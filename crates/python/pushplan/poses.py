"""Poses of objects from a camera image with AprilTags or ArUco markers on the objects.

The module needs OpenCV: ``pip install 'pushplan[camera]'``.

    from pushplan.poses import Camera, Tag, look

    table = {0: (0.2, -0.3), 1: (0.8, -0.3), 2: (0.5, 0.3)}
    camera = Camera(matrix, distortion).placed(image, table, 0.06)
    seen = look(task, image, camera, [Tag(7, "can", 0.04)])
    solution = pushplan.solve(task.at(seen.poses))

Objects stand upright, so that a pose is x, y and heading. The module fits these three values to the
corners of all tags of an object together, which is far more accurate than a pose in space from one
tag. The covariance contains the error of the detected corners (standard deviation ``pixels``) and
of the camera's pose. Lengths are metres, angles radians, and the table is the plane z = 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterable, Mapping, Optional

import numpy as np
import numpy.typing as npt

from ._camera import PIXELS, Camera, detect
from ._native import Task
from ._tags import Floats, about_z, coefficients, opencv, square
from ._tags import check_angle, check_edge, check_place

__all__ = ["Camera", "Seen", "Tag", "detect", "look"]

#: Maximum error of the corners of a fit, in standard deviations, for a valid observation.
GROSS = 8.0


@dataclass(frozen=True)
class Tag:
    """Tag on an object.

    Parameters
    ----------
    id : int
        Id of the tag in its family.
    object : str
        Name of the object.
    size : float
        Edge of the tag's black square, metres.
    position : tuple of float, optional
        Centre in the object's frame, metres, with z = 0 at the table; by default on the top.
    yaw : float, default 0
        Rotation about z in the object's frame, radians.
    turn : array_like, ``[3, 3]``, optional
        Rotation matrix in the object's frame, for tags that do not face up; it replaces ``yaw``.

    Raises
    ------
    ValueError
        If a length is out of range, for example in millimetres, or ``yaw`` is in degrees.

    Examples
    --------
    >>> tag = Tag(7, "can", 0.04)
    """

    id: int
    object: str
    size: float
    position: Optional[tuple[float, float, float]] = None
    yaw: float = 0.0
    turn: Optional[npt.ArrayLike] = None

    def __post_init__(self) -> None:
        check_edge("size", self.size)
        check_angle("yaw", self.yaw)
        if self.position is not None:
            check_place("position", self.position, 3)

    def corners(self, height: float) -> Floats:
        """Returns the corners in the object's frame, in detectors' order.

        Parameters
        ----------
        height : float
            Height of the object, metres, at which a tag without ``position`` lies.

        Returns
        -------
        ndarray, ``[4, 3]``
            Corners, metres.
        """
        turn = about_z(self.yaw) if self.turn is None else np.asarray(self.turn, float)
        middle = np.array((0.0, 0.0, height) if self.position is None else self.position)
        return middle + square(self.size) @ turn.T


@dataclass(frozen=True)
class Seen:
    """Observation of the objects, the result of `look`."""

    #: Poses for `Task.at`, ``[objects, 3]``: x, y (metres), heading (radians); default: the task's.
    poses: Floats
    #: Covariances of the poses, ``[objects, 3, 3]``; NaN without observation.
    covariance: Floats
    #: Root mean square error of the corners of each object, pixels, ``[objects]``.
    off: Floats
    #: Names of the objects without observation.
    missing: tuple[str, ...]

    @property
    def noise(self) -> tuple[float, float]:
        """Largest standard deviations of a position (metres) and a heading (radians)."""
        seen = [k for k in range(len(self.poses)) if np.isfinite(self.off[k])]
        if not seen:
            raise ValueError("no object was observed; see `missing`")
        shift = max(np.sqrt(np.linalg.eigvalsh(self.covariance[k][:2, :2])[-1]) for k in seen)
        return float(shift), float(max(np.sqrt(self.covariance[k][2, 2]) for k in seen))


def look(
    task: Task,
    image: npt.NDArray[np.uint8] | Mapping[int, npt.ArrayLike],
    camera: Camera,
    tags: Iterable[Tag],
    *,
    family: str = "apriltag_36h11",
    pixels: float = PIXELS,
) -> Seen:
    """Estimates the poses of a task's objects from the tags on them.

    Parameters
    ----------
    task : Task
        Task with the objects.
    image : ndarray of uint8, or mapping of int to array_like
        Grey or colour image, or the corners from another detector by the tags' ids, ``[4, 2]``.
    camera : Camera
        Camera with its pose.
    tags : iterable of Tag
        Tags on the objects.
    family : str, default "apriltag_36h11"
        Family of the tags, see `detect`.
    pixels : float
        Standard deviation of a detected corner, pixels.

    Returns
    -------
    Seen
        Poses with covariances.

    Raises
    ------
    ValueError
        If the camera has no pose, a tag names an object that the task does not have, or OpenCV
        has no such family.

    Examples
    --------
    >>> seen = look(task, image, camera, [Tag(7, "can", 0.04)])
    """
    camera.check_pose()
    if isinstance(image, Mapping):
        found = {int(k): np.asarray(v, float).reshape(4, 2) for k, v in image.items()}
    else:
        found = detect(image, family)
    names, heights = list(task.objects), _heights(task)
    poses = np.array(task.start, float)
    covariance = np.full((len(names), 3, 3), np.nan)
    off = np.full(len(names), np.nan)
    by_object: dict[str, list[tuple[Floats, Floats]]] = {}
    for tag in tags:
        if tag.object not in names:
            raise ValueError(
                f"tag {tag.id} is on {tag.object!r}, which the task does not have; it has "
                f"{', '.join(names)}"
            )
        if tag.id in found:
            pair = (tag.corners(heights[tag.object]), found[tag.id])
            by_object.setdefault(tag.object, []).append(pair)
    for name, pairs in by_object.items():
        points = np.concatenate([points for points, _ in pairs])
        corners = np.concatenate([corners for _, corners in pairs])
        fitted = _fit(camera, points, corners, pixels)
        if fitted is not None:
            index = names.index(name)
            poses[index], covariance[index], off[index] = fitted
    missing = tuple(name for name, value in zip(names, off) if not np.isfinite(value))
    return Seen(poses, covariance, off, missing)


def _fit(
    camera: Camera, points: Floats, corners: Floats, pixels: float
) -> Optional[tuple[Floats, Floats, float]]:
    """Fits a pose to observed corners of points; returns it with covariance and error in pixels."""
    matrix, distortion = np.asarray(camera.matrix, float), coefficients(camera.distortion)
    rays = opencv().undistortPoints(corners.reshape(-1, 1, 2), matrix, distortion)
    rays = np.column_stack([rays.reshape(-1, 2), np.ones(len(corners))]) @ camera.turn
    eye = -camera.turn.T @ camera.shift
    if np.any(np.abs(rays[:, 2]) < 1e-6):
        return None
    # Initial guess: the best rotation and translation in the plane that map the points to the rays
    # at their heights.
    flat = eye + rays * ((points[:, 2] - eye[2]) / rays[:, 2])[:, None]
    a, b = points[:, :2] - points[:, :2].mean(0), flat[:, :2] - flat[:, :2].mean(0)
    guesses = [np.arctan2((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum(), (a * b).sum())]
    if np.ptp(points[:, 2]) > 1e-3:
        # Points above each other contain little information on the rotation in the plane.
        guesses = list(np.linspace(-np.pi, np.pi, 12, endpoint=False))
    best = None
    for heading in guesses:
        shift = flat[:, :2].mean(0) - about_z(heading)[:2, :2] @ points[:, :2].mean(0)
        pose = np.array([*shift, heading])
        for _ in range(30):
            turned, slope, _ = _slopes(camera, points, pose)
            left = (corners - camera.project(turned)).ravel()
            step, *_ = np.linalg.lstsq(slope, left, rcond=None)
            pose = pose + step
            if np.abs(step).max() < 1e-9 or not np.isfinite(pose).all():
                break
        turned, slope, by_camera = _slopes(camera, points, pose)
        off = float(np.sqrt(np.mean((corners - camera.project(turned)) ** 2)))
        if np.isfinite(off) and (best is None or off < best[3]):
            best = (pose, slope, by_camera, off)
    if best is None or best[3] > GROSS * pixels:
        return None
    pose, slope, by_camera, off = best
    inverse = np.linalg.inv(slope.T @ slope)
    through = -inverse @ slope.T @ by_camera
    # If corners fit worse than expected, the covariance grows.
    spread = max(pixels, off)
    covariance = spread**2 * inverse + through @ camera.covariance @ through.T
    pose[2] = np.arctan2(np.sin(pose[2]), np.cos(pose[2]))
    return pose, covariance, off


def _slopes(camera: Camera, points: Floats, pose: Floats) -> tuple[Floats, Floats, Floats]:
    """Returns points of an object at a pose, and derivatives of their projection."""
    turned = points @ about_z(pose[2]).T + np.array([pose[0], pose[1], 0.0])
    by_point, by_camera = camera.slopes(turned)
    around = np.column_stack(
        [-(turned[:, 1] - pose[1]), turned[:, 0] - pose[0], np.zeros(len(turned))]
    )
    slope = np.stack(
        [by_point[:, :, 0], by_point[:, :, 1], np.einsum("nij,nj->ni", by_point, around)], axis=2
    )
    return turned, slope.reshape(-1, 3), by_camera


def _heights(task: Task) -> dict[str, float]:
    """Returns the heights of the objects of a task, metres."""
    things: Any = task.to_dict()["scene"]["objects"]
    heights = {}
    for thing in things:
        [(kind, shape)] = thing["shape"].items()
        heights[thing["name"]] = shape["size"][2] if kind == "cuboid" else shape["height"]
    return heights
