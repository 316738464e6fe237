//! Joints of objects in MuJoCo's terms.

use pushplan::geometry::{Pose, Vector};
use pushplan::scene::{GRAVITY, Joint, JointKind, Mount, Scene};

use super::xml::{Xml, numbers};

/// The joint between a thing and the world.
pub(super) fn mount(xml: &mut Xml, scene: &Scene, mount: &Mount) {
    let frame = mount.frames(&scene.objects)[1];
    hinge(xml, &mount.kind, frame, 1.0, rubbing(scene, mount));
}

/// The joint that attaches object `child`; in MJCF no joint means fixed.
pub(super) fn joint(xml: &mut Xml, scene: &Scene, child: usize, joint: &Joint) {
    // Limits are of the second object against the first, MuJoCo's of the child.
    let (side, sign) = if joint.between[1] == child { (1, 1.0) } else { (0, -1.0) };
    hinge(xml, &joint.kind, joint.frames(&scene.objects)[side], sign, 0.0);
}

/// What the table's friction takes from the joint between a thing and the world, N or N m: it stands on
/// the table all the same, but only along one way it can move. As contacts of feet it would be more
/// than one way up has room for: a drawer of 32 feet bounces.
fn rubbing(scene: &Scene, mount: &Mount) -> f64 {
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

/// A hinge or a slide whose frame is this one of the body's, its positions counted with `sign`, and this
/// much friction of its own, N or N m.
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
