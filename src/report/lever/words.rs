//! A lever-up, its goal and what came of it, in words.

use crate::report::document::Section;
use crate::report::number::{degrees, millimetres};
use crate::report::plan_text::{self, point};
use crate::report::table::{
    Align::{Left, Right},
    Table,
};
use crate::scene::{LeverOutcome, LeverPlan, Task};

/// One line: tool, object, turn.
pub fn plan_line(task: &Task, plan: &LeverPlan) -> String {
    let name = task.scene.objects.get(plan.lever.plate).map_or("?", |plate| plate.name.as_str());
    let way = if plan.lever.pivot < 0.0 { "prying" } else { "lifting" };
    let lever = format!("{}, {way} {name} by {}", plan.tool, degrees(plan.lever.angle));
    match &plan.follow_up {
        Some(follow_up) => format!("{lever}, then {}", plan_text::plan_line(&follow_up.plan)),
        None => lever,
    }
}

/// The lever-up in full, and the pushes that follow.
pub(super) fn plan_sections(plan: &LeverPlan) -> Vec<Section> {
    let pushes = plan.follow_up.as_ref().and_then(|follow_up| {
        let table = plan_text::push_section(&follow_up.plan)?.table;
        let title = format!("Then {}, once the object lies still", follow_up.plan.tool);
        Some(Section { title, table, ..Section::default() })
    });
    [lever_section(plan)].into_iter().chain(pushes).collect()
}

/// The lever-up in full.
pub(super) fn lever_section(plan: &LeverPlan) -> Section {
    let lever = &plan.lever;
    let table = Table::of(
        [lever],
        &[
            ("edge", Right, &|lever| lever.place.edge.to_string()),
            ("along it", Right, &|lever| format!("{:.0} %", 100.0 * lever.place.fraction)),
            ("depth", Right, &|lever| millimetres(lever.depth)),
            ("pivot", Right, &|lever| millimetres(lever.pivot)),
            ("turn", Right, &|lever| degrees(lever.angle)),
            ("speed", Right, &|lever| format!("{:.2} m/s", lever.speed)),
        ],
    );
    Section { table, ..Section::default() }
}

/// What is asked for.
pub fn goal_line(task: &Task) -> String {
    let goal = &task.goal;
    let mut demands = Vec::new();
    if let Some(block) = goal.outside.and_then(|block| task.scene.obstacles.get(block)) {
        demands.push(format!("outside of {}", block.name));
    }
    if let Some(height) = goal.raised {
        demands.push(format!("edge raised by {}", millimetres(height)));
    }
    match goal.flipped {
        Some(true) => demands.push("upside down".to_owned()),
        Some(false) => demands.push("on its underside".to_owned()),
        None => {}
    }
    if goal.has_place() {
        let (at, tolerance) = (point(goal.position), millimetres(goal.tolerance));
        demands.push(format!("at {at} within {tolerance}"));
    }
    format!("{}: {}", task.plate().name, demands.join(", "))
}

/// What came of a lever-up by several sources, one row each.
pub(super) fn outcome_table<'a>(
    outcomes: impl IntoIterator<Item = (String, &'a LeverOutcome)>,
) -> Table {
    Table::of(
        outcomes,
        &[
            ("", Left, &|(source, _)| source.clone()),
            ("edge raised", Right, &|(_, outcome)| millimetres(outcome.raised)),
            ("at rest", Left, &|(_, outcome)| outcome.ending.to_string()),
            ("final position", Left, &|(_, outcome)| point(outcome.rest)),
            ("reached", Left, &|(_, outcome)| {
                let on_the_way: Vec<String> =
                    outcome.warnings.iter().map(ToString::to_string).collect();
                let reached = if outcome.reached { "yes" } else { "no" };
                match on_the_way.is_empty() {
                    true => reached.to_owned(),
                    false => format!("{reached}, {}", on_the_way.join(", ")),
                }
            }),
        ],
    )
}
