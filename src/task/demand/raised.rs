//! Demand: at the end of a lever-up's rotation, the edge of an object lies on the blade, lifted.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose3, Vector};
use crate::scene::Scene;

use super::check::name;
use super::words::millimetres;
use super::{Check, Demand, End, Kind, Mark, Quantity};

/// Missing height of an edge that adds 1 to the score, metres.
const STEP: f64 = 0.01;

/// The state of an object at the end of a lever-up's rotation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lift {
    /// Index of the levered object.
    pub object: usize,
    /// Height of its edge at the lever point above its height before the lever-up, metres.
    pub raised: f64,
    /// Whether it lies on the blade.
    pub held: bool,
    /// Tilt of the object, radians.
    pub tilt: f64,
}

impl Lift {
    /// Returns the height (metres) to which the edge of an object is raised: of the point `edge` of
    /// its underside, in its frame, above its underside at `start`. Tables, pages and goals state
    /// this height at the end of the rotation.
    pub fn height(start: &Pose3, now: &Pose3, edge: Vector) -> f64 {
        now.point([edge.x, edge.y, 0.0].into()).z - start.position.z
    }
}

/// A height to which a blade lifts an edge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Raised {
    /// Height above the edge's height at the start, metres.
    pub height: f64,
}

impl Kind for Raised {
    fn demand(&self) -> Demand {
        Demand::Raised(self.clone())
    }

    fn is_met(&self, end: &End) -> bool {
        self.score(end) <= 1.0
    }

    fn words(&self, _: usize, _: &Scene) -> String {
        format!("edge raised by {}", millimetres(self.height))
    }

    fn score(&self, end: &End) -> f64 {
        let (found, held) = end.lift.map_or((0.0, false), |lift| (lift.raised, lift.held));
        let missing = (self.height - found) / STEP;
        if held { 1.0 + missing } else { 2.0 + missing.max(0.0) }
    }

    fn is_at_rest(&self) -> bool {
        false
    }

    fn fault(&self, _: usize, _: &Scene) -> Option<String> {
        (!self.height.is_finite()).then(|| "the height of the goal must be finite".to_owned())
    }

    fn check(&self, object: usize, scene: &Scene) -> Check {
        Check::from(Quantity::Raised { object: name(object, scene) }, self.height)
    }

    fn marks(&self, object: usize, scene: &Scene) -> Vec<Mark> {
        let z = scene.objects.get(object).map_or(0.0, |object| object.z);
        vec![Mark::Height(z + self.height)]
    }
}
