"""Types of mappings with the keys of shapes in files."""

import sys
from collections.abc import Sequence
from typing import TypedDict, Union

import numpy as np
import numpy.typing as npt

if sys.version_info >= (3, 11):
    from typing import NotRequired
if sys.version_info < (3, 11):
    from typing_extensions import NotRequired

#: Sequence of numbers, such as a position [x, y] in metres.
Numbers = Union[Sequence[float], npt.NDArray[np.float64]]


class CylinderKeys(TypedDict):
    """Upright cylinder, metres."""

    radius: float
    height: float


class CuboidKeys(TypedDict):
    """Cuboid with full extents [x, y, z], metres."""

    size: Numbers


class PrismKeys(TypedDict):
    """Upright prism with a convex polygon as its base, metres."""

    corners: Sequence[Numbers]
    height: float
    centre_of_mass: NotRequired[Numbers]


class ObjectPrismKeys(PrismKeys):
    """Upright prism of an object; `origin` is the point that lies at the object's position."""

    origin: NotRequired[Numbers]


class ShapeKeys(TypedDict, total=False):
    """Solid of a tool; exactly one of the keys."""

    cylinder: CylinderKeys
    cuboid: CuboidKeys
    prism: PrismKeys


class ObjectShapeKeys(TypedDict, total=False):
    """Solid of an object; exactly one of the keys."""

    cylinder: CylinderKeys
    cuboid: CuboidKeys
    prism: ObjectPrismKeys
