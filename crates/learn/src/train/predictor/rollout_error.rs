//! Held-out criterion: errors of whole rollouts.

use std::fmt;

use pushplan::internals::effect::EffectModel;
use pushplan_act::judge::{Comparison, ObjectError, Trial, mean, percentile};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::dataset::{Dataset, Episode};

/// Upper bound of a single error in the criterion, metres.
const CAP: f64 = 0.01;

/// Maximum number of objects of scenes with tools; larger scenes are crowds.
const FEW: usize = 3;

/// Final position errors of rollouts over held-out episodes, over objects with a true displacement
/// above 1 cm.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HeldOutError {
    /// Number of objects that count.
    pub objects: usize,
    /// Mean error, metres.
    pub mean: f64,
    /// Median error, metres.
    pub median: f64,
    /// 95th percentile of the error, metres.
    pub p95: f64,
    /// Mean error with every error limited to 10 mm, metres.
    ///
    /// This is the criterion for the best weights because otherwise a few bifurcating pushes would
    /// dominate.
    pub capped: f64,
    /// Mean heading error of cuboids, radians.
    pub heading: f64,
    /// Errors over episodes with a single object.
    pub single: Option<Box<HeldOutError>>,
    /// Errors over episodes with more than three objects.
    pub crowd: Option<Box<HeldOutError>>,
    /// Errors over each set of episodes, in their order, if there are several. `capped` is then the
    /// mean over the sets.
    #[serde(default)]
    pub sets: Vec<HeldOutError>,
}

/// Summary for the progress display.
impl fmt::Display for HeldOutError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [mean, median, p95] = [self.mean, self.median, self.p95].map(|metres| 1e3 * metres);
        write!(f, "mean {mean:.1} mm, median {median:.1} mm, p95 {p95:.1} mm")
    }
}

/// Rolls out every episode from its first frame and compares the final states.
pub fn rollout_error(model: &dyn EffectModel, sets: &[Dataset]) -> HeldOutError {
    let judged: Vec<Vec<Judged>> = sets.iter().map(|set| judge(model, set.episodes())).collect();
    if let [one] = &judged[..] {
        return summaries(one);
    }
    let sets: Vec<HeldOutError> = judged.iter().map(|set| summaries(set)).collect();
    let capped = mean(&sets.iter().map(|set| set.capped).collect::<Vec<_>>());
    HeldOutError { capped, sets, ..summaries(&judged.concat()) }
}

/// Error of an object, with the number of objects in its scene.
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
