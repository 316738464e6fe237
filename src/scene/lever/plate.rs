//! Plates: objects with six degrees of freedom, under which a blade can go.

use serde::{Deserialize, Serialize};

use crate::geometry::{
    ConvexPolygon, Footprint, Pose, Pose3, Shape, Solid, Vector, centroid, cross,
};
use crate::scene::{Object, Scene};

/// Tolerance of the right angles of a rectangle: sine of the deviation.
const SQUARE: f64 = 1e-9;

/// An upright convex prism, part of a plate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Slab {
    /// Corners of its outline in the plate's frame, counter-clockwise, metres.
    pub corners: Vec<Vector>,
    /// Height of its underside above the underside of the plate, metres.
    pub bottom: f64,
    /// Height, metres.
    pub height: f64,
}

impl Slab {
    /// Returns the centre seen from above (metres), the heading (radians) and the extents along and
    /// across it (metres) of a cuboid, in the plate frame. Returns `None` for other outlines.
    pub fn rectangle(&self) -> Option<(Vector, f64, [f64; 2])> {
        let [a, b, c, d] = *self.corners else { return None };
        let (x, y) = (b - a, d - a);
        let (length, width) = (x.norm(), y.norm());
        let square = x.dot(&y).abs() <= SQUARE * length * width;
        let closed = (c - b - y).norm() <= SQUARE * (length + width);
        (square && closed && cross(x, y) > 0.0)
            .then(|| (0.5 * (a + c), x.y.atan2(x.x), [length, width]))
    }

    /// Returns the solid about its own centre, and its pose in the plate's frame.
    pub fn solid(&self) -> Option<(Shape, Pose)> {
        if let Some((position, heading, [x, y])) = self.rectangle() {
            return Some((Shape::Cuboid { size: [x, y, self.height] }, Pose { position, heading }));
        }
        let position = centroid(&self.corners);
        let base = ConvexPolygon::new(&self.corners).ok()?;
        Some((Shape::Prism { base, height: self.height }, Pose { position, heading: 0.0 }))
    }

    /// Returns the solid about the origin of the plate's frame, which is the centre of mass of all
    /// solids.
    pub fn around_origin(&self) -> Option<Shape> {
        // An exact comparison, so that a round trip returns bitwise equal solids.
        let is_centred = |corners: &[Vector; 4]| {
            let [x, y]: [f64; 2] = corners[2].into();
            *corners == [[-x, -y], [x, -y], [x, y], [-x, y]].map(|[x, y]| Vector::new(x, y))
        };
        let height = self.height;
        match <&[Vector; 4]>::try_from(&self.corners[..]) {
            Ok(corners) if is_centred(corners) => {
                Some(Shape::Cuboid { size: [2.0 * corners[2].x, 2.0 * corners[2].y, height] })
            }
            _ => {
                let base = ConvexPolygon::balanced(&self.corners, Vector::zeros()).ok()?;
                Some(Shape::Prism { base, height })
            }
        }
    }
}

/// Returns the corners of a solid's outline, counter-clockwise, metres.
pub(super) fn outline(shape: &Shape) -> Vec<Vector> {
    match shape.footprint() {
        Footprint::Rectangle { half } => {
            let [x, y]: [f64; 2] = half.into();
            [[-x, -y], [x, -y], [x, y], [-x, y]].map(|[x, y]| Vector::new(x, y)).to_vec()
        }
        Footprint::Polygon(polygon) => polygon.corners().to_vec(),
        Footprint::Disc { radius } => (0..ROUND)
            .map(|k| std::f64::consts::TAU * k as f64 / ROUND as f64)
            .map(|angle| radius * Vector::new(angle.cos(), angle.sin()))
            .collect(),
    }
}

/// Number of corners of a cylinder's outline; over a blade's width the edge deviates from the
/// circle by less than 0.1 mm.
const ROUND: usize = 24;

/// An object with six degrees of freedom: a rigid body that consists of a convex plate with a flat
/// underside and the solids fixed on it.
///
/// Its frame lies in the plane of the underside, below the centre of mass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plate {
    /// Name, unique within the scene.
    pub name: String,
    /// Solids, of one density. The first is the plate itself, whose outline can be levered.
    pub slabs: Vec<Slab>,
    /// Mass, kg.
    pub mass: f64,
    /// Friction value; the coefficient of a pair is the mean of the two values.
    pub friction: f64,
    /// Free height below the edge, metres. A plate whose underside is no higher above the table
    /// stands on feet of this height at its corners; a higher one lies on blocks.
    pub clearance: f64,
    /// Pose of its frame at the start, seen from above.
    pub pose: Pose,
    /// Height of the underside above the table at the start, metres.
    pub z: f64,
}

impl Plate {
    /// Returns object `index` of a scene with all its solids as one body.
    pub fn of(scene: &Scene, index: usize) -> Self {
        let object = &scene.objects[index];
        let part = |k: usize| {
            let part = &scene.objects[k];
            let place = part.whole.map_or_else(Pose::default, |whole| whole.place);
            let corners = outline(&part.shape).into_iter().map(|corner| place.point(corner));
            Slab { corners: corners.collect(), bottom: part.z, height: part.shape.height() }
        };
        let base = outline(&object.shape);
        let base = Slab { corners: base, bottom: 0.0, height: object.shape.height() };
        Self {
            name: object.name.clone(),
            slabs: std::iter::once(base).chain(scene.parts_of(index).map(part)).collect(),
            mass: scene.mass(index),
            friction: object.friction,
            clearance: object.clearance,
            pose: object.pose,
            z: object.z,
        }
    }

    /// Returns the object of its first solid, and its other solids with their poses in its frame.
    ///
    /// Returns `None` if the first solid is not a convex prism of at most
    /// [`MAX_CORNERS`](crate::geometry::MAX_CORNERS) corners around the centre of mass, or if
    /// another solid is not convex.
    pub fn solids_of_object(self) -> Option<(Object, Vec<(Object, Pose)>)> {
        let volume: f64 = self.slabs.iter().map(Slab::volume).sum();
        let share = |slab: &Slab| self.mass * (slab.volume() / volume);
        let (base, parts) = self.slabs.split_first()?;
        let object = Object {
            mass: share(base),
            friction: self.friction,
            pose: self.pose,
            clearance: self.clearance,
            z: self.z,
            ..Object::new(&self.name, base.around_origin()?)
        };
        let part = |(k, slab): (usize, &Slab)| {
            let (shape, place) = slab.solid()?;
            let name = format!("{}/{}", self.name, k + 1);
            let part = Object::new(name, shape).mass(share(slab)).friction(self.friction);
            Some((part.raised(slab.bottom), place))
        };
        let parts = parts.iter().enumerate().map(part).collect::<Option<_>>()?;
        Some((object, parts))
    }

    /// Returns the corners of the outline that can be levered, counter-clockwise, plate frame,
    /// metres.
    pub fn corners(&self) -> &[Vector] {
        &self.slabs[0].corners
    }

    /// Returns the pose of its frame at the start.
    pub fn start(&self) -> Pose3 {
        Pose3::upright(self.pose, self.z)
    }

    /// Returns its solids at the start.
    pub fn solids(&self) -> Vec<Solid> {
        self.solids_at(&self.start())
    }

    /// Returns its solids when its frame is at `pose`.
    pub fn solids_at(&self, pose: &Pose3) -> Vec<Solid> {
        let solid = |slab: &Slab| {
            Solid::prism(&slab.corners, [slab.bottom, slab.bottom + slab.height], pose)
        };
        self.slabs.iter().map(solid).collect()
    }

    /// Returns `true` if it stands on feet of its own.
    pub fn has_feet(&self) -> bool {
        self.z <= self.clearance + 1e-9
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_rectangles_are_cuboids() {
        let corner = |x: f64, y: f64| {
            let turn: f64 = 0.4;
            Vector::new(1.0 + turn.cos() * x - turn.sin() * y, turn.sin() * x + turn.cos() * y)
        };
        let corners = [(0.0, 0.0), (0.06, 0.0), (0.06, 0.03), (0.0, 0.03)];
        let corners = corners.map(|(x, y)| corner(x, y)).to_vec();
        let slab = Slab { corners, bottom: 0.0, height: 0.002 };
        let (centre, turn, [x, y]) = slab.rectangle().expect("a rectangle");
        assert!((centre - corner(0.03, 0.015)).norm() < 1e-12);
        assert!((turn - 0.4).abs() < 1e-12 && (x - 0.06).abs() < 1e-12 && (y - 0.03).abs() < 1e-12);
        let mut skew = slab.clone();
        skew.corners[2].x += 1e-4;
        assert!(skew.rectangle().is_none());
        skew.corners.pop();
        assert!(skew.rectangle().is_none());
    }
}
