//! Lever-ups with pushes that follow: the plate is levered to where it lies on the table, as the goal
//! asks for, and pushed to its place from there.

use std::sync::Arc;
use std::time::Instant;

use crate::asset::ToolLibrary;
use crate::scene::{FollowUp, Goal, LeverJob, LeverPlan, LeverScene, Task};
use crate::sim::LeverSimulator;
use crate::solve::{Planner, SolveError};
use crate::verify::{LeverVerifier, VerifySettings};
use crate::watch::{Until, Watch};

use super::planner::{rank, status};
use super::{LeverPlanner, LeverSolution, PushedAfter, RankedLever};

/// Between two frames that nobody looks at, seconds: only the rest counts.
const FRAME: f64 = 1.0;

impl LeverPlanner {
    /// Solves `task`, of which `alone` are lever-ups that do not reach the goal by themselves, with
    /// pushes that follow one.
    ///
    /// # Errors
    /// [`SolveError`] for bad input only.
    pub(super) fn with_follow_up(
        &self,
        task: &Task,
        library: &ToolLibrary,
        alone: LeverSolution,
        until: &Until,
    ) -> Result<LeverSolution, SolveError> {
        let pusher = Planner::for_effort(self.effort)?.seed(self.seed).build();
        // The place is left to the pushes.
        let goal = Goal { tolerance: f64::INFINITY, ..task.goal };
        let lifted = Task { goal, ..task.clone() };
        let tools = task.blades(library)?;
        let mut solution = self.lever_up(&lifted, &tools, until);
        let began = Instant::now();
        until.stage("pushing");
        let mut plans = Vec::new();
        let left = |ranked: &RankedLever| Some((ranked.clone(), left(task, library, ranked)?));
        let to_follow = solution.plans.iter().filter_map(left).take(self.settings.followed);
        for (ranked, left) in to_follow {
            if until.cancelled() {
                break;
            }
            solution.statistics.followed += 1;
            let pushed = pusher.solve_with(&left, library, until)?;
            let pushed = Arc::new(PushedAfter { task: left, solution: pushed });
            if let Some(whole) = self.followed(task, &ranked, pushed, until) {
                let passed = whole.verdict.as_ref().is_some_and(|verdict| verdict.passed);
                plans.push(whole);
                if passed {
                    break;
                }
            }
        }
        // What a lever-up alone comes to is the nearest where no push helps.
        plans.extend(alone.plans);
        rank(&mut plans);
        let statistics = &mut solution.statistics;
        statistics.verified += alone.statistics.verified;
        statistics.simulated += alone.statistics.simulated;
        let (own, first) = (&mut statistics.timing, alone.statistics.timing);
        own.search += first.search;
        own.simulation += first.simulation;
        own.verification += first.verification;
        own.pushes = began.elapsed().as_secs_f64();
        own.total += first.total + own.pushes;
        Ok(LeverSolution { status: status(&plans), stopped: until.cancelled(), plans, ..solution })
    }

    /// The lever-up with the pushes that were found, verified as a whole; nothing if none were.
    fn followed(
        &self,
        task: &Task,
        ranked: &RankedLever,
        pushed: Arc<PushedAfter>,
        watch: &dyn Watch,
    ) -> Option<RankedLever> {
        let best = pushed.solution.best()?;
        let follow_up = FollowUp { tool: Arc::clone(&best.tool), plan: best.plan.clone() };
        let motion = follow_up.motion();
        let plan = LeverPlan { follow_up: Some(follow_up), ..ranked.plan.clone() };
        let job = LeverJob {
            scene: Arc::new(LeverScene::with(&task.scene, &ranked.tool)),
            lever: ranked.plan.lever,
        };
        let trajectory = LeverSimulator::COARSE.run_with(&job, &job.scene, Some(&motion));
        let predicted = task.goal.judge_lever(&job.scene, &job.lever, &trajectory);
        let settings = VerifySettings { disturbed: self.settings.disturbed, seed: self.seed };
        let verifier = LeverVerifier::new(settings).watched(watch);
        let nominal = verifier.nominal(task, &ranked.tool, &plan);
        let verdict = match nominal.passed {
            true => verifier.disturb(task, &ranked.tool, &plan, nominal),
            false => nominal,
        };
        Some(RankedLever {
            plan,
            predicted,
            verdict: Some(verdict),
            pushed: Some(pushed),
            ..ranked.clone()
        })
    }
}

/// What is left to do after a lever-up that reaches the rest of the goal, if its plate then lies where
/// it can be pushed.
fn left(task: &Task, library: &ToolLibrary, ranked: &RankedLever) -> Option<Task> {
    if !ranked.predicted.reached {
        return None;
    }
    let scene = Arc::new(LeverScene::with(&task.scene, &ranked.tool));
    let job = LeverJob { scene, lever: ranked.plan.lever };
    let (_, motion) = LeverSimulator::FINE.record(&job, FRAME);
    let left = task.after(&motion.frames.last()?.plates)?;
    let tools = left.pushers(library);
    Some(Task { tools, ..left })
}
