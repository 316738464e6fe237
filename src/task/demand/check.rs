//! Checks of demands as plain data, so that other programs can judge an exported scene without the
//! kinds of demands.

use serde::Serialize;

use crate::geometry::Vector;
use crate::scene::Scene;

/// A condition on the poses at rest.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Check {
    /// A quantity within limits, both included.
    Within {
        /// The quantity.
        quantity: Quantity,
        /// Smallest value.
        #[serde(skip_serializing_if = "Option::is_none")]
        low: Option<f64>,
        /// Largest value.
        #[serde(skip_serializing_if = "Option::is_none")]
        high: Option<f64>,
    },
    /// A minimum number of satisfied checks.
    AtLeast {
        /// Minimum number of satisfied checks.
        count: usize,
        /// The checks.
        of: Vec<Check>,
    },
}

/// Corners of convex polygons, metres.
type Polygons = Vec<Vec<Vector>>;

/// A quantity that follows from poses. Objects are identified by their names; poses are in the
/// world, or in the `frame` of another object.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Distance of a centre from a point, metres.
    Distance {
        /// The object.
        object: String,
        /// Object in whose frame the point is.
        #[serde(skip_serializing_if = "Option::is_none")]
        frame: Option<String>,
        /// The point, metres.
        to: Vector,
    },
    /// Rotation from the nearest equivalent heading, radians.
    Turn {
        /// The object.
        object: String,
        /// Object in whose frame the heading is.
        #[serde(skip_serializing_if = "Option::is_none")]
        frame: Option<String>,
        /// The heading, radians.
        heading: f64,
        /// Number of equivalent headings in a full turn.
        symmetry: usize,
        /// Middle of the headings within a joint's limits, radians.
        #[serde(skip_serializing_if = "Option::is_none")]
        middle: Option<f64>,
    },
    /// Distance of a centre from a convex polygon, metres; negative inside.
    Beyond {
        /// The object.
        object: String,
        /// Object in whose frame the polygon is.
        #[serde(skip_serializing_if = "Option::is_none")]
        frame: Option<String>,
        /// Its corners, counter-clockwise, metres.
        corners: Vec<Vector>,
    },
    /// Smallest distance between the outlines of two bodies, metres.
    Gap {
        /// The object.
        object: String,
        /// Its outlines in its own frame.
        own: Polygons,
        /// The other object; `None` if the other outlines are in the world.
        #[serde(skip_serializing_if = "Option::is_none")]
        other: Option<String>,
        /// The outlines of the other body in its frame.
        others: Polygons,
    },
    /// Share of an object's outline at a pose that the object covers.
    Covered {
        /// The object.
        object: String,
        /// Object in whose frame the pose is.
        #[serde(skip_serializing_if = "Option::is_none")]
        frame: Option<String>,
        /// The pose: x, y and heading.
        at: [f64; 3],
        /// Its outline in its own frame.
        pieces: Polygons,
    },
    /// Distance of the centre of mass of a fallen object beyond the nearest edge, metres.
    Over {
        /// The object.
        object: String,
        /// Its centre of mass in its own frame, metres.
        centre: Vector,
        /// Outward direction over each edge, x and y, and the distance of the edge along it.
        edges: Vec<[f64; 3]>,
        /// Part of the edge, x or y in metres.
        #[serde(skip_serializing_if = "Option::is_none")]
        part: Option<[f64; 2]>,
    },
    /// Height to which the last lever-up has lifted an edge, metres.
    Raised {
        /// The object.
        object: String,
    },
    /// Angle between an object's upper side and the vertical, radians.
    Tilt {
        /// The object.
        object: String,
    },
}

impl Check {
    /// Creates a check for a quantity of at least `low`.
    pub(super) fn from(quantity: Quantity, low: f64) -> Self {
        Self::Within { quantity, low: Some(low), high: None }
    }

    /// Creates a check for a quantity of at most `high`.
    pub(super) fn up_to(quantity: Quantity, high: f64) -> Self {
        Self::Within { quantity, low: None, high: Some(high) }
    }
}

/// Returns the name of an object, as used in checks.
pub(super) fn name(object: usize, scene: &Scene) -> String {
    scene.objects.get(object).map_or_else(String::new, |object| object.name.clone())
}
