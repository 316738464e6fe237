//! Parallel rollout of many jobs of one scene, frame by frame.

use std::sync::Arc;

use crate::{
    contact::{Bodies, SolverStats},
    graph::{Batch, Corrections},
    outcome::{Record, Trajectory},
    scene::{ModelSpec, Scene},
    task::Job,
};

use super::{
    correction::Reading,
    run::{Memory, Run},
    settings::RollSettings,
    stepper::{Corrector, Stepper},
    work::Work,
};

/// A rollout engine that keeps its memory from one call to the next.
#[derive(Clone, Debug)]
pub struct Roller {
    by: ModelSpec,
    settings: RollSettings,
    memories: Vec<Memory>,
    stepper: Stepper,
    work: Work,
}

impl Roller {
    /// Creates a roller with these settings, for the model `by`.
    pub fn new(by: ModelSpec, settings: RollSettings) -> Self {
        Self {
            by,
            settings,
            memories: Vec::new(),
            stepper: Stepper::reading(settings.corrected),
            work: Work::default(),
        }
    }

    /// Returns the cost of all rollouts so far.
    pub fn work(&self) -> &Work {
        &self.work
    }

    /// Returns the solver statistics of all frames so far.
    pub fn tally(&self) -> SolverStats {
        self.stepper.tally()
    }

    /// Rolls out every job until all objects rest.
    ///
    /// Jobs do not influence each other; they only share the network's batch, which contains the
    /// graphs of all frames. Without `correct` the analytic model is rolled out and no graphs are
    /// built.
    pub fn roll(
        &mut self,
        scene: &Scene,
        jobs: &[Job],
        record: Record,
        correct: Option<&mut Corrector<'_>>,
    ) -> Vec<Trajectory> {
        let (casts, cast) = casts(scene, jobs);
        let bodies: Vec<&Bodies> = cast.iter().map(|&cast| &casts[cast]).collect();
        let readings = self.run(scene, jobs, &bodies, record, correct.is_some());
        let Some(correct) = correct else {
            return readings.into_iter().map(|reading| reading.trajectory).collect();
        };
        let mut corrections = Corrections::default();
        correct(self.stepper.batch(), &mut corrections);
        let pairs = readings.into_iter().zip(bodies);
        pairs.map(|(reading, bodies)| reading.corrected(bodies, &corrections)).collect()
    }

    /// Rolls out every job by the analytic model, and returns the motions that the network corrects
    /// with the graphs that it reads.
    pub fn read(&mut self, scene: &Scene, jobs: &[Job], record: Record) -> (Vec<Reading>, &Batch) {
        let (casts, cast) = casts(scene, jobs);
        let bodies: Vec<&Bodies> = cast.iter().map(|&cast| &casts[cast]).collect();
        let readings = self.run(scene, jobs, &bodies, record, true);
        (readings, self.stepper.batch())
    }

    fn run(
        &mut self,
        scene: &Scene,
        jobs: &[Job],
        bodies: &[&Bodies],
        record: Record,
        read: bool,
    ) -> Vec<Reading> {
        let Self { by, settings, memories, stepper, work } = self;
        if memories.len() < jobs.len() {
            memories.resize_with(jobs.len(), Memory::default);
        }
        let mut runs: Vec<Run> = jobs
            .iter()
            .zip(memories)
            .zip(bodies)
            .map(|((job, memory), bodies)| {
                Run::new(scene, job, bodies, memory, *settings, record, by)
            })
            .collect();
        stepper.begin();
        while stepper.step(&mut runs, read) {}
        runs.iter().for_each(|run| work.add(&run.work));
        runs.into_iter().map(Run::finish).collect()
    }
}

/// Rolls out every job until all objects rest, see [`Roller::roll`].
pub fn roll(
    by: ModelSpec,
    scene: &Scene,
    jobs: &[Job],
    record: Record,
    settings: RollSettings,
    correct: Option<&mut Corrector<'_>>,
) -> Vec<Trajectory> {
    Roller::new(by, settings).roll(scene, jobs, record, correct)
}

/// Returns the bodies of the scene for every distinct tool and physics, and the index of each job's
/// bodies. A search has hundreds of jobs but only a handful of tools.
fn casts(scene: &Scene, jobs: &[Job]) -> (Vec<Bodies>, Vec<usize>) {
    let mut casts = Vec::new();
    let mut firsts: Vec<&Job> = Vec::new();
    let same = |a: &Job, b: &Job| {
        let same_physics = Arc::ptr_eq(&a.physics, &b.physics) || a.physics == b.physics;
        let same_tool = Arc::ptr_eq(&a.motion.slide().tool, &b.motion.slide().tool);
        same_tool && a.motion.slide().lift == b.motion.slide().lift && same_physics
    };
    let which = jobs
        .iter()
        .map(|job| {
            firsts.iter().position(|first| same(first, job)).unwrap_or_else(|| {
                casts.push(Bodies::new(
                    scene,
                    &job.motion.slide().tool,
                    job.motion.slide().lift,
                    &job.physics,
                ));
                firsts.push(job);
                firsts.len() - 1
            })
        })
        .collect();
    (casts, which)
}
