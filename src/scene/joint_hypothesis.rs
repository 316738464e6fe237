//! Alternative assumptions about the joints of a scene: no joints, a fixed joint at every contact,
//! or known joint types with guessed geometry.

use crate::geometry::{ContactPoint, Vector, contact_points};

use super::{Joint, JointKind, Object, Physics, Scene};

/// Gap between two objects at the start below which they count as touching when every contact
/// becomes a fixed joint, metres. The joint inference of Tekden (2020) considers the same distance.
pub const NEARLY_TOUCHING: f64 = 0.005;

impl Physics {
    /// Returns the physics that an observer assumes who knows which objects of `scene` are joined,
    /// and by which type of joint, but not the axes.
    ///
    /// The geometry is guessed from the stated poses. The axis of a revolute joint is midway
    /// between the closest points of the two objects, a prismatic joint slides along the line of
    /// their centres, and neither has limits. Such joints are marked [`Joint::guessed`]. Fixed
    /// joints are unchanged because they have no geometry to guess.
    pub fn guess_joints(&self, scene: &Scene) -> Self {
        let guess = |joint: &Joint| {
            let [first, second] = joint.between.map(|index| &scene.objects[index]);
            let kind = match joint.kind {
                JointKind::Fixed => return joint.clone(),
                JointKind::Revolute { .. } => {
                    JointKind::Revolute { at: between(first, second), limits: None }
                }
                JointKind::Prismatic { .. } => {
                    JointKind::Prismatic { axis: line_of_centres(first, second), limits: None }
                }
            };
            Joint { kind, guessed: true, ..joint.clone() }
        };
        Self { joints: self.joints.iter().map(guess).collect(), ..self.clone() }
    }

    /// Removes all joints.
    pub fn without_joints(&self) -> Self {
        Self { joints: Vec::new(), ..self.clone() }
    }

    /// Replaces all joints by fixed joints between objects of `scene` that touch or nearly touch at
    /// their stated poses (gap below [`NEARLY_TOUCHING`]).
    pub fn with_contacts_fixed(&self, scene: &Scene) -> Self {
        let mut joints = Vec::new();
        for (a, first) in scene.objects.iter().enumerate() {
            for (b, second) in scene.objects.iter().enumerate().skip(a + 1) {
                if gap(first, second) < NEARLY_TOUCHING {
                    let kind = JointKind::Fixed;
                    joints.push(Joint::new([a, b], kind));
                }
            }
        }
        Self { joints, ..self.clone() }
    }
}

/// Returns the smallest distance of two objects at the start, metres; negative if they overlap.
fn gap(first: &Object, second: &Object) -> f64 {
    closest(first, second).map_or(f64::INFINITY, |point| point.gap)
}

/// Returns the midpoint of the closest points of two objects.
fn between(first: &Object, second: &Object) -> Vector {
    match closest(first, second) {
        Some(point) => 0.5 * (point.on_first + point.on_second),
        None => 0.5 * (first.pose.position + second.pose.position),
    }
}

/// Returns the unit vector from the first centre to the second; the first object's own x axis if
/// the centres coincide.
fn line_of_centres(first: &Object, second: &Object) -> Vector {
    let line = second.pose.position - first.pose.position;
    line.try_normalize(1e-9).unwrap_or_else(|| first.pose.vector(Vector::x()))
}

fn closest(first: &Object, second: &Object) -> Option<ContactPoint> {
    let (a, b) = (first.shape.footprint(), second.shape.footprint());
    contact_points((&a, &first.pose), (&b, &second.pose), f64::INFINITY).0[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Span;

    fn scene() -> Scene {
        let object = |name: &str, x, y| Object::cylinder(name, 0.05, 0.1).at(x, y, 0.3);
        let objects = vec![object("a", 0.0, 0.0), object("b", 0.102, 0.0), object("c", 0.1, 0.2)];
        let limits = Some(Span::new(-0.1, 0.1));
        let joint = |between, kind| Joint::new(between, kind);
        let joints = vec![
            joint([0, 1], JointKind::Revolute { at: Vector::new(0.01, 0.02), limits }),
            joint([1, 2], JointKind::Prismatic { axis: Vector::x(), limits }),
            joint([0, 2], JointKind::Fixed),
        ];
        Scene { joints, ..Scene::new(objects) }
    }

    #[test]
    fn geometry_is_guessed_from_the_poses_alone() {
        let scene = scene();
        let stated = Physics::stated(&scene);
        let guessed = stated.guess_joints(&scene);
        let [revolute, prismatic, fixed] = &guessed.joints[..] else { panic!("three joints") };
        let JointKind::Revolute { at, limits: None } = revolute.kind else { panic!("revolute") };
        assert!((at - Vector::new(0.051, 0.0)).norm() < 1e-12 && revolute.guessed);
        let JointKind::Prismatic { axis, limits: None } = prismatic.kind else {
            panic!("prismatic")
        };
        let line = Vector::new(-0.002, 0.2).normalize();
        assert!((axis - line).norm() < 1e-12 && prismatic.guessed);
        assert_eq!(*fixed, scene.joints[2]);
        assert_eq!(guessed.guess_joints(&scene), guessed, "guessing again changes nothing");
    }

    #[test]
    fn contacts_become_joints_and_joints_vanish() {
        let scene = scene();
        let stated = Physics::stated(&scene);
        assert!(stated.without_joints().joints.is_empty());
        let fixed = stated.with_contacts_fixed(&scene);
        let kind = JointKind::Fixed;
        assert_eq!(fixed.joints, [Joint::new([0, 1], kind)]);
    }
}
