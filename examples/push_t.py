"""Plays Push-T, a benchmark of imitation learning, by planning.

A round finger pushes a T onto its outline, in 300 steps of 0.1 s; coverage of 95 % of the outline
is success. The planner learns nothing: it reads the true state and knows the shape, while learned
policies use human demonstrations. Before every push it predicts some thousand single pushes and
pairs of pushes. It then executes the push with the smallest expected number of steps to success.

    pip install pushplan gym-pusht
    python examples/push_t.py --seeds 100000 100050
"""

import argparse
import time
from typing import Any, NamedTuple

import gym_pusht  # type: ignore[import-not-found,import-untyped,unused-ignore]  # noqa: F401
import gymnasium
import numpy as np
import numpy.typing as npt
import shapely  # type: ignore[import-not-found,import-untyped,unused-ignore]
from shapely import affinity  # type: ignore[import-not-found,import-untyped,unused-ignore]

import pushplan

Floats = npt.NDArray[np.float64]

#: Length of a pixel of the environment, metres.
PIXEL = 0.001
#: Area of valid targets of the agent, and inner edges of the walls, pixels.
ARENA, WALLS = shapely.box(1, 1, 511, 511), (7.0, 504.0)
FINGER = 15.0
#: Distance of the finger from the T before a push and on its path there, pixels.
GAP, MARGIN = 2.0, 6.0
#: Pixels in a step of 0.1 s, on the path and during a push.
TRAVEL, PUSH = 45.0, 12.0
#: Lengths of a step on the path, pixels; shorter ones are used if a longer one touches the T.
PACES = (60.0, 45.0, 30.0, 20.0, 12.0, 6.0, 2.0)
#: Steps of a push in addition to its paths, per pixel of distance, and per factor of e.
EXTRA, FAR, FACTOR = 4.0, 0.35, 12.0
#: Sufficient distance, pixels, and error of predictions as a share of the travel.
NEAR, DOUBT = 1.2, 0.05
#: Number of pushes that are extended by a second push.
BEAM = 8
#: Corners of the T in its own frame, and points distributed evenly over it, pixels.
SHAPE = shapely.union_all([shapely.box(-60, 0, 60, 30), shapely.box(-15, 30, 15, 120)])
PLACES = [(x, y) for x in range(-55, 60, 10) for y in range(5, 120, 10)]
GRID = np.array([x + 1j * y for x, y in PLACES if SHAPE.covers(shapely.Point(x, y))])
CORNERS = np.array([complex(x, y) for x, y in shapely.get_coordinates(SHAPE)[:-1]])

#: In the environment the centre of mass of the T lies between the centres of bar and stem, and the
#: finger has no friction. Moving bodies stop at once, similar to a T on a table that rests on the
#: corners of both parts.
TASK = pushplan.Task.parse(
    """
    scene:
      objects:
        - name: tee
          shape: {cuboid: {size: [0.12, 0.03, 0.03]}}
          support: corners
          parts:
            - {shape: {cuboid: {size: [0.03, 0.09, 0.03]}}, position: [0, 0.06], mass: 0.5,
               support: corners}
          mass: 1
          friction: 0.5
          position: [0.256, 0.271]
      frictions: [{between: [tee, tool], coefficient: 0}]
    robot: {reach: {min: 0, max: 2}, hand: none, base: none}
    tools: [finger]
    goal: {object: tee, position: [0.256, 0.256], tolerance: 0.002}
    """,
    name="push-t",
)
TOOL = pushplan.Tool.parse(
    """
    name: finger
    friction: 0.5
    parts: [{name: tip, shape: {cylinder: {radius: 0.015, height: 0.05}}, position: [0, 0]}]
    """
)


def placed(poses: Floats, points: npt.NDArray[np.complex128]) -> npt.NDArray[np.complex128]:
    """Returns the positions of points of the T, ``[..., points]``, for poses ``[..., 3]``."""
    place, turn = poses[..., 0] + 1j * poses[..., 1], np.exp(1j * poses[..., 2])
    found: npt.NDArray[np.complex128] = place[..., None] + points * turn[..., None]
    return found


def tee(pose: Floats) -> Any:
    """Returns the T at a pose as a polygon."""
    turned = affinity.rotate(SHAPE, pose[2], origin=(0, 0), use_radians=True)
    return affinity.translate(turned, pose[0], pose[1])


class Goal:
    """Outline that the T must cover, with its distance from a pose."""

    def __init__(self, pose: Floats) -> None:
        self.points, self.outline = placed(pose, GRID), tee(pose)

    def distance(self, poses: Floats) -> Floats:
        """Returns the mean distance of the T's points from their goals, pixels."""
        gaps: Floats = np.abs(placed(poses, GRID) - self.points).mean(axis=-1)
        return gaps

    def covered(self, poses: Floats) -> npt.NDArray[np.bool_]:
        """Returns whether the T covers slightly more than 95 % of the outline."""
        done = self.distance(poses) < 4.0
        corners = placed(poses[done], CORNERS)
        tees = shapely.polygons(np.stack([corners.real, corners.imag], axis=-1))
        done[done] = shapely.area(shapely.intersection(tees, self.outline)) > 0.955 * SHAPE.area
        return done


def bar_of(poses: Floats) -> Floats:
    """Returns the pose of the bar, which is the pose of the object, metres: ``[..., 1, 3]``."""
    middles = placed(poses, np.array([15j])) * PIXEL
    return np.stack([middles.real, middles.imag, poses[..., 2, None]], axis=-1)


def pose_of(bar: Floats) -> Floats:
    """Returns the pose of the T from the pose of its bar, pixels."""
    place = (bar[..., 0] + 1j * bar[..., 1]) / PIXEL - 15j * np.exp(1j * bar[..., 2])
    return np.stack([place.real, place.imag, bar[..., 2]], axis=-1)


class Pushes(NamedTuple):
    """Pushes with their predictions; every frame stands for a push that ends there."""

    #: Index of the starting pose of each push.
    of: npt.NDArray[np.int64]
    start: npt.NDArray[np.complex128]
    along: npt.NDArray[np.complex128]
    #: Travel of each push, pixels, ``[pushes, frames]``, and pose of the T then, ``[.., 3]``.
    gone: Floats
    poses: Floats


def pushes(poses: Floats, spots: int, slants: Floats, length: float | np.floating[Any]) -> Pushes:
    """Predicts pushes from all around the T for several poses, at several angles to the normal."""
    ring = SHAPE.buffer(FINGER + GAP).exterior
    at = [ring.interpolate((spot + 0.5) / spots, normalized=True) for spot in range(spots)]
    starts = np.array([complex(point.x, point.y) for point in at])
    touched = [shapely.shortest_line(point, SHAPE).coords[1] for point in at]
    inward = np.array([complex(x, y) for x, y in touched]) - starts
    of, spot, slant = (axis.ravel() for axis in np.indices((len(poses), spots, len(slants))))
    start = placed(poses, starts)[of, spot]
    along = np.exp(1j * (np.angle(inward[spot]) + slants[slant] + poses[of, 2]))
    x, y = start.real * PIXEL, start.imag * PIXEL
    rows = [x, y, np.angle(along), np.full(len(of), length * PIXEL), np.full(len(of), 0.1)]
    rolled = pushplan.rollout(
        TASK,
        TOOL,
        np.stack(rows, axis=1),
        grip_yaw=0.0,
        start=bar_of(poses)[of],
        model="prior",
        threads=1,
    )
    tips = (rolled.tool_poses[..., 0] + 1j * rolled.tool_poses[..., 1]) / PIXEL
    ends = pose_of(rolled.poses[:, :, 0])
    # The finger must stay in the arena, and the T must not leave it farther than at the start.
    corners = placed(ends, CORNERS)
    sides = np.stack([np.real(corners), np.imag(corners)])
    outside = np.maximum(np.maximum(WALLS[0] - sides, sides - WALLS[1]).max(axis=(0, -1)), 0.0)
    reached = shapely.contains_xy(ARENA, np.real(tips), np.imag(tips))
    fine = np.logical_and.accumulate(reached & (outside <= outside[:, :1] + 0.5), axis=1)
    last = np.maximum(fine.sum(axis=1) - 1, 0)
    frame = np.minimum(np.arange(ends.shape[1]), last[:, None])
    gone = np.take_along_axis(np.abs(tips - start[:, None]), frame, axis=1)
    return Pushes(of, start, along, gone, np.take_along_axis(ends, frame[..., None], axis=1))


class Way:
    """Paths of the finger around a T at rest."""

    def __init__(self, agent: complex, pose: Floats) -> None:
        self.agent, self.tee = agent, tee(pose)
        ring = self.tee.buffer(FINGER + MARGIN).exterior
        count = int(ring.length / 4.0)
        points = [ring.interpolate(index / count, normalized=True) for index in range(count)]
        self.ring = np.array([complex(point.x, point.y) for point in points])
        self.open = shapely.contains_xy(ARENA, np.real(self.ring), np.imag(self.ring))
        self.step = ring.length / count

    def clear(self, ends: npt.NDArray[np.complex128], start: complex) -> npt.NDArray[np.bool_]:
        """Returns whether straight paths from a position clear the T; they may start in contact."""
        lines = np.stack([np.full(len(ends), start), ends], axis=1)
        straight = shapely.linestrings(np.stack([np.real(lines), np.imag(lines)], axis=-1))
        least = min(FINGER + 1.0, gap(start, self.tee) - 0.1)
        ok: npt.NDArray[np.bool_] = shapely.distance(straight, self.tee) >= least
        return ok

    def arc(self, end: complex) -> npt.NDArray[np.complex128] | None:
        """Returns the shorter path along the ring in the arena, or ``None``."""
        first, last = (int(np.argmin(np.abs(self.ring - at))) for at in (self.agent, end))
        count = len(self.ring)
        onward = [(first + k) % count for k in range((last - first) % count + 1)]
        back = [(first - k) % count for k in range((first - last) % count + 1)]
        ways = [way for way in (onward, back) if self.open[way].all()]
        return self.ring[min(ways, key=len)] if ways else None

    def lengths(self, ends: npt.NDArray[np.complex128]) -> Floats:
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
        touches = gap(self.agent, self.tee) < FINGER + 1.0
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


def left(goal: Goal, before: Floats, after: Floats) -> Floats:
    """Returns the expected steps to success from ``after``.

    Each push reduces the distance by about the same factor, and the error of predictions is a share
    of the travel from ``before``.
    """
    moved = np.abs(placed(after, GRID) - placed(before, GRID)).mean(axis=-1)
    distance = np.maximum(goal.distance(after) + DOUBT * moved, NEAR)
    steps = FAR * distance + FACTOR * np.log(distance / NEAR)
    found: Floats = np.where(goal.covered(after), 0.3 * steps, steps)
    return found


def choose(goal: Goal, agent: complex, pose: Floats) -> Push | None:
    """Returns the push with the fewest expected steps to success, alone or before a second push."""
    near = float(goal.distance(pose))
    first = pushes(
        pose[None], 64, np.array([-0.6, -0.3, 0.0, 0.3, 0.6]), np.clip(2.5 * near, 30, 130)
    )
    starts, place = np.unique(first.start, return_inverse=True)
    way = Way(agent, pose).lengths(starts)[place]
    steps = way[:, None] / TRAVEL + EXTRA + first.gone / PUSH
    value = np.where(
        first.gone > np.clip(0.4 * near, 3.0, 30.0), steps + left(goal, pose, first.poses), np.inf
    )
    # The best frame of every push; the best of these are extended by a second push.
    frame = value.argmin(axis=1)
    order = np.argsort(value.min(axis=1))[:BEAM]
    frame, chosen = frame[order], (order, frame[order])
    ends, gone = first.poses[chosen], first.gone[chosen]
    tips = first.start[order] + first.along[order] * gone
    second = pushes(ends, 32, np.array([-0.4, 0.0, 0.4]), np.clip(2.0 * near, 30, 130))
    # The path between both pushes is approximated by a circle around the T.
    middle = placed(ends, np.array([45j]))[:, 0]
    turn = np.abs(np.angle((second.start - middle[second.of]) / (tips - middle)[second.of]))
    later = steps[chosen][second.of] + 90.0 * turn / TRAVEL + EXTRA
    later = later[:, None] + second.gone / PUSH + left(goal, ends[second.of][:, None], second.poses)
    best = value[chosen]
    np.minimum.at(best, second.of, later.min(axis=1))
    one = int(np.argmin(best))
    if not np.isfinite(best[one]):
        return None
    return Push(complex(first.start[order[one]]), complex(tips[one]), float(best[one]))


class Game:
    """One game in the environment."""

    def __init__(self, seed: int, steps: int) -> None:
        self.seed = seed
        self.env = gymnasium.make("gym_pusht/PushT-v0", max_episode_steps=steps)
        _, self.info = self.env.reset(seed=seed)
        self.goal = Goal(self.info["goal_pose"])
        self.steps, self.most, self.done = 0, steps, False
        self.pushes, self.seconds = 0, 0.0

    @property
    def agent(self) -> complex:
        return complex(*self.info["pos_agent"])

    @property
    def pose(self) -> Floats:
        return np.asarray(self.info["block_pose"])

    @property
    def over(self) -> bool:
        return self.done or self.steps >= self.most

    def play(self) -> None:
        while not self.over:
            began = time.process_time()
            push = choose(self.goal, self.agent, self.pose)
            way = Way(self.agent, self.pose).to(push.start) if push else []
            self.seconds += time.process_time() - began
            if push is None:
                break
            self.pushes += 1
            self.follow(way)
            self.push(push.end)

    def follow(self, corners: list[complex]) -> None:
        """Moves the agent along these corners, as fast as possible without touching the T."""
        shape = tee(self.pose)
        for corner in corners:
            while not self.over and abs(corner - self.agent) > 1.0:
                rest, least = corner - self.agent, min(FINGER + 0.5, gap(self.agent, shape) - 0.1)
                wanted = self.agent
                for pace in PACES:
                    wanted = self.agent + rest * min(pace / abs(rest), 1.0)
                    if gap(self.foreseen(wanted), shape) > least:
                        break
                self.act(wanted)
                if corner != corners[-1] and abs(corner - self.agent) < 8.0:
                    break
            if corner == corners[-1]:
                self.halt(corner)

    def foreseen(self, wanted: complex) -> npt.NDArray[np.complex128]:
        """Returns positions of the agent during a step to this target, and a step of rest."""
        state = np.array([self.agent - wanted, complex(*self.info["vel_agent"]), 0.0])
        found = []
        for _ in range(2):
            state[2] = -(MOVE[-1, 0, :2] @ state[:2]) / MOVE[-1, 0, 2]
            found.append(MOVE[:, 0] @ state)
            state[:2] = MOVE[-1] @ state
        return np.concatenate(found) + wanted

    def push(self, end: complex) -> None:
        """Moves the agent straight to the end of a push and stops it there."""
        while not self.over and abs(end - self.agent) > 1.3 * PUSH:
            rest = end - self.agent
            self.act(self.agent + rest * PUSH / abs(rest))
        self.halt(end)

    def act(self, wanted: complex) -> None:
        """Makes one step that ends at this position."""
        state = np.array([self.agent - wanted, complex(*self.info["vel_agent"])])
        self.step(wanted - MOVE[-1, 0, :2] @ state / MOVE[-1, 0, 2])

    def halt(self, wanted: complex) -> None:
        """Makes two steps that end at rest at this position."""
        state = np.array([self.agent - wanted, complex(*self.info["vel_agent"])])
        drift, drive = MOVE[-1, :, :2], MOVE[-1, :, 2]
        steering = np.stack([drift @ drive, drive], axis=1)
        for action in np.linalg.solve(steering, -drift @ drift @ state):
            if not self.over:
                self.step(wanted + complex(action))

    def step(self, action: complex) -> None:
        target = np.clip([action.real, action.imag], 0.0, 512.0)
        _, _, self.done, _, self.info = self.env.step(target)
        self.steps += 1


def gap(places: complex | npt.NDArray[np.complex128], shape: Any) -> float:
    """Returns the minimum distance of the finger's centre from the T over these positions."""
    return float(np.min(shapely.distance(shapely.points(np.real(places), np.imag(places)), shape)))


def controlled() -> Floats:
    """Returns matrices from position, velocity and action to the state after 0.01 to 0.1 s."""
    once = np.eye(3)
    once[1] += 0.01 * np.array([-100.0, -20.0, 100.0])
    once[0] += 0.01 * once[1]
    return np.stack([np.linalg.matrix_power(once, count)[:2] for count in range(1, 11)])


MOVE = controlled()


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--seeds", type=int, nargs=2, default=[0, 3], metavar=("FROM", "BELOW"))
    parser.add_argument("--steps", type=int, default=300, help="maximum number of steps of a game")
    options = parser.parse_args()
    games = [Game(seed, options.steps) for seed in range(*options.seeds)]
    for game in games:
        game.play()
        what = "covered" if game.done else f"{game.info.get('coverage', 0.0):.1%} covered"
        print(f"seed {game.seed}: {what} after {game.steps} steps, {game.pushes} pushes")
    done = [game.steps for game in games if game.done]
    each = sum(game.seconds for game in games) / sum(game.pushes for game in games)
    steps = f"median {np.median(done):.0f}, maximum {max(done)} steps" if done else "none"
    print(f"{len(done)} of {len(games)} covered, {steps}; {each:.2f} s of processor time a push")
    if len(done) < 0.9 * len(games):
        raise SystemExit("fewer than nine in ten games are successful")


if __name__ == "__main__":
    main()
