//! The result: the plans that were tried, ranked.

use crate::watch::Instant;
use std::sync::Arc;

use crate::plan::bare;
use crate::{scene::Tool, task::Plan};

use super::attempts::Attempt;
use super::solving::Solving;
use super::{PlanStatus, RankedPlan, Solution};

/// At most this many plans are returned: as many as a reader looks at.
const REPORTED: usize = 8;

/// A plan that brings the object nearer to the goal by less, metres, or turns it nearer to the wanted
/// heading by less, radians, is none to look at: simulations differ by as much.
const NEARER: f64 = 0.01;
const TURNED: f64 = 0.1;

impl Solving<'_> {
    /// Whether a plan, by prediction, is clearly better than doing nothing.
    fn is_nearer(&self, tried: &Attempt) -> bool {
        let start = &self.situation.start;
        // By the goal that asks for least, as scores are in units of tolerances.
        let least = self.task.goals.iter().map(|goal| {
            let turned = goal.heading.map_or(f64::INFINITY, |(_, tolerance)| TURNED / tolerance);
            if goal.has_place() { (NEARER / goal.tolerance).min(turned) } else { turned }
        });
        let least = least.fold(f64::INFINITY, f64::min);
        bare(tried.score) <= self.task.score(start) - least
    }

    /// Ranks what was tried: the best; then those that passed, are untried, have failed - or, where
    /// none passed, the evidence first.
    pub(super) fn ranked(
        mut self,
        status: PlanStatus,
        best: Option<usize>,
        began: Instant,
    ) -> Solution {
        let rank = |index: usize, tried: &Attempt| match (&tried.verdict, status) {
            _ if Some(index) == best => 0,
            (Some(verdict), PlanStatus::Solved) => {
                if verdict.passed {
                    1
                } else {
                    3
                }
            }
            (Some(_), _) => 1,
            (None, _) => 2,
        };
        let nearest = status == PlanStatus::NoPlan;
        let mut order: Vec<(usize, Attempt)> = std::mem::take(&mut self.tried)
            .into_iter()
            .enumerate()
            .filter(|(_, tried)| !nearest || tried.plan.is_empty() || self.is_nearer(tried))
            .map(|(index, tried)| (rank(index, &tried), tried))
            .collect();
        order.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.score.total_cmp(&b.1.score)));
        order.truncate(REPORTED);
        let plans: Vec<(&Plan, &[Arc<Tool>])> =
            order.iter().map(|(_, t)| (&t.plan, &t.tools[..])).collect();
        let predictions = self.planner.predict_all(self.task, self.situation, &plans);
        let screened = self.rollouts.used();
        self.statistics.decided = plans.len()
            + match &self.deciding {
                Some(deciding) => deciding.used(),
                None => screened,
            };
        self.statistics.rollouts = self.statistics.decided
            + match self.deciding {
                Some(_) => screened,
                None => 0,
            };
        let warnings = predictions.first().map(|p| p.warnings.clone()).unwrap_or_default();
        let mut plans: Vec<RankedPlan> = order
            .into_iter()
            .zip(predictions)
            .map(|((_, tried), prediction)| RankedPlan {
                plan: tried.plan,
                tools: tried.tools,
                predicted: prediction.trajectory,
                outcome: prediction.outcome,
                verdict: tried.verdict,
                refinement: tried.refinement,
                joints: None,
            })
            .collect();
        self.add_joints(&mut plans);
        self.statistics.timing.total = began.elapsed().as_secs_f64();
        let cause = self.arm_cause(status);
        Solution {
            status,
            stopped: self.watch.cancelled(),
            models: self.planner.models(),
            plans,
            tools: self.workspace.tools.iter().map(|tool| Tool::clone(tool)).collect(),
            candidates: self.candidates,
            statistics: self.statistics,
            partial: None,
            cause,
            warnings,
        }
    }
}
