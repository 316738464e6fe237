//! Choice of the next push under the current belief.

use std::sync::Arc;

use crate::belief::Belief;
use pushplan::geometry::Vector;
use pushplan::progress::Progress;
use pushplan::solve::{Approach, ManualPush, ManualStart, SolveError, manual_plan};
use pushplan::{
    scene::{Situation, Tool},
    task::{Plan, Push, PushForm, Task},
};

use super::error::ActError;
use super::judge::{Chance, Reach, Samples, Tooled};
use super::probe::{pays, probe};
use super::runner::Runner;
use super::trace::{Step, Trace, Why};

/// Minimum relative reduction of the mean error that justifies a plan reaching the goal in no
/// sample.
const NEARER: f64 = 0.05;

/// Maximum number of pushes planned at once. Of longer plans only the first pushes are planned.
const AT_ONCE: usize = 3;

/// Maximum length of the plans searched for, in pushes, however many the task allows.
const MOST_AT_ONCE: usize = 6;

/// Next action of the runner.
#[derive(Clone, Debug)]
pub(super) enum Decision {
    /// Carries out the first push of `plan`.
    Do { why: Why, plan: Plan, tool: Arc<Tool>, chance: Chance },
    /// Stops because the goal is reached.
    Done,
    /// Stops because no push helps.
    Nothing,
}

/// Plans with their expected outcomes.
struct Judged {
    plans: Vec<Tooled>,
    reach: Vec<Vec<Reach>>,
}

impl Judged {
    /// Returns the best plan; of equal plans, the first in the planner's ranking.
    fn best(&self) -> Option<(&Tooled, Chance)> {
        let mut best: Option<(usize, Chance)> = None;
        for (k, reach) in self.reach.iter().enumerate() {
            let chance = Chance::of(reach);
            if best.is_none_or(|(_, best)| chance.beats(&best)) {
                best = Some((k, chance));
            }
        }
        best.map(|(k, chance)| (&self.plans[k], chance))
    }
}

impl Runner<'_> {
    /// Chooses the next action under `belief`, from which `samples` were drawn.
    pub(super) fn decide(
        &self,
        trace: &Trace,
        (belief, samples): (&Belief, &Samples),
        progress: &dyn Progress,
    ) -> Result<Decision, ActError> {
        let Trace { task, settings, steps, .. } = trace;
        let model = self.planner.model();
        if let Some((plan, tool)) = steps.last().and_then(|last| rest(task, &samples.now, last)) {
            let plans = [(plan, vec![Arc::clone(&tool)])];
            let chance = Chance::of(&samples.reach(model, task, &plans)[0]);
            if chance.share >= settings.min_success {
                let [(plan, _)] = plans;
                return Ok(Decision::Do { why: Why::Rest, plan, tool, chance });
            }
        }
        // The first pushes of a long plan are searched for separately because the cost of a search
        // must not grow with the remaining distance.
        if task.pushes.max_count > AT_ONCE
            && let Some(decision) = self.approach(task, samples, AT_ONCE + 1, progress)?
        {
            return Ok(decision);
        }
        let mut near = task.clone();
        near.pushes.max_count = near.pushes.max_count.min(MOST_AT_ONCE);
        let planned = &near;
        let Some(mut judged) = self.plans(planned, &samples.now, samples, progress)? else {
            return Ok(Decision::Done);
        };
        let sure = |judged: &Judged| {
            judged.best().is_some_and(|(_, chance)| chance.share >= settings.min_success)
        };
        // If no plan works in enough samples, plans are added for samples in which none works.
        let mut tried = Vec::new();
        while tried.len() < settings.others && !sure(&judged) && !progress.cancelled() {
            let missed = |s: &usize| judged.reach.iter().all(|plan| !plan[*s].reached);
            let mut samples_left = (0..samples.physics.len()).filter(|s| !tried.contains(s));
            let Some(sample) = samples_left.find(missed) else { break };
            let physics = Arc::clone(&samples.physics[sample]);
            let other = Situation { physics, ..samples.now.clone() };
            if let Some(more) = self.plans(planned, &other, samples, progress)? {
                judged.plans.extend(more.plans);
                judged.reach.extend(more.reach);
            }
            tried.push(sample);
        }
        if !sure(&judged) && probes(steps) < settings.max_probes && pays(&judged.reach) {
            let tools = task.tools(self.library).map_err(SolveError::from)?;
            let known = (tools.as_slice(), judged.reach.as_slice());
            let index = steps.len() as u64;
            let found = probe(model, task, settings, (belief, samples), known, index);
            if let Some((plan, tool)) = found {
                let plans = [(plan, vec![Arc::clone(&tool)])];
                let chance = Chance::of(&samples.reach(model, task, &plans)[0]);
                let [(plan, _)] = plans;
                return Ok(Decision::Do { why: Why::Probe, plan, tool, chance });
            }
        }
        let nothing = task.score(&samples.now.start);
        let best = judged.best();
        // A plan that reaches the goal in no sample may be a dead end; an approach is not.
        if best.is_none_or(|(_, chance)| chance.share == 0.0)
            && let Some(decision) = self.approach(task, samples, 1, progress)?
        {
            return Ok(decision);
        }
        let Some(((plan, tools), chance)) = best else { return Ok(Decision::Nothing) };
        let why = if chance.share >= settings.min_success { Why::Plan } else { Why::Best };
        let helps = chance.share > 0.0 || chance.score < (1.0 - NEARER) * nothing;
        let (plan, tool) = (plan.clone(), Arc::clone(&tools[0]));
        Ok(if helps { Decision::Do { why, plan, tool, chance } } else { Decision::Nothing })
    }

    /// Returns the first pushes of an approach of at least `least` pushes, if there is one.
    fn approach(
        &self,
        task: &Task,
        samples: &Samples,
        least: usize,
        progress: &dyn Progress,
    ) -> Result<Option<Decision>, ActError> {
        let quiet = Quiet(progress);
        let found = self.planner.approach(&samples.now, task, self.library, least, &quiet)?;
        let Some(Approach { plan, tool, .. }) = found else { return Ok(None) };
        let plans = [(plan, vec![Arc::clone(&tool)])];
        let chance = Chance::of(&samples.reach(self.planner.model(), task, &plans)[0]);
        let [(plan, _)] = plans;
        Ok(Some(Decision::Do { why: Why::Approach, plan, tool, chance }))
    }

    /// Plans for a situation and judges the plans under all samples; `None` if no push is needed.
    fn plans(
        &self,
        task: &Task,
        situation: &Situation,
        samples: &Samples,
        progress: &dyn Progress,
    ) -> Result<Option<Judged>, ActError> {
        let quiet = Quiet(progress);
        let solution = self.planner.solve_from(situation, task, self.library, &quiet)?;
        if solution.best().is_some_and(|best| best.plan.is_empty() && best.outcome.reached) {
            return Ok(None);
        }
        let plans: Vec<Tooled> = solution
            .plans
            .into_iter()
            .filter(|ranked| !ranked.plan.is_empty())
            .map(|ranked| (ranked.plan, ranked.tools))
            .collect();
        let reach = samples.reach(self.planner.model(), task, &plans);
        Ok(Some(Judged { plans, reach }))
    }
}

/// Passes on cancellation only, because progress of planning is not progress of the run.
struct Quiet<'a>(&'a dyn Progress);

impl Progress for Quiet<'_> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

/// Counts the exploratory pushes.
fn probes(steps: &[Step]) -> usize {
    steps.iter().filter(|step| step.why == Why::Probe).count()
}

/// Returns the remaining pushes of the last plan, shifted by the position error of the object.
///
/// Returns `None` if the shifted pushes break a rule of the task or no push is left.
fn rest(task: &Task, now: &Situation, last: &Step) -> Option<(Plan, Arc<Tool>)> {
    let made = last.plan.pushes();
    let left = made.get(last.pushes..).filter(|left| !left.is_empty())?;
    let mut steps = last.plan.push_steps().skip(last.pushes);
    let grip_yaw = steps.next()?.grip_yaw;
    // A plan with several tools or grips is planned anew.
    if last.plan.tools().len() > 1 || steps.any(|step| step.grip_yaw != grip_yaw) {
        return None;
    }
    // With several goals the object of the next push is unknown.
    let several = task.goals.len() > 1;
    if last.why == Why::Probe || last.plan.form() == PushForm::Chained || several {
        return None;
    }
    let off: Vector = now.start.poses[task.goals[0].object].position - last.expected.position;
    let asked = |push: &Push| ManualPush {
        start: ManualStart::At(push.start + off),
        direction: push.direction,
        length: Some(push.length),
        speed: Some(push.speed),
    };
    let pushes: Vec<ManualPush> = left.iter().map(asked).collect();
    let tool = Arc::new(last.tool.clone());
    let asked = manual_plan(task, now, &tool, &[grip_yaw], &pushes).ok()?;
    asked.violations.is_empty().then_some((asked.plan, tool))
}
