//! Rolling many jobs of one scene out side by side, frame by frame.

use std::sync::Arc;

use crate::{
    graph::{Batch, Bodies, Motion, add_graph, add_prior},
    scene::{Job, Record, Scene, Trajectory},
};

use super::{
    run::{Memory, Run},
    work::Work,
};

/// Corrects the prior of every node of a batch: fills the vector with one entry per node, in
/// output units (see [`crate::graph::Node::encode`]).
pub type Corrector<'a> = dyn FnMut(&Batch, &mut Vec<[f64; 6]>) + 'a;

/// How finely a rollout goes, and whether it looks at everything.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RollSettings {
    /// Frames of a moving tool (see [`crate::scene::FRAME_TRAVEL`]) that are predicted as one,
    /// at least 1. The states between are interpolated, so that a trajectory has the same
    /// frames whatever the stride.
    pub stride: usize,
    /// Whether bodies that the motion cannot reach, not even through others, and frames in
    /// which nothing can touch are left out. The results are the same bits.
    pub pruned: bool,
}

impl Default for RollSettings {
    fn default() -> Self {
        Self { stride: 1, pruned: true }
    }
}

/// Rolls jobs out, on memory that it keeps from one call to the next.
#[derive(Clone, Debug, Default)]
pub struct Roller {
    settings: RollSettings,
    memories: Vec<Memory>,
    batch: Batch,
    corrections: Vec<[f64; 6]>,
    motions: Vec<Vec<Motion>>,
    work: Work,
}

impl Roller {
    /// A roller with these settings.
    pub fn new(settings: RollSettings) -> Self {
        Self { settings, ..Self::default() }
    }

    /// What all rollouts so far took.
    pub fn work(&self) -> &Work {
        &self.work
    }

    /// Rolls out every job until everything rests.
    ///
    /// Jobs do not influence each other; they only share the network's batches. Without anything
    /// to `correct` the prior it rolls out needs no graphs.
    pub fn roll(
        &mut self,
        scene: &Scene,
        jobs: &[Job],
        record: Record,
        mut correct: Option<&mut Corrector<'_>>,
    ) -> Vec<Trajectory> {
        let Self { settings, memories, batch, corrections, motions, work } = self;
        let add = if correct.is_some() { add_graph } else { add_prior };
        let (casts, cast) = casts(scene, jobs);
        if memories.len() < jobs.len() {
            memories.resize_with(jobs.len(), Memory::default);
            motions.resize_with(jobs.len(), Vec::new);
        }
        let mut runs: Vec<Run> = jobs
            .iter()
            .zip(memories)
            .zip(&cast)
            .map(|((job, memory), &cast)| {
                Run::new(scene, job, &casts[cast], memory, *settings, record)
            })
            .collect();
        work.rollouts += jobs.len() as u64;
        loop {
            batch.clear();
            let mut active = false;
            for (k, run) in runs.iter_mut().enumerate() {
                active |= run.next(k as u32, add, batch, &mut motions[k], work);
            }
            if !active {
                return runs.into_iter().map(Run::finish).collect();
            }
            if let Some(correct) = &mut correct {
                correct(batch, corrections);
                apply(batch, corrections, motions);
            }
            for touch in &batch.touches {
                runs[touch.graph as usize].touch(touch);
            }
            for (run, motions) in runs.iter_mut().zip(&*motions) {
                run.advance(motions);
            }
        }
    }
}

/// Rolls out every job until everything rests, see [`Roller::roll`].
pub fn roll(
    scene: &Scene,
    jobs: &[Job],
    record: Record,
    settings: RollSettings,
    correct: Option<&mut Corrector<'_>>,
) -> Vec<Trajectory> {
    Roller::new(settings).roll(scene, jobs, record, correct)
}

/// Puts the corrected motion of every node in its graph's list.
pub fn apply(batch: &Batch, corrections: &[[f64; 6]], motions: &mut [Vec<Motion>]) {
    for (node, correction) in batch.nodes.iter().zip(corrections) {
        let mut output = node.prior;
        for (value, change) in output.iter_mut().zip(correction) {
            *value += change;
        }
        motions[node.graph as usize][node.object as usize] = node.decode(&output);
    }
}

/// The bodies of the scene with every tool and physics that occurs, and which of them each
/// job has: a search has hundreds of jobs with a handful of tools.
fn casts(scene: &Scene, jobs: &[Job]) -> (Vec<Bodies>, Vec<usize>) {
    let mut casts = Vec::new();
    let mut firsts: Vec<&Job> = Vec::new();
    let same = |a: &Job, b: &Job| {
        let same_physics = Arc::ptr_eq(&a.physics, &b.physics) || a.physics == b.physics;
        let same_tool = Arc::ptr_eq(&a.motion.tool, &b.motion.tool);
        same_tool && a.motion.lift == b.motion.lift && same_physics
    };
    let which = jobs
        .iter()
        .map(|job| {
            firsts.iter().position(|first| same(first, job)).unwrap_or_else(|| {
                casts.push(Bodies::new(scene, &job.motion.tool, job.motion.lift, &job.physics));
                firsts.push(job);
                firsts.len() - 1
            })
        })
        .collect();
    (casts, which)
}
