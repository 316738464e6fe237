//! Physical quantities for which models have ranges.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A quantity of a job for which a model has a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Number of objects in play.
    Objects,
    /// Mass of an object, kg.
    Mass,
    /// Largest ratio of two masses.
    MassRatio,
    /// Friction value of an object, the tool or the table.
    Friction,
    /// Radius of a cylinder, metres.
    Radius,
    /// First horizontal side of a cuboid object, metres.
    SizeX,
    /// Second horizontal side, metres.
    SizeY,
    /// Ratio of a cuboid object's horizontal sides.
    SideRatio,
    /// Vertical extent of an object, metres.
    Height,
    /// Deviation of a prism's corner from a right angle, radians.
    Slant,
    /// Distance of a prism's centre of mass from the centroid, metres.
    Imbalance,
    /// Number of parts of the tool.
    Parts,
    /// Longer horizontal side of a tool part, metres.
    Length,
    /// Shorter horizontal side of a tool part, metres.
    Width,
    /// Speed of the tool, m/s.
    Speed,
    /// Sliding distance of an object released at the tool's speed, metres.
    Slide,
    /// Rotation of the tool for each metre of travel, rad/m.
    Turn,
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Quantity::Objects => "number of objects",
            Quantity::Mass => "mass (kg)",
            Quantity::MassRatio => "ratio of masses",
            Quantity::Friction => "friction",
            Quantity::Radius => "radius (m)",
            Quantity::SizeX => "size along x (m)",
            Quantity::SizeY => "size along y (m)",
            Quantity::SideRatio => "ratio of sides",
            Quantity::Height => "height (m)",
            Quantity::Slant => "deviation of a corner from a right angle (rad)",
            Quantity::Imbalance => "offset of the centre of mass (m)",
            Quantity::Parts => "number of parts",
            Quantity::Length => "length (m)",
            Quantity::Width => "width (m)",
            Quantity::Speed => "speed (m/s)",
            Quantity::Slide => "free sliding (m)",
            Quantity::Turn => "tool rotation (rad/m)",
        })
    }
}
