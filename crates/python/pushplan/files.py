"""Types of mappings with the keys of files, for tools and tasks that are built in code.

``Task.from_dict`` and ``Tool.from_dict`` check such mappings as strictly as files. A type checker
finds misspelled keys earlier. ``pushplan.task_schema()`` states the meaning, range and default of
every key. Lengths are metres, masses kilograms, and angles (keys that end in ``_deg``) degrees.
"""

import sys
from collections.abc import Sequence
from typing import Any, Literal, TypedDict, Union

if sys.version_info >= (3, 11):
    from typing import NotRequired
if sys.version_info < (3, 11):
    from typing_extensions import NotRequired

from ._shape_files import (
    CuboidKeys,
    CylinderKeys,
    Numbers,
    ObjectPrismKeys,
    ObjectShapeKeys,
    PrismKeys,
    ShapeKeys,
)

__all__ = [
    "AreaKeys",
    "BasePoseKeys",
    "BladeKeys",
    "CircleKeys",
    "CostedToolKeys",
    "CuboidKeys",
    "CylinderKeys",
    "EdgeKeys",
    "FrictionKeys",
    "GoalKeys",
    "GoalRegionKeys",
    "GripKeys",
    "HandKeys",
    "JointKeys",
    "JointLimitKeys",
    "KeepKeys",
    "LeversKeys",
    "Numbers",
    "ObjectKeys",
    "ObjectPartKeys",
    "ObjectPrismKeys",
    "ObjectShapeKeys",
    "ObstacleKeys",
    "PartKeys",
    "PolygonKeys",
    "PrismKeys",
    "PushKeys",
    "ReachKeys",
    "RectangleKeys",
    "RegionKeys",
    "RobotKeys",
    "SceneKeys",
    "ShapeKeys",
    "StandKeys",
    "SupportKeys",
    "TableKeys",
    "TaskFile",
    "ToolFile",
    "ToolMountKeys",
]

class SupportKeys(TypedDict, total=False):
    """Support model of an object; exactly one of the keys."""

    spread: float
    points: Sequence[Numbers]


class TableKeys(TypedDict, total=False):
    """Table; extents and position [x, y] in metres."""

    friction: float
    size: Numbers
    position: Numbers


class ObjectPartKeys(TypedDict):
    """Part of an object; mass in kilograms, position [x, y] in the object's frame in metres.

    `z` is the height of its underside above the object's underside, metres. It may also be the
    third number of the position."""

    shape: ObjectShapeKeys
    position: Numbers
    name: NotRequired[str]
    yaw_deg: NotRequired[float]
    z: NotRequired[float]
    mass: NotRequired[float]
    friction: NotRequired[float]
    support: NotRequired[Union[Literal["even", "corners"], SupportKeys]]


class ObjectKeys(TypedDict):
    """Movable object; mass in kilograms, position [x, y] and heights in metres."""

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
    """Fixed cuboid; extents [x, y, z] and position [x, y] in metres."""

    name: str
    size: Numbers
    position: Numbers
    yaw_deg: NotRequired[float]
    friction: NotRequired[float]


class JointKeys(TypedDict):
    """Joint between two objects; its position in the world at the start, metres."""

    between: Sequence[str]
    kind: Literal["fixed", "revolute", "prismatic"]
    at: NotRequired[Numbers]
    axis: NotRequired[Numbers]
    limits: NotRequired[Numbers]
    limits_deg: NotRequired[Numbers]
    guessed: NotRequired[bool]


class FrictionKeys(TypedDict):
    """Friction coefficient of a pair that replaces the mean of its two friction values."""

    between: Sequence[str]
    coefficient: float


class SceneKeys(TypedDict):
    """Objects, obstacles, joints and table."""

    objects: Sequence[ObjectKeys]
    table: NotRequired[TableKeys]
    push_height: NotRequired[float]
    joints: NotRequired[Sequence[JointKeys]]
    obstacles: NotRequired[Sequence[ObstacleKeys]]
    frictions: NotRequired[Sequence[FrictionKeys]]


class ReachKeys(TypedDict):
    """Allowed distances of the end effector from the base, metres."""

    max: float
    min: NotRequired[float]


# Hand around the end effector, an upright cylinder: radius and height of its lower end, metres.
HandKeys = TypedDict("HandKeys", {"radius": float, "from": float}, total=False)


class StandKeys(TypedDict, total=False):
    """Height of an arm's root in metres, and its rotation; the former keys of `base`."""

    height: float
    yaw_deg: float


class BasePoseKeys(StandKeys, total=False):
    """Pose of an arm's root: position and height in metres, and its rotation."""

    position: Numbers


class JointLimitKeys(TypedDict, total=False):
    """Maximum acceleration and jerk of an arm's joints, one number for all or one for each."""

    acceleration: Union[float, Numbers]
    jerk: Union[float, Numbers]


class ToolMountKeys(TypedDict, total=False):
    """Distance from flange to tool underside, metres, and axis of the flange that points out."""

    length: float
    yaw_deg: float
    axis: Literal["x", "y", "z", "-x", "-y", "-z"]


class RobotKeys(TypedDict):
    """Reach of the end effector, metres, or its arm, and the maximum force, newtons."""

    reach: NotRequired[ReachKeys]
    home: NotRequired[Numbers]
    urdf: NotRequired[str]
    flange: NotRequired[str]
    tool_mount: NotRequired[ToolMountKeys]
    arm: NotRequired[Any]
    max_force: NotRequired[float]
    hand: NotRequired[Union[Literal["none"], HandKeys]]
    base: NotRequired[Union[Literal["none"], float, StandKeys]]
    base_pose: NotRequired[BasePoseKeys]
    joint_limits: NotRequired[JointLimitKeys]
    travel: NotRequired[float]


class PushKeys(TypedDict, total=False):
    """Allowed pushes of a plan; lengths in metres, speed in m/s."""

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
    """Circle, metres."""

    radius: float


class RectangleKeys(TypedDict):
    """Rectangle with full extents [x, y], metres."""

    size: Numbers


class PolygonKeys(TypedDict):
    """Convex polygon with corners [x, y], metres."""

    corners: Sequence[Numbers]


class AreaKeys(TypedDict, total=False):
    """Outline of a region; exactly one of the keys."""

    circle: CircleKeys
    rectangle: RectangleKeys
    polygon: PolygonKeys


class GoalRegionKeys(TypedDict):
    """Region in which (or outside which) an object's centre must lie; position [x, y] in metres."""

    area: AreaKeys
    position: NotRequired[Numbers]
    yaw_deg: NotRequired[float]
    outside: NotRequired[bool]


class GapKeys(TypedDict):
    """Distance of an object from another body, metres; at least one of the limits."""

    to: str
    min: NotRequired[float]
    max: NotRequired[float]


class CoverageKeys(TypedDict):
    """Coverage of an object's own outline at a pose, a share; position [x, y] in metres."""

    share: NotRequired[float]
    position: Numbers
    heading_deg: NotRequired[float]


class EdgeKeys(TypedDict):
    """Part of a table edge over which an object must fall, metres along the edge."""

    edge: Literal["far", "near", "left", "right"]
    between: Numbers


class GoalKeys(TypedDict):
    """Goal of an object at rest; position [x, y] and lengths in metres."""

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
    """Allowed lever-ups of a plan; metres, m/s and seconds."""

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
    """Tool with a cost of use."""

    name: str
    cost: NotRequired[float]


class TaskFile(TypedDict):
    """Task file."""

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
    """Pose of the end effector in the tool frame; position [x, y] in metres."""

    position: Numbers
    yaw_deg: NotRequired[float]


class PartKeys(TypedDict):
    """Part of a tool; extents [x, y, z] and position [x, y] in metres."""

    name: str
    position: Numbers
    size: NotRequired[Numbers]
    shape: NotRequired[ShapeKeys]
    yaw_deg: NotRequired[float]


class BladeKeys(TypedDict):
    """Blade that goes under an edge, metres."""

    length: float
    width: float
    thickness: float


class ToolFile(TypedDict):
    """Tool file."""

    name: str
    friction: NotRequired[float]
    parts: NotRequired[Sequence[PartKeys]]
    blade: NotRequired[BladeKeys]
    description: NotRequired[str]
    grip: NotRequired[GripKeys]
    joints: NotRequired[Sequence[Sequence[str]]]
