//! Demand: an object lies upside down, or on its underside.

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;

use serde::{Deserialize, Serialize};

use crate::geometry::Pose3;
use crate::scene::Scene;

use super::check::name;
use super::{Check, Demand, End, Kind, Quantity};

/// Maximum tilt of a plate on its underside, radians (15 degrees): an edge may lie on the wall of a
/// pocket. Single plates end within a degree of flat.
const FLAT: f64 = 15.0 * std::f64::consts::PI / 180.0;

/// Maximum deviation of an upside-down plate from the vertical, radians (45 degrees). Boards that
/// are levered out of a drive lie on its wall, 147 to 170 degrees from their start.
const UPSIDE_DOWN: f64 = 45.0 * std::f64::consts::PI / 180.0;

/// The resting side of a levered plate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// Underside again.
    Back,
    /// Upside down.
    Flipped,
    /// Against another body, or on edge.
    Leaning,
}

impl Ending {
    /// Returns the side on which a plate lies at rest in this pose.
    pub fn of(rest: &Pose3) -> Self {
        let tilt = rest.tilt();
        if tilt < FLAT {
            Self::Back
        } else if tilt > std::f64::consts::PI - UPSIDE_DOWN {
            Self::Flipped
        } else {
            Self::Leaning
        }
    }
}

impl fmt::Display for Ending {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Back => "back on its underside",
            Self::Flipped => "flipped",
            Self::Leaning => "leaning",
        })
    }
}

/// A demand on the resting side of an object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Flipped {
    /// Whether it must be upside down; otherwise it must be on its underside.
    pub flipped: bool,
}

impl End<'_> {
    /// Returns the tilt of the object, radians, and the side on which it lies; its underside in
    /// planar states.
    pub fn side(&self) -> (f64, Ending) {
        let space = self.state.space.as_ref().and_then(|poses| poses.get(self.object));
        space.map_or((0.0, Ending::Back), |pose| (pose.tilt(), Ending::of(pose)))
    }
}

impl Kind for Flipped {
    fn demand(&self) -> Demand {
        Demand::Flipped(self.clone())
    }

    fn is_met(&self, end: &End) -> bool {
        self.score(end) <= 1.0
    }

    fn words(&self, _: usize, _: &Scene) -> String {
        if self.flipped { "upside down" } else { "on its underside" }.to_owned()
    }

    fn score(&self, end: &End) -> f64 {
        let (tilt, ending) = end.side();
        let off = if self.flipped { PI - tilt } else { tilt };
        let wanted = if self.flipped { Ending::Flipped } else { Ending::Back };
        match ending == wanted {
            true => (off / FRAC_PI_2).min(1.0),
            false => 1.0 + off / FRAC_PI_2,
        }
    }

    fn check(&self, object: usize, scene: &Scene) -> Check {
        let quantity = Quantity::Tilt { object: name(object, scene) };
        match self.flipped {
            true => Check::from(quantity, PI - UPSIDE_DOWN),
            false => Check::up_to(quantity, FLAT),
        }
    }
}
