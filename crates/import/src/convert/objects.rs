//! Objects, before they stand on a table.

use crate::fault::Ledger;
use crate::model::{Model, Motion, Place, Solid};
use pushplan::geometry::Pose;
use pushplan::scene::{Joint, JointKind, Object, Scene, Whole};

use super::names::Names;
use super::thing::of_group;
use super::wanted::Wanted;

/// An object before it stands on a table.
pub(super) struct Draft<'a> {
    pub object: Object,
    /// Further solids that are one with it, and where they are in its frame.
    pub parts: Vec<(Object, Pose)>,
    pub place: Place,
    /// The body that it is of.
    pub body: usize,
    /// The freely movable or jointed body that this is fixed to.
    pub group: usize,
    /// What touches others.
    pub solid: &'a Solid,
    /// What touches the table, where the solid does not.
    pub feet: Vec<&'a Solid>,
    /// Height of the lowest point in the world, metres.
    pub low: f64,
}

/// Objects and joints of everything that hangs on the body `root`.
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

/// The scene with all these, parts after all things.
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
