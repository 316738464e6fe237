//! Where the time of a predicted push goes: which frames need a graph, and how much of what they
//! take is the network.

use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use crate::{
    effect::{EffectModel, Network},
    rollout::Work,
};

use super::{cpu_clock::processor_time, suite::Suite, timing::batches};

/// Rounds, of which the fastest counts: other work on the machine can only lengthen one.
const ROUNDS: usize = 5;

/// Processor time of a round, at least; the kernel may count in ticks of 4 ms.
const ROUND: Duration = Duration::from_millis(100);

/// Processor time of one push and what it is spent on, means over a suite.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PushSplit {
    /// Name of the model.
    pub model: String,
    /// Jobs handed over together.
    pub batch: usize,
    /// Processor time of a push, seconds.
    pub seconds: f64,
    /// The part of it that is the network, seconds; the rest is geometry, prior, features and
    /// integration.
    pub network: f64,
    /// Frames in which the tool moves.
    pub moving: f64,
    /// Those of them that geometry alone showed to change nothing.
    pub skipped: f64,
    /// Frames in which the tool stands still and objects come to rest.
    pub coasting: f64,
    /// Frames with a graph.
    pub graphs: f64,
    /// Nodes of these graphs.
    pub nodes: f64,
    /// Relations of these graphs.
    pub relations: f64,
    /// Lists made of what a stroke can set in motion.
    pub lists: f64,
    /// Objects on such a list.
    pub listed: f64,
}

/// Splits the pushes of `suite`, `batch` jobs at a time, on this thread.
pub fn push_split(model: &Network, suite: &Suite, batch: usize) -> PushSplit {
    let jobs = batches(&suite.cases, batch);
    let pushes = (jobs.len() * batch).max(1) as f64;
    let mut work = Work::default();
    jobs.iter().for_each(|(scene, jobs)| work.add(&model.work(scene, jobs)));
    let (mut best, mut share) = (f64::INFINITY, 0.0);
    for _ in 0..ROUNDS {
        let (mut runs, mut spent, mut network) = (0u32, Duration::ZERO, Duration::ZERO);
        let began = Instant::now();
        // Bounded, should the clock stand still.
        while spent < ROUND && runs < 10_000 && !jobs.is_empty() {
            runs += 1;
            spent += processor_time(|| {
                for (scene, jobs) in &jobs {
                    network += model.timed_rollout(scene, jobs).1;
                }
            });
        }
        let seconds = spent.as_secs_f64() / f64::from(runs.max(1));
        if seconds < best {
            best = seconds;
            share = network.as_secs_f64() / began.elapsed().as_secs_f64();
        }
    }
    let each = |count: u64| count as f64 / pushes;
    PushSplit {
        model: model.name().to_owned(),
        batch,
        seconds: best / pushes,
        network: share * best / pushes,
        moving: each(work.moving),
        skipped: each(work.skipped),
        coasting: each(work.coasting),
        graphs: each(work.graphs),
        nodes: each(work.nodes),
        relations: each(work.relations),
        lists: each(work.lists),
        listed: work.listed as f64 / work.lists.max(1) as f64,
    }
}
