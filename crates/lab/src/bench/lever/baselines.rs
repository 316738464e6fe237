//! Baseline models of lever-ups without physics, which any other model must beat.

use pushplan::internals::effect::{LeverView, lever_features};
use pushplan::internals::geometry::Pose3;
use pushplan::internals::seeded::generator;
use pushplan::internals::{
    outcome::{Ending, LEVER_FRAMES, LeverTrajectory},
    scene::LeverFeatures,
    task::LeverJob,
};
use pushplan_learn::dataset::LeverEpisode;
use pushplan_learn::lever_model::LeverModel;
use rand::Rng;
use rayon::prelude::*;

/// Similarity by which a lever-up is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Neighbour {
    /// A random lever-up.
    Random,
    /// The lever-up with the nearest features.
    Nearest(LeverFeatures),
}

/// A model that recalls recorded lever-ups.
pub struct LeverBaseline {
    kind: Kind,
}

enum Kind {
    /// No motion.
    Still,
    /// The mean motion, with the most frequent slip and ending.
    Mean(Box<Seen>),
    /// The trajectory of another plate.
    Like { neighbour: Neighbour, known: Vec<(Vec<f32>, Seen)>, seed: u64 },
}

/// A trajectory relative to the lever point.
#[derive(Clone)]
struct Seen {
    lift: Vec<[f64; LeverView::NUMBERS]>,
    held: Vec<bool>,
    rest: [f64; LeverView::NUMBERS],
    like: LeverTrajectory,
}

impl LeverBaseline {
    /// Creates the model without motion.
    pub fn still() -> Self {
        Self { kind: Kind::Still }
    }

    /// Creates the mean of these episodes; [`Self::still`] if there are none.
    pub fn mean(episodes: &[LeverEpisode]) -> Self {
        let seen: Vec<Seen> = episodes.iter().map(Seen::new).collect();
        let Some(first) = seen.first() else { return Self::still() };
        let mut mean = first.clone();
        let over = |of: &dyn Fn(&Seen) -> [f64; LeverView::NUMBERS]| {
            let mut sum = [0.0; LeverView::NUMBERS];
            for one in &seen {
                sum.iter_mut().zip(of(one)).for_each(|(sum, v)| *sum += v / seen.len() as f64);
            }
            sum
        };
        for (k, frame) in mean.lift.iter_mut().enumerate() {
            *frame = over(&|one| one.lift[k]);
        }
        mean.rest = over(&|one| one.rest);
        let half =
            |is: &dyn Fn(&Seen) -> bool| 2 * seen.iter().filter(|s| is(s)).count() > seen.len();
        mean.like.warnings.retain(|_| half(&|one| one.like.slipped()));
        mean.like.ending = if half(&|one| one.like.ending == Ending::Flipped) {
            Ending::Flipped
        } else {
            Ending::Back
        };
        Self { kind: Kind::Mean(Box::new(mean)) }
    }

    /// Creates the model that answers with the episode that `neighbour` chooses; [`Self::still`] if
    /// there are none.
    pub fn like(neighbour: Neighbour, episodes: &[LeverEpisode], seed: u64) -> Self {
        if episodes.is_empty() {
            return Self::still();
        }
        let known = episodes
            .par_iter()
            .map(|episode| (features(neighbour, &episode.job()), Seen::new(episode)))
            .collect();
        Self { kind: Kind::Like { neighbour, known, seed } }
    }

    fn one(&self, index: u64, job: &LeverJob) -> LeverTrajectory {
        match &self.kind {
            Kind::Still => still(job),
            Kind::Mean(mean) => mean.of(job),
            Kind::Like { neighbour: Neighbour::Random, known, seed } => {
                known[generator(*seed, index).random_range(0..known.len())].1.of(job)
            }
            Kind::Like { neighbour, known, .. } => {
                let own = features(*neighbour, job);
                let far = |other: &[f32]| -> f32 {
                    own.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum()
                };
                let nearest = known.iter().min_by(|a, b| far(&a.0).total_cmp(&far(&b.0)));
                nearest.map_or_else(|| still(job), |(_, seen)| seen.of(job))
            }
        }
    }
}

impl LeverModel for LeverBaseline {
    fn name(&self) -> String {
        match &self.kind {
            Kind::Still => "no motion".to_owned(),
            Kind::Mean(_) => "mean trajectory".to_owned(),
            Kind::Like { neighbour: Neighbour::Random, .. } => "a random trajectory".to_owned(),
            Kind::Like { neighbour: Neighbour::Nearest(features), .. } => {
                format!("1-NN, {features}")
            }
        }
    }

    fn takes(&self, _: &LeverJob) -> bool {
        true
    }

    fn rollout(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
        jobs.par_iter().enumerate().map(|(k, job)| self.one(k as u64, job)).collect()
    }
}

impl Seen {
    fn new(episode: &LeverEpisode) -> Self {
        let view = LeverView::new(&episode.job());
        let like = episode.trajectory.clone();
        Self {
            lift: like.lift.iter().map(|pose| view.see(pose)).collect(),
            held: like.held.clone(),
            rest: view.see(&like.rest),
            like,
        }
    }

    fn of(&self, job: &LeverJob) -> LeverTrajectory {
        let view = LeverView::new(job);
        LeverTrajectory {
            lift: self.lift.iter().map(|seen| view.pose(seen)).collect(),
            held: self.held.clone(),
            rest: view.pose(&self.rest),
            ending: self.like.ending,
            warnings: self.like.warnings.clone(),
        }
    }
}

fn features(neighbour: Neighbour, job: &LeverJob) -> Vec<f32> {
    match neighbour {
        Neighbour::Random => Vec::new(),
        Neighbour::Nearest(features) => lever_features(features, job, &LeverView::new(job)),
    }
}

fn still(job: &LeverJob) -> LeverTrajectory {
    let start: Pose3 = job.scene.plates[job.lever.plate].start();
    LeverTrajectory {
        lift: vec![start; LEVER_FRAMES],
        held: vec![true; LEVER_FRAMES],
        rest: start,
        ending: Ending::Back,
        warnings: Vec::new(),
    }
}
