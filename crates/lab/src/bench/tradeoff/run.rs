//! Measurement, unit by unit.

use std::sync::OnceLock;

use pushplan::internals::asset::ToolLibrary;
use pushplan::internals::solve::{Planner, Solution, SolveError};
use pushplan::internals::verify::{Verifier, VerifySettings};
use pushplan::internals::{
    scene::{ModelSpec, Situation},
    task::Task,
};
use pushplan_bench::SolvedTask;
use pushplan_bench::store::{Measured, RunManifest, Seconds};
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use serde::{Deserialize, Serialize};
use serde_json::json;

use super::super::cpu_clock::timed;
use crate::bench::{HeldOut, HeldOutErrors, RandomError, RandomSuite, SuiteKind, TaskKind};

use super::cost::Timed;
use super::levels::{Level, PlanLevel};
use super::measured::{SuiteErrors, TradeOffReport};

/// Held-out pushes on which errors are measured.
const SUITES: [SuiteKind; 2] = [SuiteKind::Single, SuiteKind::Touching];

/// Perturbed replays of the plan of a level in each engine, after the clock has stopped. All levels
/// have the same draws, which differ from those by which the plan was chosen.
const PERTURBED: VerifySettings = VerifySettings { replays: 12, seed: 0xD157 };

/// Key of the time of the level that solves every task a second time.
pub(super) const CONTROL: &str = "control";

/// Size of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TradeOffSettings {
    /// Number of held-out pushes of each kind.
    pub pushes: usize,
    /// Number of timed pushes.
    pub timed: usize,
    /// Number of rounds of timing.
    pub rounds: usize,
    /// Number of tasks.
    pub tasks: usize,
    /// Tolerances of the tasks relative to the tolerances of the suite. Smaller tolerances
    /// require more search.
    pub tolerance: f64,
    /// Seed of pushes and tasks.
    pub seed: u64,
}

/// Record of a unit; its times are stored separately.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Unit {
    /// Errors of a predictor.
    Predictor {
        /// Name of the predictor.
        model: String,
        /// Errors on each kind of pushes.
        suites: Vec<SuiteErrors>,
    },
    /// A round of timing.
    Round,
    /// A task at all levels of planning.
    Task {
        /// Kind of the task.
        kind: TaskKind,
        /// Results in the order of the levels.
        plans: Vec<SolvedTask>,
    },
}

/// A run of the trade-off.
pub struct TradeOff<'a> {
    library: &'a ToolLibrary,
    levels: Vec<Level>,
    plans: Vec<PlanLevel>,
    planners: Vec<Planner>,
    settings: TradeOffSettings,
    single: ThreadPool,
    suite: RandomSuite,
    held_out: OnceLock<Vec<HeldOut>>,
    timed: OnceLock<Timed>,
}

impl<'a> TradeOff<'a> {
    /// Name of the suite in manifests.
    pub const SUITE: &'static str = "tradeoff";

    /// Creates a run over `levels` and `plans`. Plans whose models are not among the levels are
    /// left out.
    ///
    /// # Errors
    /// Returns an error if the timing thread cannot be started.
    pub fn new(
        library: &'a ToolLibrary,
        levels: Vec<Level>,
        plans: Vec<PlanLevel>,
        settings: TradeOffSettings,
    ) -> Result<Self, ThreadPoolBuildError> {
        let model = |spec: &ModelSpec| levels.iter().find(|level| level.spec() == spec);
        let (plans, planners) = plans
            .into_iter()
            .filter_map(|plan| {
                let planner = Planner::builder(model(&plan.model)?.model());
                let planner = planner.settings(plan.settings).build();
                Some((plan, planner))
            })
            .unzip();
        Ok(Self {
            library,
            levels,
            plans,
            planners,
            settings,
            single: ThreadPoolBuilder::new().num_threads(1).build()?,
            suite: RandomSuite::new(library, settings.seed, &[]),
            held_out: OnceLock::new(),
            timed: OnceLock::new(),
        })
    }

    /// Returns the settings that determine the records. `weights` are digests of the networks'
    /// weights.
    pub fn manifest(&self, weights: &[String]) -> RunManifest {
        let units = self.levels.len() + 1 + self.settings.rounds + self.settings.tasks;
        let names: Vec<&str> = self.levels.iter().map(Level::name).collect();
        let settings = json!({
            "weights": weights,
            "levels": names,
            "plans": self.plans,
            "counts": self.settings,
            "tools": self.library.iter().map(|tool| &tool.name).collect::<Vec<_>>(),
        });
        RunManifest::new(Self::SUITE, units, self.settings.seed, "every level")
            .with_settings(settings)
    }

    /// Returns the title of unit `index`.
    pub fn title(&self, index: usize) -> String {
        let rounds = self.levels.len() + 1;
        match index {
            0 => "spread of the ground truth".to_owned(),
            k if k < rounds => format!("errors of {}", self.levels[k - 1].name()),
            k if k < rounds + self.settings.rounds => format!("timing round {}", k - rounds + 1),
            k => format!("task {}", k - rounds - self.settings.rounds + 1),
        }
    }

    /// Measures unit `index`. Errors are computed on the current rayon pool; timed work runs on one
    /// thread.
    ///
    /// # Errors
    /// Returns an error if a task cannot be made with these tools.
    pub fn measure(&self, index: usize) -> Result<Measured<Unit>, RandomError> {
        let rounds = self.levels.len() + 1;
        let tasks = rounds + self.settings.rounds;
        Ok(match index {
            0 => self.errors(|truth| truth.spread()),
            k if k < rounds => self.errors(|truth| truth.evaluate(&self.levels[k - 1].model())),
            k if k < tasks => {
                let timed = self.timed.get_or_init(|| {
                    Timed::draw(self.library, self.settings.seed, self.settings.timed)
                });
                let seconds = self.single.install(|| timed.round(&self.levels));
                Measured { record: Unit::Round, seconds }
            }
            k => {
                let mut made = self.suite.task(k - tasks)?;
                let tolerance = self.settings.tolerance * made.task.goals[0].tolerance();
                made.task.goals[0].set_tolerance(tolerance);
                self.task(made.kind, &made.task)?
            }
        })
    }

    /// Returns the numbers of a finished run.
    pub fn report(&self, units: &[(Unit, Seconds)]) -> TradeOffReport {
        TradeOffReport::of(self.settings, &self.levels, &self.plans, units)
    }

    fn errors(&self, evaluate: impl Fn(&HeldOut) -> HeldOutErrors) -> Measured<Unit> {
        let held_out = self.held_out.get_or_init(|| {
            let TradeOffSettings { seed, pushes, .. } = self.settings;
            SUITES.map(|kind| HeldOut::prepare(kind, self.library, seed, pushes)).into()
        });
        let mut model = String::new();
        let mut suites = Vec::new();
        for (kind, truth) in SUITES.into_iter().zip(held_out) {
            let errors = evaluate(truth);
            let all = errors.rows.into_iter().find(|row| row.group == "all");
            suites.extend(all.map(|row| SuiteErrors {
                suite: kind,
                position: row.position,
                position_3d: row.position_3d,
                failed: row.failed,
            }));
            model = errors.model;
        }
        Measured { record: Unit::Predictor { model, suites }, seconds: Seconds::new() }
    }

    fn task(&self, kind: TaskKind, task: &Task) -> Result<Measured<Unit>, SolveError> {
        let mut seconds = Seconds::new();
        let mut solve = |planner: &Planner, name: &str| -> Result<Solution, SolveError> {
            let (solution, spent) =
                self.single.install(|| timed(|| planner.solve(task, self.library)));
            let solution = solution?;
            let timing = &solution.statistics.timing;
            let share = timing.verification / timing.total.max(f64::MIN_POSITIVE);
            seconds.insert(name.to_owned(), spent.as_secs_f64());
            seconds.insert(verification_key(name), spent.as_secs_f64() * share);
            Ok(solution)
        };
        let mut plans = Vec::new();
        for (plan, planner) in self.plans.iter().zip(&self.planners) {
            let mut solution = solve(planner, &plan.name)?;
            replay(task, &mut solution);
            plans.push(SolvedTask::of(task, &solution));
        }
        if let Some(planner) = self.planners.first() {
            solve(planner, CONTROL)?;
        }
        Ok(Measured { record: Unit::Task { kind, plans }, seconds })
    }
}

/// Replays the selected plan, verified or not, nominally and perturbed.
fn replay(task: &Task, solution: &mut Solution) {
    let situation = Situation::stated(&task.scene);
    if let Some(best) = solution.plans.first_mut() {
        let verifier = Verifier::new(PERTURBED);
        best.verdict = Some(verifier.verify(task, &situation, &best.tools, &best.plan));
    }
}

/// Returns the key of the time of a level's replays.
pub(super) fn verification_key(level: &str) -> String {
    format!("{level}, verification")
}
