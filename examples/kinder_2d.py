"""Plays the push and tool environments of KinDER, a benchmark of physical reasoning, by planning.

The environments are unchanged: the player reads the public object-centric state and returns
actions. Their worlds have viscous damping instead of table friction. A slow push moves an object in
the direction in which damping resists least, as on a table, and only the ratio of the resistances
to rotation and translation matters. It is the support of the object in the task; `fit` estimates it
with the friction of the finger from twenty own pushes of a T in other episodes.

    pip install pushplan kindergarden
    python examples/kinder_2d.py --seeds 1000 1050
    python examples/kinder_2d.py DynPushPullHook2D-o5 --seeds 1000 1050
    python examples/kinder_2d.py PushPullHook2D --seeds 1000 1050
"""

import argparse
import warnings
from collections.abc import Iterator
from typing import Any

import kinder  # type: ignore[import-not-found,import-untyped,unused-ignore]
import numpy as np
import numpy.typing as npt
import shapely  # type: ignore[import-not-found,import-untyped,unused-ignore]
from _kinder import Episode, State
from _kinder_hook import HookGame
from _kinder_push import ButtonGame
from _kinder_stick import StickGame
from _tee import PIXEL, Board, Floats, Goal, Way, play, pushes

import pushplan

#: Environments, each with the maximum number of steps.
STEPS = {
    "DynPushT2D-t1": 3000,
    **{f"DynPushPullHook2D-{variant}": 500 for variant in ("o0", "o1", "o5")},
    "PushPullHook2D": 3000,
    **{f"StickButton2D-{variant}": 3000 for variant in ("b1", "b2", "b3", "b5", "b10")},
}
#: Pixels in a unit of the environment.
UNIT = 100.0
#: Largest change of x and of y in one step, pixels. On its way the finger overshoots by a quarter.
STEP, OVERSHOOT = 5.0, 0.25
#: Required accuracy, slightly better than in the environment: pixels and radians.
ACCURACY, TURN = 2.7, np.radians(7.2)
#: Seeds of the episodes in which pushes are recorded, and number of pushes in each.
RECORDED, EACH = range(100000, 100004), 5
#: Support of the blocks: damping of a rectangle acts at its radius of gyration, 1 / sqrt(3) of the
#: distance of its corners.
BLOCKS = 0.577


def board_of(state: State, support: float, friction: float) -> Board:
    """Returns the board of a T with this support and this friction with the finger."""
    tee, finger = state["tblock"], state["robot"]["radius"] * UNIT
    width, across, along = (
        tee[key] * UNIT for key in ("width", "length_horizontal", "length_vertical")
    )
    scene = scene_of(tee)
    for part in (scene["objects"][0], *scene["objects"][0]["parts"]):
        part["support"] = {"spread": support}
    scene["frictions"] = [{"between": ["tee", "tool"], "coefficient": friction}]
    whole: Any = {
        "scene": scene,
        "robot": {"reach": {"min": 0, "max": 2}, "hand": "none", "base": "none"},
        "tools": ["finger"],
        "goal": {"object": "tee", "position": [0.25, 0.25], "tolerance": 0.003},
    }
    task = pushplan.Task.from_dict(whole)
    tip: Any = {"name": "tip", "shape": finger_of(state), "position": [0, 0]}
    tool = pushplan.Tool.from_dict({"name": "finger", "friction": 0.5, "parts": [tip]})
    bar = shapely.box(-across / 2, -width, across / 2, 0)
    stem = shapely.box(-width / 2, -width - along, width / 2, -width)
    shape = shapely.union_all([bar, stem])
    inside = [(x, y) for x in range(-95, 96, 10) for y in range(-205, 6, 10)]
    return Board(
        task=task,
        tool=tool,
        shape=shape,
        bar=-0.5j * width,
        finger=finger,
        arena=shapely.box(finger + 1, finger + 1, 499 - finger, 499 - finger),
        walls=(1.0, 499.0),
        travel=STEP,
        push=STEP,
        grid=np.array([x + 1j * y for x, y in inside if shape.covers(shapely.Point(x, y))]),
    )


def scene_of(tee: dict[str, float]) -> dict[str, Any]:
    """Returns the scene of a T: its mass is distributed evenly."""
    width, across, along = (
        tee[key] * UNIT * PIXEL for key in ("width", "length_horizontal", "length_vertical")
    )
    pose = np.array([tee["x"] * UNIT, tee["y"] * UNIT, tee["theta"]])
    place = complex(*pose[:2]) * PIXEL - 0.5j * width * np.exp(1j * pose[2])
    return {
        "objects": [
            {
                "name": "tee",
                "shape": {"cuboid": {"size": [across, width, 0.03]}},
                "parts": [
                    {
                        "shape": {"cuboid": {"size": [width, along, 0.03]}},
                        "position": [0, -(width + along) / 2],
                    }
                ],
                "mass": 1,
                "friction": 0.5,
                "position": [place.real, place.imag],
                "yaw_deg": float(np.degrees(pose[2])),
            }
        ]
    }


def two_bars(tee: dict[str, float]) -> dict[str, Any]:
    """Returns the scene of a T for recordings, which have no compound objects."""
    scene = scene_of(tee)
    [bar] = scene["objects"]
    [part] = bar.pop("parts")
    stem = {**bar, "name": "stem", "shape": part["shape"]}
    areas = [body["shape"]["cuboid"]["size"] for body in (bar, stem)]
    for body, size in zip((bar, stem), areas):
        body["mass"] = size[0] * size[1] / sum(x * y for x, y, _ in areas)
        del body["position"]
    joint = {"between": ["tee", "stem"], "kind": "fixed"}
    return {"objects": [bar, stem], "joints": [joint]}


def finger_of(state: State) -> dict[str, Any]:
    return {"cylinder": {"radius": state["robot"]["radius"] * UNIT * PIXEL, "height": 0.05}}


class TeeGame(Episode):
    """Episode of `DynPushT2D`: a finger pushes a T to a pose."""

    def __init__(self, seed: int, steps: int, support: float, friction: float) -> None:
        super().__init__("kinder/DynPushT2D-t1-v0", seed, steps)
        self.board = board_of(self.state, support, friction)
        self.pushes, self.seconds = 0, 0.0
        wanted = self.pose_of("goal_tblock")
        # The environment compares headings from -pi to pi without wrapping them.
        wanted[2] = np.clip(wanted[2], -np.pi + TURN / 2, np.pi - TURN / 2)
        self.goal = Goal(self.board, wanted, reached)

    def pose_of(self, name: str) -> Floats:
        thing = self.state[name]
        return np.array([thing["x"] * UNIT, thing["y"] * UNIT, thing["theta"]])

    @property
    def pose(self) -> Floats:
        return self.pose_of("tblock")

    @property
    def agent(self) -> complex:
        robot = self.state["robot"]
        return complex(robot["x"], robot["y"]) * UNIT

    def play(self) -> None:
        play(self)

    def follow(self, corners: list[complex]) -> None:
        """Moves the finger along these corners without touching the T."""
        tee = self.board.at(self.pose)
        for corner in corners:
            while not self.over and abs(corner - self.agent) > 0.2:
                least = min(self.board.finger + 0.5, self.board.gap(self.agent, tee) - 0.1)
                for pace in (1.0, 0.5, 0.25, 0.1):
                    step = limited((corner - self.agent) * pace)
                    if self.board.gap(self.agent + (1 + OVERSHOOT) * step, tee) > least:
                        break
                self.move(step)

    def push(self, end: complex) -> None:
        """Moves the finger straight on until it has been at this position."""
        while not self.over:
            rest = (end - self.agent) / (1 + OVERSHOOT)
            self.move(limited(rest))
            if limited(rest) == rest:
                break

    def move(self, step: complex) -> None:
        self.act([step.real / UNIT, step.imag / UNIT])


def limited(step: complex) -> complex:
    """Returns the part of a step that the finger makes at once."""
    return step / max(abs(step.real) / STEP, abs(step.imag) / STEP, 1.0)


def reached(goal: Goal, poses: Floats) -> npt.NDArray[np.bool_]:
    """Returns whether a T is slightly nearer to its goal than the environment demands."""
    miss = np.abs(poses - goal.pose)
    turn = np.abs(np.angle(np.exp(1j * (poses[..., 2] - goal.pose[2]))))
    near: npt.NDArray[np.bool_] = (miss[..., :2] < ACCURACY).all(axis=-1) & (turn < TURN)
    return near


def recorded(seed: int) -> Iterator[pushplan.Recording]:
    """Yields recordings of random pushes in one episode."""
    game, draws = TeeGame(seed, 10**6, 0.7, 0.5), np.random.default_rng(seed)
    for _ in range(EACH):
        pose = game.pose
        tried = pushes(game.board, pose[None], 64, np.array([-0.5, 0.0, 0.5]), 40.0)
        ways = Way(game.board, game.agent, pose).lengths(tried.start)
        able = np.flatnonzero(np.isfinite(ways) & (tried.gone[:, -1] > 39.0))
        if not len(able):
            return
        one = draws.choice(able)
        start, along = complex(tried.start[one]), complex(tried.along[one])
        game.follow(Way(game.board, game.agent, pose).to(start))
        scene, frames = two_bars(game.state["tblock"]), [frame_of(game, 0.0)]
        while abs(game.agent - start) < 35.0:
            # The T follows the overshoot of the finger.
            step = limited(along * STEP)
            game.move(step)
            frames.append(frame_of(game, OVERSHOOT * step))
        yield pushplan.Recording.from_dict(
            {
                "schema_version": 1,
                "kind": "recording",
                "scene": scene,
                "pusher": finger_of(game.state),
                "frame_time": 0.5,
                "frames": frames,
            }
        )


def frame_of(game: TeeGame, beyond: complex) -> dict[str, Any]:
    """Returns a frame with the finger this far beyond its position."""
    at = (game.agent + beyond) * PIXEL
    [bar] = game.board.bar_of(game.pose)
    tee = game.state["tblock"]
    away = 0.5j * (tee["width"] + tee["length_vertical"]) * UNIT * PIXEL * np.exp(1j * bar[2])
    yaw = float(np.degrees(bar[2]))
    stem = complex(bar[0], bar[1]) - away
    places = [[float(bar[0]), float(bar[1]), yaw], [stem.real, stem.imag, yaw]]
    return {"pusher": [at.real, at.imag], "objects": places}


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("environment", nargs="?", choices=STEPS, default="DynPushT2D-t1")
    parser.add_argument("--seeds", type=int, nargs=2, default=[0, 2], metavar=("FROM", "BELOW"))
    parser.add_argument("--steps", type=int, help="maximum number of steps")
    options = parser.parse_args()
    warnings.filterwarnings("ignore", module="gymnasium")
    kinder.register_all_environments()
    steps = options.steps or STEPS[options.environment]
    seeds, games = range(*options.seeds), []
    support = friction = BLOCKS
    if options.environment == "DynPushT2D-t1":
        fit = pushplan.fit([one for seed in RECORDED for one in recorded(seed)])
        print(f"support {fit.support}, friction {fit.friction} from {fit.pushes} pushes")
        if fit.support is None or fit.friction is None:
            raise SystemExit("the recorded pushes do not determine support and friction")
        support, friction = fit.support, fit.friction
    kind, _, variant = options.environment.partition("-")
    for seed in seeds:
        game: TeeGame | HookGame | StickGame | ButtonGame
        if kind == "DynPushT2D":
            game = TeeGame(seed, steps, support, friction)
        elif kind == "DynPushPullHook2D":
            game = HookGame(variant, seed, steps, support)
        elif kind == "PushPullHook2D":
            game = ButtonGame(seed, steps)
        else:
            game = StickGame(variant, seed, steps)
        game.play()
        what = "reached" if game.done else "not reached"
        print(f"seed {seed}: {what} after {game.steps} steps, {game.pushes} pushes", flush=True)
        games.append(game)
    done = [game.steps for game in games if game.done]
    each = sum(game.seconds for game in games) / max(sum(game.pushes for game in games), 1)
    most = f"median {np.median(done):.0f}, maximum {max(done)} steps" if done else "none"
    count = f"{options.environment}: {len(done)} of {len(games)} reached"
    print(f"{count}, {most}; {each:.2f} s of processor time a push")


if __name__ == "__main__":
    main()
