//! Network values of relations, averaged over a rollout for each pair of objects.

use std::collections::BTreeMap;

use crate::{
    contact::Pairs,
    graph::Batch,
    scene::{Body, Scene},
    task::Job,
};

/// Sums of row vectors of the relations between objects, over the frames of a rollout.
#[derive(Clone, Debug)]
pub struct PairMeans {
    pairs: Pairs,
    width: usize,
    sums: BTreeMap<[usize; 2], Vec<f32>>,
    frames: usize,
}

impl PairMeans {
    /// Creates an empty average for a rollout of `job`, with rows of `width` numbers.
    pub fn new(scene: &Scene, job: &Job, width: usize) -> Self {
        let parts = job.motion.slide().tool.outline().len();
        let pairs = Pairs::new(scene.objects.len(), scene.obstacles.len(), parts);
        Self { pairs, width, sums: BTreeMap::new(), frames: 0 }
    }

    /// Adds the `frames` of a rollout. `row(k, into)` must add the row of relation `k` to `into`.
    /// Both directions of a pair, and all its contact points, are summed.
    pub fn add(&mut self, batch: &Batch, frames: usize, row: impl Fn(usize, &mut [f32])) {
        self.frames += frames;
        for (k, pair) in batch.pairs.iter().enumerate() {
            let (first, Body::Object(second)) = self.pairs.bodies(*pair) else { continue };
            let sum = self.sums.entry([first.0, second]).or_insert_with(|| vec![0.0; self.width]);
            row(k, sum);
        }
    }

    /// Returns the mean row of a pair of objects, the lower index first; zeros for a pair without
    /// relations.
    pub fn mean(&self, pair: [usize; 2]) -> Vec<f32> {
        let mut mean = self.sums.get(&pair).cloned().unwrap_or_else(|| vec![0.0; self.width]);
        mean.iter_mut().for_each(|value| *value /= self.frames.max(1) as f32);
        mean
    }
}
