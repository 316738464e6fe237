//! Nothing moves.

use crate::{
    effect::{EffectModel, Trust},
    geometry::Pose,
    outcome::{Record, Trajectory},
    scene::{ModelKind, ModelSpec, Physics, Scene},
    task::Job,
};

use super::play::{Rule, Table, play_all};

/// Objects stay where they are, whatever the tool does.
#[derive(Clone, Copy, Debug, Default)]
pub struct Still;

static SPEC: ModelSpec = ModelSpec::of(ModelKind::Still);

struct Nothing;

impl Rule for Nothing {
    fn begin(_: &Scene, _: &Physics) -> Self {
        Nothing
    }

    fn step(&mut self, _: &Table, _: &Pose, _: &Pose, _: &mut [Pose]) {}
}

impl EffectModel for Still {
    fn spec(&self) -> &ModelSpec {
        &SPEC
    }

    fn trust(&self, _: &Scene, job: &Job) -> Trust {
        if job.in_space() {
            return Trust::NotMine;
        }
        Trust::Mine { error: None, warnings: Vec::new() }
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        play_all::<Nothing>(&SPEC, scene, jobs, record)
    }
}
