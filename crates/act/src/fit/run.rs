//! Fit on a rough grid over the whole range, then on a fine grid over its probable part.

use std::sync::Arc;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::judge::{Comparison, Trial, mean, percentile};
use pushplan::effect::EffectModel;
use pushplan::progress::{Count, Progress};
use pushplan::{
    outcome::Record,
    scene::{ModelSpec, Span, Support, Surface},
    task::Job,
};

use super::grid::{Axis, Grid};
use super::likelihood::{NoiseLaw, Residual, Widths};
use super::posterior::{Estimate, Posterior};

/// Displacement below which an object is ignored, if all predictions agree, metres.
const STILL: f64 = 5e-4;

/// Probability relative to the best below which cells are excluded from the fine grid.
const UNLIKELY: f64 = 1e-4;

/// Search ranges and assumptions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FitSettings {
    /// Range of the spread with a uniform prior: shares of the corners' distance.
    pub spread: Span,
    /// Range of the friction coefficient between pusher and object, with a uniform prior.
    pub friction: Span,
    /// Number of values per axis of a grid.
    pub values: usize,
    /// Noise law.
    pub law: NoiseLaw,
    /// Width of the noise in x, y and the rotation at the radius of gyration, metres; `None` to
    /// estimate it.
    pub noise: Option<f64>,
}

impl Default for FitSettings {
    fn default() -> Self {
        Self {
            spread: Span::new(0.2, 1.0),
            friction: Span::new(0.02, 1.0),
            values: 17,
            law: NoiseLaw::Student,
            noise: None,
        }
    }
}

/// Final position errors over all objects that move, with one support and the pusher friction that
/// fits it best, metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SupportError {
    /// Support of all objects.
    pub support: Support,
    /// Friction coefficient of the pusher.
    pub friction: f64,
    /// Mean error.
    pub mean: f64,
    /// Median error.
    pub median: f64,
}

/// Final position errors with the supports stated in the scenes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AsStated {
    /// Friction coefficient of the pusher that fits these supports best.
    pub friction: f64,
    /// Mean error, metres.
    pub mean: f64,
    /// Median error, metres.
    pub median: f64,
    /// Whether the recordings are more probable with these supports than with a common spread,
    /// averaged over the prior.
    pub likelier: bool,
}

/// Result of a fit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fit {
    /// Model that was fitted.
    pub by: ModelSpec,
    /// Search ranges and assumptions.
    pub settings: FitSettings,
    /// Number of recordings.
    pub recordings: usize,
    /// Number of objects that move.
    pub moved: usize,
    /// Mean displacement of these objects, metres.
    pub motion: f64,
    /// Width of the noise, metres: the stated one, otherwise the estimate at the maximum of the
    /// posterior.
    pub noise: f64,
    /// Support radius as a share of the corners' distance.
    pub spread: Estimate,
    /// Friction coefficient of pusher and objects.
    pub friction: Estimate,
    /// Posterior over the whole range.
    pub rough: Posterior,
    /// Posterior on a finer grid over the probable part, from which the estimates are computed.
    pub fine: Posterior,
    /// Errors with the most probable parameters.
    pub best: SupportError,
    /// Errors with uniform pressure.
    pub even: SupportError,
    /// Errors with corner support.
    pub corners: SupportError,
    /// Errors with the stated supports.
    pub stated: AsStated,
}

impl Fit {
    /// Returns the spread if the recordings identify it better than the stated supports do.
    pub fn identified_spread(&self) -> Option<f64> {
        (self.spread.identified && !self.stated.likelier).then_some(self.spread.best)
    }

    /// Returns the friction for [`Self::identified_spread`], otherwise for the supports as stated.
    pub fn identified_friction(&self) -> f64 {
        if self.identified_spread().is_some() { self.friction.best } else { self.stated.friction }
    }
}

/// Fits a common spread and pusher friction to recordings.
///
/// `progress` receives the number of finished recordings, first for the rough grid and then for the
/// fine one. Masses and the table's friction are as stated because they do not affect slow pushes.
/// Returns `None` if no object moves.
///
/// The noise is at least 2 % of the mean motion because models of equal physics differ by this
/// much. From slow pushes (0.01 m/s) in either engine, the analytic model recovers the spread to
/// 0.05. From pushes at 0.04 m/s it estimates 0.8 instead of 0.9, while the 2-D engine recovers its
/// own spread to 0.01.
///
/// Only the last instant of a recording is compared, so a recording of several pushes has no more
/// weight than a recording of one.
pub fn fit(
    model: &dyn EffectModel,
    trials: &[Trial],
    settings: &FitSettings,
    progress: &dyn Progress,
) -> Option<Fit> {
    let FitSettings { values, law, .. } = *settings;
    let moves: Vec<Vec<bool>> = trials.iter().map(|trial| moving(model, trial)).collect();
    let motions: Vec<f64> = trials
        .iter()
        .zip(&moves)
        .flat_map(|(trial, moves)| {
            let pairs = trial.motions().into_iter().zip(moves.clone());
            pairs.filter(|(_, moves)| *moves).map(|(motion, _)| motion).collect::<Vec<_>>()
        })
        .collect();
    if motions.is_empty() {
        return None;
    }
    let widths = Widths::of(settings.noise, mean(&motions));
    let look = |what: &str, hypotheses: Vec<(Option<Support>, f64)>| -> Vec<Vec<Ended>> {
        progress.stage(what);
        let count = Count::new(progress, 0, trials.len());
        let by_trial: Vec<Vec<Vec<Ended>>> = trials
            .par_iter()
            .zip(&moves)
            .map(|(trial, moves)| {
                let ends = ends(model, trial, moves, &hypotheses);
                count.one();
                ends
            })
            .collect();
        let of = |cell: usize| by_trial.iter().flat_map(|cells| cells[cell].clone()).collect();
        (0..hypotheses.len()).map(of).collect()
    };
    let over = |what: &str, grid: Grid| {
        let hypotheses =
            grid.cells().map(|[spread, mu]| (Some(Support::Spread(spread)), mu)).collect();
        let cells = look(what, hypotheses);
        let found: Vec<(f64, f64)> =
            cells.iter().map(|cell| widths.log_density(law, &residuals(cell))).collect();
        let logs: Vec<f64> = found.iter().map(|(log, _)| *log).collect();
        let posterior = Posterior::of(grid, &logs);
        let noise = found[posterior.best()].1;
        let best = cells[posterior.best()].clone();
        (posterior, noise, best, mean_log(&logs))
    };
    let axis = |span| Axis::over(span, values);
    let grid = Grid { spread: axis(settings.spread), friction: axis(settings.friction) };
    let (rough, _, _, over_spreads) = over("roughly", grid);
    let most = rough.probabilities[rough.best()];
    let (fine, noise, best, _) =
        over("finely", grid.around(|cell| rough.probabilities[cell] > UNLIKELY * most));

    let rested = |support: Option<Support>| {
        let hypotheses: Vec<(Option<Support>, f64)> =
            grid.friction.values().map(|friction| (support.clone(), friction)).collect();
        let cells = look("even, on corners and as stated", hypotheses);
        let log = |cell: &Vec<Ended>| widths.log_density(law, &residuals(cell)).0;
        let logs: Vec<f64> = cells.iter().map(log).collect();
        let likeliest = (0..logs.len()).max_by(|&a, &b| logs[a].total_cmp(&logs[b])).unwrap_or(0);
        (grid.friction.at(likeliest), cells[likeliest].clone(), mean_log(&logs))
    };
    let with = |support: Support| {
        let (friction, ends, _) = rested(Some(support.clone()));
        error(support, friction, &ends)
    };
    let (friction_as_stated, ends_as_stated, as_stated) = rested(None);
    let SupportError { mean: mean_as_stated, median: median_as_stated, .. } =
        error(Support::Even, friction_as_stated, &ends_as_stated);
    let [spread, friction] = fine.best_cell();
    Some(Fit {
        by: model.spec().clone(),
        settings: settings.clone(),
        recordings: trials.len(),
        moved: motions.len(),
        motion: mean(&motions),
        noise,
        spread: fine.spread(settings.spread),
        friction: fine.friction(settings.friction),
        best: error(Support::Spread(spread), friction, &best),
        even: with(Support::Even),
        corners: with(Support::Corners),
        stated: AsStated {
            friction: friction_as_stated,
            mean: mean_as_stated,
            median: median_as_stated,
            likelier: as_stated >= over_spreads,
        },
        rough,
        fine,
    })
}

/// Final error of one object.
#[derive(Clone, Copy)]
struct Ended {
    position: f64,
    residual: Residual,
}

/// Returns whether each object moves by more than [`STILL`], in the recording or the prediction.
pub(super) fn moving(model: &dyn EffectModel, trial: &Trial) -> Vec<bool> {
    let start = trial.scene.start();
    let predicted = model.rollout(&trial.scene, &[trial.job()], Record::Outcome);
    let ends = predicted.first().and_then(|trajectory| trajectory.frames.last());
    let motions = trial.motions().into_iter().enumerate();
    motions
        .map(|(k, motion)| {
            let moved = |end: &pushplan::outcome::Frame| {
                (end.state.poses[k].position - start.poses[k].position).norm()
            };
            motion > STILL || ends.is_some_and(|end| moved(end) > STILL)
        })
        .collect()
}

/// Returns the final errors of the moving objects for each support and friction.
fn ends(
    model: &dyn EffectModel,
    trial: &Trial,
    moves: &[bool],
    hypotheses: &[(Option<Support>, f64)],
) -> Vec<Vec<Ended>> {
    let stated = trial.job();
    let jobs: Vec<Job> = hypotheses
        .iter()
        .map(|(support, friction)| {
            let mut physics = (*stated.physics).clone();
            if let Some(support) = support {
                physics.support_all(&trial.scene, support);
            }
            for index in 0..trial.scene.objects.len() {
                physics = physics.with_pair(index, Surface::Tool, *friction);
            }
            Job { physics: Arc::new(physics), ..stated.clone() }
        })
        .collect();
    let rolled = model.rollout(&trial.scene, &jobs, Record::Outcome);
    rolled
        .into_iter()
        .map(|trajectory| {
            let comparison = Comparison::new(trial, trajectory);
            let errors = comparison.end().into_iter().zip(&trial.scene.objects).zip(moves);
            errors
                .filter(|(_, moves)| **moves)
                .map(|((error, object), _)| {
                    let arm = object.shape.footprint().gyration_radius();
                    // A missing prediction counts as an error of 1 m or 1 rad.
                    let far = |value: f64| if value.is_finite() { value } else { 1.0 };
                    let position = far(error.position);
                    let residual = match error.heading {
                        Some(turn) => {
                            Residual { distance: position.hypot(arm * far(turn)), numbers: 3.0 }
                        }
                        None => Residual { distance: position, numbers: 2.0 },
                    };
                    Ended { position, residual }
                })
                .collect()
        })
        .collect()
}

/// Returns the logarithm of the mean of the exponentials of `logs`.
fn mean_log(logs: &[f64]) -> f64 {
    let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    most + mean(&logs.iter().map(|log| (log - most).exp()).collect::<Vec<f64>>()).ln()
}

fn residuals(ends: &[Ended]) -> Vec<Residual> {
    ends.iter().map(|end| end.residual).collect()
}

fn error(support: Support, friction: f64, ends: &[Ended]) -> SupportError {
    let mut errors: Vec<f64> = ends.iter().map(|end| end.position).collect();
    errors.sort_by(f64::total_cmp);
    SupportError { support, friction, mean: mean(&errors), median: percentile(&errors, 50.0) }
}
