//! The held-out criterion: whole rollouts against the truth.

use rayon::prelude::*;

use crate::{
    dataset::Episode,
    geometry::wrap_angle,
    network::{Buffers, Forward},
    rollout::{RollSettings, roll},
    scene::{Job, Record},
};

use super::HeldOutError;

/// True motion from which an object counts, metres.
const MOVED: f64 = 0.01;

/// Cap of a single error in the criterion, metres.
const CAP: f64 = 0.01;

/// One counted object: error in metres, heading error in radians (cuboids), number of objects
/// in its scene.
type Sample = (f64, Option<f64>, usize);

/// Scenes with more objects than this are crowds: those with tools have no more.
const FEW: usize = 3;

/// Rolls every episode out from its first frame and compares the last.
pub fn rollout_error(forward: &Forward, episodes: &[Episode], step: u64) -> HeldOutError {
    let samples: Vec<Sample> = episodes
        .par_iter()
        .map_init(Buffers::default, |buffers, episode| samples(forward, episode, buffers))
        .flatten_iter()
        .collect();
    let part = |wanted: &dyn Fn(usize) -> bool| {
        let part: Vec<Sample> = samples.iter().copied().filter(|s| wanted(s.2)).collect();
        (!part.is_empty()).then(|| Box::new(summary(&part, step)))
    };
    HeldOutError {
        single: part(&|objects| objects == 1),
        crowd: part(&|objects| objects > FEW),
        ..summary(&samples, step)
    }
}

fn samples(forward: &Forward, episode: &Episode, buffers: &mut Buffers) -> Vec<Sample> {
    let (Some(first), Some(last)) = (episode.frames.first(), episode.frames.last()) else {
        return Vec::new();
    };
    let job =
        Job { start: first.state.clone(), ..Job::stated(&episode.scene, episode.motion.clone()) };
    let predicted = roll(
        &episode.scene,
        &[job],
        Record::Outcome,
        RollSettings::default(),
        Some(&mut |batch, corrections| {
            forward.run(batch, buffers, corrections);
        }),
    );
    let predicted = predicted[0].outcome();
    let mut found = Vec::new();
    for (k, object) in episode.scene.objects.iter().enumerate() {
        let (start, end) = (first.state.poses[k], last.state.poses[k]);
        if (end.position - start.position).norm() <= MOVED {
            continue;
        }
        let guess = predicted.poses[k];
        let heading =
            (!object.shape.is_cylinder()).then(|| wrap_angle(guess.heading - end.heading).abs());
        found.push(((guess.position - end.position).norm(), heading, episode.scene.objects.len()));
    }
    found
}

fn summary(samples: &[Sample], step: u64) -> HeldOutError {
    let mut errors: Vec<f64> = samples.iter().map(|s| s.0).collect();
    errors.sort_by(f64::total_cmp);
    let count = errors.len();
    let at = |share: f64| {
        errors.get(((count as f64 * share) as usize).min(count.saturating_sub(1))).copied()
    };
    let mean = |values: &mut dyn Iterator<Item = f64>| {
        let (sum, count) = values.fold((0.0, 0usize), |(s, n), x| (s + x, n + 1));
        sum / count.max(1) as f64
    };
    HeldOutError {
        step,
        objects: count,
        mean: mean(&mut errors.iter().copied()),
        median: at(0.5).unwrap_or(0.0),
        p95: at(0.95).unwrap_or(0.0),
        capped: mean(&mut errors.iter().map(|e| e.min(CAP))),
        heading: mean(&mut samples.iter().filter_map(|s| s.1)),
        single: None,
        crowd: None,
    }
}
