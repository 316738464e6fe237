//! Which push comes next, under what is believed.

use std::sync::Arc;

use crate::geometry::Vector;
use crate::scene::{Plan, Push, PushForm, Situation, Task, Tool};
use crate::solve::{AskedPush, AskedStart, Planner, asked_plan};
use crate::watch::Watch;

use super::error::ActError;
use super::judge::{Chance, Samples};
use super::runner::Runner;
use super::settings::RunSettings;
use super::trace::{Step, Why};

/// A plan that misses in all samples is worth a push if it comes nearer by this share on average.
const NEARER: f64 = 0.05;

/// What is done next.
#[derive(Clone, Debug)]
pub(super) enum Decision {
    /// A plan, of which the first push is made.
    Do { why: Why, plan: Plan, tool: Arc<Tool>, chance: Chance },
    /// Nothing, as the goal is reached.
    Done,
    /// Nothing, as nothing helps.
    Nothing,
}

/// Plans with what is expected of each.
pub(super) struct Judged {
    pub plans: Vec<(Plan, Arc<Tool>)>,
    pub chances: Vec<Chance>,
}

impl Judged {
    /// The best; the first of equals, as the planner ranks them.
    pub fn best(&self) -> Option<(&(Plan, Arc<Tool>), Chance)> {
        let mut best: Option<usize> = None;
        for (k, chance) in self.chances.iter().enumerate() {
            if best.is_none_or(|best| chance.beats(&self.chances[best])) {
                best = Some(k);
            }
        }
        best.map(|k| (&self.plans[k], self.chances[k]))
    }
}

impl Runner<'_> {
    /// What to do where things are as in `samples`, after `last`.
    pub(super) fn decide(
        &self,
        task: &Task,
        settings: &RunSettings,
        samples: &Samples,
        last: Option<&Step>,
        watch: &dyn Watch,
    ) -> Result<Decision, ActError> {
        let model = self.planner.model();
        if let Some((plan, tool)) = last.and_then(|last| rest(task, &samples.now, last)) {
            let plans = [(plan, tool)];
            let chance = samples.chances(model, task, &plans)[0];
            if chance.share >= settings.enough {
                let [(plan, tool)] = plans;
                return Ok(Decision::Do { why: Why::Rest, plan, tool, chance });
            }
        }
        let Some(mut judged) = self.plans(task, &samples.now, samples, watch)? else {
            return Ok(Decision::Done);
        };
        let sure = |judged: &Judged| {
            judged.best().is_some_and(|(_, chance)| chance.share >= settings.enough)
        };
        // Where the likeliest physics gives no plan that does, another may.
        for physics in samples.physics.iter().take(settings.others) {
            if sure(&judged) || watch.cancelled() {
                break;
            }
            let other = Situation { physics: Arc::clone(physics), ..samples.now.clone() };
            if let Some(more) = self.plans(task, &other, samples, watch)? {
                judged.plans.extend(more.plans);
                judged.chances.extend(more.chances);
            }
        }
        let nothing = task.goal.score(&samples.now.start);
        Ok(match judged.best() {
            Some(((plan, tool), chance)) => {
                let why = if chance.share >= settings.enough { Why::Plan } else { Why::Best };
                let helps = chance.share > 0.0 || chance.score < (1.0 - NEARER) * nothing;
                match helps {
                    true => Decision::Do { why, plan: plan.clone(), tool: tool.clone(), chance },
                    false => Decision::Nothing,
                }
            }
            None => Decision::Nothing,
        })
    }

    /// Plans for a situation, judged under the samples; nothing if no push is needed.
    fn plans(
        &self,
        task: &Task,
        situation: &Situation,
        samples: &Samples,
        watch: &dyn Watch,
    ) -> Result<Option<Judged>, ActError> {
        let planner: &Planner = self.planner;
        let solution = planner.solve_from(situation, task, self.library, watch)?;
        if solution.best().is_some_and(|best| best.plan.pushes.is_empty() && best.outcome.reached) {
            return Ok(None);
        }
        let plans: Vec<(Plan, Arc<Tool>)> = solution
            .plans
            .into_iter()
            .filter(|ranked| !ranked.plan.pushes.is_empty())
            .map(|ranked| (ranked.plan, ranked.tool))
            .collect();
        let chances = samples.chances(planner.model(), task, &plans);
        Ok(Some(Judged { plans, chances }))
    }
}

/// What is left of a plan after a step, moved by as much as the object stands beside where it was
/// expected; nothing if that breaks a rule of the task, or nothing is left.
fn rest(task: &Task, now: &Situation, last: &Step) -> Option<(Plan, Arc<Tool>)> {
    let left = last.plan.pushes.get(last.pushes..).filter(|left| !left.is_empty())?;
    if last.why == Why::Probe || last.plan.form == PushForm::Chained {
        return None;
    }
    let off: Vector = now.start.poses[task.goal.object].position - last.expected.position;
    let asked = |push: &Push| AskedPush {
        start: AskedStart::At(push.start + off),
        direction: push.direction,
        length: Some(push.length),
        speed: Some(push.speed),
    };
    let pushes: Vec<AskedPush> = left.iter().map(asked).collect();
    let tool = Arc::new(last.tool.clone());
    let asked = asked_plan(task, now, &tool, &[last.plan.grip_yaw], &pushes).ok()?;
    asked.broken.is_empty().then_some((asked.plan, tool))
}
