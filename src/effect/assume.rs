//! A model that is told other joints than the scene has.

use crate::scene::{Record, Scene, ToolMotion, Trajectory, Warning};

use super::{EffectModel, Job};

/// What a model is told about the joints of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Assumption {
    /// The type of every joint, its geometry guessed from the start poses
    /// ([`Scene::guess_joints`]).
    TypesOnly,
    /// That there are none ([`Scene::without_joints`]).
    NoJoints,
    /// That whatever touches at the start is fixed together ([`Scene::with_contacts_fixed`]).
    ContactsFixed,
}

impl Assumption {
    /// All of them.
    pub const ALL: [Assumption; 3] =
        [Assumption::TypesOnly, Assumption::NoJoints, Assumption::ContactsFixed];

    /// A word or two for tables.
    pub fn title(self) -> &'static str {
        match self {
            Assumption::TypesOnly => "types only",
            Assumption::NoJoints => "no joints",
            Assumption::ContactsFixed => "every contact fixed",
        }
    }

    /// The scene as it is believed to be.
    pub fn scene(self, scene: &Scene) -> Scene {
        match self {
            Assumption::TypesOnly => scene.guess_joints(),
            Assumption::NoJoints => scene.without_joints(),
            Assumption::ContactsFixed => scene.with_contacts_fixed(),
        }
    }
}

/// A model under an assumption about joints: `brdpn-128, no joints`.
#[derive(Clone, Debug)]
pub struct Assuming<M> {
    model: M,
    assumption: Assumption,
    name: String,
}

impl<M: EffectModel> Assuming<M> {
    /// `model`, told only what `assumption` says.
    pub fn new(model: M, assumption: Assumption) -> Self {
        let name = format!("{}, {}", model.name(), assumption.title());
        Self { model, assumption, name }
    }
}

impl<M: EffectModel> EffectModel for Assuming<M> {
    fn name(&self) -> &str {
        &self.name
    }

    fn warnings(&self, scene: &Scene, motion: &ToolMotion) -> Vec<Warning> {
        self.model.warnings(&self.assumption.scene(scene), motion)
    }

    /// Unknown: measured errors are those with the true joints.
    fn error_p95(&self) -> f64 {
        f64::INFINITY
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        self.model.rollout(&self.assumption.scene(scene), jobs, record)
    }
}
