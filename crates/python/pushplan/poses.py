"""Where objects are, from tags that a camera sees: AprilTags or ArUco markers on what is pushed.

Needs OpenCV: ``pip install 'pushplan[camera]'``.

    from pushplan.poses import Camera, Tag, look

    camera = Camera(matrix, distortion).placed(image, {0: (0.2, -0.3), 1: (0.8, -0.3), 2: (0.5, 0.3)}, 0.06)
    seen = look(task, image, camera, [Tag(7, "can", 0.04)])
    solution = pushplan.solve(task.at(seen.poses))

Objects stand upright, so that a pose is x, y and heading: these three are fitted to the corners of all tags
of an object at once, which is far better known than a pose in space from one tag. The covariance is that of
the fit, for corners that are found to within ``pixels``, plus what is not known of where the camera is.
Lengths are metres, angles radians, and the table is the plane z = 0.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, Iterable, Mapping, Optional, Sequence

import numpy as np
import numpy.typing as npt

from ._native import Task

__all__ = ["Camera", "Seen", "Tag", "detect", "look"]

Floats = npt.NDArray[np.float64]

#: Default standard deviation of a detected corner, pixels: measured on tags rendered by MuJoCo, of 40 to 90
#: pixels.
PIXELS = 0.15

#: Maximum error of the corners of a fit, in standard deviations; beyond it the observation is rejected.
GROSS = 8.0


@dataclass(frozen=True)
class Tag:
    """A tag on an object: ``size`` is the edge of its black square, ``position`` its middle in the object's
    frame with z from the table on (by default on top, in the middle), ``yaw`` its turn there; ``turn`` is the
    whole turn as a 3 x 3 matrix, for tags that do not face up."""

    id: int
    object: str
    size: float
    position: Optional[tuple[float, float, float]] = None
    yaw: float = 0.0
    turn: Optional[npt.ArrayLike] = None

    def corners(self, height: float) -> Floats:
        """Its corners in the object's frame, as detectors order them, ``[4, 3]``."""
        turn = _about_z(self.yaw) if self.turn is None else np.asarray(self.turn, float)
        middle = np.array((0.0, 0.0, height) if self.position is None else self.position)
        return middle + _square(self.size) @ turn.T


@dataclass(frozen=True)
class Camera:
    """A calibrated camera: its matrix, distortion as OpenCV has it, and where it is: ``turn`` and ``shift``
    take points of the table into its frame (x right, y down, z ahead). ``covariance`` is of a small turn
    (radians) and shift (metres) of that, in its frame."""

    matrix: npt.ArrayLike
    distortion: npt.ArrayLike = ()
    turn: Floats = field(default_factory=lambda: np.eye(3))
    shift: Floats = field(default_factory=lambda: np.zeros(3))
    covariance: Floats = field(default_factory=lambda: np.zeros((6, 6)))

    def at(self, position: Sequence[float], turn: npt.ArrayLike) -> Camera:
        """The same at a position on the table's frame, ``turn`` being the camera's axes as columns."""
        turn = np.asarray(turn, float).T
        return replace(self, turn=turn, shift=-turn @ np.asarray(position, float), covariance=np.zeros((6, 6)))

    def placed(
        self,
        image: npt.NDArray[np.uint8],
        tags: Mapping[int, Sequence[float]],
        size: float,
        *,
        family: str = "apriltag_36h11",
        pixels: float = PIXELS,
    ) -> Camera:
        """The same where it must be to see these tags, which lie flat on the table: of each its id and where
        its middle is, x, y and, if it is turned, by how much. More than one, far apart, tell it well."""
        cv2 = _cv2()
        found = detect(image, family)
        known = [k for k in tags if k in found]
        if not known:
            raise ValueError(f"none of the tags {sorted(tags)} is seen, but {sorted(found)}")
        middles = {k: (*tuple(tags[k]), 0.0)[:3] for k in known}
        points = np.concatenate(
            [np.array([x, y, 0.0]) + _square(size) @ _about_z(yaw).T for x, y, yaw in middles.values()]
        )
        corners = np.concatenate([found[k] for k in known])
        matrix, distortion = np.asarray(self.matrix, float), _distortion(self.distortion)
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

    def project(self, points: Floats) -> Floats:
        """Where points of the table's frame are seen, pixels, ``[points, 2]``."""
        cv2 = _cv2()
        seen, _ = cv2.projectPoints(
            points @ self.turn.T + self.shift, np.zeros(3), np.zeros(3),
            np.asarray(self.matrix, float), _distortion(self.distortion),
        )
        return np.asarray(seen, float).reshape(-1, 2)

    def slopes(self, points: Floats) -> tuple[Floats, Floats]:
        """How what is seen moves with the points, ``[points, 2, 3]``, and with the camera, ``[2 points, 6]``:
        by a turn and a shift in its frame."""
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


@dataclass(frozen=True)
class Seen:
    """What a look gives. ``poses`` has x, y and heading of every object, ``[objects, 3]``, for
    `Task.at`; an object that was not seen is where the task has it, and is in ``missing``. ``covariance``
    is theirs, ``[objects, 3, 3]``; ``off`` how far the corners of each are off its fit, pixels."""

    poses: Floats
    covariance: Floats
    off: Floats
    missing: tuple[str, ...]

    @property
    def noise(self) -> tuple[float, float]:
        """Standard deviations of a position (metres) and a heading (radians), of what is known least: for
        `run` and `infer`."""
        seen = [k for k in range(len(self.poses)) if np.isfinite(self.off[k])]
        if not seen:
            raise ValueError("no object was seen")
        shift = max(np.sqrt(np.linalg.eigvalsh(self.covariance[k][:2, :2])[-1]) for k in seen)
        return float(shift), float(max(np.sqrt(self.covariance[k][2, 2]) for k in seen))


def detect(image: npt.NDArray[np.uint8], family: str = "apriltag_36h11") -> dict[int, Floats]:
    """Tags in an image (grey, or in colours), by their ids: four corners each, pixels. Families are those of
    OpenCV's dictionaries: ``apriltag_36h11``, ``4x4_50`` and so on."""
    aruco = _cv2().aruco
    name = "DICT_" + (family.upper().replace("H", "h") if family.startswith("apriltag") else family.upper())
    if not hasattr(aruco, name):
        known = sorted(word[5:].lower() for word in dir(aruco) if word.startswith("DICT_"))
        raise ValueError(f"no family of tags is called {family!r}; there are {', '.join(known)}")
    settings = aruco.DetectorParameters()
    settings.cornerRefinementMethod = aruco.CORNER_REFINE_SUBPIX
    # With these windows, corners of rendered tags have a mean error of 0.14 pixels; with OpenCV's own
    # windows, 0.38.
    settings.cornerRefinementWinSize = 7
    settings.relativeCornerRefinmentWinSize = 0.5
    detector = aruco.ArucoDetector(aruco.getPredefinedDictionary(getattr(aruco, name)), settings)
    corners, ids, _ = detector.detectMarkers(image)
    if ids is None:
        return {}
    found: dict[int, Floats] = {}
    for tag, four in zip(np.ravel(ids), corners):
        # A tag that is seen twice is ambiguous, because a picture of it may be in the scene.
        found[int(tag)] = np.full((4, 2), np.nan) if int(tag) in found else np.asarray(four, float).reshape(4, 2)
    return {tag: four for tag, four in found.items() if np.isfinite(four).all()}


def look(
    task: Task,
    image: npt.NDArray[np.uint8] | Mapping[int, npt.ArrayLike],
    camera: Camera,
    tags: Iterable[Tag],
    *,
    family: str = "apriltag_36h11",
    pixels: float = PIXELS,
) -> Seen:
    """Where the objects of a task are, by the tags on them. ``image`` may also be the corners that another
    detector has found, by ids. Corners are known to ``pixels``, a standard deviation."""
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
            raise ValueError(f"tag {tag.id} is on {tag.object!r}, which the task does not have")
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


def _fit(camera: Camera, points: Floats, corners: Floats, pixels: float) -> Optional[tuple[Floats, Floats, float]]:
    """The pose of what has these points, seen at these corners; its covariance, and how far off they are."""
    matrix = np.asarray(camera.matrix, float)
    rays = _cv2().undistortPoints(corners.reshape(-1, 1, 2), matrix, _distortion(camera.distortion))
    rays = np.column_stack([rays.reshape(-1, 2), np.ones(len(corners))]) @ camera.turn
    eye = -camera.turn.T @ camera.shift
    if np.any(np.abs(rays[:, 2]) < 1e-6):
        return None
    # Initial guess: the best rotation and translation in the plane that map the points to the rays at their
    # heights.
    flat = eye + rays * ((points[:, 2] - eye[2]) / rays[:, 2])[:, None]
    a, b = points[:, :2] - points[:, :2].mean(0), flat[:, :2] - flat[:, :2].mean(0)
    guesses = [np.arctan2((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum(), (a * b).sum())]
    if np.ptp(points[:, 2]) > 1e-3:
        # Points above each other contain little information on the rotation in the plane.
        guesses = list(np.linspace(-np.pi, np.pi, 12, endpoint=False))
    best = None
    for heading in guesses:
        shift = flat[:, :2].mean(0) - _about_z(heading)[:2, :2] @ points[:, :2].mean(0)
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
    """Points of an object at a pose, and how what is seen of them moves with the pose and with the camera."""
    turned = points @ _about_z(pose[2]).T + np.array([pose[0], pose[1], 0.0])
    by_point, by_camera = camera.slopes(turned)
    around = np.column_stack([-(turned[:, 1] - pose[1]), turned[:, 0] - pose[0], np.zeros(len(turned))])
    slope = np.stack(
        [by_point[:, :, 0], by_point[:, :, 1], np.einsum("nij,nj->ni", by_point, around)], axis=2
    )
    return turned, slope.reshape(-1, 3), by_camera


def _heights(task: Task) -> dict[str, float]:
    """Heights of the objects of a task, metres."""
    things: Any = task.to_dict()["scene"]["objects"]
    heights = {}
    for thing in things:
        [(kind, shape)] = thing["shape"].items()
        heights[thing["name"]] = shape["size"][2] if kind == "cuboid" else shape["height"]
    return heights


def _square(size: float) -> Floats:
    half = size / 2
    return np.array([[-half, half, 0.0], [half, half, 0.0], [half, -half, 0.0], [-half, -half, 0.0]])


def _about_z(angle: float) -> Floats:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def _distortion(values: npt.ArrayLike) -> Floats:
    found = np.ravel(np.asarray(values, float))
    return found if len(found) else np.zeros(5)


def _cv2() -> Any:
    try:
        import cv2
    except ImportError as error:
        raise ImportError("looking for tags needs OpenCV: pip install 'pushplan[camera]'") from error
    return cv2
