//! Errors of models of boards that are levered out of drives (Tekden 2020, section 8.5).

use pushplan::internals::{outcome::LeverTrajectory, scene::LeverScene, task::LeverJob};
use pushplan_act::judge::Summary;
use pushplan_learn::dataset::{LEVERS_PER_SHAPE, LeverEpisode};
use pushplan_learn::judge::{LeverError, lever_error};
use pushplan_learn::lever_model::LeverModel;
use serde::{Deserialize, Serialize};

use super::accuracy::on_one_core;
use super::suite::pocket;

/// Errors of a model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DriveRow {
    /// Name of the model.
    pub model: String,
    /// Root mean square distance of the centre of mass over the frames of the rotation, metres.
    pub lift: Option<Summary>,
    /// Root mean square angle over the frames of the rotation, radians.
    pub turn: Option<Summary>,
    /// Distance at the end of the rotation, metres.
    pub last: Option<Summary>,
    /// Distance at rest, metres.
    pub rest: Option<Summary>,
    /// Share of boards correctly predicted to rest in or out of the pocket.
    pub outside: f64,
    /// Processor time of a lever-up on one core, seconds.
    pub time: f64,
}

/// Errors of models on boards in drives.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DriveReport {
    /// Seed of the drives.
    pub seed: u64,
    /// Number of lever-ups.
    pub cases: usize,
    /// Number of drives.
    pub drives: usize,
    /// Number of boards with a final rest position out of the pocket.
    pub outside: usize,
    /// A row for each model.
    pub rows: Vec<DriveRow>,
}

/// Measures `models` on `episodes` with drives of this seed. Only episodes that came to rest
/// without a jam are counted, and for each model only the lever-ups in its domain.
pub fn drive_report(
    seed: u64,
    episodes: &[LeverEpisode],
    models: &[&dyn LeverModel],
) -> DriveReport {
    let sound: Vec<&LeverEpisode> = episodes.iter().filter(|episode| episode.is_sound()).collect();
    let mut drives: Vec<u64> = sound.iter().map(|e| e.index / LEVERS_PER_SHAPE).collect();
    drives.dedup();
    DriveReport {
        seed,
        cases: sound.len(),
        drives: drives.len(),
        outside: sound.iter().filter(|e| is_outside(&e.scene, &e.trajectory)).count(),
        rows: models.iter().map(|model| row(*model, &sound)).collect(),
    }
}

fn row(model: &dyn LeverModel, episodes: &[&LeverEpisode]) -> DriveRow {
    let takes = |job: &LeverJob| model.takes(job);
    let (mine, jobs): (Vec<&LeverEpisode>, Vec<LeverJob>) = episodes
        .iter()
        .map(|episode| (*episode, episode.job()))
        .filter(|(_, job)| takes(job))
        .unzip();
    let (predicted, time) = on_one_core(model, &jobs);
    let pairs = || mine.iter().zip(&jobs).zip(&predicted);
    let errors: Vec<_> = pairs()
        .map(|((episode, job), predicted)| lever_error(job, &episode.trajectory, predicted))
        .collect();
    let turns: Vec<f64> =
        pairs().map(|((episode, _), predicted)| turn(&episode.trajectory, predicted)).collect();
    let right = pairs().filter(|((episode, _), predicted)| {
        is_outside(&episode.scene, predicted) == is_outside(&episode.scene, &episode.trajectory)
    });
    let right = right.count() as f64 / mine.len().max(1) as f64;
    let of = |error: fn(&LeverError) -> f64| {
        Summary::of(&errors.iter().map(error).collect::<Vec<f64>>())
    };
    DriveRow {
        model: model.name(),
        lift: of(|error| error.lift),
        turn: Summary::of(&turns),
        last: of(|error| error.last),
        rest: of(|error| error.rest),
        outside: right,
        time,
    }
}

/// Returns the root mean square angle between two trajectories over the frames of the rotation,
/// radians.
fn turn(truth: &LeverTrajectory, predicted: &LeverTrajectory) -> f64 {
    let squares: f64 =
        truth.lift.iter().zip(&predicted.lift).map(|(a, b)| a.angle_to(b).powi(2)).sum();
    (squares / truth.lift.len().max(1) as f64).sqrt()
}

/// Returns `true` if the board rests with its centre of mass out of the pocket, seen from above.
fn is_outside(scene: &LeverScene, trajectory: &LeverTrajectory) -> bool {
    let pocket = pocket(&scene.blocks);
    let local = pocket.pose.inverse().point(trajectory.rest.position.xy());
    local.x.abs() > 0.5 * pocket.size[0] || local.y.abs() > 0.5 * pocket.size[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use pushplan::internals::effect::LeverPrior;
    use pushplan_learn::dataset::{LeverConfig, LeverPreset};

    #[test]
    fn the_true_model_has_no_error_and_a_resting_model_has_one() {
        let config = LeverConfig { seed: 3, episodes: 12, preset: LeverPreset::Drive };
        let episodes: Vec<LeverEpisode> =
            (0..12).map(|index| LeverEpisode::draw(&config, index)).collect();
        let fine = pushplan_learn::lever_model::SimulatedLevers {
            simulator: pushplan::internals::sim::LeverSimulator::FINE,
        };
        let still = super::super::LeverBaseline::still();
        let prior = LeverPrior::default();
        let report = drive_report(3, &episodes, &[&fine, &still, &prior]);
        assert_eq!((report.cases, report.drives), (12, 3));
        assert!(report.outside > 0 && report.outside < 12, "{}", report.outside);
        let [fine, still, prior] = &report.rows[..] else { panic!("three rows") };
        let mean = |of: &Option<Summary>| of.as_ref().expect("cases").mean;
        assert!(mean(&fine.lift) == 0.0 && mean(&fine.turn) < 1e-12 && fine.outside == 1.0);
        assert!(mean(&still.lift) > 0.01 && mean(&still.turn) > 0.2);
        assert!((still.outside + report.outside as f64 / 12.0 - 1.0).abs() < 1e-12);
        // Far below the required 4 mm and 5 degrees.
        assert!(mean(&prior.lift) < 1e-3 && mean(&prior.turn) < 0.01, "{prior:?}");
        assert!(prior.outside > 0.9, "{prior:?}");
    }
}
