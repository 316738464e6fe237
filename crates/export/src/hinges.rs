//! MJCF of the joints of objects.

use pushplan::geometry::{Pose, Vector};
use pushplan::scene::{GRAVITY, Joint, JointKind, Scene, WorldJoint};

use super::xml::{Xml, numbers};

/// Writes the joint between an object and the world.
pub(super) fn mount(xml: &mut Xml, scene: &Scene, mount: &WorldJoint) {
    let frame = mount.frames(&scene.objects)[1];
    hinge(xml, &mount.kind, frame, 1.0, rubbing(scene, mount));
}

/// Writes the joint that attaches object `child`; in MJCF a body without a joint is fixed.
pub(super) fn joint(xml: &mut Xml, scene: &Scene, child: usize, joint: &Joint) {
    // Limits in files are of the second object against the first, in MuJoCo of the child.
    let (side, sign) = if joint.between[1] == child { (1, 1.0) } else { (0, -1.0) };
    hinge(xml, &joint.kind, joint.frames(&scene.objects)[side], sign, 0.0);
}

/// Returns the joint friction that replaces the table's friction on an object with a world joint, N
/// or N m.
///
/// The object rests on the table but has only one degree of freedom. Contacts at its feet would
/// overconstrain it in height: a drawer with 32 feet bounces.
fn rubbing(scene: &Scene, mount: &WorldJoint) -> f64 {
    let [hinge, _] = mount.frames(&scene.objects);
    let of = |k: usize| {
        let object = &scene.objects[k];
        let drag = |(at, share): (Vector, f64)| match mount.kind {
            JointKind::Revolute { .. } => share * (object.pose.point(at) - hinge.position).norm(),
            _ => share,
        };
        let feet = scene.feet(k, &object.support);
        let arms: f64 = feet.each().map(drag).sum();
        feet.share * object.mass * GRAVITY * scene.support_friction(k) * arms
    };
    scene.parts_of(mount.object).chain([mount.object]).map(of).sum()
}

/// Writes a hinge or slide joint in this frame of the body, with positions multiplied by `sign`,
/// and with joint friction, N or N m.
fn hinge(xml: &mut Xml, kind: &JointKind, frame: Pose, sign: f64, friction: f64) {
    let (name, axis, at) = match *kind {
        JointKind::Fixed => return,
        JointKind::Revolute { .. } => ("hinge", [0.0, 0.0, sign], frame.position),
        JointKind::Prismatic { .. } => {
            let (y, x) = frame.heading.sin_cos();
            ("slide", [sign * x, sign * y, 0.0], frame.position)
        }
    };
    let mut attributes =
        vec![("type", name.into()), ("pos", numbers(&[at.x, at.y, 0.0])), ("axis", numbers(&axis))];
    if friction > 0.0 {
        attributes.push(("frictionloss", numbers(&[friction])));
    }
    if let Some(limits) = kind.limits() {
        attributes.push(("range", numbers(&[limits.low, limits.high])));
    }
    xml.leaf("joint", &attributes);
}
