//! Errors of models of lever-ups on held-out data.

use pushplan::internals::{
    outcome::{Ending, LeverTrajectory},
    task::LeverJob,
};
use pushplan_act::judge::Summary;
use pushplan_learn::dataset::{LeverEpisode, LeverPreset};
use pushplan_learn::judge::{LeverError, lever_error};
use pushplan_learn::lever_model::LeverModel;
use serde::{Deserialize, Serialize};

use super::super::cpu_clock::timed;
use super::baselines::LeverBaseline;
use super::supports::{SupportRow, support_rows};

/// Errors of a model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverRow {
    /// Name of the model.
    pub model: String,
    /// Number of lever-ups in the model's domain.
    pub taken: usize,
    /// Root mean square distance of the centre of mass over the frames of the rotation, metres.
    pub lift: Option<Summary>,
    /// Distance as in `lift`, over the lever-ups that slip.
    pub slipping: Option<Summary>,
    /// Distance as in `lift`, over the lever-ups that do not slip.
    pub kept: Option<Summary>,
    /// Distance at the end of the rotation, metres.
    pub last: Option<Summary>,
    /// Angle at the end of the rotation, radians.
    pub turn: Option<Summary>,
    /// Distance at rest, metres.
    pub rest: Option<Summary>,
    /// Share of correctly predicted slips.
    pub slips: f64,
    /// Share of correctly predicted endings.
    pub endings: f64,
    /// Processor time of a lever-up on one core, seconds.
    pub time: f64,
}

/// Errors of models on a family of lever-ups.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverReport {
    /// Family of the lever-ups.
    pub preset: LeverPreset,
    /// Seed of the family.
    pub seed: u64,
    /// Number of lever-ups.
    pub cases: usize,
    /// Mean displacement of the centre of mass until the end of the rotation, metres.
    pub motion: f64,
    /// Number of lever-ups that slip.
    pub slipped: usize,
    /// Number of plates that end upside down.
    pub flipped: usize,
    /// Number of plates that end leaning.
    pub leaning: usize,
    /// Accuracy of the support edge in closed form.
    pub supports: Vec<SupportRow>,
    /// A row for each model.
    pub rows: Vec<LeverRow>,
}

/// Measures `models` on `episodes` of a family and seed. Only episodes that came to rest without a
/// jam are counted.
pub fn lever_report(
    (preset, seed): (LeverPreset, u64),
    episodes: &[LeverEpisode],
    models: &[&dyn LeverModel],
) -> LeverReport {
    let episodes: Vec<LeverEpisode> =
        episodes.iter().filter(|episode| episode.is_sound()).cloned().collect();
    let still = LeverBaseline::still();
    let motion = |episode: &LeverEpisode| {
        let job = episode.job();
        still
            .rollout(std::slice::from_ref(&job))
            .first()
            .map_or(0.0, |start| lever_error(&job, &episode.trajectory, start).last)
    };
    let ends = |ending: Ending| {
        episodes.iter().filter(|episode| episode.trajectory.ending == ending).count()
    };
    LeverReport {
        preset,
        seed,
        cases: episodes.len(),
        motion: episodes.iter().map(motion).sum::<f64>() / episodes.len().max(1) as f64,
        slipped: episodes.iter().filter(|episode| episode.trajectory.slipped()).count(),
        flipped: ends(Ending::Flipped),
        leaning: ends(Ending::Leaning),
        supports: support_rows(&episodes),
        rows: models.iter().map(|model| row(*model, &episodes)).collect(),
    }
}

fn row(model: &dyn LeverModel, episodes: &[LeverEpisode]) -> LeverRow {
    let takes = |job: &LeverJob| model.takes(job);
    let (mine, jobs): (Vec<&LeverEpisode>, Vec<LeverJob>) = episodes
        .iter()
        .map(|episode| (episode, episode.job()))
        .filter(|(_, job)| takes(job))
        .unzip();
    let (predicted, time) = on_one_core(model, &jobs);
    let errors: Vec<_> = mine
        .iter()
        .zip(&jobs)
        .zip(&predicted)
        .map(|((episode, job), predicted)| {
            (episode.trajectory.slipped(), lever_error(job, &episode.trajectory, predicted))
        })
        .collect();
    let over = |is: &dyn Fn(bool) -> bool, of: &dyn Fn(&LeverError) -> f64| {
        let some = errors.iter().filter(|(slipped, _)| is(*slipped));
        Summary::of(&some.map(|(_, error)| of(error)).collect::<Vec<f64>>())
    };
    let all = |_: bool| true;
    let share = |is: &dyn Fn(&LeverError) -> bool| {
        errors.iter().filter(|(_, error)| is(error)).count() as f64 / errors.len().max(1) as f64
    };
    LeverRow {
        model: model.name(),
        taken: mine.len(),
        lift: over(&all, &|error| error.lift),
        slipping: over(&|slipped| slipped, &|error| error.lift),
        kept: over(&|slipped| !slipped, &|error| error.lift),
        last: over(&all, &|error| error.last),
        turn: over(&all, &|error| error.turn),
        rest: over(&all, &|error| error.rest),
        slips: share(&|error| error.same_slip),
        endings: share(&|error| error.same_ending),
        time,
    }
}

/// Returns the predictions of `model` for `jobs`, and the processor time of a job on one core,
/// seconds.
pub(super) fn on_one_core(
    model: &dyn LeverModel,
    jobs: &[LeverJob],
) -> (Vec<LeverTrajectory>, f64) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let (predicted, time) = match pool {
        Ok(pool) => pool.install(|| timed(|| model.rollout(jobs))),
        Err(_) => timed(|| model.rollout(jobs)),
    };
    (predicted, time.as_secs_f64() / jobs.len().max(1) as f64)
}
