//! The way of a hinged object to its wanted heading, for drawings.

use crate::geometry::{Footprint, Pose, Vector};
use crate::scene::{JointKind, Scene};

use super::{Facing, mark::Swing};

/// Distance of a centre from its hinge below which it has no direction, metres.
const NEAR: f64 = 1e-3;

impl Facing {
    /// Returns the way of an object about its hinge, or `None` for an object without one.
    pub(super) fn swing(&self, object: usize, scene: &Scene) -> Option<Swing> {
        let hinge = hinge(object, scene, self.limit_middle.is_some())?;
        let pose = scene.objects.get(object)?.pose;
        let solids = || scene.parts_of(object).chain([object]);
        let corners = || solids().flat_map(|k| corners(scene, k)).map(|corner| corner - hinge);
        let far = corners().max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        let centre = pose.position - hinge;
        let way = if centre.norm() > NEAR { centre } else { far };
        let from = way.y.atan2(way.x);
        let turn = match self.limit_middle {
            // Within limits, headings are not wrapped.
            Some(_) => self.heading - pose.heading,
            None => self.least_turn(self.heading - pose.heading),
        };
        Some(Swing { hinge, radius: far.norm(), from, to: from + turn })
    }
}

/// Returns the position of the hinge about which an object turns: to the world, otherwise its only
/// one to another object if the rotation against that object is `limited`.
fn hinge(object: usize, scene: &Scene, limited: bool) -> Option<Vector> {
    let at = |kind: &JointKind| match kind {
        JointKind::Revolute { at, .. } => Some(*at),
        _ => None,
    };
    if let Some(mount) = scene.mounts.iter().find(|mount| mount.object == object) {
        return at(&mount.kind);
    }
    let own = scene.joints.iter().filter(|joint| joint.between.contains(&object));
    let mut hinges = own.filter_map(|joint| at(&joint.kind));
    let hinge = hinges.next().filter(|_| limited)?;
    hinges.next().is_none().then_some(hinge)
}

/// Returns the corners of a solid at the start, metres; of a disc, four points of its rim.
fn corners(scene: &Scene, solid: usize) -> Vec<Vector> {
    let object = &scene.objects[solid];
    let own = match object.shape.footprint() {
        Footprint::Disc { radius } => {
            square(Vector::new(radius, radius)).map(|c| c * 0.5f64.sqrt()).to_vec()
        }
        Footprint::Rectangle { half } => square(half).to_vec(),
        Footprint::Polygon(polygon) => polygon.corners().to_vec(),
    };
    let pose: Pose = object.pose;
    own.into_iter().map(|corner| pose.point(corner)).collect()
}

fn square(half: Vector) -> [Vector; 4] {
    [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
        .map(|(x, y)| Vector::new(x * half.x, y * half.y))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::scene::{Object, Span};

    #[test]
    fn a_door_swings_about_its_hinge_the_way_its_limits_allow() {
        // A door of 0.3 m along x, hinged at its left end.
        let door = Object::cuboid("door", [0.3, 0.02, 0.1]).at(0.65, 0.0, 0.0);
        let scene = |limits| {
            let kind = JointKind::Revolute { at: Vector::new(0.5, 0.0), limits };
            Scene::new([door.clone()]).with_mount(0, kind)
        };
        let swing = |heading: f64, limits: Option<Span>| {
            let scene = scene(limits);
            let mut facing = Facing::new(heading, 0.1);
            facing.limit(0, &scene);
            facing.swing(0, &scene).expect("it has a hinge")
        };
        let quarter = swing(FRAC_PI_2, None);
        assert!((quarter.radius - 0.3f64.hypot(0.01)).abs() < 1e-12);
        assert_eq!((quarter.hinge, quarter.from), (Vector::new(0.5, 0.0), 0.0));
        assert!((quarter.to - FRAC_PI_2).abs() < 1e-12);
        // The longer way, because the shorter one is behind a limit.
        let longer = swing(FRAC_PI_2, Some(Span::new(-6.0, 0.0)));
        assert!((longer.to + 3.0 * FRAC_PI_2).abs() < 1e-12, "{longer:?}");
        let loose = Scene::new([door.clone()]);
        assert_eq!(Facing::new(1.0, 0.1).swing(0, &loose), None);
    }
}
