//! Regions of the table that are to be kept out of.

use serde::{Deserialize, Serialize};

use crate::geometry::{Footprint, Pose, Shape, clearance};

/// A region of the table that some bodies keep out of, at whatever height.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Region {
    /// Unique among objects, obstacles and regions.
    pub name: String,
    /// Its outline is that of this solid; the height does not matter.
    pub shape: Shape,
    /// Where it is.
    pub pose: Pose,
    /// Whether objects keep out of it.
    pub objects: bool,
    /// Whether the tool does.
    pub tool: bool,
    /// Whether the hand does.
    pub hand: bool,
}

impl Region {
    /// Overlap with a region below which a body is outside of it, metres: rounding.
    pub(super) const SLACK: f64 = 1e-6;

    /// Objects are predicted to keep this far out of regions, metres: predictions are off by
    /// millimetres, and starts are known no better.
    pub const MARGIN: f64 = 0.01;

    /// What it covers.
    pub fn footprint(&self) -> Footprint {
        self.shape.footprint()
    }

    /// Its outline as a sheet on the table that is so thick, metres: to be shown.
    pub fn sheet(&self, thick: f64) -> Shape {
        match self.shape {
            Shape::Cylinder { radius, .. } => Shape::Cylinder { radius, height: thick },
            Shape::Cuboid { size: [x, y, _] } => Shape::Cuboid { size: [x, y, thick] },
            Shape::Prism { base, .. } => Shape::Prism { base, height: thick },
        }
    }

    /// Who keeps out of it, in words.
    pub fn words(&self) -> String {
        let all = [(self.objects, "objects"), (self.tool, "tool"), (self.hand, "hand")];
        let all: Vec<&str> = all.iter().filter(|(out, _)| *out).map(|(_, word)| *word).collect();
        format!("no place for {}", all.join(", "))
    }

    /// Whether this footprint is in it, there, or nearer to it than `margin` metres.
    pub fn holds(&self, footprint: &Footprint, pose: &Pose, margin: f64) -> bool {
        let own = match margin {
            margin if margin > 0.0 => self.footprint().grown(margin),
            _ => self.footprint().shrunk(Self::SLACK),
        };
        clearance((footprint, pose), (&own, &self.pose), Self::SLACK) <= 0.0
    }
}
