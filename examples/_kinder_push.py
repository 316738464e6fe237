"""Brings a button to another one with a hook (`PushPullHook2D`).

The world is kinematic: a held hook moves the button out of its way along the contact normal,
without friction. A flat side that moves along its own normal therefore moves the button straight
along. The player rotates the hook until one of its four long sides faces the way to the goal, finds
a way to the start of that stroke on a lattice of poses, and makes the stroke.
"""

import itertools
import time

import numpy as np
import numpy.typing as npt
import shapely  # type: ignore[import-not-found,import-untyped,unused-ignore]
from _kinder import Episode
from _kinder_hook import Box, Floats, at, corners, graph_of, hook_boxes
from scipy.sparse.csgraph import (  # type: ignore[import-not-found,import-untyped,unused-ignore]
    dijkstra,
)

Mask = npt.NDArray[np.bool_]

#: Steps of the robot: change of x and y, of the heading, and of the arm.
STEP, TURN, REACH = 0.05, np.pi / 16, 0.1
#: Size of the world, and edge of the table, which the robot's base does not cross.
WIDE, HIGH, EDGE = 3.5, 2.5, 1.25
#: Lattice of base poses: distance between places, and number of headings.
GRID, ANGLES = 0.1, 48
#: Distance that the robot keeps from things and walls.
CLEAR = 0.02
#: Distance of the gripper from the hook when it is taken, and at which strokes begin.
TAKEN, BEFORE = 0.013, 0.03
#: Strokes until the episode is given up.
MOST = 12


class ButtonGame(Episode):
    """Episode of `PushPullHook2D`."""

    def __init__(self, seed: int, steps: int) -> None:
        super().__init__("kinder/PushPullHook2D-v0", seed, steps)
        self.pushes, self.seconds, self.vacuum = 0, 0.0, 0.0
        #: Grips that were tried.
        self.tried: list[int] = []

    @property
    def base(self) -> Floats:
        robot = self.state["robot"]
        return np.array([robot["x"], robot["y"], robot["theta"]])

    def place(self, name: str) -> complex:
        return complex(self.state[name]["x"], self.state[name]["y"])

    def move(self, pose: Floats, speed: float = 1.0) -> bool:
        """Moves the base straight to a pose with a stretched arm; returns whether it arrives."""
        while not self.over:
            robot = self.state["robot"]
            turn = np.angle(np.exp(1j * (pose[2] - robot["theta"])))
            arm = robot["arm_length"] - robot["arm_joint"]
            rest = np.array([pose[0] - robot["x"], pose[1] - robot["y"], turn, arm])
            far = float(np.max(np.abs(rest) / (speed * np.array([STEP, STEP, TURN, REACH]))))
            if far < 1e-3:
                return True
            before = self.base
            self.act([*(rest / max(far, 1.0)), self.vacuum])
            if np.array_equal(self.base, before) and robot == self.state["robot"]:
                # A step into a wall or a thing changes nothing.
                return False
        return False

    def robot_boxes(self) -> list[Box]:
        """Returns the boxes of the stretched arm with its gripper, in the frame of the base."""
        robot = self.state["robot"]
        long, wide = robot["arm_length"], robot["gripper_height"]
        return [Box("arm", long / 2, 0.0, long, wide)]

    def outlines(self, poses: Floats, hook: Floats | None) -> Floats:
        """Returns the corners of arm and held hook: ``[poses, boxes, 4, 2]``.

        ``hook`` is the pose of the hook in the frame of the base.
        """
        found = [corners(self.robot_boxes(), poses)]
        if hook is not None:
            there = (poses[:, 0] + 1j * poses[:, 1]) + complex(*hook[:2]) * np.exp(1j * poses[:, 2])
            turned = np.stack([there.real, there.imag, poses[:, 2] + hook[2]], axis=1)
            found.append(corners(hook_boxes(self.state["hook"]), turned))
        return np.concatenate(found, axis=1)

    def free(self, poses: Floats, hook: Floats | None, things: shapely.Geometry) -> Mask:
        """Returns which poses keep clear of things, walls and the table."""
        radius = self.state["robot"]["base_radius"]
        x, y = poses[:, 0], poses[:, 1]
        low = radius + 0.5 * CLEAR
        fine = (x > low) & (x < WIDE - low) & (y > low) & (y < EDGE - low)
        index = np.flatnonzero(fine)
        shapes = self.outlines(poses[index], hook)
        edge = 0.5 * CLEAR
        inside = (shapes > edge).all(axis=(1, 2, 3))
        inside &= (shapes[..., 0] < WIDE - edge).all(axis=(1, 2))
        inside &= (shapes[..., 1] < HIGH - edge).all(axis=(1, 2))
        shapely.prepare(things)
        near = np.any(shapely.dwithin(shapely.polygons(shapes), things, CLEAR), axis=1)
        near |= shapely.dwithin(shapely.points(poses[index, :2]), things, radius + CLEAR)
        fine[index[near | ~inside]] = False
        return fine

    def go(self, goals: list[Floats], hook: Floats | None, things: shapely.Geometry) -> int | None:
        """Moves to the nearest of some poses without touching things; returns its index."""
        x0, y0, turn0 = self.base
        columns = np.arange(np.ceil(-x0 / GRID), np.floor((WIDE - x0) / GRID) + 1)
        rows = np.arange(np.ceil(-y0 / GRID), np.floor((EDGE - y0) / GRID) + 1)
        shape = (1, len(columns), len(rows), ANGLES)
        _, i, j, k = np.indices(shape).reshape(4, -1)
        turns = turn0 + 2 * np.pi / ANGLES * k
        poses = np.stack([x0 + GRID * columns[i], y0 + GRID * rows[j], turns], axis=1)
        open_poses = self.free(poses, hook, things)
        start = int(np.ravel_multi_index((0, int(-columns[0]), int(-rows[0]), 0), shape))
        # The robot may begin in contact.
        open_poses[start] = True
        graph = graph_of(open_poses.reshape(shape))
        steps, before = dijkstra(graph, indices=start, return_predecessors=True)
        best: tuple[float, int, int] | None = None
        allowed = self.free(np.array(goals), hook, things) if goals else np.zeros(0, bool)
        for index in map(int, np.flatnonzero(allowed)):
            goal = goals[index]
            near = np.abs(poses[:, :2] - goal[:2]).max(axis=1) < GRID
            near &= np.abs(np.angle(np.exp(1j * (poses[:, 2] - goal[2])))) < 2 * np.pi / ANGLES
            for one in map(int, np.flatnonzero(near & np.isfinite(steps))):
                if best is None or steps[one] < best[0]:
                    best = (float(steps[one]), one, index)
        if best is None:
            return None
        way = [best[1]]
        while way[-1] != start:
            way.append(int(before[way[-1]]))
        for one in reversed(way[:-1]):
            self.move(poses[one])
        self.move(goals[best[2]])
        return best[2]

    def take(self) -> Floats | None:
        """Takes the hook at its handle; returns its pose in the frame of the base."""
        hook = self.state["hook"]
        turn, corner = hook["theta"], self.place("hook")
        along, aside = np.exp(1j * turn), 1j * np.exp(1j * turn)
        long, width = hook["length_side1"], hook["width"]
        reach = self.state["robot"]["arm_length"]
        # Points on the surface with their outward normals: the end, then both sides near it.
        points = [(corner - long * along - 0.5 * width * aside, -along)]
        for back in np.arange(0.04, 0.9, 0.08):
            foot = corner - (long - back) * along
            points += [(foot, aside), (foot - width * aside, -aside)]
        pose = np.array([[corner.real, corner.imag, turn]])
        outline = shapely.union_all(shapely.polygons(corners(hook_boxes(self.state["hook"]), pose)[0]))
        things = shapely.union_all([outline, self.button()])
        waits, able = [], []
        for point, normal in points:
            turned = float(np.angle(-normal))
            waits.append(at(point + (reach + TAKEN + 2 * CLEAR) * normal, turned))
            base = point + (reach + TAKEN) * normal
            able.append(len(self.strokes(self.seen(at(base, turned)), self.way(0.0))))
        # The first choice is a grip with which a stroke leads to the goal.
        for fewest in (1, 0):
            some = [k for k, count in enumerate(able) if count >= fewest and k not in self.tried]
            chosen = self.go([waits[k] for k in some], None, things)
            if chosen is not None:
                break
        else:
            return None
        self.tried.append(some[chosen])
        point, normal = points[some[chosen]]
        self.move(at(point + (reach + TAKEN) * normal, waits[some[chosen]][2]), speed=0.3)
        # The vacuum holds objects that it touched before the step.
        self.vacuum = 1.0
        self.act([0.0, 0.0, 0.0, 0.0, self.vacuum])
        return self.seen(self.base)

    def release(self) -> None:
        """Leaves the hook where it is."""
        self.vacuum = 0.0
        x, y, turn = self.base
        self.move(at(complex(x, y) - 3 * CLEAR * np.exp(1j * turn), turn))

    def seen(self, base: Floats) -> Floats:
        """Returns the pose of the hook in the frame of a base."""
        place = (self.place("hook") - complex(*base[:2])) * np.exp(-1j * base[2])
        return np.array([place.real, place.imag, self.state["hook"]["theta"] - base[2]])

    def way(self, turn: float) -> complex:
        """Returns the direction from the button to the other one, rotated."""
        return self.rest() / abs(self.rest()) * complex(np.exp(1j * turn))

    def button(self) -> shapely.Geometry:
        middle = self.place("movable_button")
        radius = self.state["movable_button"]["radius"]
        return shapely.Point(middle.real, middle.imag).buffer(radius)

    def strokes(self, hook: Floats, way: complex) -> list[Floats]:
        """Returns base poses from which a stroke along `way` moves the button straight."""
        button, radius = self.place("movable_button"), self.state["movable_button"]["radius"]
        thing = self.state["hook"]
        width, long, short = thing["width"], thing["length_side1"], thing["length_side2"]
        # Sides in the hook's frame: normal, and both ends without their last centimetres.
        off = 0.06
        sides = [
            (1j, complex(-long + off, 0.0), complex(-off, 0.0)),
            (-1j, complex(-long + off, -width), complex(-width - 2 * radius, -width)),
            (1 + 0j, complex(0.0, -short + off), complex(0.0, -off)),
            (-1 + 0j, complex(-width, -short + off), complex(-width, -width - 2 * radius)),
        ]
        starts, ends = [], []
        for (normal, first, last), share in itertools.product(sides, np.linspace(0.0, 1.0, 9)):
            turn = float(np.angle(way) - np.angle(normal))
            point = first + (last - first) * share
            corner = button - (radius + BEFORE) * way - point * np.exp(1j * turn)
            heading = turn - hook[2]
            there = corner - complex(*hook[:2]) * np.exp(1j * heading)
            starts.append(at(there, heading))
            ends.append(at(there + (BEFORE + abs(self.rest())) * way, heading))
        fine = self.free(np.array(ends), hook, shapely.Point(-9, -9))
        return [start for start, one in zip(starts, fine) if one]

    def rest(self) -> complex:
        """Returns the way of the button to the other one."""
        return self.place("target_button") - self.place("movable_button")

    def play(self) -> None:
        began = time.process_time()
        while not self.over and self.pushes < MOST:
            hook = self.take()
            if hook is None:
                break
            while not self.over and self.pushes < MOST and self.stroke(hook):
                pass
            if not self.over:
                self.release()
        self.seconds = time.process_time() - began

    def stroke(self, hook: Floats) -> bool:
        """Makes one stroke with the held hook; returns whether the button came nearer."""
        before = abs(self.rest())
        # If no side can make the whole way, a detour to either side comes first.
        for turn in (0.0, 0.5, -0.5, 1.0, -1.0, 1.5, -1.5):
            way = self.way(turn)
            length = max(BEFORE + before * np.cos(turn), BEFORE + 0.1)
            if self.go(self.strokes(hook, way), hook, self.button()) is not None:
                break
        else:
            return False
        self.pushes += 1
        end = complex(*self.base[:2]) + length * way
        self.move(at(end, self.base[2]), speed=0.5)
        # The hook leaves the button before it rotates.
        self.move(at(complex(*self.base[:2]) - 2 * BEFORE * way, self.base[2]))
        return abs(self.rest()) < before - 0.01 or turn != 0.0
