//! A model in which touched objects stick to the tool.

use pushplan::internals::{
    effect::{EffectModel, Trust},
    geometry::Pose,
    outcome::{Record, Trajectory},
    scene::{Body, ModelSpec, Physics, Scene},
    task::Job,
};

use super::play::{Rule, Table, play_all};

/// Baseline model in which an object that the tool runs into moves with the tool until the tool is
/// lifted. Objects that a moving object runs into also move with the tool.
#[derive(Clone, Copy, Debug, Default)]
pub struct Follow;

static SPEC: ModelSpec = ModelSpec::of(Follow::KIND);

struct Sticking {
    held: Vec<bool>,
}

impl Rule for Sticking {
    fn begin(scene: &Scene, _: &Physics) -> Self {
        Self { held: vec![false; scene.objects.len()] }
    }

    fn step(&mut self, table: &Table, from: &Pose, to: &Pose, poses: &mut [Pose]) {
        let motion = *to * from.inverse();
        for (pose, _) in poses.iter_mut().zip(&self.held).filter(|(_, held)| **held) {
            *pose = motion * *pose;
        }
        // Each round attaches at least one more object or is the last.
        for _ in 0..poses.len() {
            let run_into = (0..poses.len()).find(|&object| {
                let others = (0..poses.len())
                    .filter(|&other| self.held[other])
                    .map(|other| (Body::Object(other), poses[other]));
                !self.held[object]
                    && table.parts(to).chain(others).any(|(body, pose)| {
                        let point = table.contact(object, &poses[object], (body, &pose), 0.0);
                        point.is_some_and(|point| point.gap < 0.0)
                    })
            });
            let Some(object) = run_into else { break };
            self.held[object] = true;
            poses[object] = motion * poses[object];
        }
    }

    fn lift(&mut self) {
        self.held.fill(false);
    }
}

impl EffectModel for Follow {
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
        play_all::<Sticking>(&SPEC, scene, jobs, record)
    }
}
