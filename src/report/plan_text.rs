//! A plan and where it ends, in words and tables for the terminal.

use crate::geometry::{Vector, wrap_angle};
use crate::scene::{Engine, Outcome, Plan, Task, Warning};

use super::{
    document::Section,
    number::{degrees, millimetres},
    table::{
        Align::{Left, Right},
        NONE, Table,
    },
};

/// One line: tool, grip yaw, number of pushes; for a plan that leaves everything as it is, just
/// that.
pub(super) fn plan_line(plan: &Plan) -> String {
    let pushes = match plan.pushes.len() {
        0 => return "no push".to_owned(),
        1 => "1 push".to_owned(),
        count => format!("{count} pushes"),
    };
    format!("{}, grip yaw {}, {pushes}", plan.tool, whole_degrees(plan.grip_yaw))
}

/// One row per push; `None` without any.
pub(super) fn push_section(plan: &Plan) -> Option<Section> {
    let table = push_table(plan);
    (!table.is_empty()).then(|| Section { table, ..Section::default() })
}

fn push_table(plan: &Plan) -> Table {
    Table::of(
        plan.pushes.iter().enumerate(),
        &[
            ("push", Right, &|(k, _)| (k + 1).to_string()),
            ("end effector starts at", Left, &|(_, push)| point(push.start)),
            ("direction", Right, &|(_, push)| direction(push.direction)),
            ("length", Right, &|(_, push)| millimetres(push.length)),
            ("speed", Right, &|(_, push)| format!("{:.2} m/s", push.speed)),
        ],
    )
}

/// Where the goal object ends by several sources, one row each, and what went wrong on the way.
pub(super) fn outcome_table<'a>(
    task: &Task,
    outcomes: impl Iterator<Item = (String, &'a Outcome, Option<&'a Warning>)>,
) -> Table {
    let end = |outcome: &Outcome| {
        let end = outcome.state.poses.get(task.goal.object);
        end.map_or(NONE.to_owned(), |pose| point(pose.position))
    };
    let heading = |outcome: &Outcome| outcome.heading_error.map_or(NONE.to_owned(), degrees);
    Table::of(
        outcomes,
        &[
            ("", Left, &|(source, ..)| source.clone()),
            ("final position", Left, &|(_, outcome, _)| end(outcome)),
            ("error", Right, &|(_, outcome, _)| millimetres(outcome.error)),
            ("heading error", Right, &|(_, outcome, _)| heading(outcome)),
            ("reached", Left, &|(_, outcome, fault)| match (outcome.reached, fault) {
                (true, _) => "yes".to_owned(),
                (false, None) => "no".to_owned(),
                (false, Some(fault)) => format!("no, {}", fault.word()),
            }),
        ],
    )
}

/// An engine in a sentence or a table.
pub(super) fn engine_name(engine: Engine) -> &'static str {
    match engine {
        Engine::Planar => "planar",
        Engine::Spatial => "3-D",
        Engine::Upright => "3-D, upright",
    }
}

/// One line: what must come where.
pub(super) fn goal_line(task: &Task) -> String {
    let goal = &task.goal;
    let name = task.scene.objects.get(goal.object).map_or("object", |object| &object.name);
    let heading = goal.heading.map_or(String::new(), |(heading, tolerance)| {
        let alike = match goal.alike {
            1 => String::new(),
            alike => format!(", or any of {alike} that look the same"),
        };
        format!(", heading {} \u{00b1} {}{alike}", degrees(heading), degrees(tolerance))
    });
    let (at, within) = (point(goal.position), millimetres(goal.tolerance));
    format!("{name} at {at} within {within}{heading}")
}

/// A position on the table.
pub(super) fn point(position: Vector) -> String {
    format!("({:.3}, {:.3}) m", position.x + 0.0, position.y + 0.0)
}

/// A direction, degrees in (-180, 180] as shown.
fn direction(radians: f64) -> String {
    // Half of the last digit shown, so that nothing is shown as -180.0.
    let wrapped = wrap_angle(radians);
    let half_turn = wrapped <= -(179.95f64.to_radians());
    degrees(if half_turn { std::f64::consts::PI } else { wrapped })
}

fn whole_degrees(radians: f64) -> String {
    format!("{:.0}\u{00b0}", radians.to_degrees() + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Push, PushForm};

    #[test]
    fn a_plan_reads_as_a_table() {
        let push = Push { start: Vector::new(0.42, -0.0), direction: 3.2, length: 0.2, speed: 0.1 };
        let plan = Plan {
            tool: "l-hook".to_owned(),
            grip_yaw: -std::f64::consts::FRAC_PI_2,
            form: PushForm::Placed,
            lift: 0.002,
            pushes: vec![push],
        };
        insta::assert_snapshot!(plan_line(&plan), @"l-hook, grip yaw -90°, 1 push");
        insta::assert_snapshot!(push_table(&plan).to_text(), @r"
        push  end effector starts at  direction  length     speed
           1  (0.420, 0.000) m          -176.7°  200 mm  0.10 m/s
        ");
    }
}
