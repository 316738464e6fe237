//! Measuring the tasks one by one; those of one start share its rollouts.

use crate::{
    effect::{EffectModel, Simulated},
    geometry::Vector,
    plan::{Rollouts, SequenceTree},
    scene::{Situation, Task},
    sim::Simulator,
};

use super::super::store::{Measured, Seconds};
use super::{
    execute::Executions,
    goals::GoalSet,
    record::ToolRecord,
    setup::{ReferenceSetup, STEPS},
    spent::Spent,
    trials::Trials,
};

/// The benchmark: goals, the model that is measured, and what tasks of the last start share.
pub struct ToolBench<'a> {
    setup: ReferenceSetup,
    goals: GoalSet,
    model: &'a dyn EffectModel,
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
    pub predicted: SequenceTree,
    /// The same with the planar engine as effect model, beginnings shared.
    pub planar: SequenceTree,
    /// The same as the planar engine plays them, each whole.
    pub played: SequenceTree,
    /// What was executed so far.
    pub executions: Executions,
    /// What `predicted` took.
    pub spent: Spent,
}

impl<'a> ToolBench<'a> {
    /// Measures `model` on `goals` of `setup`; `seed` is of the random choices.
    pub fn new(
        setup: ReferenceSetup,
        goals: GoalSet,
        model: &'a dyn EffectModel,
        seed: u64,
    ) -> Self {
        Self { setup, goals, model, seed, shared: None }
    }

    /// Number of tasks.
    pub fn tasks(&self) -> usize {
        self.goals.len()
    }

    /// Measures task `index`: every method, for all tool poses together and each alone, on the
    /// current rayon pool. Tasks of one start share its rollouts if they follow each other.
    /// Nothing if there is no such task.
    pub fn measure(&mut self, index: usize) -> Option<Measured<ToolRecord>> {
        let (start, goal) = self.goals.task(index)?;
        let task = self.setup.task(Vector::from(self.goals.starts[start].start), goal);
        let kept = self.shared.take().filter(|shared| shared.start == start);
        let shared = match kept {
            Some(shared) => self.shared.insert(shared),
            None => self.shared.insert(Shared::new(&self.setup, self.model, &task, start)),
        };
        let mut seconds = Seconds::new();
        let mut record = ToolRecord { start, goal: goal.into(), trials: Vec::new() };
        let poses = (0..self.setup.poses.len()).map(Some);
        for pose in std::iter::once(None).chain(poses) {
            let mut trials = Trials::new(&self.setup, self.model, &task, shared, pose);
            let times = pose.is_none().then_some(&mut seconds);
            record.trials.extend(trials.run((self.seed, index as u64), times));
        }
        Some(Measured { record, seconds })
    }
}

impl Shared {
    fn new(setup: &ReferenceSetup, model: &dyn EffectModel, task: &Task, start: usize) -> Self {
        let workspace = setup.workspace(task);
        let free = setup.free_poses(task.scene.objects[task.goal.object].pose.position);
        let grips = setup.grips(&free);
        let mut rollouts = Rollouts::new(model, Situation::stated(&task.scene));
        let (predicted, spent) =
            Spent::on(|| SequenceTree::roll(&workspace, &mut rollouts, &grips, STEPS));
        let planar = Simulated::new(Simulator::planar());
        let mut rollouts = Rollouts::new(&planar, Situation::stated(&task.scene));
        Self {
            start,
            free,
            predicted,
            planar: SequenceTree::roll(&workspace, &mut rollouts, &grips, STEPS),
            played: SequenceTree::roll_whole(&workspace, &mut rollouts, &grips, STEPS),
            executions: Executions::default(),
            spent,
        }
    }
}
