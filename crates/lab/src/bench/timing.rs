//! Cost of a push: predicted, simulated in 2-D and in 3-D, and in a search of one-push candidates.
//! A single run measures all of them, so that the ratios are comparable.

use std::sync::Arc;

use pushplan::internals::asset::ToolLibrary;
use pushplan::internals::effect::{EffectModel, Job, Simulated};
use pushplan::internals::sim::Simulator;
use pushplan::internals::solve::{Planner, Settings, SolveError};
use pushplan::internals::{outcome::Record, scene::Scene, task::Task};
use serde::{Deserialize, Serialize};

use super::cpu_clock::processor_time;
use super::suite::{Case, Suite};

/// Number of times that a search is timed. The shortest counts, because other work on the machine
/// can only lengthen it.
const REPEATS: usize = 5;

/// Minimum processor time of repeated pushes, seconds; the kernel may count in ticks of 4 ms.
const ENOUGH: f64 = 0.25;

/// Processor time of a push.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PushCost {
    /// Name of the model.
    pub model: String,
    /// Number of jobs per rollout call.
    pub batch: usize,
    /// Processor time per push, seconds.
    pub seconds: f64,
    /// Processor time per frame of a push, seconds.
    pub seconds_per_frame: f64,
}

/// Cost of a search of one-push candidates on the current rayon pool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SearchCost {
    /// Name of the model.
    pub model: String,
    /// Name of the task.
    pub task: String,
    /// Number of threads of the pool.
    pub threads: usize,
    /// Number of rollouts.
    pub rollouts: usize,
    /// Wall-clock time, seconds.
    pub seconds: f64,
}

/// Times pushes of `suite` on one thread: `model` with `batch` jobs per call on the same scene and
/// one per call, then both engines.
///
/// The jobs of a batch are copies of one push. No model takes advantage of that, so their time is
/// the cost of a candidate in a search.
///
/// # Errors
/// Returns an error if the thread cannot be started.
pub fn push_costs(
    model: &dyn EffectModel,
    suite: &Suite,
    batch: usize,
) -> Result<Vec<PushCost>, rayon::ThreadPoolBuildError> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let (planar, spatial) =
        (Simulated::new(Simulator::planar()), Simulated::new(Simulator::spatial()));
    let runs: [(&dyn EffectModel, usize); 4] =
        [(model, batch.max(1)), (model, 1), (&planar, 1), (&spatial, 1)];
    Ok(pool.install(|| runs.into_iter().map(|(m, batch)| push_cost(m, suite, batch)).collect()))
}

fn push_cost(model: &dyn EffectModel, suite: &Suite, batch: usize) -> PushCost {
    let seconds = push_seconds(model, &suite.cases, batch, ENOUGH);
    let strokes = suite.cases.iter().flat_map(|case| &case.motion.strokes);
    let frames = strokes.map(|stroke| stroke.frames()).sum::<usize>();
    let pushes = suite.cases.len();
    PushCost {
        model: model.spec().to_string(),
        batch,
        seconds,
        seconds_per_frame: seconds * pushes as f64 / frames.max(1) as f64,
    }
}

/// Returns the processor time of a push on this thread, seconds: the mean over `cases`, with
/// `batch` copies of a push per call, all repeated for at least `enough` seconds.
pub(super) fn push_seconds(
    model: &dyn EffectModel,
    cases: &[Case],
    batch: usize,
    enough: f64,
) -> f64 {
    let work = batches(cases, batch);
    let (mut seconds, mut runs) = (0.0, 0u32);
    // Bounded in case the clock stands still.
    while seconds < enough && runs < 10_000 && !work.is_empty() {
        runs += 1;
        seconds += processor_time(|| {
            for (scene, jobs) in &work {
                std::hint::black_box(model.rollout(scene, jobs, Record::Outcome));
            }
        })
        .as_secs_f64();
    }
    seconds / f64::from(runs.max(1)) / (work.len() * batch).max(1) as f64
}

/// Returns every push `batch` times, with its scene.
pub(super) fn batches(cases: &[Case], batch: usize) -> Vec<(&Scene, Vec<Job>)> {
    let repeated = |case: &'_ Case| {
        let motion = case.motion.clone();
        vec![Job::stated(&case.scene, motion); batch]
    };
    cases.iter().map(|case| (&case.scene, repeated(case))).collect()
}

/// Times the planner's search of at most `candidates` one-push candidates for `task` with each
/// model, one after another on the current rayon pool.
///
/// # Errors
/// Returns the error of a planner that refuses the task.
pub fn search_costs(
    models: &[Arc<dyn EffectModel>],
    task: &Task,
    library: &ToolLibrary,
    offsets: usize,
    candidates: usize,
) -> Result<Vec<SearchCost>, SolveError> {
    let settings = Settings {
        levers: pushplan::internals::solve::LeverSettings::STANDARD,
        offsets,
        beam: 1,
        search_rollouts: candidates,
        refined: 1,
        refine_rounds: 0,
        refine_extra: 0,
        verified_at_once: 1,
        verify_batches: 1,
        replays: 0,
    };
    let mut task = task.clone();
    task.pushes.max_count = 1;
    let cost = |model: &Arc<dyn EffectModel>| {
        let planner = Planner::builder(Arc::clone(model)).settings(settings).build();
        let solved = (0..REPEATS).map(|_| Ok(planner.solve(&task, library)?.statistics));
        let solved = solved.collect::<Result<Vec<_>, SolveError>>()?;
        let seconds = solved.iter().map(|statistics| statistics.timing.search);
        Ok(SearchCost {
            model: model.spec().to_string(),
            task: task.name.clone(),
            threads: rayon::current_num_threads(),
            rollouts: solved.first().map_or(0, |statistics| statistics.search.rollouts),
            seconds: seconds.fold(f64::INFINITY, f64::min),
        })
    };
    models.iter().map(cost).collect()
}
