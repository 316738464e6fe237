//! Support models of objects, as files state them.

use serde::{Deserialize, Serialize};

use crate::geometry::Vector;

/// The distribution of an object's weight over its underside, stated by a task.
///
/// Friction resists rotation the more, the farther out the weight rests: a box on its corners
/// rotates half as far as a box on even pressure. The true support of an object can be fitted to
/// recorded pushes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Support {
    /// Even pressure on the whole underside.
    #[default]
    Even,
    /// The corners of a cuboid or prism; the rim of a cylinder.
    Corners,
    /// Points at this share of the corners' distance from the centre.
    Spread(f64),
    /// Stated points in the object's frame, metres.
    Points(Vec<Vector>),
}
