"""Push-T, the benchmark of imitation learning, played by planning.

A round finger pushes a T onto its outline, in 300 steps of 0.1 s; 95 % of the outline covered is
success. Nothing is learned here: the true state is read and the shape is known, where learned
policies know what people have shown them. Before every push some thousand are predicted, alone and
one after another, and the one is made that promises success in the fewest steps.

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

#: The environment counts in pixels; one is taken for a millimetre.
PIXEL = 0.001
#: Where the agent may be told to go, and where the walls begin, pixels.
ARENA, WALLS = shapely.box(1, 1, 511, 511), (7.0, 504.0)
FINGER = 15.0
#: How near the finger comes to the T before a push and on its way there, pixels.
GAP, MARGIN = 2.0, 6.0
#: Pixels in a step of 0.1 s, on the way and while pushing.
TRAVEL, PUSH = 45.0, 12.0
#: What a step on the way may be, pixels, if a longer one touches the T.
PACES = (60.0, 45.0, 30.0, 20.0, 12.0, 6.0, 2.0)
#: Steps that a push takes beside its ways, that a pixel of distance is worth, and a factor of e.
EXTRA, FAR, FACTOR = 4.0, 0.35, 12.0
#: A distance that is near enough, pixels, and by what share of their way predictions are off.
NEAR, DOUBT = 1.2, 0.05
#: How many pushes are looked at with another one behind.
BEAM = 8
#: Corners of the T in its own frame, and points spread evenly over it, pixels.
SHAPE = shapely.union_all([shapely.box(-60, 0, 60, 30), shapely.box(-15, 30, 15, 120)])
PLACES = [(x, y) for x in range(-55, 60, 10) for y in range(5, 120, 10)]
GRID = np.array([x + 1j * y for x, y in PLACES if SHAPE.covers(shapely.Point(x, y))])
CORNERS = np.array([complex(x, y) for x, y in SHAPE.exterior.coords[:-1]])

#: The environment's T has its centre of mass between the middles of bar and stem and no friction
#: against the finger. What moves there stops at once, which resembles a table on which the T
#: stands on the corners of both.
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
    """Where points of the T are, ``[..., points]``, for poses ``[..., 3]``."""
    place, turn = poses[..., 0] + 1j * poses[..., 1], np.exp(1j * poses[..., 2])
    found: npt.NDArray[np.complex128] = place[..., None] + points * turn[..., None]
    return found


def tee(pose: Floats) -> Any:
    """The T as a polygon."""
    turned = affinity.rotate(SHAPE, pose[2], origin=(0, 0), use_radians=True)
    return affinity.translate(turned, pose[0], pose[1])


class Goal:
    """How far a T is from the outline that it has to cover."""

    def __init__(self, pose: Floats) -> None:
        self.points, self.outline = placed(pose, GRID), tee(pose)

    def distance(self, poses: Floats) -> Floats:
        """Mean distance of the T's points from where they belong, pixels."""
        gaps: Floats = np.abs(placed(poses, GRID) - self.points).mean(axis=-1)
        return gaps

    def covered(self, poses: Floats) -> npt.NDArray[np.bool_]:
        """Whether a little more than 95 % of the outline is covered."""
        done = self.distance(poses) < 4.0
        corners = placed(poses[done], CORNERS)
        tees = shapely.polygons(np.stack([corners.real, corners.imag], axis=-1))
        done[done] = shapely.area(shapely.intersection(tees, self.outline)) > 0.955 * SHAPE.area
        return done


def bar_of(poses: Floats) -> Floats:
    """Where the middle of the bar is, whose pose is the object's, metres: ``[..., 1, 3]``."""
    middles = placed(poses, np.array([15j])) * PIXEL
    return np.stack([middles.real, middles.imag, poses[..., 2, None]], axis=-1)


def pose_of(bar: Floats) -> Floats:
    """The pose of the T whose bar is here, pixels."""
    place = (bar[..., 0] + 1j * bar[..., 1]) / PIXEL - 15j * np.exp(1j * bar[..., 2])
    return np.stack([place.real, place.imag, bar[..., 2]], axis=-1)


class Pushes(NamedTuple):
    """Pushes and what they are predicted to do: every frame is a push that ends there."""

    #: Which of the starting poses each push is for.
    of: npt.NDArray[np.int64]
    start: npt.NDArray[np.complex128]
    along: npt.NDArray[np.complex128]
    #: How far each has gone, pixels, ``[pushes, frames]``, and where the T is then, ``[.., 3]``.
    gone: Floats
    poses: Floats


def pushes(poses: Floats, spots: int, slants: Floats, length: float | np.floating[Any]) -> Pushes:
    """Pushes from all around the T for each of some poses, along the normal and aslant of it."""
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
    # Neither the finger leaves the arena nor the T, farther than it does already.
    corners = placed(ends, CORNERS)
    sides = np.stack([corners.real, corners.imag])
    outside = np.maximum(np.maximum(WALLS[0] - sides, sides - WALLS[1]).max(axis=(0, -1)), 0.0)
    reached = shapely.contains_xy(ARENA, tips.real, tips.imag)
    fine = np.logical_and.accumulate(reached & (outside <= outside[:, :1] + 0.5), axis=1)
    last = np.maximum(fine.sum(axis=1) - 1, 0)
    frame = np.minimum(np.arange(ends.shape[1]), last[:, None])
    gone = np.take_along_axis(np.abs(tips - start[:, None]), frame, axis=1)
    return Pushes(of, start, along, gone, np.take_along_axis(ends, frame[..., None], axis=1))


class Way:
    """Ways of the finger around a T that stays where it is."""

    def __init__(self, agent: complex, pose: Floats) -> None:
        self.agent, self.tee = agent, tee(pose)
        ring = self.tee.buffer(FINGER + MARGIN).exterior
        count = int(ring.length / 4.0)
        points = [ring.interpolate(index / count, normalized=True) for index in range(count)]
        self.ring = np.array([complex(point.x, point.y) for point in points])
        self.open = shapely.contains_xy(ARENA, self.ring.real, self.ring.imag)
        self.step = ring.length / count

    def clear(self, ends: npt.NDArray[np.complex128], start: complex) -> npt.NDArray[np.bool_]:
        """Whether straight ways from a place meet no T; they may begin where it touches."""
        lines = np.stack([np.full(len(ends), start), ends], axis=1)
        straight = shapely.linestrings(np.stack([lines.real, lines.imag], axis=-1))
        least = min(FINGER + 1.0, gap(start, self.tee) - 0.1)
        ok: npt.NDArray[np.bool_] = shapely.distance(straight, self.tee) >= least
        return ok

    def arc(self, end: complex) -> npt.NDArray[np.complex128] | None:
        """The shorter way along the ring, if one stays in the arena."""
        first, last = (int(np.argmin(np.abs(self.ring - at))) for at in (self.agent, end))
        count = len(self.ring)
        onward = [(first + k) % count for k in range((last - first) % count + 1)]
        back = [(first - k) % count for k in range((first - last) % count + 1)]
        ways = [way for way in (onward, back) if self.open[way].all()]
        return self.ring[min(ways, key=len)] if ways else None

    def lengths(self, ends: npt.NDArray[np.complex128]) -> Floats:
        """How far it is to these places, pixels; infinite where there is no way."""
        found = np.abs(ends - self.agent)
        for index in np.flatnonzero(~self.clear(ends, self.agent)):
            arc = self.arc(ends[index])
            found[index] = np.inf if arc is None else self.step * len(arc)
        return found

    def to(self, end: complex) -> list[complex]:
        """The corners of a short way to this place."""
        arc = self.arc(end)
        points = np.array([*(arc if arc is not None else []), end])
        # What touches the T leaves it first.
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
    """A straight way of the finger, and after how many steps success is promised."""

    start: complex
    end: complex
    steps: float


def left(goal: Goal, before: Floats, after: Floats) -> Floats:
    """Steps to success from ``after``: each push gains about the same factor, and predictions are
    off by a share of the way from ``before``."""
    moved = np.abs(placed(after, GRID) - placed(before, GRID)).mean(axis=-1)
    distance = np.maximum(goal.distance(after) + DOUBT * moved, NEAR)
    steps = FAR * distance + FACTOR * np.log(distance / NEAR)
    found: Floats = np.where(goal.covered(after), 0.3 * steps, steps)
    return found


def choose(goal: Goal, agent: complex, pose: Floats) -> Push | None:
    """The push that promises success in the fewest steps, be it with another one after it."""
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
    # Of every push the best frame; behind the best of those another push is looked at.
    frame = value.argmin(axis=1)
    order = np.argsort(value.min(axis=1))[:BEAM]
    frame, chosen = frame[order], (order, frame[order])
    ends, gone = first.poses[chosen], first.gone[chosen]
    tips = first.start[order] + first.along[order] * gone
    second = pushes(ends, 32, np.array([-0.4, 0.0, 0.4]), np.clip(2.0 * near, 30, 130))
    # The way between both is taken for a circle about the T.
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
    """An environment that is being played."""

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
        """Moves the agent along these corners, as fast as it can without touching the T."""
        shape = tee(self.pose)
        for corner in corners:
            while not self.over and abs(corner - self.agent) > 1.0:
                rest, least = corner - self.agent, min(FINGER + 0.5, gap(self.agent, shape) - 0.1)
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
        """Where the agent is during a step that ends here, and another that stays."""
        state = np.array([self.agent - wanted, complex(*self.info["vel_agent"]), 0.0])
        found = []
        for _ in range(2):
            state[2] = -(MOVE[-1, 0, :2] @ state[:2]) / MOVE[-1, 0, 2]
            found.append(MOVE[:, 0] @ state)
            state[:2] = MOVE[-1] @ state
        return np.concatenate(found) + wanted

    def push(self, end: complex) -> None:
        """Moves the agent straight to the end of a push and lets it rest there."""
        while not self.over and abs(end - self.agent) > 1.3 * PUSH:
            rest = end - self.agent
            self.act(self.agent + rest * PUSH / abs(rest))
        self.halt(end)

    def act(self, wanted: complex) -> None:
        """A step after which the agent is here."""
        state = np.array([self.agent - wanted, complex(*self.info["vel_agent"])])
        self.step(wanted - MOVE[-1, 0, :2] @ state / MOVE[-1, 0, 2])

    def halt(self, wanted: complex) -> None:
        """Two steps after which the agent rests here."""
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
    """The least distance of the finger's middle from the T in any of these places."""
    return float(np.min(shapely.distance(shapely.points(np.real(places), np.imag(places)), shape)))


def controlled() -> Floats:
    """What 1 to 10 hundredths of a second make of place, velocity and action of the agent."""
    once = np.eye(3)
    once[1] += 0.01 * np.array([-100.0, -20.0, 100.0])
    once[0] += 0.01 * once[1]
    return np.stack([np.linalg.matrix_power(once, count)[:2] for count in range(1, 11)])


MOVE = controlled()


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--seeds", type=int, nargs=2, default=[0, 3], metavar=("FROM", "BELOW"))
    parser.add_argument("--steps", type=int, default=300, help="most steps of a game")
    options = parser.parse_args()
    games = [Game(seed, options.steps) for seed in range(*options.seeds)]
    for game in games:
        game.play()
        what = "covered" if game.done else f"{game.info.get('coverage', 0.0):.1%} covered"
        print(f"seed {game.seed}: {what} after {game.steps} steps, {game.pushes} pushes")
    done = [game.steps for game in games if game.done]
    each = sum(game.seconds for game in games) / sum(game.pushes for game in games)
    steps = f"median {np.median(done):.0f}, most {max(done)} steps" if done else "none"
    print(f"{len(done)} of {len(games)} covered, {steps}; {each:.2f} s of processor time a push")
    if len(done) < 0.9 * len(games):
        raise SystemExit("fewer than nine in ten")


if __name__ == "__main__":
    main()
