//! Plans that cannot be replayed, because they name missing bodies or tools or take too long.

use std::sync::Arc;

use crate::outcome::{LeverFault, PushFault, Warning};
use crate::scene::{Scene, Tool};
use crate::task::{LeverUp, Plan, Push, Step};

use super::{lever, tools};

/// Returns the first reason why a plan cannot be replayed.
pub(in crate::verify) fn unplayable(
    scene: &Scene,
    library: &[Arc<Tool>],
    plan: &Plan,
) -> Option<Warning> {
    plan.steps.iter().enumerate().find_map(|(index, step)| {
        let forbidden = || Warning::ForbiddenTool { tool: step.tool().to_owned() };
        let Some(tool) = tools::named(library, step) else { return Some(forbidden()) };
        match step {
            Step::Push(_) if !tool.pushes() => Some(forbidden()),
            // A NaN counts as too long.
            Step::Push(step) => {
                let in_time = step.push.duration() <= Push::LONGEST;
                let fault = PushFault::TooLong(step.push.duration());
                (!in_time).then_some(Warning::ForbiddenPush { push: index, fault })
            }
            Step::LeverUp(step) => {
                let fault = match tool.blade() {
                    None => Some(LeverFault::NoBlade),
                    Some(_) => lever::nonsense(scene, step),
                };
                let in_time = step.lever.duration() <= LeverUp::LONGEST;
                let fault = fault.or((!in_time).then_some(LeverFault::TooLong));
                fault.map(|fault| Warning::CannotLever { step: index, fault })
            }
        }
    })
}
