//! The held-out criterion: whole rollouts against the truth.

use std::fmt;

use pushplan::internals::effect::EffectModel;
use pushplan_act::judge::{Comparison, ObjectError, Trial, mean, percentile};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::dataset::{Dataset, Episode};

/// Cap of a single error in the criterion, metres.
const CAP: f64 = 0.01;

/// Scenes with more objects than this are crowds: those with tools have no more.
const FEW: usize = 3;

/// Final position errors of rollouts over held-out episodes; objects whose true motion exceeds
/// 1 cm are counted.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HeldOutError {
    /// Objects counted.
    pub objects: usize,
    /// Mean, metres.
    pub mean: f64,
    /// Median, metres.
    pub median: f64,
    /// 95th percentile, metres.
    pub p95: f64,
    /// Mean with every error capped at 10 mm, metres: what decides which weights are best,
    /// because a handful of pushes that end differently by chance otherwise would.
    pub capped: f64,
    /// Mean heading error of cuboids, radians.
    pub heading: f64,
    /// The same over episodes with a single object.
    pub single: Option<Box<HeldOutError>>,
    /// The same over episodes with more than three.
    pub crowd: Option<Box<HeldOutError>>,
    /// The same over each set of episodes, in their order, if there are several; `capped` above is
    /// then the mean of theirs.
    #[serde(default)]
    pub sets: Vec<HeldOutError>,
}

/// What a person wants to follow.
impl fmt::Display for HeldOutError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [mean, median, p95] = [self.mean, self.median, self.p95].map(|metres| 1e3 * metres);
        write!(f, "mean {mean:.1} mm, median {median:.1} mm, p95 {p95:.1} mm")
    }
}

/// Rolls every episode out from its first frame and compares the last.
pub fn rollout_error(model: &dyn EffectModel, sets: &[Dataset]) -> HeldOutError {
    let judged: Vec<Vec<Judged>> = sets.iter().map(|set| judge(model, set.episodes())).collect();
    if let [one] = &judged[..] {
        return summaries(one);
    }
    let sets: Vec<HeldOutError> = judged.iter().map(|set| summaries(set)).collect();
    let capped = mean(&sets.iter().map(|set| set.capped).collect::<Vec<_>>());
    HeldOutError { capped, sets, ..summaries(&judged.concat()) }
}

/// An object's error, with the number of objects in its scene.
type Judged = (usize, ObjectError);

fn judge(model: &dyn EffectModel, episodes: &[Episode]) -> Vec<Judged> {
    episodes
        .par_iter()
        .filter_map(|episode| Some((episode, episode.frames.last()?)))
        .flat_map_iter(|(episode, last)| {
            let (scene, motion) = (episode.scene.clone(), episode.motion.clone());
            let trial = Trial::to_rest(scene, motion, last.state.poses.clone());
            let errors = Comparison::of(model, &trial).end();
            let objects = errors.len();
            errors.into_iter().filter(ObjectError::moved).map(move |error| (objects, error))
        })
        .collect()
}

fn summaries(judged: &[Judged]) -> HeldOutError {
    let part = |wanted: &dyn Fn(usize) -> bool| -> Vec<ObjectError> {
        let among = judged.iter().filter(|(objects, _)| wanted(*objects));
        among.map(|(_, error)| *error).collect()
    };
    let boxed = |part: Vec<ObjectError>| (!part.is_empty()).then(|| Box::new(summary(&part)));
    HeldOutError {
        single: boxed(part(&|objects| objects == 1)),
        crowd: boxed(part(&|objects| objects > FEW)),
        ..summary(&part(&|_| true))
    }
}

fn summary(errors: &[ObjectError]) -> HeldOutError {
    let mut sorted: Vec<f64> = errors.iter().map(|error| error.position).collect();
    sorted.sort_by(f64::total_cmp);
    let capped: Vec<f64> = sorted.iter().map(|error| error.min(CAP)).collect();
    let headings: Vec<f64> = errors.iter().filter_map(|error| error.heading).collect();
    HeldOutError {
        objects: sorted.len(),
        mean: mean(&sorted),
        median: percentile(&sorted, 50.0),
        p95: percentile(&sorted, 95.0),
        capped: mean(&capped),
        heading: mean(&headings),
        single: None,
        crowd: None,
        sets: Vec::new(),
    }
}
