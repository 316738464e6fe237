//! Check of all rules for one plan.

use std::sync::Arc;

use crate::outcome::Warning;
use crate::scene::{Scene, Tool};
use crate::task::{Plan, Step, Task};

use super::{clearance, lever, push, reach, tools};

/// Returns every violation of a rule when `plan` is executed in `scene` with its tools, found by
/// name in `library`.
pub fn rule_violations(
    task: &Task,
    scene: &Scene,
    library: &[Arc<Tool>],
    plan: &Plan,
) -> Vec<Warning> {
    let mut found = tools::forbidden_tools(task, plan);
    found.extend(push::forbidden_pushes(task, plan));
    for (index, step) in plan.steps.iter().enumerate() {
        let Some(tool) = tools::named(library, step) else { continue };
        match step {
            Step::Push(step) => {
                found.extend(reach::out_of_reach(task, (index, step)));
                let comes_down = push::comes_down(plan, index);
                found.extend(clearance::collisions((task, scene), tool, (index, step), comes_down));
            }
            Step::LeverUp(step) => {
                let fault = |fault| Warning::CannotLever { step: index, fault };
                found.extend(lever::repeated(task, plan, (index, step)).map(fault));
                found.extend(lever::faults(task, scene, tool, step).into_iter().map(fault));
            }
        }
    }
    found
}
