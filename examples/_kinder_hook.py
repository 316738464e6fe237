"""Takes an L-shaped hook and pulls a block through clutter to a line (`DynPushPullHook2D`).

Taking the hook is a script: the gripper closes around the end of its long side. From then on the
hook is a tool with a planar pose. Before every stroke a search over a lattice finds the poses that
the tool reaches without touching anything. From these poses some thousand straight strokes are
predicted with all blocks, and the best one is executed up to its best moment.
"""

import itertools
import time
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import shapely  # type: ignore[import-not-found,import-untyped,unused-ignore]
from _kinder import Episode
from scipy.sparse import csr_matrix  # type: ignore[import-not-found,import-untyped,unused-ignore]
from scipy.sparse.csgraph import (  # type: ignore[import-not-found,import-untyped,unused-ignore]
    dijkstra,
)

import pushplan

Floats = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int64]

#: Metres in the task for a unit of the environment.
SCALE = 0.2
#: Steps of the robot: change of x and y, and of the heading, the arm and the fingers.
STEP, TURN, REACH, CLOSE = 0.05, np.pi / 48, 0.1, 0.02
#: Share of a step by which the robot overshoots on its way.
OVERSHOOT = 0.25
#: Lattice of base poses: distance between places, and between headings.
GRID, ANGLES = 0.1, 48
#: Lengths of the arm in the lattice.
ARMS = (0.24, 0.48)
#: Smallest distance of the free tool from blocks, and of the base from walls.
CLEAR, WALL = 0.03, 0.02
#: Size of the world and height of the middle wall, with half of its thickness.
SIZE, MIDDLE, HALF = 3.5, 1.75, 0.025
#: Length of the longest stroke, and number of drawn and of predicted strokes.
STROKE, DRAWN, STROKES = 1.2, 16000, 800
#: Distance at which a block is expected to touch the line, and additional length of its stroke.
TOUCH, BEYOND = 0.003, 0.05
#: Distance within which a stroke must come to a block.
SOON = 0.15
#: Least motion of blocks for each earlier stroke that did not help.
STIR = 0.2
#: Length of the hook between the fingers beyond their middle, and gap of closed fingers.
IN_HAND, CLOSED = 0.06, 0.125
#: Value of a step, in units of distance.
COST = 0.002


class Box(NamedTuple):
    """Rectangle in the frame of the robot's base: centre and full sizes."""

    name: str
    x: float
    y: float
    along: float
    across: float


def hook_boxes(hook: dict[str, float]) -> list[Box]:
    """Returns the boxes of a hook in its own frame."""
    width, long, short = hook["width"], hook["length_side1"], hook["length_side2"]
    return [
        Box("handle", -long / 2, -width / 2, long, width),
        Box("bar", -width / 2, -(width + short) / 2, width, short - width),
    ]


class Stroke(NamedTuple):
    """Straight motion from a pose of the lattice, with its predicted value."""

    value: float
    start: int
    heading: float
    length: float


def corners(boxes: list[Box], poses: Floats) -> Floats:
    """Returns the corners of every box at every pose: ``[poses, boxes, 4, 2]``."""
    local = np.array(
        [
            [
                complex(box.x + a * box.along / 2, box.y + b * box.across / 2)
                for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))
            ]
            for box in boxes
        ]
    )
    place = poses[:, 0] + 1j * poses[:, 1]
    found = place[:, None, None] + local * np.exp(1j * poses[:, 2])[:, None, None]
    return np.stack([found.real, found.imag], axis=-1)


def at(place: complex, turn: float) -> Floats:
    """Returns a pose."""
    return np.array([place.real, place.imag, turn])


def block(thing: dict[str, float]) -> Any:
    """Returns the outline of a rectangular block."""
    pose = np.array([[thing["x"], thing["y"], thing["theta"]]])
    box = Box("block", 0.0, 0.0, thing["width"], thing["height"])
    return shapely.Polygon(corners([box], pose)[0, 0])


class HookGame(Episode):
    """Episode of `DynPushPullHook2D`."""

    def __init__(self, variant: str, seed: int, steps: int, support: float) -> None:
        super().__init__(f"kinder/DynPushPullHook2D-{variant}-v0", seed, steps)
        self.draws = np.random.default_rng(seed)
        self.support, self.seconds, self.pushes, self.idle = support, 0.0, 0, 0
        names = [name for name in self.state if name.startswith("obstruction")]
        self.blocks = ["target_block", *sorted(names)]

    @property
    def base(self) -> Floats:
        robot = self.state["robot"]
        return np.array([robot["x"], robot["y"], robot["theta"]])

    @property
    def arm(self) -> float:
        return self.state["robot"]["arm_joint"]

    @property
    def holds(self) -> bool:
        return self.state["hook"]["held"] > 0.5

    # Motions.

    def move(self, pose: Floats, arm: float | None = None, speed: float = 1.0) -> None:
        """Moves the base straight to a pose, and the arm to a length."""
        turn = np.angle(np.exp(1j * (pose[2] - self.base[2])))
        wanted = np.array([*pose[:2], self.base[2] + turn])
        for _ in range(200):
            rest = np.array([*(wanted - self.base), (arm or self.arm) - self.arm])
            limits = speed * np.array([STEP, STEP, TURN, REACH])
            far = float(np.max(np.abs(rest) / limits))
            if self.over or far < 0.02:
                break
            before = np.array([*self.base, self.arm])
            self.act([*(rest / max(far, 1.0)), 0.0])
            # A base that touches a wall stays where it is.
            if far > 1.0 and np.abs(np.array([*self.base, self.arm]) - before).max() < 1e-3:
                break

    def close(self, until: float) -> None:
        """Closes the gripper until it holds the hook or has this gap."""
        while not (self.over or self.holds) and self.state["robot"]["finger_gap"] > until:
            self.act([0.0, 0.0, 0.0, 0.0, -CLOSE])

    # Geometry.

    def robot_boxes(self, arm: float, gap: float) -> list[Box]:
        """Returns the boxes of arm and gripper."""
        robot = self.state["robot"]
        wide, high = robot["gripper_base_width"], robot["gripper_base_height"]
        long, thick = robot["finger_width"], robot["finger_height"]
        back = arm - wide / 2 - robot["arm_length"]
        return [
            Box("arm", (back + arm) / 2, 0.0, arm - back, wide),
            Box("gripper", arm, 0.0, wide, high),
            Box("left", arm + long / 2, gap / 2, long, thick),
            Box("right", arm + long / 2, -gap / 2, long, thick),
        ]

    def tool(self, arm: float) -> list[Box]:
        """Returns the boxes of arm, gripper and held hook with another length of the arm."""
        hook = self.state["hook"]
        x, y, turn = self.base
        place = complex(hook["x"] - x, hook["y"] - y) * np.exp(-1j * turn) + arm - self.arm
        yaw = hook["theta"] - turn
        found = self.robot_boxes(arm, self.state["robot"]["finger_gap"])
        for box in hook_boxes(self.state["hook"]):
            centre = place + complex(box.x, box.y) * np.exp(1j * yaw)
            # The gripper has aligned the hook with the arm, up to the angle that a grasp allows.
            found.append(Box(box.name, centre.real, centre.imag, box.along, box.across))
        return found

    def free(self, boxes: list[Box], poses: Floats, things: Any, clear: float) -> Any:
        """Returns which poses of the robot keep a distance from things and walls."""
        radius = self.state["robot"]["base_radius"] + WALL
        x, y = poses[:, 0], poses[:, 1]
        fine = (x > radius) & (x < SIZE - radius) & (y > radius)
        fine &= y < MIDDLE - HALF - radius
        if things is None:
            return fine
        shapely.prepare(things)
        index = np.flatnonzero(fine)
        shapes = shapely.polygons(corners(boxes, poses[index]))
        near = shapely.dwithin(shapes, things, clear).any(axis=1)
        places = shapely.points(poses[index, :2])
        near |= shapely.dwithin(places, things, self.state["robot"]["base_radius"] + clear)
        fine[index[near]] = False
        return fine

    # The script that takes the hook.

    def take(self) -> None:
        """Takes the hook by the end of its long side, and makes room behind it before if needed."""
        gap = self.state["robot"]["gripper_base_height"]
        least = self.state["robot"]["base_radius"] + WALL
        for _ in range(6):
            if self.over or self.holds:
                return
            hook = self.state["hook"]
            turn, place = hook["theta"], complex(hook["x"], hook["y"])
            along, width = np.exp(1j * turn), hook["width"]
            pose = np.array([[place.real, place.imag, turn]])
            outline = shapely.union_all(shapely.polygons(corners(hook_boxes(self.state["hook"]), pose)[0]))
            lattice = Lattice(self, [self.robot_boxes(ARMS[0], gap)], outline)
            grasp = place - (hook["length_side1"] + ARMS[0] + IN_HAND + 0.5j * width) * along
            if any(lattice.go(at(grasp - back * along, turn), 0) for back in (0.16, 0.08, 0.0)):
                ready = self.base
                self.move(at(grasp, turn), speed=0.5)
                self.close(CLOSED)
                if not self.holds:
                    self.open(gap)
                    self.move(ready)
                continue
            # From inside the L the gripper pushes the short side along the long one.
            ready = place - (width + ARMS[0] + 0.26 + 0.40j) * along
            if not lattice.go(at(ready, turn), 0):
                return
            far = max(least + 0.1 - grasp.real, 0.1) + 0.06
            self.move(at(ready + far * along, turn))
            self.move(at(ready, turn))

    def open(self, gap: float) -> None:
        while not self.over and self.state["robot"]["finger_gap"] < gap - 0.005:
            self.act([0.0, 0.0, 0.0, 0.0, CLOSE])

    # Strokes.

    def play(self) -> None:
        self.take()
        while not self.over and self.holds and self.pushes < 60:
            began = time.process_time()
            done = self.stroke()
            self.seconds += time.process_time() - began
            if not done:
                return

    def task(self) -> pushplan.Task:
        """Returns the scene of all blocks; the middle wall is lower than the tool."""
        objects = []
        for index, name in enumerate(self.blocks):
            thing = self.state[name]
            objects.append(
                {
                    "name": name.replace("_", "-"),
                    "shape": {
                        "cuboid": {"size": [thing["width"] * SCALE, thing["height"] * SCALE, 0.06]}
                    },
                    "mass": 1.0,
                    "friction": 0.5,
                    "support": {"spread": self.support},
                    # Rollouts state where the blocks are, which may touch.
                    "position": [0.2 * index, -0.3],
                }
            )
        thin, span = 2 * HALF * SCALE, SIZE * SCALE
        walls = [("middle", span / 2, MIDDLE * SCALE, span, thin)]
        walls += [("top", span / 2, span + thin / 2, span, thin)]
        sides = (("left", -thin / 2), ("right", span + thin / 2))
        walls += [(name, x, span / 2, thin, span) for name, x in sides]
        obstacles = [
            {"name": name, "size": [along, across, 0.01], "position": [x, y]}
            for name, x, y, along, across in walls
        ]
        pairs = [{"between": [thing["name"], "tool"], "coefficient": 1.0} for thing in objects]
        scene = {"objects": objects, "obstacles": obstacles, "frictions": pairs}
        goal = {"object": "target-block", "position": [0.35, 0.6], "tolerance": 0.01}
        robot = {"reach": {"min": 0, "max": 2}, "hand": "none", "base": "none"}
        whole: Any = {"scene": scene, "robot": robot, "tools": ["hook"], "goal": goal}
        return pushplan.Task.from_dict(whole)

    def poses(self) -> Floats:
        """Returns the poses of all blocks."""
        keys = ("x", "y", "theta")
        return np.array([[self.state[name][key] for key in keys] for name in self.blocks])

    def shape(self, arm: float) -> pushplan.Tool:
        """Returns arm, gripper and hook as a tool that is held at the centre of the base."""
        parts = [
            {
                "name": box.name,
                "size": [box.along * SCALE, box.across * SCALE, 0.03],
                "position": [box.x * SCALE, box.y * SCALE],
            }
            for box in self.tool(arm)
        ]
        joints = [["gripper", "handle"], ["handle", "bar"]]
        whole: Any = {"name": "hook", "friction": 0.5, "parts": parts, "joints": joints}
        return pushplan.Tool.from_dict(whole)

    def value(self, poses: Floats) -> Floats:
        """Returns the distance of the block from the middle wall, with obstructions in its way.

        ``poses`` is ``[..., blocks, 3]``.
        """
        sizes = np.array([[self.state[n]["width"], self.state[n]["height"]] for n in self.blocks])
        cos, sin = np.abs(np.cos(poses[..., 2])), np.abs(np.sin(poses[..., 2]))
        half = 0.5 * np.stack(
            [cos * sizes[:, 0] + sin * sizes[:, 1], sin * sizes[:, 0] + cos * sizes[:, 1]], axis=-1
        )
        low, high = poses[..., :2] - half, poses[..., :2] + half
        gap = np.maximum(low[..., 0, 1] - (MIDDLE + HALF), 0.0)
        overlap = np.minimum(high[..., 1:, 0], high[..., :1, 0]) - np.maximum(
            low[..., 1:, 0], low[..., :1, 0]
        )
        # An obstruction counts if it lies below the block and in its column.
        below = poses[..., 1:, 1] < poses[..., :1, 1]
        away = np.clip((overlap + 0.02) / 0.3, 0.0, 1.0) * below
        found: Floats = np.where(gap > TOUCH, gap + 0.05 + 0.6 * away.sum(axis=-1), 0.0)
        return found

    def stroke(self) -> bool:
        """Executes the best stroke from a free pose; returns whether there is one."""
        before = self.poses()
        things = shapely.union_all([block(self.state[name]) for name in self.blocks])
        lattice = Lattice(self, [self.tool(arm) for arm in ARMS], things)
        best = self.best(lattice, *self.candidates(lattice))
        if best is None:
            return False
        self.pushes += 1
        lattice.follow(best.start)
        way = np.array([np.cos(best.heading), np.sin(best.heading), 0.0])
        self.move(self.base + best.length * way)
        if not self.over:
            # The environment compares the state before its last step.
            self.act(np.zeros(5))
        # After a stroke that did not help, the next one must move more.
        gained = float(self.value(before) - self.value(self.poses()))
        self.idle = self.idle + 1 if gained < 0.02 else 0
        return True

    def candidates(self, lattice: "Lattice") -> tuple[Indices, Floats]:
        """Returns strokes that come near a block soon: poses of the lattice, and headings."""
        reachable = np.flatnonzero(np.isfinite(lattice.steps))
        count = 16 * len(reachable)
        drawn = self.draws.choice(count, min(DRAWN, count), replace=False)
        start, heading = reachable[drawn // 16], drawn % 16 * np.pi / 8
        ahead = np.stack([np.cos(heading), np.sin(heading), np.zeros(len(heading))], axis=1)
        ahead = lattice.poses[start] + SOON * ahead
        near = np.zeros(len(start), bool)
        for level, boxes in enumerate(lattice.boxes):
            mine = np.flatnonzero(lattice.level[start] == level)
            hook = [box for box in boxes if box.name in ("handle", "bar")]
            shapes = shapely.polygons(corners(hook, ahead[mine]))
            near[mine] = shapely.intersects(shapes, lattice.things).any(axis=1)
        able = np.flatnonzero(near)
        chosen = self.draws.choice(able, min(STROKES, len(able)), replace=False)
        return start[chosen], heading[chosen]

    def best(self, lattice: "Lattice", start: Indices, heading: Floats) -> Stroke | None:
        """Returns the predicted stroke of the lowest value, up to its best moment."""
        found: Stroke | None = None
        now, task = self.poses(), self.task()
        scaled = now * np.array([SCALE, SCALE, 1.0])
        for level, arm in enumerate(ARMS):
            mine = np.flatnonzero(lattice.level[start] == level)
            if not len(mine):
                continue
            pose, ways = lattice.poses[start[mine]], heading[mine]
            alike = np.ones(len(mine))
            rows = [
                pose[:, 0] * SCALE,
                pose[:, 1] * SCALE,
                ways,
                alike * STROKE * SCALE,
                alike * 0.1,
            ]
            rolled = pushplan.rollout(
                task,
                self.shape(arm),
                np.stack(rows, axis=1),
                grip_yaw=pose[:, 2],
                start=scaled,
                model="prior",
            )
            ends = rolled.poses / np.array([SCALE, SCALE, 1.0])
            tips = rolled.tool_poses[..., :2] / SCALE
            gone = np.linalg.norm(tips - pose[:, None, :2], axis=-1)
            # The base must stay in its half.
            inside = self.free([], tips.reshape(-1, 2), None, 0.0).reshape(gone.shape)
            moved = np.abs(ends - now)[..., :2].sum(axis=(-1, -2))
            fine = np.logical_and.accumulate(inside, axis=1)
            fine &= (gone > 0.02) & (moved >= STIR * self.idle)
            steps = lattice.steps[start[mine], None] + gone / STEP
            value = np.where(fine, self.value(ends) + COST * steps, np.inf)
            one, frame = np.unravel_index(np.argmin(value), value.shape)
            if np.isfinite(value[one, frame]) and (
                found is None or value[one, frame] < found.value
            ):
                touches = float(self.value(ends[one, frame])) == 0.0
                length = float(gone[one, frame]) + (BEYOND if touches else 0.0)
                found = Stroke(
                    float(value[one, frame]), int(start[mine[one]]), float(ways[one]), length
                )
        return found


def graph_of(free: npt.NDArray[np.bool_]) -> Any:
    """Returns the graph of free poses ``[arms, columns, rows, headings]`` with steps of the robot.

    Two steps of the robot are one of the lattice, and diagonal steps take as long as straight ones.
    """
    number = np.arange(free.size).reshape(free.shape)
    moves = [(0, *move) for move in itertools.product((-1, 0, 1), repeat=3) if any(move)]
    tails, heads, costs = [], [], []
    for move in [*moves, (1, 0, 0, 0), (-1, 0, 0, 0)]:
        moved = np.roll(number, [-step for step in move], axis=(0, 1, 2, 3))
        valid = free & free[np.unravel_index(moved, free.shape)]
        # Headings go round; arms and places end.
        for axis, step in enumerate(move[:3]):
            edge = [slice(None)] * 4
            edge[axis] = slice(-1, None) if step > 0 else slice(0, max(-step, 0))
            valid[tuple(edge)] = False if step else valid[tuple(edge)]
        tails.append(number[valid])
        heads.append(moved[valid])
        cost = 3.0 if move[0] else 2.0 + 1e-3 * sum(map(abs, move))
        costs.append(np.full(int(valid.sum()), cost))
    ends = (np.concatenate(tails), np.concatenate(heads))
    return csr_matrix((np.concatenate(costs), ends), shape=(free.size, free.size))


class Lattice:
    """Poses of the robot on a lattice, with the steps to reach them without touching anything."""

    def __init__(self, game: HookGame, boxes: list[list[Box]], things: Any) -> None:
        self.game, self.boxes, self.things = game, boxes, things
        x0, y0, turn0 = game.base
        columns = np.arange(np.ceil((0.2 - x0) / GRID), np.floor((SIZE - 0.2 - x0) / GRID) + 1)
        rows = np.arange(np.ceil((0.2 - y0) / GRID), np.floor((MIDDLE - 0.2 - y0) / GRID) + 1)
        shape = (len(boxes), len(columns), len(rows), ANGLES)
        level, i, j, k = np.indices(shape).reshape(4, -1)
        x, y = x0 + GRID * columns[i], y0 + GRID * rows[j]
        self.poses = np.stack([x, y, turn0 + 2 * np.pi / ANGLES * k], axis=1)
        self.level = level
        free = np.concatenate(
            [
                game.free(one, self.poses[level == number], things, CLEAR)
                for number, one in enumerate(boxes)
            ]
        )
        arms = np.array(ARMS[: len(boxes)])
        nearest = int(np.argmin(np.abs(arms - game.arm)))
        self.start = int(np.ravel_multi_index((nearest, int(-columns[0]), int(-rows[0]), 0), shape))
        # The robot may begin in contact.
        free[self.start] = True
        self.steps, self.before = dijkstra(
            graph_of(free.reshape(shape)), indices=self.start, return_predecessors=True
        )

    def go(self, goal: Floats, level: int) -> bool:
        """Moves the robot to a pose near the lattice; returns whether there is a way."""
        if not self.game.free([], goal[None], None, 0.0)[0]:
            return False
        near = np.abs(self.poses[:, :2] - goal[:2]).max(axis=1) < GRID
        turn = np.abs(np.angle(np.exp(1j * (self.poses[:, 2] - goal[2])))) < 2 * np.pi / ANGLES
        options = np.flatnonzero(near & turn & (self.level == level) & np.isfinite(self.steps))
        if not len(options):
            return False
        miss = np.abs(self.poses[options, :2] - goal[:2]).sum(axis=1)
        self.follow(int(options[np.argmin(miss)]))
        self.game.move(goal)
        return True

    def follow(self, index: int) -> None:
        """Moves the robot to a pose of the lattice."""
        way = []
        while index != self.start:
            way.append(index)
            index = int(self.before[index])
        for one in reversed(way):
            self.game.move(self.poses[one], ARMS[self.level[one]])
