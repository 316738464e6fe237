//! Conversion of bodies to objects, before they are placed on a table.

use crate::diagnostic::Ledger;
use crate::model::{Model, Motion, Place, Solid};
use pushplan::geometry::Pose;
use pushplan::scene::{Joint, JointKind, Object, Scene, Whole};

use super::names::Names;
use super::thing::of_group;
use super::wanted::Wanted;

/// Object before it is placed on a table.
pub(super) struct Draft<'a> {
    pub object: Object,
    /// Additional solids of a compound object, with their poses in its frame.
    pub parts: Vec<(Object, Pose)>,
    pub place: Place,
    /// Index of the body that the object represents.
    pub body: usize,
    /// Index of the freely movable or jointed body that the object is fixed to.
    pub group: usize,
    /// Solid that touches other objects.
    pub solid: &'a Solid,
    /// Spheres that touch the table in place of the solid.
    pub feet: Vec<&'a Solid>,
    /// Height of the lowest point in the world, metres.
    pub low: f64,
}

/// Returns objects and joints of the body `root` and all bodies attached to it.
pub(super) fn drafts<'a>(
    model: &'a Model,
    root: usize,
    wanted: &Wanted,
    names: &mut Names,
    ledger: &mut Ledger,
) -> (Vec<Draft<'a>>, Vec<(usize, Motion)>) {
    let (mut found, mut hung) = (Vec::new(), Vec::new());
    let mut waiting = vec![root];
    while let Some(group) = waiting.pop() {
        let bodies = model.rigid(group);
        found.extend(of_group(model, group, &bodies, wanted, names, ledger));
        for body in &bodies {
            for child in model.children(*body).filter(|child| !bodies.contains(child)) {
                hung.push((child, model.bodies[child].motion.clone()));
                waiting.push(child);
            }
        }
    }
    (found, hung)
}

/// Returns the scene with the parts of all objects appended.
pub(super) fn placed(mut scene: Scene, drafts: &[Draft<'_>]) -> Scene {
    for (index, draft) in drafts.iter().enumerate() {
        for (part, place) in &draft.parts {
            let pose = scene.objects[index].pose * *place;
            let whole = Some(Whole { object: index, place: *place });
            scene.joints.push(Joint::new([index, scene.objects.len()], JointKind::Fixed));
            scene.objects.push(Object { pose, whole, ..part.clone() });
        }
    }
    scene
}
