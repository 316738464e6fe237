//! A model that is told other joints than the scene has.

use std::sync::Arc;

use crate::scene::{Physics, Record, Scene, ToolMotion, Trajectory, Warning};

use super::{EffectModel, Job};

/// What a model is told about the joints of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Assumption {
    /// The type of every joint, its geometry guessed from the start poses
    /// ([`Physics::guess_joints`]).
    TypesOnly,
    /// That there are none ([`Physics::without_joints`]).
    NoJoints,
    /// That whatever touches at the start is fixed together ([`Physics::with_contacts_fixed`]).
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

    /// What is believed instead of `physics`.
    pub fn physics(self, scene: &Scene, physics: &Physics) -> Physics {
        match self {
            Assumption::TypesOnly => physics.guess_joints(scene),
            Assumption::NoJoints => physics.without_joints(),
            Assumption::ContactsFixed => physics.with_contacts_fixed(scene),
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
        self.model.warnings(scene, motion)
    }

    /// Unknown: measured errors are those with the true joints.
    fn error_p95(&self) -> f64 {
        f64::INFINITY
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        let assume = |job: &Job| {
            let physics = Arc::new(self.assumption.physics(scene, &job.physics));
            Job { physics, ..job.clone() }
        };
        let jobs: Vec<Job> = jobs.iter().map(assume).collect();
        self.model.rollout(scene, &jobs, record)
    }
}
