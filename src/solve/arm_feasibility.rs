//! What an arm makes of plans: those that it cannot carry out are not verified.

use crate::arm::follow;
use crate::plan::Evaluation;
use crate::verify;

use super::solving::Solving;
use super::{Cause, PlanStatus, RankedPlan};

impl Solving<'_> {
    /// Whether the task's arm, if it has one, carries a plan out, as far as predictions say where objects
    /// are. Notes what it cannot.
    pub(super) fn is_for_arm(&mut self, evaluation: &Evaluation) -> bool {
        let Some(arm) = self.task.arm.as_deref() else { return true };
        let (tools, plan) = (evaluation.tools(&self.workspace), evaluation.plan(&self.workspace));
        // Between pushes they are about where they were.
        let mut states = vec![self.situation.start.clone(); plan.steps.len()];
        states.push(evaluation.outcome.clone());
        let scene = &*self.situation.scene;
        match follow(self.task, (arm, scene), &tools[0], &plan, &states) {
            Ok(_) => true,
            Err((_, fault)) => {
                self.unable.get_or_insert(fault);
                false
            }
        }
    }

    /// Why there is no plan, where there would be one without the arm.
    pub(super) fn arm_cause(&self, status: PlanStatus) -> Option<Cause> {
        let fault = self.unable.clone().filter(|_| status == PlanStatus::NoPlan)?;
        Some(Cause::Arm { fault })
    }

    /// Adds to plans how the arm carries them out.
    pub(super) fn add_joints(&self, plans: &mut [RankedPlan]) {
        for ranked in plans.iter_mut().filter(|ranked| !ranked.plan.is_empty()) {
            let evidence = ranked.verdict.as_ref().map_or(&[][..], |verdict| &verdict.evidence);
            let (task, situation) = (self.task, self.situation);
            let made = verify::joints(task, situation, &ranked.tools[0], &ranked.plan, evidence);
            ranked.joints = made.and_then(Result::ok);
        }
    }
}
