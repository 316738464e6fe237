//! Measurement of a random task: the planner's plan, doing nothing and a random choice.

use pushplan::internals::asset::ToolLibrary;
use pushplan::internals::geometry::Pose;
use pushplan::internals::seeded::generator;
use pushplan::internals::solve::{Planner, SolveError};
use pushplan::internals::verify::{Verifier, VerifySettings};
use pushplan::internals::{
    outcome::{Outcome, Trajectory},
    scene::{Engine, ModelKind, Situation},
};
use pushplan_bench::store::Measured;
use pushplan_bench::{End, SolvedTask};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::kind::TaskKind;
use super::making::random_plan;
use super::suite::{NoTask, RandomSuite, SuiteTask};

/// The result of a random task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RandomRecord {
    /// Kind of the task.
    pub kind: TaskKind,
    /// Plan behind the goal; `None` for an unsolvable task.
    pub maker: Option<Maker>,
    /// Result of the planner.
    pub solved: SolvedTask,
    /// Final pose of the object if nothing is done.
    pub nothing: End,
    /// Random plan of one push; `None` if no push is feasible.
    pub random: Option<Choice>,
}

/// Summary of the plan behind a goal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Maker {
    /// Name of its tool.
    pub tool: String,
    /// Number of its pushes.
    pub pushes: usize,
}

/// A random plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    /// Name of its tool.
    pub tool: String,
    /// Outcome in the 2-D engine.
    pub planar: End,
    /// Outcome in the 3-D engine.
    pub spatial: End,
}

/// Error of a random task that could not be measured.
#[derive(Debug, Error)]
pub enum RandomError {
    /// No task could be made.
    #[error(transparent)]
    NoTask(#[from] NoTask),
    /// The planner refuses the task.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

impl RandomSuite {
    /// Solves task `index` with `planner` and the tools of `library`, which are the tools of the
    /// suite. The times are the planner's alone.
    ///
    /// # Errors
    /// Returns an error if the task cannot be made or the planner refuses it.
    pub fn measure(
        &self,
        planner: &Planner,
        library: &ToolLibrary,
        index: usize,
    ) -> Result<Measured<RandomRecord>, RandomError> {
        let made = self.task(index)?;
        let solution = planner.solve(&made.task, library)?;
        let maker = made.made.as_ref();
        let maker = maker
            .map(|(plan, _)| Maker { tool: plan.tool().to_owned(), pushes: plan.pushes().len() });
        let record = RandomRecord {
            kind: made.kind,
            maker,
            solved: SolvedTask::of(&made.task, &solution),
            nothing: nothing(&made),
            random: self.random_choice(&made, index),
        };
        Ok(Measured { record, seconds: SolvedTask::seconds(&solution) })
    }

    fn random_choice(&self, made: &SuiteTask, index: usize) -> Option<Choice> {
        let mut rng = generator(self.seed() ^ 0xC401CE, index as u64);
        let tools = self.tools_for(&made.task);
        let plan = random_plan(&mut rng, &made.task, &tools)?;
        let tool = tools.iter().find(|tool| tool.name == plan.tool())?;
        let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
        let verdict = verifier.nominal(
            &made.task,
            &Situation::stated(&made.task.scene),
            std::slice::from_ref(tool),
            &plan,
        );
        let end =
            |engine: Engine| verdict.nominal(engine).map(|evidence| End::of(&evidence.outcome));
        Some(Choice {
            tool: plan.tool().to_owned(),
            planar: end(Engine::Planar)?,
            spatial: end(Engine::Spatial)?,
        })
    }
}

fn nothing(made: &SuiteTask) -> End {
    let state = made.task.scene.start();
    let trajectory = Trajectory::standing(ModelKind::Still.into(), Pose::default(), state);
    End::of(&Outcome::judge(&made.task.scene, &made.task, &trajectory))
}
