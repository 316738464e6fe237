//! Measuring the tasks one by one; those of one start share its rollouts.

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

/// Why a task was not measured.
#[derive(Debug, Error)]
pub enum ToolBenchError {
    /// There is no such task.
    #[error("there is no task {index}")]
    NoTask {
        /// Its index.
        index: usize,
    },
    /// The planner refuses it.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

/// The benchmark: goals, the model that is measured, and what tasks of the last start share.
pub struct ToolBench {
    setup: ReferenceSetup,
    goals: GoalSet,
    model: Arc<dyn EffectModel>,
    planner: Planner,
    seed: u64,
    shared: Option<Shared>,
}

/// What the tasks of one start share.
pub(super) struct Shared {
    /// Index of the start.
    start: usize,
    /// Indices of the poses that can be set down.
    pub free: Vec<usize>,
    /// All sequences as the model predicts them.
    pub predicted: Sequences,
    /// The same with the planar engine as effect model, beginnings shared.
    pub planar: Sequences,
    /// The same as the planar engine plays them, each whole.
    pub played: Sequences,
    /// What was executed so far.
    pub executions: Executions,
    /// What `predicted` took.
    pub spent: Spent,
}

impl ToolBench {
    /// Measures `model` on `goals` of `setup` by the protocol of the reference, and `planner` as
    /// well; `seed` is that of the random choices.
    pub fn new(
        setup: ReferenceSetup,
        goals: GoalSet,
        model: Arc<dyn EffectModel>,
        planner: Planner,
        seed: u64,
    ) -> Self {
        Self { setup, goals, model, planner, seed, shared: None }
    }

    /// Number of tasks.
    pub fn tasks(&self) -> usize {
        self.goals.len()
    }

    /// Measures task `index`: every method, for all tool poses together and each alone, on the
    /// current rayon pool. Tasks of one start share its rollouts if they follow each other.
    ///
    /// # Errors
    /// What the planner refuses; an index without a task.
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
