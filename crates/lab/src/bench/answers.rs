//! Answers to 20 fixed tasks and pushes: numbers that change when the program answers otherwise.

use pushplan::internals::asset::{Faults, ToolLibrary};
use pushplan::internals::effect::{EffectModel, EffectModels, ModelError, Prior};
use pushplan::internals::outcome::Record;
use pushplan::internals::scene::{Engine, ModelKind, Rate};
use pushplan::internals::solve::{Effort, Planner, Settings, Solution, SolveError};
use pushplan::internals::task::{Job, Task};
use pushplan_act::belief::{BeliefRegulator, RegulatorError};
use pushplan_learn::dataset::JointRule;
use thiserror::Error;

use super::belief::{BeliefSuite, Sighting};
use super::crowd::CrowdFamily;
use super::suite::{Case, Suite, SuiteKind, crowd_cases};

/// Seed of the pushes and observations.
const SEED: u64 = 20;

/// Pushes by kind; two more move the hand into a crowd with joints.
const PUSHES: [(SuiteKind, usize); 3] =
    [(SuiteKind::Single, 4), (SuiteKind::SingleAnySpeed, 2), (SuiteKind::Touching, 2)];

/// Number of objects in a crowd.
const CROWD: usize = 6;

/// Shipped tasks of pushes: near walls, to a heading, with a joint, with two tools, without a plan.
const TASKS: [&str; 6] =
    ["pull-back-behind-wall", "narrow-gap", "turn-the-box", "drawer", "two-tools", "boxed-in"];

/// Shipped tasks of levering.
const LEVER_TASKS: [&str; 2] = ["flip-plate", "drive-board"];

/// Number of observed crowds.
const OBSERVED: usize = 2;

/// Answers to ten pushes, six tasks, two tasks of levering and two observed crowds.
#[derive(Clone, Debug, PartialEq)]
pub struct Answers {
    /// Final positions (metres) and headings (radians) of all objects by four models.
    pub predictions: Vec<f64>,
    /// Status, rollouts, plan and replays of every task.
    pub plans: Vec<f64>,
    /// Status, rollouts, plan and replays of every task of levering.
    pub lever_ups: Vec<f64>,
    /// Probabilities of joint types by the filter and the regulator.
    pub beliefs: Vec<f64>,
}

/// A question that could not be answered.
#[derive(Debug, Error)]
pub enum AnswerError {
    /// A shipped task or tool is wrong.
    #[error("{0}")]
    File(#[from] Faults),
    /// A model cannot be built.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A task is refused.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The regulator cannot be built.
    #[error(transparent)]
    Regulator(#[from] RegulatorError),
}

impl Answers {
    /// Answers all questions; `draft` are the budgets of the planner.
    ///
    /// # Errors
    /// Shipped files or weights that cannot be read.
    pub fn of(draft: Settings) -> Result<Self, AnswerError> {
        let library = ToolLibrary::embedded()?;
        let planner = Planner::for_effort(Effort::Draft)?.settings(draft).build();
        Ok(Self {
            predictions: predictions(&library)?,
            plans: plans(&planner, &library, &TASKS)?,
            lever_ups: plans(&planner, &library, &LEVER_TASKS)?,
            beliefs: beliefs()?,
        })
    }
}

/// Final poses of the fixed pushes by network, analytic model and both engines.
fn predictions(library: &ToolLibrary) -> Result<Vec<f64>, ModelError> {
    let drawn = PUSHES.map(|(kind, count)| Suite::draw(kind, library, SEED, count).cases);
    let cases: Vec<Case> = drawn.into_iter().flatten().chain(crowd_cases(CROWD, SEED, 2)).collect();
    let spatial = ModelKind::Simulated { engine: Engine::Spatial, rate: Rate::DEFAULT };
    let mut numbers = Vec::new();
    for kind in [ModelKind::NETWORK, ModelKind::PRIOR, ModelKind::PLANAR, spatial] {
        let model = EffectModels::build(&kind.into())?;
        for Case { scene, motion } in &cases {
            let jobs = [Job::stated(scene, motion.clone())];
            let ends = model.rollout(scene, &jobs, Record::Outcome);
            let poses = ends.iter().flat_map(|end| &end.outcome().poses);
            numbers.extend(poses.flat_map(|pose| [pose.position.x, pose.position.y, pose.heading]));
        }
    }
    Ok(numbers)
}

/// Solutions of shipped tasks.
fn plans(
    planner: &Planner,
    library: &ToolLibrary,
    names: &[&str],
) -> Result<Vec<f64>, AnswerError> {
    let mut numbers = Vec::new();
    for name in names {
        numbers.extend(solution(&planner.solve(&Task::example(name)?, library)?));
    }
    Ok(numbers)
}

/// Status, rollouts, number of steps, predicted error, and end of every replay of the best plan.
fn solution(solution: &Solution) -> Vec<f64> {
    let mut numbers = vec![f64::from(solution.status as u8), solution.statistics.rollouts as f64];
    let Some(best) = solution.best() else { return numbers };
    numbers.extend([best.plan.steps.len() as f64, best.outcome.error()]);
    let replays = best.verdict.iter().flat_map(|verdict| &verdict.evidence);
    numbers.extend(
        replays.flat_map(|replay| {
            [replay.outcome.error(), f64::from(u8::from(replay.outcome.reached))]
        }),
    );
    numbers
}

/// Probabilities of joint types along two observed crowds.
fn beliefs() -> Result<Vec<f64>, AnswerError> {
    let regulator = BeliefRegulator::shipped()?;
    let sets = (&[CrowdFamily::Dense][..], &[CROWD][..], JointRule::Mixed);
    let suite = BeliefSuite::new(sets, &[Sighting::Fine], SEED, (Some(regulator), false));
    let model: &dyn EffectModel = &Prior::default();
    let records = (0..OBSERVED).map(|index| suite.measure(model, index).record);
    let checkpoints = records.flat_map(|record| record.checkpoints);
    let types = checkpoints.flat_map(|checkpoint| checkpoint.probabilities);
    Ok(types.flat_map(|(_, pairs)| pairs).flatten().collect())
}
