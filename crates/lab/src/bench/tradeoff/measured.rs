//! Results of a run: the numbers of every level, and the levels on the front.

use std::collections::BTreeMap;

use pushplan::internals::asset::SCHEMA_VERSION;
use pushplan::internals::solve::{Effort, PlanStatus};
use pushplan_act::judge::{Summary, mean, percentile};
use pushplan_bench::store::Seconds;
use pushplan_bench::{End, SolvedTask};
use serde::{Deserialize, Serialize};

use crate::bench::SuiteKind;

use super::choice::shipped_efforts;
use super::cost::{OBJECTS, YARDSTICK, alone_key, key};
use super::front::{Noise, Point, on_front};
use super::levels::{Level, PlanLevel};
use super::run::{CONTROL, TradeOffSettings, Unit, verification_key};

/// Relative difference below which costs of tasks count as equal.
const LEAST_COST_NOISE: f64 = 0.02;

/// Name of the reference model for costs.
const RIVAL: &str = "planar";

/// Errors of a predictor on a kind of held-out pushes; objects that moved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SuiteErrors {
    /// Kind of the pushes.
    pub suite: SuiteKind,
    /// Distance from the final positions in the 2-D ground truth, metres.
    pub position: Option<Summary>,
    /// Distance from the final positions in the 3-D engine, metres.
    pub position_3d: Option<Summary>,
    /// Number of objects without a finite prediction.
    pub failed: usize,
}

/// A predictor with its errors and its cost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PredictorRow {
    /// Name of the predictor.
    pub model: String,
    /// Errors by kind of pushes.
    pub suites: Vec<SuiteErrors>,
    /// Processor time of a push with one object, seconds; in a batch, for models that gain by it.
    pub seconds: f64,
    /// Processor time of a push predicted alone, where that differs, seconds.
    pub seconds_alone: Option<f64>,
    /// Whether no other predictor is both cheaper and more accurate (mean over one object).
    pub on_front: bool,
}

/// Cost of a push with several objects on the table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ObjectCost {
    /// Number of objects.
    pub objects: usize,
    /// Name of the predictor.
    pub model: String,
    /// Processor time of a push, seconds.
    pub seconds: f64,
    /// Cost of the 2-D engine at its default step relative to this predictor.
    pub planar_ratio: f64,
}

/// A level of planning with its results and its cost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanRow {
    /// Level of planning.
    #[serde(flatten)]
    pub level: PlanLevel,
    /// Share of tasks with a predicted success.
    pub predicted: f64,
    /// Share of tasks solved in the 2-D replay.
    pub planar: f64,
    /// Share of tasks solved, as verified by the level.
    pub success: f64,
    /// Share of perturbed replays that reach the goal, in the engine with fewer successes; mean
    /// over the tasks. These replays differ from those by which the level has chosen its plan.
    pub robustness: f64,
    /// Final error in 3-D, metres.
    pub error: Option<Summary>,
    /// Predicted final error, metres.
    pub predicted_error: Option<Summary>,
    /// Number of rollouts of the effect model per task.
    pub rollouts: f64,
    /// Number of plans verified per task.
    pub verified: f64,
    /// Processor time of a task on one thread, including verification, seconds.
    pub seconds: f64,
    /// Processor time of the replays, seconds.
    pub verification: f64,
    /// Whether no other level is both cheaper and more robust, beyond the noise, among the levels
    /// that determine robustness.
    pub on_front: bool,
}

impl PlanRow {
    /// Returns cost and share of failures under perturbations.
    pub fn point(&self) -> Point {
        Point { cost: self.seconds, error: 1.0 - self.robustness }
    }

    /// Returns `true` if the level determines the robustness of plans.
    pub fn is_complete(&self) -> bool {
        self.level.settings.replays > 0
    }
}

/// A finished run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TradeOffReport {
    /// Version of the file format.
    pub schema_version: u32,
    /// Size of the run.
    pub counts: TradeOffSettings,
    /// Rate of matrix products of one thread in the same run, 1e9 operations per second.
    pub gigaflops: f64,
    /// Noise of a push's cost, relative: the excess of the median round over the fastest, which is
    /// the reported one.
    pub push_noise: f64,
    /// Noise between levels of planning: the difference of two measurements of one level's cost,
    /// and one standard error of the best level's robustness.
    pub noise: Noise,
    /// Comparison of the 2-D ground truth with itself, with the start shifted by 0.1 mm.
    pub spread: Vec<SuiteErrors>,
    /// Predictors with errors and costs.
    pub predictors: Vec<PredictorRow>,
    /// Costs by number of objects.
    pub objects: Vec<ObjectCost>,
    /// Levels of planning.
    pub plans: Vec<PlanRow>,
    /// Measured level of each effort.
    pub efforts: BTreeMap<Effort, PlanLevel>,
}

impl TradeOffReport {
    pub(super) fn of(
        counts: TradeOffSettings,
        levels: &[Level],
        plans: &[PlanLevel],
        units: &[(Unit, Seconds)],
    ) -> Self {
        let rounds: Vec<&Seconds> =
            units.iter().filter(|(unit, _)| *unit == Unit::Round).map(|(_, times)| times).collect();
        let fastest = |key: &str| least(&rounds, key);
        let mut errors = units.iter().filter_map(|(unit, _)| match unit {
            Unit::Predictor { suites, .. } => Some(suites.clone()),
            _ => None,
        });
        let spread = errors.next().unwrap_or_default();
        let names = levels.iter().map(Level::name);
        let predictors = predictor_rows(names.zip(errors), &fastest);
        let noise = task_noise(units, plans);
        let plans = plan_rows(plans, units, noise);
        Self {
            schema_version: SCHEMA_VERSION,
            counts,
            gigaflops: fastest(YARDSTICK).map_or(f64::INFINITY, f64::recip).min(f64::MAX),
            push_noise: round_noise(&rounds),
            noise,
            spread,
            objects: object_costs(
                levels.iter().filter(|level| level.is_plain()).map(Level::name),
                &fastest,
            ),
            predictors,
            efforts: shipped_efforts(&plans),
            plans,
        }
    }
}

fn least(rounds: &[&Seconds], key: &str) -> Option<f64> {
    rounds.iter().filter_map(|round| round.get(key)).copied().min_by(f64::total_cmp)
}

fn predictor_rows<'a>(
    rows: impl Iterator<Item = (&'a str, Vec<SuiteErrors>)>,
    fastest: &dyn Fn(&str) -> Option<f64>,
) -> Vec<PredictorRow> {
    let mut rows: Vec<PredictorRow> = rows
        .map(|(model, suites)| PredictorRow {
            model: model.to_owned(),
            suites,
            seconds: fastest(&key(1, model)).unwrap_or_default(),
            seconds_alone: fastest(&alone_key(model)),
            on_front: false,
        })
        .collect();
    let points: Vec<Point> = rows
        .iter()
        .map(|row| {
            let errors = row.suites.first().and_then(|errors| errors.position.as_ref());
            Point { cost: row.seconds, error: errors.map_or(f64::INFINITY, |errors| errors.mean) }
        })
        .collect();
    let front = on_front(&points, Noise::default());
    rows.iter_mut().zip(front).for_each(|(row, front)| row.on_front = front);
    rows
}

fn object_costs<'a>(
    models: impl Iterator<Item = &'a str> + Clone,
    fastest: &dyn Fn(&str) -> Option<f64>,
) -> Vec<ObjectCost> {
    OBJECTS
        .into_iter()
        .flat_map(|objects| models.clone().map(move |model| (objects, model)))
        .filter_map(|(objects, model)| {
            let seconds = fastest(&key(objects, model))?;
            let planar = fastest(&key(objects, RIVAL))?;
            Some(ObjectCost {
                objects,
                model: model.to_owned(),
                seconds,
                planar_ratio: planar / seconds.max(f64::MIN_POSITIVE),
            })
        })
        .collect()
}

/// Iterates over the tasks with the outcomes of all levels.
fn tasks(units: &[(Unit, Seconds)]) -> impl Iterator<Item = (&[SolvedTask], &Seconds)> {
    units.iter().filter_map(|(unit, times)| match unit {
        Unit::Task { plans, .. } => Some((plans.as_slice(), times)),
        _ => None,
    })
}

fn plan_rows(plans: &[PlanLevel], units: &[(Unit, Seconds)], noise: Noise) -> Vec<PlanRow> {
    let mut rows: Vec<PlanRow> = plans
        .iter()
        .enumerate()
        .map(|(k, level)| {
            let outcomes: Vec<&SolvedTask> =
                tasks(units).filter_map(|(plans, _)| plans.get(k)).collect();
            let over = |value: &dyn Fn(&SolvedTask) -> Option<f64>| -> Vec<f64> {
                outcomes.iter().filter_map(|outcome| value(outcome)).collect()
            };
            let share = |is: &dyn Fn(&SolvedTask) -> bool| {
                mean(&over(&|outcome| Some(f64::from(u8::from(is(outcome))))))
            };
            let seconds = |key: &str| {
                let times = tasks(units).filter_map(|(_, times)| times.get(key).copied());
                mean(&times.collect::<Vec<f64>>())
            };
            PlanRow {
                predicted: share(&|outcome| reached(&outcome.predicted)),
                planar: share(&|outcome| reached(&outcome.planar)),
                success: share(&|outcome| outcome.status == PlanStatus::Solved),
                robustness: mean(&over(&|outcome| Some(robustness(outcome)))),
                error: Summary::of(&over(&|outcome| outcome.spatial.map(|end| end.error))),
                predicted_error: Summary::of(&over(&|outcome| {
                    outcome.predicted.map(|end| end.error)
                })),
                rollouts: mean(&over(&|outcome| Some(outcome.rollouts as f64))),
                verified: mean(&over(&|outcome| Some(outcome.attempts as f64))),
                seconds: seconds(&level.name),
                verification: seconds(&verification_key(&level.name)),
                level: level.clone(),
                on_front: false,
            }
        })
        .collect();
    let (complete, points): (Vec<usize>, Vec<Point>) = rows
        .iter()
        .enumerate()
        .filter(|(_, row)| row.is_complete())
        .map(|(k, row)| (k, row.point()))
        .unzip();
    for (k, front) in complete.into_iter().zip(on_front(&points, noise)) {
        rows[k].on_front = front;
    }
    rows
}

/// Returns the robustness, zero if nothing can be pushed.
fn robustness(task: &SolvedTask) -> f64 {
    task.robustness.unwrap_or_default()
}

fn reached(end: &Option<End>) -> bool {
    end.is_some_and(|end| end.reached)
}

fn task_noise(units: &[(Unit, Seconds)], plans: &[PlanLevel]) -> Noise {
    let sum = |name: &str| tasks(units).filter_map(|(_, times)| times.get(name)).sum::<f64>();
    let first = plans.first().map_or(0.0, |plan| sum(&plan.name));
    let again = sum(CONTROL);
    let cost = if first > 0.0 { (again / first - 1.0).abs() } else { 0.0 };
    let shares = (0..plans.len()).map(|k| {
        let all = tasks(units).filter_map(|(plans, _)| plans.get(k));
        all.map(robustness).collect::<Vec<f64>>()
    });
    let best = shares.max_by(|a, b| mean(a).total_cmp(&mean(b))).unwrap_or_default();
    let square =
        mean(&best.iter().map(|share| (share - mean(&best)).powi(2)).collect::<Vec<f64>>());
    Noise {
        cost: cost.max(LEAST_COST_NOISE),
        error: (square / (best.len().max(2) - 1) as f64).sqrt(),
    }
}

/// Returns the relative excess of the median round over the fastest round: the median over all
/// measured times.
fn round_noise(rounds: &[&Seconds]) -> f64 {
    let keys = rounds.first().map(|round| round.keys()).into_iter().flatten();
    let mut excess: Vec<f64> = keys
        .filter_map(|key| {
            let mut values: Vec<f64> =
                rounds.iter().filter_map(|round| round.get(key)).copied().collect();
            values.sort_by(f64::total_cmp);
            let least = values.first().copied().filter(|least| *least > 0.0)?;
            Some(percentile(&values, 50.0) / least - 1.0)
        })
        .collect();
    excess.sort_by(f64::total_cmp);
    percentile(&excess, 50.0)
}
