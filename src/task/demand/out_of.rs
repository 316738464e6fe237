//! Demand: the centre of an object lies outside of an area of the table.

use serde::{Deserialize, Serialize};

use crate::geometry::{Footprint, Pose, Vector, contact_points};
use crate::scene::Scene;

use super::check::name;
use super::{Area, Check, Demand, End, Kind, Mark, Quantity, less};

/// Distance of the targets of search and refinement from the rim, metres. Simulations differ by
/// millimetres.
const BEYOND: f64 = 0.02;

/// An area that the centre of an object must leave, or stay out of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OutOfArea {
    /// The area.
    pub area: Area,
    /// Maximum distance from the nearest target point, far enough outside, metres.
    pub tolerance: f64,
    /// Index of the object in whose frame the area is; `None` for the world.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relative: Option<usize>,
}

impl OutOfArea {
    /// Creates a demand with an area in the world.
    pub fn new(area: Area) -> Self {
        Self { area, tolerance: BEYOND, relative: None }
    }

    fn seen(&self, end: &End) -> Area {
        let frame = self.relative.and_then(|other| end.state.poses.get(other));
        frame.map_or(self.area, |frame| self.area.seen_from(frame))
    }
}

impl Kind for OutOfArea {
    fn demand(&self) -> Demand {
        Demand::OutOf(Box::new(self.clone()))
    }

    fn is_met(&self, end: &End) -> bool {
        !self.seen(end).holds(end.pose().position)
    }

    fn words(&self, _: usize, _: &Scene) -> String {
        format!("outside of {}", self.area.words())
    }

    fn off(&self, end: &End) -> Option<Vector> {
        let area = self.seen(end);
        let at = Pose { position: end.pose().position, heading: 0.0 };
        let dot = Footprint::Disc { radius: 0.0 };
        let (points, _) =
            contact_points((&dot, &at), (&area.shape.footprint(), &area.pose), BEYOND);
        let missing = points[0].map(|found| (found.gap - BEYOND).min(0.0) * found.normal);
        Some(missing.unwrap_or_default())
    }

    fn tolerance(&self) -> Option<f64> {
        Some(self.tolerance)
    }

    fn anchor(&self) -> Vector {
        self.area.pose.position
    }

    fn stricter(&self, place: f64, _: f64) -> Demand {
        let (area, tolerance) = (self.area.grown(place), less(self.tolerance, place));
        Self { area, tolerance, ..self.clone() }.demand()
    }

    fn shifted(&self, shift: Vector) -> Demand {
        Self { area: self.area.shifted(shift), ..self.clone() }.demand()
    }

    fn seen_from(&self, frame: &Pose) -> Demand {
        Self { area: self.area.seen_from(frame), relative: None, ..self.clone() }.demand()
    }

    fn relative_to(&self, other: usize) -> Demand {
        Self { relative: Some(other), ..self.clone() }.demand()
    }

    fn relative(&self) -> Option<usize> {
        self.relative
    }

    fn is_relation(&self) -> bool {
        true
    }

    fn fault(&self, _: usize, _: &Scene) -> Option<String> {
        let sound =
            self.area.pose.is_finite() && self.tolerance.is_finite() && self.tolerance > 0.0;
        (!sound).then(|| "the area of the goal must be finite".to_owned())
    }

    fn check(&self, object: usize, scene: &Scene) -> Check {
        let (frame, corners) = (self.relative.map(|other| name(other, scene)), self.area.corners());
        Check::from(Quantity::Beyond { object: name(object, scene), frame, corners }, 0.0)
    }

    fn marks(&self, _: usize, _: &Scene) -> Vec<Mark> {
        vec![Mark::Outside(self.area)]
    }
}

#[cfg(test)]
mod tests {
    use crate::geometry::Shape;
    use crate::scene::State;

    use super::*;

    #[test]
    fn the_way_out_is_the_shortest_and_ends_beyond_the_rim() {
        for shape in
            [Shape::Cuboid { size: [0.2, 0.1, 1.0] }, Shape::Cylinder { radius: 0.05, height: 1.0 }]
        {
            let area = Area { shape, pose: Pose::new(0.5, 0.0, 0.0) };
            let demand = OutOfArea::new(area);
            for y in [0.0, 0.01, 0.04, 0.06] {
                let state = State::at_rest(vec![Pose::new(0.5, y, 0.0)]);
                let end = End::resting(0, &state);
                let off = demand.off(&end).expect("a place");
                assert!((off.norm() - (0.07 - y)).abs() < 1e-9, "{shape:?} {y}: {off}");
                assert_eq!(demand.is_met(&end), y > 0.05);
                assert_eq!(demand.score(&end) <= 1.0, y > 0.05);
                let there = State::at_rest(vec![Pose::new(0.5 - off.x, y - off.y, 0.0)]);
                assert!(demand.off(&End::resting(0, &there)).expect("a place").norm() < 1e-9);
            }
            let strict = demand.stricter(0.005, 0.0);
            let state = State::at_rest(vec![Pose::new(0.5, 0.054, 0.0)]);
            assert!(demand.is_met(&End::resting(0, &state)));
            assert!(!strict.kind().is_met(&End::resting(0, &state)));
        }
    }
}
