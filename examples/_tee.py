"""Plans pushes of a T by a round finger, for games that ask for the pose of a T.

Before every push the planner predicts some thousand single pushes and pairs of pushes, and returns
the push with the smallest expected number of steps to success. Lengths are pixels of one millimetre
in the task, and points of the plane are complex numbers.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple, Protocol

import numpy as np
import numpy.typing as npt
import shapely  # type: ignore[import-not-found,import-untyped,unused-ignore]
from shapely import affinity  # type: ignore[import-not-found,import-untyped,unused-ignore]

import pushplan

Floats = npt.NDArray[np.float64]
Points = npt.NDArray[np.complex128]

#: Length of a pixel in the task, metres.
PIXEL = 0.001
#: Distance of the finger from the T before a push and on its path there, pixels.
GAP, MARGIN = 2.0, 6.0
#: Steps of a push in addition to its paths, per pixel of distance, and per factor of e.
EXTRA, FAR, FACTOR = 4.0, 0.35, 12.0
#: Sufficient distance, pixels, and error of predictions as a share of the travel.
NEAR, DOUBT = 1.2, 0.05
#: Number of pushes that are extended by a second push.
BEAM = 8


@dataclass(frozen=True)
class Board:
    """A T, a finger and the arena, with the task in which pushes are predicted."""

    task: pushplan.Task
    tool: pushplan.Tool
    #: Outline of the T in its own frame, and the centre of its bar, which is the object's position.
    shape: Any
    bar: complex
    finger: float
    #: Area of valid targets of the agent, and inner edges of the walls, pixels.
    arena: Any
    walls: tuple[float, float]
    #: Pixels in a step, on the path and during a push.
    travel: float
    push: float
    #: Points distributed evenly over the T.
    grid: Points

    @cached_property
    def corners(self) -> Points:
        return np.array([complex(x, y) for x, y in shapely.get_coordinates(self.shape)[:-1]])

    def at(self, pose: Floats) -> Any:
        """Returns the T at a pose as a polygon."""
        turned = affinity.rotate(self.shape, pose[2], origin=(0, 0), use_radians=True)
        return affinity.translate(turned, pose[0], pose[1])

    def gap(self, places: complex | Points, tee: Any) -> float:
        """Returns the minimum distance of the finger's centre from the T over these positions."""
        return float(
            np.min(shapely.distance(shapely.points(np.real(places), np.imag(places)), tee))
        )

    def bar_of(self, poses: Floats) -> Floats:
        """Returns the pose of the bar, which is the pose of the object, metres: ``[..., 1, 3]``."""
        middles = placed(poses, np.array([self.bar])) * PIXEL
        return np.stack([middles.real, middles.imag, poses[..., 2, None]], axis=-1)

    def pose_of(self, bar: Floats) -> Floats:
        """Returns the pose of the T from the pose of its bar, pixels."""
        place = (bar[..., 0] + 1j * bar[..., 1]) / PIXEL - self.bar * np.exp(1j * bar[..., 2])
        return np.stack([place.real, place.imag, bar[..., 2]], axis=-1)


def placed(poses: Floats, points: Points) -> Points:
    """Returns the positions of points of the T, ``[..., points]``, for poses ``[..., 3]``."""
    place, turn = poses[..., 0] + 1j * poses[..., 1], np.exp(1j * poses[..., 2])
    found: Points = place[..., None] + points * turn[..., None]
    return found


class Goal:
    """Goal pose of the T, with its distance from a pose and the rule of success."""

    def __init__(
        self, board: Board, pose: Floats, rule: Callable[["Goal", Floats], npt.NDArray[np.bool_]]
    ) -> None:
        self.board, self.pose, self.points = board, pose, placed(pose, board.grid)
        self.outline = board.at(pose)
        self._rule = rule

    def distance(self, poses: Floats) -> Floats:
        """Returns the mean distance of the T's points from their goals, pixels."""
        gaps: Floats = np.abs(placed(poses, self.board.grid) - self.points).mean(axis=-1)
        return gaps

    def covered(self, poses: Floats) -> npt.NDArray[np.bool_]:
        """Returns whether the T is slightly better than the rule of success demands."""
        return self._rule(self, poses)

    def left(self, before: Floats, after: Floats) -> Floats:
        """Returns the expected steps to success from ``after``.

        Each push reduces the distance by about the same factor, and the error of predictions is a
        share of the travel from ``before``.
        """
        grid = self.board.grid
        moved = np.abs(placed(after, grid) - placed(before, grid)).mean(axis=-1)
        distance = np.maximum(self.distance(after) + DOUBT * moved, NEAR)
        steps = FAR * distance + FACTOR * np.log(distance / NEAR)
        found: Floats = np.where(self.covered(after), 0.3 * steps, steps)
        return found


class Pushes(NamedTuple):
    """Pushes with their predictions; every frame stands for a push that ends there."""

    #: Index of the starting pose of each push.
    of: npt.NDArray[np.int64]
    start: Points
    along: Points
    #: Travel of each push, pixels, ``[pushes, frames]``, and pose of the T then, ``[.., 3]``.
    gone: Floats
    poses: Floats


def pushes(
    board: Board, poses: Floats, spots: int, slants: Floats, length: float | np.floating[Any]
) -> Pushes:
    """Predicts pushes from all around the T for several poses, at several angles to the normal."""
    ring = board.shape.buffer(board.finger + GAP).exterior
    at = [ring.interpolate((spot + 0.5) / spots, normalized=True) for spot in range(spots)]
    starts = np.array([complex(point.x, point.y) for point in at])
    touched = [shapely.shortest_line(point, board.shape).coords[1] for point in at]
    inward = np.array([complex(x, y) for x, y in touched]) - starts
    of, spot, slant = (axis.ravel() for axis in np.indices((len(poses), spots, len(slants))))
    start = placed(poses, starts)[of, spot]
    along = np.exp(1j * (np.angle(inward[spot]) + slants[slant] + poses[of, 2]))
    x, y = start.real * PIXEL, start.imag * PIXEL
    rows = [x, y, np.angle(along), np.full(len(of), length * PIXEL), np.full(len(of), 0.1)]
    rolled = pushplan.rollout(
        board.task,
        board.tool,
        np.stack(rows, axis=1),
        grip_yaw=0.0,
        start=board.bar_of(poses)[of],
        model="prior",
        threads=1,
    )
    tips = (rolled.tool_poses[..., 0] + 1j * rolled.tool_poses[..., 1]) / PIXEL
    ends = board.pose_of(rolled.poses[:, :, 0])
    # The finger must stay in the arena, and the T must not leave it farther than at the start.
    corners = placed(ends, board.corners)
    sides = np.stack([np.real(corners), np.imag(corners)])
    low, high = board.walls
    outside = np.maximum(np.maximum(low - sides, sides - high).max(axis=(0, -1)), 0.0)
    reached = shapely.contains_xy(board.arena, np.real(tips), np.imag(tips))
    fine = np.logical_and.accumulate(reached & (outside <= outside[:, :1] + 0.5), axis=1)
    last = np.maximum(fine.sum(axis=1) - 1, 0)
    frame = np.minimum(np.arange(ends.shape[1]), last[:, None])
    gone = np.take_along_axis(np.abs(tips - start[:, None]), frame, axis=1)
    return Pushes(of, start, along, gone, np.take_along_axis(ends, frame[..., None], axis=1))


class Way:
    """Paths of the finger around a T at rest."""

    def __init__(self, board: Board, agent: complex, pose: Floats) -> None:
        self.board, self.agent, self.tee = board, agent, board.at(pose)
        ring = self.tee.buffer(board.finger + MARGIN).exterior
        count = int(ring.length / 4.0)
        points = [ring.interpolate(index / count, normalized=True) for index in range(count)]
        self.ring = np.array([complex(point.x, point.y) for point in points])
        self.open = shapely.contains_xy(board.arena, np.real(self.ring), np.imag(self.ring))
        self.step = ring.length / count

    def clear(self, ends: Points, start: complex) -> npt.NDArray[np.bool_]:
        """Returns whether straight paths from a position clear the T; they may start in contact."""
        lines = np.stack([np.full(len(ends), start), ends], axis=1)
        straight = shapely.linestrings(np.stack([np.real(lines), np.imag(lines)], axis=-1))
        least = min(self.board.finger + 1.0, self.board.gap(start, self.tee) - 0.1)
        ok: npt.NDArray[np.bool_] = shapely.distance(straight, self.tee) >= least
        return ok

    def arc(self, end: complex) -> Points | None:
        """Returns the shorter path along the ring in the arena, or ``None``."""
        first, last = (int(np.argmin(np.abs(self.ring - at))) for at in (self.agent, end))
        count = len(self.ring)
        onward = [(first + k) % count for k in range((last - first) % count + 1)]
        back = [(first - k) % count for k in range((first - last) % count + 1)]
        ways = [way for way in (onward, back) if self.open[way].all()]
        return self.ring[min(ways, key=len)] if ways else None

    def lengths(self, ends: Points) -> Floats:
        """Returns path lengths to these positions, pixels; infinite without a path."""
        found = np.abs(ends - self.agent)
        for index in np.flatnonzero(~self.clear(ends, self.agent)):
            arc = self.arc(ends[index])
            found[index] = np.inf if arc is None else self.step * len(arc)
        return found

    def to(self, end: complex) -> list[complex]:
        """Returns the corners of a short path to this position."""
        arc = self.arc(end)
        points = np.array([*(arc if arc is not None else []), end])
        # A finger in contact with the T leaves it first.
        touches = self.board.gap(self.agent, self.tee) < self.board.finger + 1.0
        corners = [complex(self.ring[np.argmin(np.abs(self.ring - self.agent))])] if touches else []
        at = corners[0] if touches else self.agent
        while len(points):
            seen = np.flatnonzero(self.clear(points, at))
            last = int(seen[-1]) if len(seen) else 0
            at, points = complex(points[last]), points[last + 1 :]
            corners.append(at)
        return corners


class Push(NamedTuple):
    """Straight motion of the finger, with the expected number of steps to success."""

    start: complex
    end: complex
    steps: float


def choose(goal: Goal, agent: complex, pose: Floats) -> Push | None:
    """Returns the push with the fewest expected steps to success, alone or before a second push."""
    board, near = goal.board, float(goal.distance(pose))
    slants = np.array([-0.6, -0.3, 0.0, 0.3, 0.6])
    first = pushes(board, pose[None], 64, slants, np.clip(2.5 * near, 30, 130))
    starts, place = np.unique(first.start, return_inverse=True)
    way = Way(board, agent, pose).lengths(starts)[place]
    steps = way[:, None] / board.travel + EXTRA + first.gone / board.push
    value = np.where(
        first.gone > np.clip(0.4 * near, 3.0, 30.0), steps + goal.left(pose, first.poses), np.inf
    )
    # The best frame of every push; the best of these are extended by a second push.
    frame = value.argmin(axis=1)
    order = np.argsort(value.min(axis=1))[:BEAM]
    frame, chosen = frame[order], (order, frame[order])
    ends, gone = first.poses[chosen], first.gone[chosen]
    tips = first.start[order] + first.along[order] * gone
    second = pushes(board, ends, 32, np.array([-0.4, 0.0, 0.4]), np.clip(2.0 * near, 30, 130))
    # The path between both pushes is approximated by a circle around the T.
    middle = placed(ends, np.array([3.0 * board.bar]))[:, 0]
    turn = np.abs(np.angle((second.start - middle[second.of]) / (tips - middle)[second.of]))
    later = steps[chosen][second.of] + 90.0 * turn / board.travel + EXTRA
    later = (
        later[:, None]
        + second.gone / board.push
        + goal.left(ends[second.of][:, None], second.poses)
    )
    best = value[chosen]
    np.minimum.at(best, second.of, later.min(axis=1))
    one = int(np.argmin(best))
    if not np.isfinite(best[one]):
        return None
    return Push(complex(first.start[order[one]]), complex(tips[one]), float(best[one]))


class Player(Protocol):
    """Game in which a finger pushes a T."""

    goal: Goal
    pushes: int
    seconds: float

    @property
    def agent(self) -> complex: ...
    @property
    def pose(self) -> Floats: ...
    @property
    def over(self) -> bool: ...
    def follow(self, corners: list[complex]) -> None: ...
    def push(self, end: complex) -> None: ...


def play(game: Player) -> None:
    """Plans and executes pushes until the game is over or no push helps."""
    while not game.over:
        began = time.process_time()
        push = choose(game.goal, game.agent, game.pose)
        way = Way(game.goal.board, game.agent, game.pose).to(push.start) if push else []
        game.seconds += time.process_time() - began
        if push is None:
            break
        game.pushes += 1
        game.follow(way)
        game.push(push.end)
