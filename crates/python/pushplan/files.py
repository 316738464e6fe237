"""The keys of files as types, for tools and tasks that are built in code.

``Task.of`` and ``Tool.of`` take such mappings and check them as strictly as files; a type checker
finds misspelled keys before. ``pushplan.task_schema()`` says what every key means, its range and its
default. Lengths are metres, masses kilograms, angles (keys that end in ``_deg``) degrees.
"""

import sys
from collections.abc import Sequence
from typing import Any, Literal, TypedDict, Union

import numpy as np
import numpy.typing as npt

if sys.version_info >= (3, 11):
    from typing import NotRequired
else:
    from typing_extensions import NotRequired

__all__ = [
    "AreaKeys", "BladeKeys", "CircleKeys", "CostedToolKeys", "CuboidKeys", "CylinderKeys", "EdgeKeys",
    "FrictionKeys", "GoalKeys", "GoalRegionKeys", "GripKeys", "HandKeys", "JointKeys",
    "KeepKeys", "LeversKeys", "Numbers", "ObjectKeys", "ObjectPartKeys",
    "ObjectPrismKeys", "ObjectShapeKeys", "ObstacleKeys", "PartKeys", "PolygonKeys",
    "PrismKeys", "PushKeys", "ReachKeys", "RectangleKeys", "RegionKeys", "RobotKeys",
    "SceneKeys", "ShapeKeys", "StandKeys", "SupportKeys", "TableKeys", "TaskFile", "ToolFile",
    "ToolMountKeys",
]

#: Numbers in a row, such as a position [x, y] in metres.
Numbers = Union[Sequence[float], npt.NDArray[np.float64]]


class CylinderKeys(TypedDict):
    """An upright cylinder, metres."""

    radius: float
    height: float


class CuboidKeys(TypedDict):
    """A cuboid of these full extents [x, y, z], metres."""

    size: Numbers


class PrismKeys(TypedDict):
    """An upright prism on a convex polygon, metres."""

    corners: Sequence[Numbers]
    height: float
    centre_of_mass: NotRequired[Numbers]


class ObjectPrismKeys(PrismKeys):
    """The same of an object, with the point of it that is at its position."""

    origin: NotRequired[Numbers]


class ShapeKeys(TypedDict, total=False):
    """One solid: exactly one of the keys."""

    cylinder: CylinderKeys
    cuboid: CuboidKeys
    prism: PrismKeys


class ObjectShapeKeys(TypedDict, total=False):
    """The solid of an object: exactly one of the keys."""

    cylinder: CylinderKeys
    cuboid: CuboidKeys
    prism: ObjectPrismKeys


class SupportKeys(TypedDict, total=False):
    """How an object's weight is spread: exactly one of the keys."""

    spread: float
    points: Sequence[Numbers]


class TableKeys(TypedDict, total=False):
    """The table; extents and position [x, y] in metres."""

    friction: float
    size: Numbers
    position: Numbers


class ObjectPartKeys(TypedDict):
    """A part of an object; mass in kilograms, position [x, y] in the object's frame and z, the height of
    its underside above the object's, in metres; a third number of the position is z."""

    shape: ObjectShapeKeys
    position: Numbers
    name: NotRequired[str]
    yaw_deg: NotRequired[float]
    z: NotRequired[float]
    mass: NotRequired[float]
    friction: NotRequired[float]
    support: NotRequired[Union[Literal["even", "corners"], SupportKeys]]


class ObjectKeys(TypedDict):
    """A movable object; mass in kilograms, position [x, y] and heights in metres."""

    name: str
    shape: ObjectShapeKeys
    mass: float
    friction: float
    position: Numbers
    yaw_deg: NotRequired[float]
    support: NotRequired[Union[Literal["even", "corners"], SupportKeys]]
    may_fall: NotRequired[bool]
    max_force: NotRequired[float]
    color: NotRequired[Numbers]
    parts: NotRequired[Sequence[ObjectPartKeys]]
    clearance: NotRequired[float]
    z: NotRequired[float]


class ObstacleKeys(TypedDict):
    """A fixed cuboid; extents [x, y, z] and position [x, y] in metres."""

    name: str
    size: Numbers
    position: Numbers
    yaw_deg: NotRequired[float]
    friction: NotRequired[float]


class JointKeys(TypedDict):
    """A joint between two objects; where it is, in metres in the world at the start."""

    between: Sequence[str]
    kind: Literal["fixed", "revolute", "prismatic"]
    at: NotRequired[Numbers]
    axis: NotRequired[Numbers]
    limits: NotRequired[Numbers]
    limits_deg: NotRequired[Numbers]
    guessed: NotRequired[bool]


class FrictionKeys(TypedDict):
    """The coefficient of friction of a pair that is not the mean of the two values."""

    between: Sequence[str]
    coefficient: float


class SceneKeys(TypedDict):
    """The scene on the table."""

    objects: Sequence[ObjectKeys]
    table: NotRequired[TableKeys]
    push_height: NotRequired[float]
    joints: NotRequired[Sequence[JointKeys]]
    obstacles: NotRequired[Sequence[ObstacleKeys]]
    frictions: NotRequired[Sequence[FrictionKeys]]


class ReachKeys(TypedDict):
    """Distances of the end effector from the base, metres."""

    max: float
    min: NotRequired[float]


# Hand about the end effector, an upright cylinder: its radius and the height of its lower end, metres.
HandKeys = TypedDict("HandKeys", {"radius": float, "from": float}, total=False)


class StandKeys(TypedDict, total=False):
    """How an arm stands at the origin: its height in metres, and its turn."""

    height: float
    yaw_deg: float


class ToolMountKeys(TypedDict, total=False):
    """From the flange to the tool's underside, metres, and the tool's turn about the flange's axis."""

    length: float
    yaw_deg: float


class RobotKeys(TypedDict):
    """Where the end effector can be, metres, or the arm that holds it, and how hard it can press, newtons."""

    reach: NotRequired[ReachKeys]
    home: NotRequired[Numbers]
    urdf: NotRequired[str]
    flange: NotRequired[str]
    tool_mount: NotRequired[ToolMountKeys]
    arm: NotRequired[Any]
    max_force: NotRequired[float]
    hand: NotRequired[Union[Literal["none"], HandKeys]]
    base: NotRequired[Union[Literal["none"], float, StandKeys]]
    travel: NotRequired[float]


class PushKeys(TypedDict, total=False):
    """The pushes that a plan may contain; lengths in metres, speed in m/s."""

    form: Literal["placed", "chained"]
    directions: Union[Literal["principal"], int, Numbers]
    offsets: Numbers
    grip_yaws_deg: Numbers
    length: float
    speed: float
    max_count: int
    tool_changes: int
    lift: float


class CircleKeys(TypedDict):
    """A circle, metres."""

    radius: float


class RectangleKeys(TypedDict):
    """A rectangle, full extents [x, y] in metres."""

    size: Numbers


class PolygonKeys(TypedDict):
    """A convex polygon, corners [x, y] in metres."""

    corners: Sequence[Numbers]


class AreaKeys(TypedDict, total=False):
    """The outline of a region: exactly one of these."""

    circle: CircleKeys
    rectangle: RectangleKeys
    polygon: PolygonKeys


class GoalRegionKeys(TypedDict):
    """Where an object's centre may lie, or must not; position [x, y] in metres."""

    area: AreaKeys
    position: NotRequired[Numbers]
    yaw_deg: NotRequired[float]
    outside: NotRequired[bool]


class GapKeys(TypedDict):
    """How far an object is from something else, metres; at least one of the limits."""

    to: str
    min: NotRequired[float]
    max: NotRequired[float]


class CoverageKeys(TypedDict):
    """How much of its own outline there an object covers; position [x, y] in metres."""

    share: NotRequired[float]
    position: Numbers
    heading_deg: NotRequired[float]


class EdgeKeys(TypedDict):
    """A part of an edge of the table over which an object is to fall, metres along it."""

    edge: Literal["far", "near", "left", "right"]
    between: Numbers


class GoalKeys(TypedDict):
    """Where an object must come to rest, and how; position [x, y] and lengths in metres."""

    object: NotRequired[str]
    objects: NotRequired[Sequence[str]]
    at_least: NotRequired[int]
    position: NotRequired[Numbers]
    tolerance: NotRequired[float]
    region: NotRequired[GoalRegionKeys]
    gap: NotRequired[GapKeys]
    coverage: NotRequired[CoverageKeys]
    off_table: NotRequired[Union[Literal["any", "far", "near", "left", "right"], EdgeKeys]]
    outside: NotRequired[str]
    raised: NotRequired[float]
    flipped: NotRequired[bool]
    heading_deg: NotRequired[float]
    heading_tolerance_deg: NotRequired[float]
    symmetric: NotRequired[bool]
    relative_to: NotRequired[str]
    joint_deg: NotRequired[float]
    joint: NotRequired[float]
    weight: NotRequired[float]


class LeversKeys(TypedDict, total=False):
    """The lever-ups that a plan may contain; metres, m/s and seconds."""

    depth: Numbers
    angle_deg: Numbers
    pivot: Union[Literal["auto"], float, Sequence[Union[Literal["auto"], float]]]
    speed: float
    hold: float
    retreat: float


class KeepKeys(TypedDict):
    """Objects that no plan may move by more than `within` metres."""

    objects: Sequence[str]
    within: NotRequired[float]


RegionKeys = TypedDict(
    "RegionKeys",
    {
        "name": str,
        "area": AreaKeys,
        "position": NotRequired[Numbers],
        "yaw_deg": NotRequired[float],
        "for": NotRequired[Sequence[Literal["objects", "tool", "hand"]]],
    },
)


class CostedToolKeys(TypedDict):
    """A tool that costs something to use."""

    name: str
    cost: NotRequired[float]


class TaskFile(TypedDict):
    """The keys of a task file."""

    scene: SceneKeys
    robot: RobotKeys
    tools: Union[Literal["all"], Sequence[Union[str, CostedToolKeys]]]
    goal: Union[GoalKeys, Sequence[GoalKeys]]
    name: NotRequired[str]
    description: NotRequired[str]
    pushes: NotRequired[PushKeys]
    robustness: NotRequired[float]
    unknown: NotRequired[Sequence[Literal["joints", "masses", "frictions", "support"]]]
    levers: NotRequired[LeversKeys]
    keep: NotRequired[KeepKeys]
    keep_out: NotRequired[Sequence[RegionKeys]]


class GripKeys(TypedDict):
    """The end effector's pose in the tool frame; position [x, y] in metres."""

    position: Numbers
    yaw_deg: NotRequired[float]


class PartKeys(TypedDict):
    """One solid of a tool; extents [x, y, z] and position [x, y] in metres."""

    name: str
    position: Numbers
    size: NotRequired[Numbers]
    shape: NotRequired[ShapeKeys]
    yaw_deg: NotRequired[float]


class BladeKeys(TypedDict):
    """What goes under an edge, metres."""

    length: float
    width: float
    thickness: float


class ToolFile(TypedDict):
    """The keys of a tool file."""

    name: str
    friction: NotRequired[float]
    parts: NotRequired[Sequence[PartKeys]]
    blade: NotRequired[BladeKeys]
    description: NotRequired[str]
    grip: NotRequired[GripKeys]
    joints: NotRequired[Sequence[Sequence[str]]]
