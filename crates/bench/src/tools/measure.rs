//! Sequential measurement of the tasks; tasks of one start share its rollouts.

use std::sync::Arc;

use thiserror::Error;

use crate::store::{Measured, Seconds};
use pushplan::{
    effect::{EffectModel, Simulated},
    geometry::Vector,
    sim::Simulator,
    solve::{Planner, SolveError},
    task::Task,
};

use super::{
    execute::Executions,
    goals::GoalSet,
    record::ToolRecord,
    sequences::{Rolling, Sequences},
    setup::{ReferenceSetup, STEPS},
    spent::Spent,
    trials::Trials,
};

/// Error of measuring a task.
#[derive(Debug, Error)]
pub enum ToolBenchError {
    /// Index without a task.
    #[error("no task has the index {index}")]
    NoTask {
        /// Index of the task.
        index: usize,
    },
    /// Error of the planner.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

/// Benchmark state: goals, measured model, and shared data of the last start.
pub struct ToolBench {
    setup: ReferenceSetup,
    goals: GoalSet,
    model: Arc<dyn EffectModel>,
    planner: Planner,
    seed: u64,
    shared: Option<Shared>,
}

/// Data shared by the tasks of one start.
pub(super) struct Shared {
    /// Index of the start.
    start: usize,
    /// Indices of the poses that can be set down.
    pub free: Vec<usize>,
    /// Sequences predicted by the model.
    pub predicted: Sequences,
    /// Sequences predicted by the 2-D engine as effect model, with shared beginnings.
    pub planar: Sequences,
    /// Sequences executed in the 2-D engine, each from its beginning.
    pub played: Sequences,
    /// Results of executed actions.
    pub executions: Executions,
    /// Time spent on `predicted`.
    pub spent: Spent,
}

impl ToolBench {
    /// Returns a benchmark of `model` on `goals` of `setup` by the protocol of the reference, and
    /// of `planner`; `seed` determines the random choices.
    pub fn new(
        setup: ReferenceSetup,
        goals: GoalSet,
        model: Arc<dyn EffectModel>,
        planner: Planner,
        seed: u64,
    ) -> Self {
        Self { setup, goals, model, planner, seed, shared: None }
    }

    /// Returns the number of tasks.
    pub fn tasks(&self) -> usize {
        self.goals.len()
    }

    /// Measures task `index` on the current rayon pool: every method, for all tool poses together
    /// and each alone. Consecutive tasks of one start share its rollouts.
    ///
    /// # Errors
    /// Returns errors of the planner, and an error for an index without a task.
    pub fn measure(&mut self, index: usize) -> Result<Measured<ToolRecord>, ToolBenchError> {
        let (start, goal) = self.goals.task(index).ok_or(ToolBenchError::NoTask { index })?;
        let task = self.setup.task(Vector::from(self.goals.starts[start].start), goal);
        let kept = self.shared.take().filter(|shared| shared.start == start);
        let shared = match kept {
            Some(shared) => self.shared.insert(shared),
            None => self.shared.insert(Shared::new(&self.setup, &*self.model, &task, start)),
        };
        let mut seconds = Seconds::new();
        let mut record = ToolRecord { start, goal: goal.into(), trials: Vec::new() };
        let poses = (0..self.setup.poses.len()).map(Some);
        for pose in std::iter::once(None).chain(poses) {
            let choosers = (&*self.model, &self.planner);
            let mut trials = Trials::new(&self.setup, choosers, &task, shared, pose);
            let times = pose.is_none().then_some(&mut seconds);
            record.trials.extend(trials.run((self.seed, index as u64), times)?);
        }
        Ok(Measured { record, seconds })
    }
}

impl Shared {
    fn new(setup: &ReferenceSetup, model: &dyn EffectModel, task: &Task, start: usize) -> Self {
        let free = setup.free_poses(task.scene.objects[task.goals[0].object].pose.position);
        let planar = Simulated::new(Simulator::planar());
        let rolling = Rolling { setup, task, model, poses: &free, steps: STEPS };
        let (predicted, spent) = Spent::on(|| rolling.shared());
        let rolling = Rolling { model: &planar, ..rolling };
        let (planar, played) = (rolling.shared(), rolling.whole());
        let executions = Executions::default();
        Self { start, predicted, planar, played, executions, spent, free }
    }
}
