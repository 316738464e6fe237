//! Measuring, unit by unit.

use std::sync::OnceLock;

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use serde::{Deserialize, Serialize};
use serde_json::json;

use crate::{
    asset::ToolLibrary,
    bench::{
        HeldOut, HeldOutErrors, Measured, RunManifest, Seconds, SuiteKind,
        cpu_clock::processor_time, random::random_task,
    },
    scene::{Engine, Outcome, Task},
    solve::{Planner, Solution},
    verify::{Verifier, VerifySettings},
};

use super::{
    cost::Timed,
    levels::{Level, PlanLevel},
    measured::{SuiteErrors, TradeOffReport},
};

/// Held-out pushes on which errors are measured.
const SUITES: [SuiteKind; 2] = [SuiteKind::Single, SuiteKind::Touching];

/// Name of the time of the level that every task is solved with a second time.
pub(super) const CONTROL: &str = "control";

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TradeOffSettings {
    /// Held-out pushes of each kind.
    pub pushes: usize,
    /// Pushes that are timed.
    pub timed: usize,
    /// Rounds of timing.
    pub rounds: usize,
    /// Tasks solved.
    pub tasks: usize,
    /// Seed of all of them.
    pub seed: u64,
}

/// What is kept of a unit; its times stand beside it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Unit {
    /// Errors of one predictor.
    Predictor {
        /// Its name.
        model: String,
        /// Of each kind of pushes.
        suites: Vec<SuiteErrors>,
    },
    /// A round of timing.
    Round,
    /// A task at all levels of planning.
    Task {
        /// Its name.
        task: String,
        /// In the order of the levels.
        plans: Vec<PlanOutcome>,
    },
}

/// How one task ended at one level.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanOutcome {
    /// Final error as the effect model predicts it, metres; nothing without a plan.
    pub predicted: Option<f64>,
    /// Final error in the planar engine, metres.
    pub planar: Option<f64>,
    /// Final error in the 3-D engine, metres.
    pub spatial: Option<f64>,
    /// Whether the goal is reached: predicted, planar, 3-D.
    pub reached: [bool; 3],
    /// Rollouts of the effect model.
    pub rollouts: usize,
    /// Plans verified on the way.
    pub verified: usize,
}

/// A run of the trade-off.
pub struct TradeOff<'a> {
    library: &'a ToolLibrary,
    levels: Vec<Level>,
    plans: Vec<PlanLevel>,
    planners: Vec<Planner>,
    settings: TradeOffSettings,
    single: ThreadPool,
    held_out: OnceLock<Vec<HeldOut>>,
    timed: OnceLock<Timed>,
}

impl<'a> TradeOff<'a> {
    /// A run over `levels` and `plans`, whose models are among them; those of others are left
    /// out.
    ///
    /// # Errors
    /// If the one thread that is timed cannot be started.
    pub fn new(
        library: &'a ToolLibrary,
        levels: Vec<Level>,
        plans: Vec<PlanLevel>,
        settings: TradeOffSettings,
    ) -> Result<Self, ThreadPoolBuildError> {
        let model = |name: &str| levels.iter().find(|level| level.name() == name);
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
            held_out: OnceLock::new(),
            timed: OnceLock::new(),
        })
    }

    /// What decides the records. `weights` are digests of the networks' weights.
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
        RunManifest::new("tradeoff", units, self.settings.seed, "every level")
            .with_settings(settings)
    }

    /// What unit `index` is, in words.
    pub fn title(&self, index: usize) -> String {
        let rounds = self.levels.len() + 1;
        match index {
            0 => "the truth's own spread".to_owned(),
            k if k < rounds => format!("errors of {}", self.levels[k - 1].name()),
            k if k < rounds + self.settings.rounds => format!("round {} of timing", k - rounds + 1),
            k => format!("task {}", k - rounds - self.settings.rounds + 1),
        }
    }

    /// Measures unit `index`. Errors are computed on the current rayon pool; what is timed runs
    /// on one thread.
    pub fn measure(&self, index: usize) -> Measured<Unit> {
        let rounds = self.levels.len() + 1;
        let tasks = rounds + self.settings.rounds;
        match index {
            0 => self.errors(|truth| truth.spread()),
            k if k < rounds => self.errors(|truth| truth.evaluate(&self.levels[k - 1].model())),
            k if k < tasks => {
                let timed = self.timed.get_or_init(|| {
                    Timed::draw(self.library, self.settings.seed, self.settings.timed)
                });
                let seconds = self.single.install(|| timed.round(&self.levels));
                Measured { record: Unit::Round, seconds }
            }
            k => self.task(&random_task(self.library, self.settings.seed, k - tasks)),
        }
    }

    /// The numbers of a finished run.
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

    fn task(&self, task: &Task) -> Measured<Unit> {
        let mut seconds = Seconds::new();
        let mut solve = |planner: &Planner, name: &str| {
            let mut solution = None;
            let spent = self
                .single
                .install(|| processor_time(|| solution = planner.solve(task, self.library).ok()));
            seconds.insert(name.to_owned(), spent.as_secs_f64());
            solution
        };
        let plans = self.plans.iter().zip(&self.planners);
        let plans =
            plans.map(|(plan, planner)| judge(task, solve(planner, &plan.name).as_ref())).collect();
        if let Some(planner) = self.planners.first() {
            solve(planner, CONTROL);
        }
        Measured { record: Unit::Task { task: task.name.clone(), plans }, seconds }
    }
}

/// How the first plan of a solution ends, replayed in both engines.
fn judge(task: &Task, solution: Option<&Solution>) -> PlanOutcome {
    let best = solution.and_then(Solution::best);
    let verdict = best.map(|best| {
        let verifier = Verifier::new(VerifySettings { disturbed: 0, seed: 0 });
        verifier.nominal(task, &best.tool, &best.plan)
    });
    let replayed = |engine: Engine| {
        let evidence = verdict.iter().flat_map(|verdict| &verdict.evidence);
        evidence.into_iter().find(|one| one.engine == engine).map(|one| &one.outcome)
    };
    let outcomes: [Option<&Outcome>; 3] =
        [best.map(|best| &best.outcome), replayed(Engine::Planar), replayed(Engine::Spatial)];
    let [predicted, planar, spatial] = outcomes.map(|outcome| {
        let error = outcome.map(|outcome| outcome.error);
        error.filter(|error| error.is_finite())
    });
    PlanOutcome {
        predicted,
        planar,
        spatial,
        reached: outcomes.map(|outcome| outcome.is_some_and(|outcome| outcome.reached)),
        rollouts: solution.map_or(0, |solution| solution.statistics.rollouts),
        verified: solution.map_or(0, |solution| solution.statistics.verified),
    }
}
