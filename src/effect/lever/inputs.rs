//! Inputs of the lever-up network, and the baseline that it corrects.

use crate::network::{LEVER_POSE, LeverOutput, LeverSizes};
use crate::{
    outcome::{Ending, LEVER_FRAMES, LeverTrajectory, LeverWarning},
    scene::LeverFeatures,
    task::LeverJob,
};

use super::{LeverView, lever_action, lever_features};

/// Unit of predicted displacements, metres.
const WAY: f64 = 0.05;

/// Unit of the blade tip's position, metres: its depth under an edge.
const TIP: f64 = 0.02;

/// Frames of the analytic model whose displacements are inputs from the first step on. If the
/// analytic model slips slightly too late, the correction must begin earlier.
const AHEAD: [usize; 5] = [2, 5, 8, 11, 14];

/// A lever-up as network inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct LeverInputs {
    /// Features of the lever-up, `[S]`.
    pub still: Vec<f32>,
    /// Features of every frame, [T, M].
    pub moving: Vec<f32>,
    /// Baseline of the predictions: poses `[T, 9]` and the pose at rest, `[9]`.
    pub base: Vec<f32>,
}

impl LeverInputs {
    /// Returns the widths of the inputs, with a hidden state of `width`.
    pub fn sizes(features: LeverFeatures, prior: bool, width: usize) -> LeverSizes {
        // Slip, endings, rest, displacements ahead, and duration of contact.
        let whole = if prior { 4 + LEVER_POSE + 3 * AHEAD.len() + 1 } else { 0 };
        LeverSizes {
            still: LeverFeatures::ACTION + features.count() + whole,
            // Pose, whether it is held, and the blade's tip.
            moving: 3 + if prior { LEVER_POSE + 1 + 3 } else { 0 },
            width,
            feedback: false,
        }
    }

    /// Converts a pose into the units of predictions.
    pub fn in_units(seen: [f64; LEVER_POSE]) -> [f32; LEVER_POSE] {
        std::array::from_fn(|k| (seen[k] / unit(k)) as f32)
    }

    /// Converts predictions into a pose.
    pub fn seen(predicted: &[f32]) -> [f64; LEVER_POSE] {
        std::array::from_fn(|k| f64::from(predicted[k]) * unit(k))
    }

    /// Combines a network prediction with the baseline that it corrects.
    pub fn answer(
        &self,
        predicted: &LeverOutput,
        job: &LeverJob,
        prior: Option<&LeverTrajectory>,
    ) -> LeverTrajectory {
        let view = LeverView::new(job);
        let pose = |base: &[f32], predicted: &[f32]| {
            let sum: Vec<f32> =
                base.iter().zip(predicted).map(|(base, predicted)| base + predicted).collect();
            view.pose(&Self::seen(&sum))
        };
        let (frames, rest) = self.base.split_at(LEVER_FRAMES * LEVER_POSE);
        let lift = frames
            .chunks_exact(LEVER_POSE)
            .zip(predicted.poses.chunks_exact(LEVER_POSE))
            .map(|(base, predicted)| pose(base, predicted))
            .collect();
        let slips = predicted.end[0] > 0.0;
        let endings = [Ending::Back, Ending::Flipped, Ending::Leaning];
        let best = (0..3).max_by(|a, b| predicted.end[1 + a].total_cmp(&predicted.end[1 + b]));
        LeverTrajectory {
            lift,
            held: prior.map_or_else(|| vec![!slips; LEVER_FRAMES], |prior| prior.held.clone()),
            rest: pose(rest, &predicted.end[4..]),
            ending: best.map_or(Ending::Back, |best| endings[best]),
            warnings: if slips { vec![LeverWarning::Slipped] } else { Vec::new() },
        }
    }
}

/// Returns the inputs of a job, with the prediction of the analytic model if the network corrects
/// it.
pub fn lever_inputs(
    features: LeverFeatures,
    job: &LeverJob,
    prior: Option<&LeverTrajectory>,
) -> LeverInputs {
    let view = LeverView::new(job);
    let mut still = lever_action(job).to_vec();
    still.extend(lever_features(features, job, &view));
    let start = LeverInputs::in_units(view.see(&job.scene.plates[job.lever.plate].start()));
    let (mut moving, mut base) = (Vec::new(), Vec::new());
    for frame in 0..LEVER_FRAMES {
        let share = (frame + 1) as f64 / LEVER_FRAMES as f64;
        let (sin, cos) = (share * job.lever.angle).sin_cos();
        moving.extend([share, sin, cos].map(|value| value as f32));
        let Some(prior) = prior else {
            base.extend(start);
            continue;
        };
        let predicted = LeverInputs::in_units(view.see(&prior.lift[frame]));
        base.extend(predicted);
        moving.extend(predicted);
        moving.push(is(prior.held[frame]));
        moving.extend(view.tip(job, share, &prior.lift[frame]).map(|x| (x / TIP) as f32));
    }
    let Some(prior) = prior else {
        base.extend(start);
        return LeverInputs { still, moving, base };
    };
    let rest = LeverInputs::in_units(view.see(&prior.rest));
    still.push(is(prior.slipped()));
    still.extend([Ending::Back, Ending::Flipped, Ending::Leaning].map(|e| is(prior.ending == e)));
    still.extend(rest);
    still.extend(AHEAD.iter().flat_map(|frame| &base[frame * LEVER_POSE..][..3]));
    let held = prior.held.iter().rposition(|held| *held).map_or(0, |frame| frame + 1);
    still.push(held as f32 / LEVER_FRAMES as f32);
    base.extend(rest);
    LeverInputs { still, moving, base }
}

/// Returns the unit of number `k` of a pose, whose displacement comes first.
fn unit(k: usize) -> f64 {
    if k < 3 { WAY } else { 1.0 }
}

fn is(is: bool) -> f32 {
    f32::from(u8::from(is))
}
