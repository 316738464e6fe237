//! What a network is told of a lever-up, and to what it adds.

use crate::network::{LEVER_POSE, LeverSizes};
use crate::scene::{Ending, LEVER_FRAMES, LeverFeatures, LeverJob, LeverTrajectory};

use super::{LeverView, lever_action, lever_features};

/// Unit of ways that the network predicts, metres.
const WAY: f64 = 0.05;

/// A lever-up in numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct LeverInputs {
    /// Features of the whole: [S].
    pub still: Vec<f32>,
    /// Features of every frame: [T, M].
    pub moving: Vec<f32>,
    /// What predictions are added to: poses [T, 9] and that at rest [9].
    pub base: Vec<f32>,
}

impl LeverInputs {
    /// Widths of the inputs, with a hidden state of `width`.
    pub fn sizes(features: LeverFeatures, prior: bool, width: usize) -> LeverSizes {
        let told = if prior { 4 + LEVER_POSE } else { 0 };
        LeverSizes {
            still: LeverFeatures::ACTION + features.count() + told,
            moving: 1 + if prior { LEVER_POSE + 1 } else { 0 },
            width,
        }
    }

    /// The numbers of a pose in the unit of predictions.
    pub fn told(seen: [f64; LEVER_POSE]) -> [f32; LEVER_POSE] {
        let mut k = 0;
        seen.map(|value| {
            k += 1;
            if k <= 3 { (value / WAY) as f32 } else { value as f32 }
        })
    }

    /// The pose behind such numbers.
    pub fn seen(told: &[f32]) -> [f64; LEVER_POSE] {
        std::array::from_fn(|k| f64::from(told[k]) * if k < 3 { WAY } else { 1.0 })
    }
}

/// The inputs of a job, with what the prior says of it if that is corrected.
pub fn lever_inputs(
    features: LeverFeatures,
    job: &LeverJob,
    prior: Option<&LeverTrajectory>,
) -> LeverInputs {
    let view = LeverView::new(job);
    let mut still = lever_action(job).to_vec();
    still.extend(lever_features(features, job, &view));
    let start = view.see(&job.scene.plates[job.lever.plate].start());
    let (mut moving, mut base) = (Vec::new(), Vec::new());
    for frame in 0..LEVER_FRAMES {
        moving.push((frame + 1) as f32 / LEVER_FRAMES as f32);
        let seen = prior.map_or(start, |prior| view.see(&prior.lift[frame]));
        let told = LeverInputs::told(seen);
        base.extend(told);
        if let Some(prior) = prior {
            moving.extend(told);
            moving.push(f32::from(u8::from(prior.held[frame])));
        }
    }
    let rest = LeverInputs::told(prior.map_or(start, |prior| view.see(&prior.rest)));
    base.extend(rest);
    if let Some(prior) = prior {
        let is = |is: bool| f32::from(u8::from(is));
        still.push(is(prior.slipped()));
        still.extend(
            [Ending::Back, Ending::Flipped, Ending::Leaning].map(|e| is(prior.ending == e)),
        );
        still.extend(rest);
    }
    LeverInputs { still, moving, base }
}
