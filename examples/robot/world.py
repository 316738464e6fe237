"""MuJoCo world with tagged objects on a table, a camera above it, and an arm with position servos.

The world replaces the robot. The planner uses only `photo` and `carry_out`. True masses and
frictions of the objects differ at random from the stated ones.
"""

# The compiled parts of mujoco have no stubs.
# pyright: reportAttributeAccessIssue=false, reportOptionalSubscript=false

from __future__ import annotations

import math
import os
from typing import Any, Callable, Optional

# Rendering without a screen; MUJOCO_GL=osmesa also needs no graphics driver.
os.environ.setdefault("MUJOCO_GL", "egl")

import cv2  # type: ignore[import-not-found,import-untyped,unused-ignore]
import mujoco  # type: ignore[import-not-found,import-untyped,unused-ignore]
import numpy as np
import numpy.typing as npt

import pushplan
from pushplan.poses import Camera, Tag

Floats = npt.NDArray[np.float64]

WIDTH, HEIGHT, FIELD = 1280, 960, 50.0
#: Position and target of the camera, in front of the robot, so that the arm at home hides little.
EYE, MIDDLE = np.array([1.15, 0.0, 0.85]), np.array([0.5, 0.0, 0.0])
#: Position and target of a second camera for the animation.
FILM = np.array([1.3, -0.85, 1.05]), np.array([0.36, 0.0, 0.24])
FAMILY = "DICT_APRILTAG_36h11"
#: Tags on the table by id, with their centres, and edges of the black squares, metres.
TABLE = {0: (0.28, -0.48), 1: (0.80, -0.42), 2: (0.28, 0.48), 3: (0.80, 0.42)}
EDGE, ON_OBJECTS = 0.07, 0.05
FIRST = 10
#: Share of a tag's edge that is black, inside a white margin.
BLACK = 0.7
COLOURS = {
    "table": [0.75, 0.72, 0.66, 1],
    "object": [0.80, 0.35, 0.25, 1],
    "obstacle": [0.35, 0.35, 0.35, 1],
    "tool": [0.25, 0.45, 0.75, 1],
    "arm": [0.93, 0.93, 0.93, 1],
}
#: Speed of the joints on the way home, rad/s.
HOMEWARDS = 0.5
#: Maximum speed of an object at rest, m/s, and maximum time to wait for rest, seconds.
REST, PATIENCE = 1e-3, 5.0


def tags_of(task: pushplan.Task) -> list[Tag]:
    """Returns a tag at the centre of the top of every object."""
    return [Tag(FIRST + k, name, ON_OBJECTS) for k, name in enumerate(task.objects)]


def camera() -> Camera:
    """Returns the calibrated camera; the tags on the table give its pose."""
    focal = HEIGHT / 2 / math.tan(math.radians(FIELD) / 2)
    # MuJoCo's pixel coordinates refer to corners, OpenCV's to centres.
    return Camera(np.array([[focal, 0, WIDTH / 2 - 0.5], [0, focal, HEIGHT / 2 - 0.5], [0, 0, 1]]))


class World:
    """Simulated table of a task; ``poses`` has the true poses, x, y and heading."""

    def __init__(self, task: pushplan.Task, seed: int) -> None:
        self.task = task
        rng = np.random.default_rng(seed)
        #: Ratios of true and stated masses and frictions.
        self.heavier = rng.uniform(0.8, 1.25, len(task.objects))
        self.rougher = rng.uniform(0.85, 1.15, len(task.objects))
        #: Positions of the free joints of the objects.
        self.places: Optional[Floats] = None
        #: Function that is called with model and data after every step, for animations.
        self.watch: Optional[Callable[[Any, Any], None]] = None
        self._build(pushplan.Plan.of(task, task.tools[0] if task.tools else "stick", []))

    def photo(self) -> npt.NDArray[np.uint8]:
        """Returns the image of the camera."""
        mujoco.mj_forward(self.model, self.data)
        with mujoco.Renderer(self.model, HEIGHT, WIDTH) as renderer:
            renderer.update_scene(self.data, "camera")
            return np.ascontiguousarray(renderer.render())

    def carry_out(self, plan: pushplan.Plan) -> None:
        """Executes the joint trajectory of a plan with its tool, and moves the arm home."""
        self._build(plan)
        way = plan.to_dict()["joints"]["points"]
        times = np.array([point["time"] for point in way])
        places = np.array([point["positions"] for point in way])
        speeds = np.array([point["velocities"] for point in way])
        if not np.allclose(places[-1], places[0]):
            # The plan found no free path home; a lifted tool mostly clears all bodies.
            takes = 1.5 * np.abs(places[-1] - places[0]).max() / HOMEWARDS
            times = np.append(times, times[-1] + takes)
            places, speeds = np.vstack([places, places[0]]), np.vstack([speeds, 0 * speeds[0]])
        self.data.qpos[self.joints] = places[0]
        for k in range(math.ceil(times[-1] / self.step)):
            self._steer(*between(times, places, speeds, k * self.step))
        for _ in range(round(PATIENCE / self.step)):
            if self._speed() < REST:
                break
            self._steer(places[-1], speeds[-1])
        self.places = self.data.qpos[self._at()].copy()

    @property
    def poses(self) -> Floats:
        """True poses of the objects; the heading of a toppled object is NaN."""
        found = []
        for name in self.task.objects:
            body = self.data.body(f"object/{name}")
            turn = body.xmat.reshape(3, 3)
            upright = turn[2, 2] > math.cos(math.radians(5))
            found.append(
                [*body.xpos[:2], math.atan2(turn[1, 0], turn[0, 0]) if upright else math.nan]
            )
        return np.array(found)

    def _steer(self, places: Floats, speeds: Floats) -> None:
        self.data.ctrl[self.servos[0]], self.data.ctrl[self.servos[1]] = places, speeds
        mujoco.mj_step(self.model, self.data)
        if self.watch is not None:
            self.watch(self.model, self.data)

    def _speed(self) -> float:
        moving = np.array(
            [self.data.qvel[joint.dofadr[0] : joint.dofadr[0] + 6] for joint in self.free]
        )
        return float((np.abs(moving[:, :3]).max(1) + 0.05 * np.abs(moving[:, 3:]).max(1)).max())

    def _at(self) -> npt.NDArray[np.int64]:
        return np.concatenate([joint.qposadr[0] + np.arange(7) for joint in self.free])

    def _build(self, plan: pushplan.Plan) -> None:
        """Builds the scene of a plan with tags and cameras; objects keep their poses."""
        spec = mujoco.MjSpec.from_string(plan.to_mjcf())
        spec.visual.global_.offwidth, spec.visual.global_.offheight = WIDTH, HEIGHT
        spec.visual.headlight.ambient, spec.visual.headlight.specular = [0.5] * 3, [0.0] * 3
        heights = {}
        things: Any = self.task.to_dict()["scene"]["objects"]
        for thing in things:
            [(kind, shape)] = thing["shape"].items()
            heights[thing["name"]] = shape["size"][2] if kind == "cuboid" else shape["height"]
        for tag, (x, y) in TABLE.items():
            stick(spec, spec.worldbody, tag, EDGE, [x, y, 2e-4])
        for k, name in enumerate(self.task.objects):
            stick(
                spec,
                spec.body(f"object/{name}"),
                FIRST + k,
                ON_OBJECTS,
                [0, 0, heights[name] / 2 + 2e-4],
            )
        for geom in spec.geoms:
            geom.rgba = COLOURS.get(geom.name.split("/")[0], geom.rgba)
            if geom.name == "obstacle/robot base":
                # The column that represents the arm's base in plans would hide the arm.
                geom.rgba[3] = 0
        if not plan.pushes:
            # Without pushes the hand is empty, and the scene has no arm.
            for geom in spec.body("tool").geoms:
                geom.rgba[3] = 0
        for name, eye, middle in [("camera", EYE, MIDDLE), ("film", *FILM)]:
            spec.worldbody.add_camera(name=name, pos=eye, quat=towards(eye, middle), fovy=FIELD)
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        self.step = self.model.opt.timestep
        self._make_true()
        joints = [self.model.joint(k) for k in range(self.model.njnt)]
        names = [joint.name for joint in joints if joint.name.startswith("arm/")]
        self.joints = [self.model.joint(name).qposadr[0] for name in names]
        self.servos = [
            [self.model.actuator(f"{name}/{of}").id for name in names]
            for of in ("position", "speed")
        ]
        self.free = [
            self.model.joint(self.model.body(f"object/{name}").jntadr[0])
            for name in self.task.objects
        ]
        if self.places is not None:
            self.data.qpos[self._at()] = self.places
        arm: Any = plan.task.to_dict()["robot"]
        self.data.qpos[self.joints] = arm["arm"]["home"] if names else []
        mujoco.mj_forward(self.model, self.data)

    def _make_true(self) -> None:
        """Sets the true masses and frictions."""
        for k, name in enumerate(self.task.objects):
            body = self.model.body(f"object/{name}")
            self.model.body_mass[body.id] *= self.heavier[k]
            self.model.body_inertia[body.id] *= self.heavier[k]
            for pair in range(self.model.npair):
                geoms = self.model.pair_geom1[pair], self.model.pair_geom2[pair]
                if body.id in self.model.geom_bodyid[list(geoms)]:
                    self.model.pair_friction[pair, :2] *= self.rougher[k]


def stick(spec: Any, body: Any, tag: int, edge: float, at: list[float]) -> None:
    """Attaches a tag to a body."""
    dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, FAMILY))
    black = cv2.aruco.generateImageMarker(dictionary, tag, 400)
    white = round(400 * (1 / BLACK - 1) / 2)
    image = np.pad(black, white, constant_values=255)
    spec.assets = {**spec.assets, f"tag{tag}.png": cv2.imencode(".png", image)[1].tobytes()}
    spec.add_texture(name=f"tag {tag}", type=mujoco.mjtTexture.mjTEXTURE_2D, file=f"tag{tag}.png")
    material = spec.add_material(name=f"tag {tag}", specular=0, reflectance=0)
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = f"tag {tag}"
    half = edge / BLACK / 2
    body.add_geom(
        type=mujoco.mjtGeom.mjGEOM_BOX, size=[half, half, 1e-4], pos=at, material=f"tag {tag}",
        contype=0, conaffinity=0, mass=0,
    )


def towards(eye: Floats, middle: Floats) -> Floats:
    """Returns the rotation (w x y z) of a camera towards a point."""
    ahead = (middle - eye) / np.linalg.norm(middle - eye)
    right = np.cross(ahead, [0, 0, 1])
    right /= np.linalg.norm(right)
    turn = np.empty(4)
    mujoco.mju_mat2Quat(turn, np.column_stack([right, np.cross(right, ahead), -ahead]).ravel())
    return turn


class Film:
    """Animation from the second camera at twice the speed."""

    EVERY, SIZE = 0.2, (270, 360)

    def __init__(self) -> None:
        self.frames: list[npt.NDArray[np.uint8]] = []
        self.model: Any = None
        self.due = 0.0

    def watch(self, model: Any, data: Any) -> None:
        """Records a frame if one is due; called after every step."""
        if model is not self.model:
            self.model, self.due = model, 0.0
            self.renderer = mujoco.Renderer(model, *self.SIZE)
        if data.time >= self.due:
            self.due += self.EVERY
            self.renderer.update_scene(data, "film")
            self.frames.append(self.renderer.render()[:, :, ::-1].copy())

    def save(self, path: str) -> None:
        """Writes the animation: WebP, GIF or APNG by the suffix, with OpenCV 4.11 or newer."""
        animation = cv2.Animation()
        animation.frames, animation.durations = (
            self.frames,
            [round(500 * self.EVERY)] * len(self.frames),
        )
        cv2.imwriteanimation(path, animation, [cv2.IMWRITE_WEBP_QUALITY, 70])


def between(times: Floats, places: Floats, speeds: Floats, time: float) -> tuple[Floats, Floats]:
    """Returns joint positions and velocities by cubic interpolation between trajectory points."""
    k = int(np.clip(np.searchsorted(times, time) - 1, 0, len(times) - 2))
    dt = times[k + 1] - times[k]
    s = min(max((time - times[k]) / dt, 0.0), 1.0)
    a, b, v, w = *places[k : k + 2], *speeds[k : k + 2]
    h = [2 * s**3 - 3 * s**2 + 1, s**3 - 2 * s**2 + s, 3 * s**2 - 2 * s**3, s**3 - s**2]
    d = [6 * s**2 - 6 * s, 3 * s**2 - 4 * s + 1, 6 * s - 6 * s**2, 3 * s**2 - 2 * s]
    place = h[0] * a + h[1] * dt * v + h[2] * b + h[3] * dt * w
    return place, (d[0] * a + d[2] * b) / dt + d[1] * v + d[3] * w
