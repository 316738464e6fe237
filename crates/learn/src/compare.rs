//! Comparison of an effect model with the analytic model on a data set, by kind of push.

use pushplan::internals::effect::{EffectModel, Prior};
use pushplan::internals::geometry::Footprint;
use pushplan_act::judge::{Comparison, ObjectError, Trial, mean};
use rayon::prelude::*;
use serde::Serialize;

use crate::dataset::{Dataset, Episode};

/// Aspect ratio from which a box is long, speed from which a push is fast (m/s), and friction from
/// which a scene is sticky.
const LONG: f64 = 3.0;
const FAST: f64 = 0.2;
const STICKY: f64 = 1.0;

/// Name of a kind of pushes, and its test.
type Kind = (&'static str, fn(&Episode) -> bool);

/// Kinds of pushes; a push can be of several kinds.
const KINDS: [Kind; 7] = [
    ("all", |_| true),
    ("one object, no obstacle", |one| one.scene.objects.len() == 1 && !is_walled(one)),
    ("several objects", |one| one.scene.objects.len() > 1),
    ("obstacles", is_walled),
    ("long boxes", is_long),
    ("fast", |one| {
        one.motion.strokes.iter().any(|stroke| stroke.travel() > FAST * stroke.duration)
    }),
    ("sticky", |one| one.scene.objects.iter().any(|object| object.friction > STICKY)),
];

/// Errors of a model relative to the analytic model on pushes of one kind.
#[derive(Clone, Debug, Serialize)]
pub struct Compared {
    /// Kind of the pushes.
    pub kind: &'static str,
    /// Number of pushes in which an object moves.
    pub pushes: usize,
    /// Mean final error of the analytic model over moved objects, metres.
    pub prior: f64,
    /// Mean final error of the model, metres.
    pub model: f64,
    /// Standard error of the ratio of both.
    pub ratio_error: f64,
    /// Rank correlation of the expected with the actual error (Spearman); `None` if the model
    /// states no errors.
    pub rank: Option<f64>,
    /// Share of the errors within the stated 90 %.
    pub within_90: Option<f64>,
}

impl Compared {
    /// Returns the mean error relative to the analytic model.
    pub fn ratio(&self) -> f64 {
        self.model / self.prior
    }
}

/// Final errors of a push, means over its moved objects, metres.
struct Push {
    prior: f64,
    model: f64,
    /// Expected and actual error, and the limit of 90 %, of every moved object.
    stated: Vec<[f64; 3]>,
}

/// Compares `model` with the analytic model on a data set.
pub fn compared(model: &dyn EffectModel, data: &Dataset) -> Vec<Compared> {
    let pushes: Vec<(&Episode, Push)> = data
        .episodes()
        .par_iter()
        .filter_map(|episode| Some((episode, push(model, episode)?)))
        .collect();
    let of_kind = |(kind, wanted): &Kind| {
        let own = pushes.iter().filter(|(episode, _)| wanted(episode));
        let own: Vec<&Push> = own.map(|(_, push)| push).collect();
        (!own.is_empty()).then(|| summary(kind, &own))
    };
    KINDS.iter().filter_map(of_kind).collect()
}

fn push(model: &dyn EffectModel, episode: &Episode) -> Option<Push> {
    let last = episode.frames.last()?;
    let (scene, motion) = (episode.scene.clone(), episode.motion.clone());
    let trial = Trial::to_rest(scene, motion, last.state.poses.clone());
    let own = Comparison::of(model, &trial);
    let [prior, ends] = [Comparison::of(&Prior::default(), &trial).end(), own.end()];
    let moved: Vec<usize> = (0..ends.len()).filter(|&k| ends[k].moved()).collect();
    let error =
        |ends: &[ObjectError]| mean(&moved.iter().map(|&k| ends[k].position).collect::<Vec<_>>());
    let spreads = &own.predicted().spreads;
    let stated = moved.iter().filter_map(|&k| {
        let spread = spreads.get(k).filter(|spread| spread.position > 0.0)?;
        Some([spread.position, ends[k].position, spread.within_90().position])
    });
    (!moved.is_empty()).then(|| Push {
        prior: error(&prior),
        model: error(&ends),
        stated: stated.collect(),
    })
}

fn summary(kind: &'static str, pushes: &[&Push]) -> Compared {
    let [prior, model] = [|push: &Push| push.prior, |push: &Push| push.model]
        .map(|of| mean(&pushes.iter().map(|push| of(push)).collect::<Vec<_>>()));
    // Delta method for the ratio of two means.
    let off = |push: &&&Push| (push.model - model / prior * push.prior).powi(2);
    let count = pushes.len() as f64;
    let ratio_error = (pushes.iter().map(|push| off(&push)).sum::<f64>()).sqrt() / (count * prior);
    let stated: Vec<[f64; 3]> = pushes.iter().flat_map(|push| push.stated.clone()).collect();
    let within = stated.iter().filter(|[_, error, limit]| error <= limit).count();
    Compared {
        kind,
        pushes: pushes.len(),
        prior,
        model,
        ratio_error,
        rank: (stated.len() > 2).then(|| rank_correlation(&stated)),
        within_90: (!stated.is_empty()).then(|| within as f64 / stated.len() as f64),
    }
}

/// Returns the correlation of the ranks of expected and actual errors (Spearman 1904).
fn rank_correlation(stated: &[[f64; 3]]) -> f64 {
    let ranks = |which: usize| {
        let mut order: Vec<usize> = (0..stated.len()).collect();
        order.sort_by(|&a, &b| stated[a][which].total_cmp(&stated[b][which]));
        let mut ranks = vec![0.0; stated.len()];
        order.into_iter().enumerate().for_each(|(rank, k)| ranks[k] = rank as f64);
        ranks
    };
    let (a, b) = (ranks(0), ranks(1));
    let middle = (stated.len() - 1) as f64 / 2.0;
    let product = |a: &[f64], b: &[f64]| -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - middle) * (b - middle)).sum()
    };
    product(&a, &b) / (product(&a, &a) * product(&b, &b)).sqrt()
}

fn is_walled(episode: &Episode) -> bool {
    !episode.scene.obstacles.is_empty()
}

fn is_long(episode: &Episode) -> bool {
    episode.scene.objects.iter().any(|object| match object.shape.footprint() {
        Footprint::Rectangle { half } => half.max() > LONG * half.min(),
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_correlate_by_order_alone() {
        let stated = |errors: [f64; 4]| {
            errors.iter().enumerate().map(|(k, e)| [k as f64, *e, 0.0]).collect::<Vec<_>>()
        };
        assert!((rank_correlation(&stated([0.1, 0.2, 5.0, 90.0])) - 1.0).abs() < 1e-12);
        assert!((rank_correlation(&stated([4.0, 3.0, 2.0, 1.0])) + 1.0).abs() < 1e-12);
        // One exchange of neighbours: 1 - 6 * 2 / (4 * 15).
        assert!((rank_correlation(&stated([2.0, 1.0, 3.0, 4.0])) - 0.8).abs() < 1e-12);
    }
}
