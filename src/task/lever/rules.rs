//! The lever-ups that a task allows.

use serde::{Deserialize, Serialize};

use super::LeverUp;

/// Position of the axis about which a blade rotates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Pivot {
    /// Axis on the support line, so that the object's tilt equals the blade's rotation.
    Auto,
    /// Axis at this signed distance from the edge, inward, metres: see [`LeverUp::pivot`].
    At(f64),
}

/// The lever-ups that a plan may contain, all of the goal's object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverRules {
    /// Smallest and largest depth of the tip behind the edge, metres.
    pub depth: [f64; 2],
    /// Smallest and largest rotation, radians.
    pub angle: [f64; 2],
    /// Allowed positions of the axis.
    pub pivots: Vec<Pivot>,
    /// Speed of the tip, m/s.
    pub speed: f64,
    /// Time for which the blade then stands still, seconds.
    pub hold: f64,
    /// Distance by which the blade is then drawn back, metres; it approaches from the same
    /// distance.
    pub retreat: f64,
}

impl LeverRules {
    /// Default depths, metres; slips become frequent below.
    pub const DEPTH: [f64; 2] = [0.008, 0.02];
    /// Default rotations, degrees; beyond a right angle a blade pushes over an object that a wall
    /// holds upright.
    pub const ANGLE_DEG: [f64; 2] = [30.0, 150.0];
    /// Minimum distance of a blade from a corner, metres.
    pub const CORNER: f64 = 0.012;
    /// A long arc that suits plates of the size of a hand, metres.
    pub const LIFT: f64 = 0.16;
    /// A fulcrum just outside of the edge, metres.
    pub const PRY: f64 = -0.012;
}

/// The support line, a fixed arc and prying.
impl Default for LeverRules {
    fn default() -> Self {
        Self {
            depth: Self::DEPTH,
            angle: Self::ANGLE_DEG.map(f64::to_radians),
            pivots: vec![Pivot::Auto, Pivot::At(Self::LIFT), Pivot::At(Self::PRY)],
            speed: LeverUp::SPEED,
            hold: LeverUp::HOLD,
            retreat: LeverUp::RETREAT,
        }
    }
}
