//! Judging models on a test set.

use rayon::prelude::*;

use crate::watch::{Count, Watch};
use crate::{
    effect::EffectModel,
    judge::{Comparison, DriftSums, ObjectError, RelativeErrors, Trial, mean},
};

use super::report::{CrowdModel, CurvePoint, Phases};

/// Steps of the curve of error by horizon: about every ten frames of a sparse trajectory.
const CURVE_STEPS: usize = 20;

/// Errors of `model` on `trials`, rolled out on all threads of the current rayon pool;
/// `watch` is told the trajectories done.
pub fn evaluate_crowd(model: &dyn EffectModel, trials: &[Trial], watch: &dyn Watch) -> CrowdModel {
    watch.stage(&model.spec().to_string());
    let count = Count::new(watch, 0, trials.len());
    let judged: Vec<Judged> = trials
        .par_iter()
        .map(|trial| {
            let judged = Judged::of(&Comparison::of(model, trial));
            count.one();
            judged
        })
        .collect();
    let overlaps: Vec<f64> = judged.iter().map(|one| one.overlap).collect();
    let mut drift = DriftSums::default();
    judged.iter().for_each(|one| drift.add(&one.drift));
    let moved = judged.iter().flat_map(Judged::end).filter(|object| object.moved());
    let headings: Vec<f64> = moved.filter_map(ObjectError::heading_deg).collect();
    CrowdModel {
        model: model.spec().to_string(),
        all: phases(&judged, |_| true),
        moved: phases(&judged, ObjectError::moved),
        heading_deg: (!headings.is_empty()).then(|| mean(&headings)),
        curve: curve(&judged),
        overlap: overlaps.iter().copied().fold(0.0, f64::max),
        overlap_mean: mean(&overlaps),
        drift: drift.by_kind(),
        failed: judged.iter().filter(|one| one.failed).count(),
    }
}

/// One trajectory, judged.
struct Judged {
    /// Errors of all objects, moment by moment.
    moments: Vec<Vec<ObjectError>>,
    overlap: f64,
    drift: DriftSums,
    failed: bool,
}

impl Judged {
    fn of(comparison: &Comparison) -> Self {
        Self {
            moments: comparison.moments(),
            overlap: comparison.overlap(),
            drift: comparison.drift(),
            failed: !comparison.is_finite(),
        }
    }

    /// Errors of all objects at the last moment.
    fn end(&self) -> &[ObjectError] {
        self.moments.last().map_or(&[], Vec::as_slice)
    }

    /// Error and motion of an object, averaged over moments, metres.
    fn averaged(&self, object: usize) -> [f64; 2] {
        let of = |value: &dyn Fn(&ObjectError) -> f64| {
            let sum: f64 = self.moments.iter().map(|objects| value(&objects[object])).sum();
            sum / self.moments.len().max(1) as f64
        };
        [of(&|error| error.position), of(&|error| error.motion)]
    }
}

fn phases(judged: &[Judged], counts: impl Fn(&ObjectError) -> bool) -> Phases {
    let gather = |pair: &dyn Fn(&Judged, usize) -> [f64; 2]| {
        let of_trial = |one: &Judged| -> Vec<[f64; 2]> {
            let counted = one.end().iter().enumerate().filter(|(_, error)| counts(error));
            counted.map(|(object, _)| pair(one, object)).collect()
        };
        RelativeErrors::of(&judged.iter().map(of_trial).collect::<Vec<_>>())
    };
    Phases {
        end: gather(&|one, object| [one.end()[object].position, one.end()[object].motion]),
        averaged: gather(&|one, object| one.averaged(object)),
    }
}

fn curve(judged: &[Judged]) -> Vec<CurvePoint> {
    let objects = judged.iter().map(|one| one.end().len()).sum::<usize>().max(1) as f64;
    let sum = |step: usize, value: &dyn Fn(&ObjectError) -> f64| -> f64 {
        let of_trial = |one: &Judged| {
            let frame = (one.moments.len() * step).div_ceil(CURVE_STEPS).checked_sub(1);
            let errors = frame.map_or(&[][..], |frame| one.moments[frame].as_slice());
            errors.iter().fold(0.0, |sum, error| sum + value(error))
        };
        judged.iter().map(of_trial).sum()
    };
    (0..=CURVE_STEPS)
        .map(|step| CurvePoint {
            horizon: step as f64 / CURVE_STEPS as f64,
            // At the start nothing has moved and nothing is wrong.
            error: sum(step, &|error| error.position) / objects,
            motion: sum(step, &|error| error.motion) / objects,
        })
        .collect()
}
