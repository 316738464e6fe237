//! What a network computes of relations, averaged over a rollout, by pair of objects.

use std::collections::BTreeMap;

use crate::{
    contact::Pairs,
    graph::Batch,
    scene::{Body, Scene},
    task::Job,
};

/// Rows of numbers of relations between objects, averaged over the frames of one rollout.
#[derive(Clone, Debug)]
pub struct PairMeans {
    pairs: Pairs,
    width: usize,
    sums: BTreeMap<[usize; 2], Vec<f32>>,
    frames: usize,
}

impl PairMeans {
    /// Of a rollout of `job` with no frames yet, for rows of `width` numbers.
    pub fn new(scene: &Scene, job: &Job, width: usize) -> Self {
        let parts = job.motion.slide().tool.outline().len();
        let pairs = Pairs::new(scene.objects.len(), scene.obstacles.len(), parts);
        Self { pairs, width, sums: BTreeMap::new(), frames: 0 }
    }

    /// Adds a frame, whose relation `k` has the row that `row(k, into)` adds to `into`. Both
    /// directions of a pair, and all of its points, add up.
    pub fn add(&mut self, batch: &Batch, row: impl Fn(usize, &mut [f32])) {
        self.frames += 1;
        for (k, pair) in batch.pairs.iter().enumerate() {
            let (first, Body::Object(second)) = self.pairs.bodies(*pair) else { continue };
            let sum = self.sums.entry([first.0, second]).or_insert_with(|| vec![0.0; self.width]);
            row(k, sum);
        }
    }

    /// The mean row of a pair of objects, the lower index first; zeros where no frame related them.
    pub fn mean(&self, pair: [usize; 2]) -> Vec<f32> {
        let mut mean = self.sums.get(&pair).cloned().unwrap_or_else(|| vec![0.0; self.width]);
        mean.iter_mut().for_each(|value| *value /= self.frames.max(1) as f32);
        mean
    }
}
