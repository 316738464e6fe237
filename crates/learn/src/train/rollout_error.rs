//! The held-out criterion: whole rollouts against the truth.

use pushplan::internals::effect::EffectModel;
use pushplan::internals::judge::{Comparison, ObjectError, Trial, mean, percentile};
use rayon::prelude::*;

use crate::dataset::Episode;

use super::HeldOutError;

/// Cap of a single error in the criterion, metres.
const CAP: f64 = 0.01;

/// Scenes with more objects than this are crowds: those with tools have no more.
const FEW: usize = 3;

/// Rolls every episode out from its first frame and compares the last.
pub fn rollout_error(model: &dyn EffectModel, episodes: &[Episode], step: u64) -> HeldOutError {
    // With the number of objects in its scene.
    let judged: Vec<(usize, ObjectError)> = episodes
        .par_iter()
        .filter_map(|episode| Some((episode, episode.frames.last()?)))
        .flat_map_iter(|(episode, last)| {
            let (scene, motion) = (episode.scene.clone(), episode.motion.clone());
            let trial = Trial::to_rest(scene, motion, last.state.poses.clone());
            let errors = Comparison::of(model, &trial).end();
            let objects = errors.len();
            errors.into_iter().filter(ObjectError::moved).map(move |error| (objects, error))
        })
        .collect();
    let part = |wanted: &dyn Fn(usize) -> bool| -> Vec<ObjectError> {
        let among = judged.iter().filter(|(objects, _)| wanted(*objects));
        among.map(|(_, error)| *error).collect()
    };
    let boxed = |part: Vec<ObjectError>| (!part.is_empty()).then(|| Box::new(summary(&part, step)));
    HeldOutError {
        single: boxed(part(&|objects| objects == 1)),
        crowd: boxed(part(&|objects| objects > FEW)),
        ..summary(&part(&|_| true), step)
    }
}

fn summary(errors: &[ObjectError], step: u64) -> HeldOutError {
    let mut sorted: Vec<f64> = errors.iter().map(|error| error.position).collect();
    sorted.sort_by(f64::total_cmp);
    let capped: Vec<f64> = sorted.iter().map(|error| error.min(CAP)).collect();
    let headings: Vec<f64> = errors.iter().filter_map(|error| error.heading).collect();
    HeldOutError {
        step,
        objects: sorted.len(),
        mean: mean(&sorted),
        median: percentile(&sorted, 50.0),
        p95: percentile(&sorted, 95.0),
        capped: mean(&capped),
        heading: mean(&headings),
        single: None,
        crowd: None,
    }
}
