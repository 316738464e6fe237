//! What an object stands on, as files state it.

use serde::{Deserialize, Serialize};

use crate::geometry::Vector;

/// How an object's weight is spread over its underside, as a task states it.
///
/// Friction resists turning the more, the farther out the weight rests: a box on its corners turns
/// half as far as one on even pressure. What is true of an object can be fitted to recorded pushes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Support {
    /// Even pressure over the whole underside.
    #[default]
    Even,
    /// The corners of a cuboid or prism; the rim of a cylinder.
    Corners,
    /// Like `Corners`, but at this share of their distance from the centre.
    Spread(f64),
    /// These points, in the object's frame, metres.
    Points(Vec<Vector>),
}
