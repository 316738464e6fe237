//! Problem to solve, which is constant during the solution.

use std::sync::Arc;

use crate::plan::{RefineSettings, Search, Workspace};
use crate::progress::Progress;
use crate::scene::{Situation, Tool};
use crate::task::{Goal, Job, Task};

use super::aims::first_aims;
use super::planner::Planner;
use super::settings::Settings;
use super::typical::{error_p95, typical};

/// Maximum room of later pushes for the model's error, metres: a longer approach costs reach and
/// time.
const MOST_ROOM_FOR_MODEL: f64 = 0.02;

/// Maximum number of rollouts of a refinement times the number of objects on the table. A push into
/// a crowd costs up to a hundred times a push of a single object, and late rounds gain little
/// because its outcome is not smooth. With up to four objects, the limit on rounds applies first.
const REFINE_WORK: usize = 20_000;

/// Number of pushes above which a plan is not refined as a whole. Such plans follow legs, so that
/// their pushes have been refined or corrected one by one. A round would cost hundreds of long
/// rollouts.
const LONG: usize = 10;

/// Task in a situation, with its planner and progress observer.
#[derive(Clone, Copy)]
pub(super) struct Query<'a> {
    pub planner: &'a Planner,
    pub task: &'a Task,
    pub situation: &'a Situation,
    /// Allowed tools: for pushing, or with blades in a task of levering.
    pub tools: &'a [Arc<Tool>],
    pub progress: &'a dyn Progress,
    /// Budgets of the planner or of its first attempt.
    pub settings: Settings,
}

impl<'a> Query<'a> {
    /// Returns the limits for pushes.
    pub fn workspace(&self) -> Workspace<'a> {
        Workspace { task: self.task, tools: self.tools }
    }

    /// Returns the first aims of refinement for the task's goals.
    pub fn goals(&self) -> Vec<Goal> {
        first_aims(self.task)
    }

    /// Returns the number of plans that are verified together.
    pub fn at_once(&self) -> usize {
        self.settings.at_once(self.situation.scene.objects.len())
    }

    /// Returns the maximum number of rollouts of one refinement.
    pub fn refine_rollouts(&self) -> usize {
        REFINE_WORK / self.situation.scene.objects.len().max(1)
    }

    /// Returns the settings with which candidates of `pushes` pushes are refined.
    pub fn refine_settings(&self, pushes: usize) -> RefineSettings {
        let settings = &self.settings;
        RefineSettings {
            rounds: if pushes > LONG { 0 } else { settings.refine_rounds },
            extra: settings.refine_extra,
            // Each number of pushes has its own random stream, so that samples are not shared.
            seed: self.planner.seed().wrapping_mul(0x9E37_79B9).wrapping_add(pushes as u64) << 16,
            enough: self.at_once(),
            rollouts: self.refine_rollouts(),
        }
    }

    /// Prepares the search for plans with one grip, without any rollout.
    pub fn search(&self) -> Search<'a> {
        let errors = self.tools.iter().map(|tool| {
            let start = &self.situation.start;
            let job = Job::new(self.situation, typical(self.task, start, tool));
            error_p95(self.planner.model(), self.situation, &job).unwrap_or(f64::INFINITY)
        });
        let error = errors.fold(0.0, f64::max).min(MOST_ROOM_FOR_MODEL);
        let settings = self.settings.search(error);
        Search::new(self.workspace(), self.situation, settings)
    }
}
