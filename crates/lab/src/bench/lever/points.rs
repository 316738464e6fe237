//! Accuracy of the lever point inferred from the first frames, and of its prediction for the rest.

use pushplan::internals::geometry::Pose3;
use pushplan::internals::outcome::LEVER_FRAMES;
use pushplan_act::judge::Summary;
use pushplan_learn::dataset::{LeverEpisode, LeverPreset};
use pushplan_learn::lever_model::LeverModel;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::point_search::LeverSearch;

/// Errors after a number of observed frames.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointRow {
    /// Number of observed frames at the start of the motion.
    pub seen: usize,
    /// Angle between the true and the inferred place as seen from the centre of mass, radians.
    pub angle: Option<Summary>,
    /// Root mean square distance of the centre of mass over the frames that follow, metres.
    pub rest: Option<Summary>,
    /// Distance of the centre of mass at the end of the rotation, metres.
    pub last: Option<Summary>,
    /// Distance as in `rest`, for the model alone from the true place, metres.
    pub known: Option<Summary>,
}

/// Lever points of a family.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointReport {
    /// Family of the lever-ups.
    pub preset: LeverPreset,
    /// Seed of the family.
    pub seed: u64,
    /// Number of lever-ups.
    pub cases: usize,
    /// Name of the inverted model.
    pub model: String,
    /// Rows by the number of observed frames: from one to all but one.
    pub rows: Vec<PointRow>,
}

/// Errors of a lever-up: angle, error over the rest and at its end, and error of the model alone.
type Found = [f64; 4];

/// Infers the place of each of `episodes` of a family and seed by `model`, in parallel on the
/// current rayon pool. The result has the same bits for any number of threads. Only episodes that
/// came to rest without a jam are counted.
pub fn point_report(
    (preset, seed): (LeverPreset, u64),
    episodes: &[LeverEpisode],
    model: &dyn LeverModel,
) -> PointReport {
    let episodes: Vec<&LeverEpisode> =
        episodes.iter().filter(|episode| episode.is_sound()).collect();
    let found: Vec<Vec<Found>> =
        episodes.par_iter().map(|episode| measure(model, episode)).collect();
    let rows = (1..LEVER_FRAMES).map(|seen| {
        let over = |k: usize| {
            let of: Vec<f64> =
                found.iter().filter_map(|one| one.get(seen - 1)).map(|f| f[k]).collect();
            Summary::of(&of)
        };
        PointRow { seen, angle: over(0), rest: over(1), last: over(2), known: over(3) }
    });
    PointReport { preset, seed, cases: episodes.len(), model: model.name(), rows: rows.collect() }
}

/// Returns the errors after a frame, after two, and so on.
fn measure(model: &dyn LeverModel, episode: &LeverEpisode) -> Vec<Found> {
    let (job, lift) = (episode.job(), &episode.trajectory.lift);
    let centre = job.scene.plates[job.lever.plate].weight().centre;
    let apart = |a: &[Pose3], b: &[Pose3]| -> Vec<f64> {
        a.iter().zip(b).map(|(a, b)| (a.point(centre) - b.point(centre)).norm()).collect()
    };
    let over = |apart: &[f64]| {
        (apart.iter().map(|far| far * far).sum::<f64>() / apart.len().max(1) as f64).sqrt()
    };
    let alone = model.rollout(std::slice::from_ref(&job));
    let search = LeverSearch::new(model, &job);
    let one = |seen: usize| {
        let (before, after) = lift.split_at(seen);
        let point = search.infer(before)?;
        let off = apart(after, &point.rest(&job, before));
        let alone =
            alone.first().map_or_else(Vec::new, |predicted| apart(after, &predicted.lift[seen..]));
        Some([point.off(&job), over(&off), *off.last()?, over(&alone)])
    };
    (1..lift.len()).filter_map(one).collect()
}
