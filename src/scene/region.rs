//! Keep-out regions of the table.

use serde::{Deserialize, Serialize};

use crate::geometry::{Footprint, Pose, Shape, clearance};

/// A region of the table from which some bodies keep out, at any height.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Region {
    /// Name, unique among objects, obstacles and regions.
    pub name: String,
    /// Solid with the region's outline; its height does not matter.
    pub shape: Shape,
    /// Pose of the region.
    pub pose: Pose,
    /// Whether objects keep out of it.
    pub objects: bool,
    /// Whether the tool keeps out of it.
    pub tool: bool,
    /// Whether the hand keeps out of it.
    pub hand: bool,
}

impl Region {
    /// Overlap with a region below which a body is outside of it, metres: rounding.
    pub(super) const SLACK: f64 = 1e-6;

    /// Clearance of predicted objects from regions, metres: predictions and start poses have errors
    /// of millimetres.
    pub const MARGIN: f64 = 0.01;

    /// Returns its outline.
    pub fn footprint(&self) -> Footprint {
        self.shape.footprint()
    }

    /// Returns a sheet on the table with its outline and this thickness, metres, for drawings.
    pub fn sheet(&self, thick: f64) -> Shape {
        match self.shape {
            Shape::Cylinder { radius, .. } => Shape::Cylinder { radius, height: thick },
            Shape::Cuboid { size: [x, y, _] } => Shape::Cuboid { size: [x, y, thick] },
            Shape::Prism { base, .. } => Shape::Prism { base, height: thick },
        }
    }

    /// Returns the bodies that keep out of it, in words.
    pub fn words(&self) -> String {
        let all = [(self.objects, "objects"), (self.tool, "tool"), (self.hand, "hand")];
        let all: Vec<&str> = all.iter().filter(|(out, _)| *out).map(|(_, word)| *word).collect();
        format!("keep-out region for {}", all.join(", "))
    }

    /// Returns `true` if this footprint at `pose` is in the region or nearer to it than `margin`
    /// metres; a negative margin is an overlap that does not count.
    pub fn holds(&self, footprint: &Footprint, pose: &Pose, margin: f64) -> bool {
        let own = match margin {
            margin if margin > 0.0 => self.footprint().grown(margin),
            margin => self.footprint().shrunk(Self::SLACK.max(-margin)),
        };
        clearance((footprint, pose), (&own, &self.pose), Self::SLACK) <= 0.0
    }
}
