//! Demand: the centre of an object lies near a point.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Vector};
use crate::scene::Scene;

use super::check::name;
use super::words::{millimetres, point};
use super::{Check, Demand, End, Kind, Mark, Quantity, less};

/// A point for the centre of an object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AtPlace {
    /// Wanted position of the centre, metres.
    pub position: Vector,
    /// Maximum distance from it, metres.
    pub tolerance: f64,
    /// Index of the object in whose frame the position is; `None` for the world.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relative: Option<usize>,
}

impl Kind for AtPlace {
    fn demand(&self) -> Demand {
        Demand::Place(self.clone())
    }

    fn is_met(&self, end: &End) -> bool {
        self.off(end).is_some_and(|off| off.norm() <= self.tolerance)
    }

    fn words(&self, _: usize, _: &Scene) -> String {
        format!("at {} within {}", point(self.position), millimetres(self.tolerance))
    }

    fn off(&self, end: &End) -> Option<Vector> {
        let frame = self.relative.and_then(|other| end.state.poses.get(other));
        let wanted = frame.map_or(self.position, |frame| frame.point(self.position));
        Some(end.pose().position - wanted)
    }

    fn tolerance(&self) -> Option<f64> {
        Some(self.tolerance)
    }

    fn position(&self) -> Option<Vector> {
        Some(self.position)
    }

    fn anchor(&self) -> Vector {
        self.position
    }

    fn stricter(&self, place: f64, _: f64) -> Demand {
        Demand::Place(Self { tolerance: less(self.tolerance, place), ..self.clone() })
    }

    fn shifted(&self, shift: Vector) -> Demand {
        Demand::Place(Self { position: self.position + shift, ..self.clone() })
    }

    fn seen_from(&self, frame: &Pose) -> Demand {
        let position = frame.point(self.position);
        Demand::Place(Self { position, relative: None, ..self.clone() })
    }

    fn relative_to(&self, other: usize) -> Demand {
        Demand::Place(Self { relative: Some(other), ..self.clone() })
    }

    fn relative(&self) -> Option<usize> {
        self.relative
    }

    fn fault(&self, _: usize, _: &Scene) -> Option<String> {
        let Self { position, tolerance, .. } = self;
        if !(tolerance.is_finite() && *tolerance > 0.0) {
            return Some(format!(
                "the tolerance of the goal is {tolerance}, but must be a positive number"
            ));
        }
        let finite = position.iter().all(|v| v.is_finite());
        (!finite).then(|| "the goal must be finite".to_owned())
    }

    fn check(&self, object: usize, scene: &Scene) -> Check {
        let (frame, to) = (self.relative.map(|other| name(other, scene)), self.position);
        let quantity = Quantity::Distance { object: name(object, scene), frame, to };
        Check::up_to(quantity, self.tolerance)
    }

    fn marks(&self, _: usize, _: &Scene) -> Vec<Mark> {
        vec![Mark::Disc { centre: self.position, radius: self.tolerance }]
    }
}
