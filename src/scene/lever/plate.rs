//! A plate: what a blade goes under.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Pose3, Vector};

/// An upright convex prism, part of a plate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Slab {
    /// Corners of its outline in the plate's frame, counter-clockwise, metres.
    pub corners: Vec<Vector>,
    /// Height of its underside above that of the plate, metres.
    pub bottom: f64,
    /// Height, metres.
    pub height: f64,
}

/// A rigid body with a flat underside: a convex plate and whatever is fixed on it.
///
/// Its frame lies in the plane of the underside, below the centre of mass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plate {
    /// Unique within the scene.
    pub name: String,
    /// Its solids, of one density. The first is the plate itself, whose outline can be levered.
    pub slabs: Vec<Slab>,
    /// Mass, kg.
    pub mass: f64,
    /// Friction value; the coefficient of a pair is the mean of the two values.
    pub friction: f64,
    /// Free height below the edge, metres. A plate whose underside is no higher above the table
    /// stands on feet of this height at its corners; a higher one lies on blocks.
    pub clearance: f64,
    /// Where its frame is at the start, seen from above.
    pub pose: Pose,
    /// Height of the underside above the table at the start, metres.
    pub z: f64,
}

impl Plate {
    /// The corners of the outline that can be levered, counter-clockwise, plate frame, metres.
    pub fn corners(&self) -> &[Vector] {
        &self.slabs[0].corners
    }

    /// Where its frame is at the start.
    pub fn start(&self) -> Pose3 {
        Pose3::upright(self.pose, self.z)
    }

    /// Whether it stands on feet of its own.
    pub fn has_feet(&self) -> bool {
        self.z <= self.clearance + 1e-9
    }
}
