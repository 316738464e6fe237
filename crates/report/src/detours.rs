//! Detours of the lifted tool.

use pushplan::{
    outcome::step_states,
    scene::Robot,
    solve::RankedPlan,
    task::{Task, TravelLeg},
};

use super::plan_text::point;

/// Returns a line for each detour of the lifted tool.
pub(super) fn detours(task: &Task, best: &RankedPlan) -> Vec<String> {
    let evidence = best.verdict.as_ref().map_or(&[][..], |verdict| &verdict.evidence);
    let states = step_states(&task.scene.start(), best.plan.steps.len(), evidence);
    let legs = task.legs(&task.scene, &best.tools, &best.plan, &states).unwrap_or_default();
    let line = |leg: &TravelLeg| {
        // The column of the robot is obvious.
        let what = leg.around.as_deref().filter(|what| !what.starts_with(Robot::BASE))?;
        let corners = &leg.path[1..leg.path.len() - 1];
        let by: Vec<String> = corners.iter().copied().map(point).collect();
        let way = match (leg.from, leg.to) {
            (_, None) => "on the way home".to_owned(),
            (None, Some(to)) => format!("from home to step {}", to + 1),
            (Some(from), Some(to)) => format!("between steps {} and {}", from + 1, to + 1),
        };
        Some(format!(
            "{way} the tool moves {:.2} m at {:.2} m above the table around {what}, via {}",
            leg.length(),
            task.robot.travel,
            by.join(", ")
        ))
    };
    legs.iter().filter_map(line).collect()
}
