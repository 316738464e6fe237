"""Plays Push-T, a benchmark of imitation learning, by planning.

A round finger pushes a T onto its outline, in 300 steps of 0.1 s; coverage of 95 % of the outline
is success. The planner learns nothing: it reads the true state and knows the shape, while learned
policies use human demonstrations. Before every push it predicts some thousand single pushes and
pairs of pushes. It then executes the push with the smallest expected number of steps to success.

    pip install pushplan gym-pusht 'pymunk<7'
    python examples/push_t.py --seeds 100000 100050
"""

import argparse

import gym_pusht  # type: ignore[import-not-found,import-untyped,unused-ignore]  # noqa: F401
import gymnasium
import numpy as np
import numpy.typing as npt
import shapely  # type: ignore[import-not-found,import-untyped,unused-ignore]
from _tee import Board, Floats, Goal, Points, placed, play

import pushplan

FINGER = 15.0
#: Pixels in a step of 0.1 s, on the path and during a push.
TRAVEL, PUSH = 45.0, 12.0
#: Lengths of a step on the path, pixels; shorter ones are used if a longer one touches the T.
PACES = (60.0, 45.0, 30.0, 20.0, 12.0, 6.0, 2.0)
#: Outline of the T in its own frame, pixels.
SHAPE = shapely.union_all([shapely.box(-60, 0, 60, 30), shapely.box(-15, 30, 15, 120)])
PLACES = [(x, y) for x in range(-55, 60, 10) for y in range(5, 120, 10)]

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
BOARD = Board(
    task=TASK,
    tool=TOOL,
    shape=SHAPE,
    bar=15j,
    finger=FINGER,
    arena=shapely.box(1, 1, 511, 511),
    walls=(7.0, 504.0),
    travel=TRAVEL,
    push=PUSH,
    grid=np.array([x + 1j * y for x, y in PLACES if SHAPE.covers(shapely.Point(x, y))]),
)


def covered(goal: Goal, poses: Floats) -> npt.NDArray[np.bool_]:
    """Returns whether the T covers slightly more than 95 % of the outline."""
    done = goal.distance(poses) < 4.0
    corners = placed(poses[done], BOARD.corners)
    tees = shapely.polygons(np.stack([corners.real, corners.imag], axis=-1))
    done[done] = shapely.area(shapely.intersection(tees, goal.outline)) > 0.955 * SHAPE.area
    return done


class Game:
    """One game in the environment."""

    def __init__(self, seed: int, steps: int) -> None:
        self.seed = seed
        self.env = gymnasium.make("gym_pusht/PushT-v0", max_episode_steps=steps)
        _, self.info = self.env.reset(seed=seed)
        self.goal = Goal(BOARD, self.info["goal_pose"], covered)
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
        play(self)

    def follow(self, corners: list[complex]) -> None:
        """Moves the agent along these corners, as fast as possible without touching the T."""
        shape = BOARD.at(self.pose)
        for corner in corners:
            while not self.over and abs(corner - self.agent) > 1.0:
                rest = corner - self.agent
                least = min(FINGER + 0.5, BOARD.gap(self.agent, shape) - 0.1)
                wanted = self.agent
                for pace in PACES:
                    wanted = self.agent + rest * min(pace / abs(rest), 1.0)
                    if BOARD.gap(self.foreseen(wanted), shape) > least:
                        break
                self.act(wanted)
                if corner != corners[-1] and abs(corner - self.agent) < 8.0:
                    break
            if corner == corners[-1]:
                self.halt(corner)

    def foreseen(self, wanted: complex) -> Points:
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
