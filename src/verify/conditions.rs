//! Conditions of the perturbed replays of a plan that do not depend on the draw: the table without
//! its edge, obstacles nearer where an object is squeezed, and tools with filled inner corners.

use crate::outcome::{Evidence, Warning};
use crate::scene::{Body, Scene};
use crate::task::{Task, ToolMotion};

use super::inner_corners::filled;
use super::perturbation::{SHIFT, lifted, wary};
use super::sequential_test::LOOK;
use super::tightened::tightened;

/// Scene and motions of perturbed replays.
pub(super) struct Conditions {
    /// The scene.
    pub scene: Scene,
    /// Motions with the tools as stated.
    sharp: Vec<ToolMotion>,
    /// Motions with filled inner corners; empty if no object rolls from one part to another.
    rounded: Vec<ToolMotion>,
}

impl Conditions {
    /// Returns the conditions for a plan with these `motions` and nominal replays.
    pub fn of(task: &Task, scene: &Scene, motions: Vec<ToolMotion>, nominal: &[Evidence]) -> Self {
        let mut scene = wary(task, scene);
        let mut sharp: Vec<ToolMotion> =
            motions.into_iter().map(|motion| lifted(&scene, motion)).collect();
        let is_squeeze = |warning: &Warning| matches!(warning, Warning::Squeezed { .. });
        if nominal.iter().any(|evidence| evidence.warnings.iter().any(is_squeeze)) {
            match tightened(&scene, nominal) {
                Some(tight) => scene = tight,
                None => sharp.iter_mut().for_each(farther),
            }
        }
        let rounded = match rolls_between_parts(&scene, nominal) {
            true => sharp.iter().map(with_filled_corners).collect(),
            false => Vec::new(),
        };
        Self { scene, sharp, rounded }
    }

    /// Returns the motions of a draw. Half of the draws with each support model have filled inner
    /// corners.
    pub fn motions(&self, draw: usize) -> &[ToolMotion] {
        let rounds = (draw + draw / LOOK) % 2 == 1 && !self.rounded.is_empty();
        if rounds { &self.rounded } else { &self.sharp }
    }
}

/// Moves a motion forward, towards the joint or the object that holds the squeezed object.
fn farther(motion: &mut ToolMotion) {
    for stroke in &mut motion.strokes {
        let along = stroke.to.position - stroke.from.position;
        if let Some(along) = along.try_normalize(0.0) {
            stroke.from.position += SHIFT * along;
            stroke.to.position += SHIFT * along;
        }
    }
}

fn with_filled_corners(motion: &ToolMotion) -> ToolMotion {
    ToolMotion { tool: filled(&motion.tool), ..motion.clone() }
}

/// Returns `true` if a round object touches two parts of a tool.
fn rolls_between_parts(scene: &Scene, nominal: &[Evidence]) -> bool {
    let contacts = nominal.iter().filter_map(|evidence| evidence.trajectory.as_ref());
    contacts.map(|trajectory| &trajectory.contacts).any(|contacts| {
        let by_part = |contact: &&crate::outcome::Contact| {
            let round = scene.objects[contact.object].shape.is_cylinder();
            round && matches!(contact.with, Body::Part(_))
        };
        let touched = contacts.iter().filter(by_part);
        touched.clone().any(|a| touched.clone().any(|b| a.object == b.object && a.with != b.with))
    })
}
