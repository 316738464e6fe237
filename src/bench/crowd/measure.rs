//! Rolling models out on a test set and judging them.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use crate::{
    bench::{
        heldout::MOVED,
        statistics::{mean, percentile},
    },
    effect::{EffectModel, Job},
    geometry::wrap_angle,
    scene::{Record, Span, Warning},
};

use super::{
    physical::{DriftSums, Joints, Overlaps},
    report::{CrowdErrors, CrowdModel, CurvePoint, Phases},
    trial::Trial,
};

/// Steps of the curve of error by horizon: about every ten frames of a sparse trajectory.
const CURVE_STEPS: usize = 20;

/// Resamples of a bootstrap: the ends of a 95 % interval are then the 25th of a thousand.
const RESAMPLES: usize = 1000;

/// Errors of `model` on `trials`, rolled out on all threads of the current rayon pool; `tick`
/// is called after each trajectory.
pub fn evaluate_crowd(
    model: &dyn EffectModel,
    trials: &[Trial],
    tick: &(dyn Fn() + Sync),
) -> CrowdModel {
    let judged: Vec<Judged> = trials
        .par_iter()
        .map(|trial| {
            let judged = judge(model, trial);
            tick();
            judged
        })
        .collect();
    let overlaps: Vec<f64> = judged.iter().map(|one| one.overlap).collect();
    let mut drift = DriftSums::default();
    judged.iter().for_each(|one| drift.add(&one.drift));
    let headings: Vec<f64> = judged.iter().flat_map(|one| one.headings.iter().copied()).collect();
    CrowdModel {
        model: model.name().to_owned(),
        all: phases(&judged, |_| true),
        moved: phases(&judged, |object| object.motion > MOVED),
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
    objects: Vec<JudgedObject>,
    /// Heading errors of moved cuboids, degrees.
    headings: Vec<f64>,
    /// Sums over the objects at every step of the curve: error, motion, metres.
    curve: [[f64; 2]; CURVE_STEPS + 1],
    overlap: f64,
    drift: DriftSums,
    failed: bool,
}

/// One object: final and averaged over frames, metres.
struct JudgedObject {
    error: f64,
    motion: f64,
    averaged_error: f64,
    averaged_motion: f64,
}

fn judge(model: &dyn EffectModel, trial: &Trial) -> Judged {
    let start = trial.scene.start();
    let job = Job::stated(&trial.scene, trial.motion.clone());
    let predicted = model.rollout(&trial.scene, &[job], Record::Frames);
    let predicted = predicted.into_iter().next().unwrap_or_default();
    let gave_up = |warning: &Warning| matches!(warning, Warning::NotFinite | Warning::Refused);
    let failed = predicted.frames.is_empty() || predicted.warnings.iter().any(gave_up);
    let states = match predicted.frames.is_empty() {
        // Saying nothing is predicting that nothing moves.
        true => vec![&start; trial.truth.len()],
        false => trial.aligned(&predicted),
    };
    let error = |frame: usize, object: usize| {
        (states[frame].poses[object].position - trial.truth[frame].poses[object].position).norm()
    };
    let motion = |frame: usize, object: usize| {
        (trial.truth[frame].poses[object].position - start.poses[object].position).norm()
    };
    let frames = trial.truth.len();
    let over_frames =
        |value: &dyn Fn(usize) -> f64| (0..frames).map(value).sum::<f64>() / frames.max(1) as f64;
    let last = frames.saturating_sub(1);
    let objects: Vec<JudgedObject> = (0..if frames > 0 { start.poses.len() } else { 0 })
        .map(|object| JudgedObject {
            error: error(last, object),
            motion: motion(last, object),
            averaged_error: over_frames(&|frame| error(frame, object)),
            averaged_motion: over_frames(&|frame| motion(frame, object)),
        })
        .collect();
    let headings = objects
        .iter()
        .enumerate()
        .filter(|(object, judged)| {
            let cuboid = !trial.scene.objects[*object].shape.is_cylinder();
            cuboid && trial.headings[*object] && judged.motion > MOVED
        })
        .map(|(object, _)| {
            let turned =
                states[last].poses[object].heading - trial.truth[last].poses[object].heading;
            wrap_angle(turned).abs().to_degrees()
        })
        .collect();
    let mut curve = [[0.0; 2]; CURVE_STEPS + 1];
    // At the start nothing has moved and nothing is wrong.
    for (step, sums) in curve.iter_mut().enumerate().skip(1).filter(|_| frames > 0) {
        let frame = (frames * step).div_ceil(CURVE_STEPS) - 1;
        for object in 0..objects.len() {
            sums[0] += error(frame, object);
            sums[1] += motion(frame, object);
        }
    }
    let overlaps = Overlaps::new(&trial.scene);
    let overlap = states.iter().map(|state| overlaps.deepest(state));
    Judged {
        overlap: overlap.fold(0.0, f64::max),
        drift: Joints::new(&trial.scene).drift(&states),
        objects,
        headings,
        curve,
        failed,
    }
}

fn phases(judged: &[Judged], counts: impl Fn(&JudgedObject) -> bool) -> Phases {
    let gather = |pair: &dyn Fn(&JudgedObject) -> [f64; 2]| {
        let of_trial = |one: &Judged| -> Vec<[f64; 2]> {
            one.objects.iter().filter(|object| counts(object)).map(pair).collect()
        };
        errors(&judged.iter().map(of_trial).collect::<Vec<_>>())
    };
    Phases {
        end: gather(&|object| [object.error, object.motion]),
        averaged: gather(&|object| [object.averaged_error, object.averaged_motion]),
    }
}

/// From pairs of error and motion, trajectory by trajectory.
fn errors(trials: &[Vec<[f64; 2]>]) -> Option<CrowdErrors> {
    let mut sorted: Vec<f64> = trials.iter().flatten().map(|pair| pair[0]).collect();
    if sorted.is_empty() {
        return None;
    }
    sorted.sort_by(f64::total_cmp);
    let motions: Vec<f64> = trials.iter().flatten().map(|pair| pair[1]).collect();
    let motion = mean(&motions);
    Some(CrowdErrors {
        objects: sorted.len(),
        motion,
        mean: mean(&sorted),
        median: percentile(&sorted, 50.0),
        p90: percentile(&sorted, 90.0),
        relative: ratio(mean(&sorted), motion),
        relative_interval: interval(trials),
    })
}

/// 95 % interval of the ratio of summed errors to summed motions, by the percentile bootstrap
/// (Efron 1979, doi:10.1214/aos/1176344552) over trajectories, with a fixed seed so that a table
/// is the same every time.
fn interval(trials: &[Vec<[f64; 2]>]) -> Span {
    let sum = |pairs: &Vec<[f64; 2]>| {
        pairs.iter().fold([0.0, 0.0], |sum, pair| [sum[0] + pair[0], sum[1] + pair[1]])
    };
    let sums: Vec<[f64; 2]> = trials.iter().map(sum).collect();
    let mut rng = Pcg64::seed_from_u64(sums.len() as u64);
    let mut ratios: Vec<f64> = (0..RESAMPLES)
        .map(|_| {
            let mut drawn = [0.0; 2];
            for _ in 0..sums.len() {
                let one = sums[rng.random_range(0..sums.len())];
                drawn = [drawn[0] + one[0], drawn[1] + one[1]];
            }
            ratio(drawn[0], drawn[1])
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    Span::new(percentile(&ratios, 2.5), percentile(&ratios, 97.5))
}

/// `error / motion`; 0 where nothing moved, so that no infinity travels.
fn ratio(error: f64, motion: f64) -> f64 {
    if motion > 0.0 { error / motion } else { 0.0 }
}

fn curve(judged: &[Judged]) -> Vec<CurvePoint> {
    let objects = judged.iter().map(|one| one.objects.len()).sum::<usize>().max(1) as f64;
    (0..=CURVE_STEPS)
        .map(|step| {
            let sum = |k: usize| judged.iter().map(|one| one.curve[step][k]).sum::<f64>();
            CurvePoint {
                horizon: step as f64 / CURVE_STEPS as f64,
                error: sum(0) / objects,
                motion: sum(1) / objects,
            }
        })
        .collect()
}
