//! Demand: the centre of an object lies in an area of the table.

use serde::{Deserialize, Serialize};

use crate::geometry::{Footprint, Pose, Shape, Vector, clearance, contact_points};
use crate::scene::Scene;

use super::check::name;
use super::words::{millimetres, point};
use super::{Check, Demand, End, Kind, Mark, Quantity, less};

/// Depth of the targets of search and refinement inside of an area, metres, but at most half-way to
/// the middle of a narrow area. Simulations differ by millimetres.
const INSIDE: f64 = 0.02;

/// An area for the centre of an object.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Area {
    /// Solid with the area's outline; its height does not matter.
    pub shape: Shape,
    /// Pose, in the world or in the frame to which the goal is relative.
    pub pose: Pose,
}

impl Area {
    /// Returns the depth of target points inside of the rim, metres.
    pub fn depth(&self) -> f64 {
        INSIDE.min(0.5 * self.shape.footprint().inner_radius())
    }

    /// Returns `true` if a point is in it.
    pub fn holds(&self, point: Vector) -> bool {
        let at = Pose { position: point, heading: 0.0 };
        let dot = Footprint::Disc { radius: 0.0 };
        clearance((&dot, &at), (&self.shape.footprint(), &self.pose), 1e-3) <= 0.0
    }

    /// Returns its corners, counter-clockwise. A circle becomes a polygon that deviates by less
    /// than a thousandth of its radius.
    pub fn corners(&self) -> Vec<Vector> {
        const ROUND: usize = 64;
        let own = match self.shape.footprint() {
            Footprint::Disc { radius } => (0..ROUND)
                .map(|k| {
                    let angle = std::f64::consts::TAU * k as f64 / ROUND as f64;
                    radius * Vector::new(angle.cos(), angle.sin())
                })
                .collect(),
            Footprint::Rectangle { half } => [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
                .map(|(x, y)| Vector::new(x * half.x, y * half.y))
                .to_vec(),
            Footprint::Polygon(polygon) => polygon.corners().to_vec(),
        };
        own.into_iter().map(|corner| self.pose.point(corner)).collect()
    }

    /// Returns the nearest point to `point` that is [deep enough](Self::depth) inside.
    pub fn nearest(&self, point: Vector) -> Vector {
        let at = Pose { position: point, heading: 0.0 };
        let dot = Footprint::Disc { radius: 0.0 };
        let core = self.shape.footprint().shrunk(self.depth());
        let (points, _) = contact_points((&dot, &at), (&core, &self.pose), f64::INFINITY);
        match points[0] {
            Some(found) if found.gap > 0.0 => found.on_second,
            _ => point,
        }
    }

    /// Returns the area smaller by `margin` metres on every side, or by half of its extent if that
    /// is less.
    pub fn shrunk(self, margin: f64) -> Self {
        self.of(self.shape.footprint().shrunk(margin))
    }

    /// Returns the area larger by `margin` metres on every side.
    pub fn grown(self, margin: f64) -> Self {
        self.of(self.shape.footprint().grown(margin))
    }

    fn of(self, footprint: Footprint) -> Self {
        let height = self.shape.height();
        let shape = match footprint {
            Footprint::Disc { radius } => Shape::Cylinder { radius, height },
            Footprint::Rectangle { half } => {
                Shape::Cuboid { size: [2.0 * half.x, 2.0 * half.y, height] }
            }
            Footprint::Polygon(base) => Shape::Prism { base, height },
        };
        Self { shape, ..self }
    }

    /// Returns its outline and its centre in words.
    pub(super) fn words(&self) -> String {
        let outline = match self.shape.footprint() {
            Footprint::Disc { radius } => format!("a circle of {}", millimetres(radius)),
            Footprint::Rectangle { half } => {
                let [x, y] = [half.x, half.y].map(|half| millimetres(2.0 * half));
                format!("a rectangle of {x} by {y}")
            }
            Footprint::Polygon(_) => "a polygon".to_owned(),
        };
        format!("{outline} about {}", point(self.pose.position))
    }

    /// Returns its outline as a solid of this height, metres.
    pub fn flat(&self, height: f64) -> Shape {
        match self.shape {
            Shape::Cylinder { radius, .. } => Shape::Cylinder { radius, height },
            Shape::Cuboid { size: [x, y, _] } => Shape::Cuboid { size: [x, y, height] },
            Shape::Prism { base, .. } => Shape::Prism { base, height },
        }
    }

    /// Moves the area by `shift`, metres.
    pub fn shifted(self, shift: Vector) -> Self {
        let pose = Pose { position: self.pose.position + shift, ..self.pose };
        Self { pose, ..self }
    }

    /// Returns the area in the frame in which `frame` is given.
    pub fn seen_from(self, frame: &Pose) -> Self {
        Self { pose: *frame * self.pose, ..self }
    }
}

/// An area for the centre of an object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct InArea {
    /// The area.
    pub area: Area,
    /// Maximum distance from the nearest target point, [deep enough](Area::depth) inside, metres.
    pub tolerance: f64,
    /// Index of the object in whose frame the area is; `None` for the world.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relative: Option<usize>,
}

impl InArea {
    /// Creates a demand with an area in the world.
    pub fn new(area: Area) -> Self {
        Self { area, tolerance: area.depth(), relative: None }
    }

    fn seen(&self, end: &End) -> Area {
        let frame = self.relative.and_then(|other| end.state.poses.get(other));
        frame.map_or(self.area, |frame| self.area.seen_from(frame))
    }
}

impl Kind for InArea {
    fn demand(&self) -> Demand {
        Demand::Area(Box::new(self.clone()))
    }

    fn is_met(&self, end: &End) -> bool {
        self.seen(end).holds(end.pose().position)
    }

    fn words(&self, _: usize, _: &Scene) -> String {
        format!("in {}", self.area.words())
    }

    fn off(&self, end: &End) -> Option<Vector> {
        let at = end.pose().position;
        Some(at - self.seen(end).nearest(at))
    }

    fn tolerance(&self) -> Option<f64> {
        Some(self.tolerance)
    }

    fn position(&self) -> Option<Vector> {
        Some(self.area.pose.position)
    }

    fn anchor(&self) -> Vector {
        self.area.pose.position
    }

    fn stricter(&self, place: f64, _: f64) -> Demand {
        let (area, tolerance) = (self.area.shrunk(place), less(self.tolerance, place));
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

    fn fault(&self, _: usize, _: &Scene) -> Option<String> {
        let sound =
            self.area.pose.is_finite() && self.tolerance.is_finite() && self.tolerance > 0.0;
        (!sound).then(|| "the area of the goal must be finite".to_owned())
    }

    fn check(&self, object: usize, scene: &Scene) -> Check {
        let (frame, corners) = (self.relative.map(|other| name(other, scene)), self.area.corners());
        Check::up_to(Quantity::Beyond { object: name(object, scene), frame, corners }, 0.0)
    }

    fn marks(&self, _: usize, _: &Scene) -> Vec<Mark> {
        vec![Mark::Area(self.area)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_target_lies_deep_enough_inside() {
        let shape = Shape::Cuboid { size: [0.2, 0.1, 1.0] };
        let area = Area { shape, pose: Pose::new(0.5, 0.0, std::f64::consts::FRAC_PI_2) };
        let close = |point: Vector, x: f64, y: f64| (point - Vector::new(x, y)).norm() < 1e-9;
        assert!(close(area.nearest(Vector::new(0.7, 0.0)), 0.53, 0.0));
        assert!(close(area.nearest(Vector::new(0.52, 0.05)), 0.52, 0.05), "inside");
        assert!(close(area.nearest(Vector::new(0.7, 0.3)), 0.53, 0.08), "a corner");
        assert!(area.holds(Vector::new(0.549, 0.099)) && !area.holds(Vector::new(0.551, 0.0)));
    }
}
