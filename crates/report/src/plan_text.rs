//! Plans and their outcomes as sentences and tables for the terminal.

use pushplan::geometry::{Vector, fixed, wrap_angle};
use pushplan::{
    outcome::{Outcome, Warning},
    scene::Engine,
    task::{Goal, LeverUp, Plan, Step, Task},
};

use super::{
    document::Section,
    number::{degrees, millimetres},
    recorded::percent,
    table::{
        Align::{Left, Right},
        Column, NONE, Table,
    },
};

/// Formats a plan in one line: tool, grip yaw and number of pushes, or the effect of a lever-up;
/// "no push" for an empty plan.
pub(super) fn plan_line(plan: &Plan) -> String {
    let lines: Vec<String> = rows(plan).into_iter().map(row_line).collect();
    match lines.is_empty() {
        true => "no push".to_owned(),
        false => lines.join(", then "),
    }
}

/// Groups consecutive steps of one kind with one tool and one grip.
fn rows(plan: &Plan) -> Vec<&[Step]> {
    let together = |a: &Step, b: &Step| match (a, b) {
        (Step::Push(a), Step::Push(b)) => a.tool == b.tool && a.grip_yaw == b.grip_yaw,
        _ => false,
    };
    plan.steps.chunk_by(together).collect()
}

fn row_line(row: &[Step]) -> String {
    match &row[0] {
        Step::Push(step) => {
            let pushes = match row.len() {
                1 => "1 push".to_owned(),
                count => format!("{count} pushes"),
            };
            format!("{}, grip yaw {}, {pushes}", step.tool, whole_degrees(step.grip_yaw))
        }
        Step::LeverUp(step) => {
            let way = if step.lever.pivot < 0.0 { "prying" } else { "lifting" };
            format!("{}, {way} by {}", step.tool, degrees(step.lever.angle))
        }
    }
}

/// Returns the steps in full, one table for each tool and grip.
pub(super) fn plan_sections(plan: &Plan) -> Vec<Section> {
    let rows = rows(plan);
    let section = |(k, row): (usize, &&[Step])| {
        let title = match k {
            0 => String::new(),
            _ => format!("Then, once everything is at rest: {}", row_line(row)),
        };
        let table = match &row[0] {
            Step::Push(_) => push_table(row),
            Step::LeverUp(step) => lever_table(&step.lever),
        };
        Section { title, table, ..Section::default() }
    };
    rows.iter().enumerate().map(section).collect()
}

fn push_table(row: &[Step]) -> Table {
    let pushes = row.iter().filter_map(|step| match step {
        Step::Push(step) => Some(&step.push),
        Step::LeverUp(_) => None,
    });
    Table::of(
        pushes.enumerate(),
        &[
            ("push", Right, &|(k, _)| (k + 1).to_string()),
            ("end effector starts at", Left, &|(_, push)| point(push.start)),
            ("direction", Right, &|(_, push)| direction(push.direction)),
            ("length", Right, &|(_, push)| millimetres(push.length)),
            ("speed", Right, &|(_, push)| format!("{:.2} m/s", push.speed)),
        ],
    )
}

fn lever_table(lever: &LeverUp) -> Table {
    Table::of(
        [lever],
        &[
            ("edge", Right, &|lever| lever.place.edge.to_string()),
            ("along the edge", Right, &|lever| format!("{:.0} %", 100.0 * lever.place.fraction)),
            ("depth", Right, &|lever| millimetres(lever.depth)),
            ("pivot", Right, &|lever| millimetres(lever.pivot)),
            ("rotation", Right, &|lever| degrees(lever.angle)),
            ("speed", Right, &|lever| format!("{:.2} m/s", lever.speed)),
        ],
    )
}

/// Outcome of a plan by one source, with the failure during execution, if any.
type Row<'a> = (String, &'a Outcome, Option<&'a Warning>);

/// Returns a table of the goal object's final position and the failure, one row per source.
pub(super) fn outcome_table<'a>(
    task: &Task,
    outcomes: impl Iterator<Item = (String, &'a Outcome, Option<&'a Warning>)>,
) -> Table {
    let end = |outcome: &Outcome| {
        let end = outcome.state.poses.get(task.goals[0].object);
        end.map_or(NONE.to_owned(), |pose| point(pose.position))
    };
    let covered =
        |outcome: &Outcome| task.goals[0].covered(&outcome.state).map_or(NONE.to_owned(), percent);
    let heading = |outcome: &Outcome| outcome.heading_error().map_or(NONE.to_owned(), degrees);
    let outcomes: Vec<(String, &Outcome, Option<&Warning>)> = outcomes.collect();
    if outcomes.iter().any(|(_, outcome, _)| outcome.state.space.is_some()) {
        return lying_table(task.goals[0].object, outcomes, &end);
    }
    if task.goals.iter().map(|goal| goal.movers().len()).sum::<usize>() > 1 {
        return goals_table(task, outcomes);
    }
    let position = |(_, outcome, _): &Row| end(outcome);
    let error = |(_, outcome, _): &Row| millimetres(outcome.error());
    let turned = |(_, outcome, _): &Row| heading(outcome);
    let share = |(_, outcome, _): &Row| covered(outcome);
    let there = |(_, outcome, fault): &Row| reached(outcome, *fault);
    let mut columns: Vec<Column<Row>> = vec![
        ("", Left, &|(source, ..)| source.clone()),
        ("final position", Left, &position),
        ("error", Right, &error),
        ("heading error", Right, &turned),
    ];
    if task.goals[0].covered(&task.scene.start()).is_some() {
        columns.push(("covered", Right, &share));
    }
    columns.push(("reached", Left, &there));
    Table::of(outcomes, &columns)
}

/// Returns a table of the final poses of several goal objects; errors refer to their own goals.
fn goals_table(task: &Task, outcomes: Vec<(String, &Outcome, Option<&Warning>)>) -> Table {
    let mut rows = Vec::new();
    for (source, outcome, fault) in outcomes {
        let ends = &outcome.state.poses;
        let known = |goal: &&Goal| goal.movers().iter().all(|k| *k < ends.len());
        for (k, goal) in task.goals.iter().filter(known).enumerate() {
            let turned = goal.heading_error(&outcome.state);
            // A failure during execution fails all goals.
            let met = fault.is_none() && goal.reached(&outcome.state);
            let there = if met { "yes".to_owned() } else { reached(outcome, fault) };
            for (m, object) in goal.movers().into_iter().enumerate() {
                rows.push(match m {
                    0 => [
                        if k == 0 { source.clone() } else { String::new() },
                        task.scene.objects[object].name.clone(),
                        point(ends[object].position),
                        millimetres(goal.error(&outcome.state)),
                        turned.map_or(NONE.to_owned(), degrees),
                        there.clone(),
                    ],
                    _ => {
                        let (name, at) = (&task.scene.objects[object].name, ends[object].position);
                        let none = String::new;
                        [none(), name.clone(), point(at), none(), none(), none()]
                    }
                });
            }
        }
    }
    Table::of(
        rows,
        &[
            ("", Left, &|row| row[0].clone()),
            ("object", Left, &|row| row[1].clone()),
            ("final position", Left, &|row| row[2].clone()),
            ("error", Right, &|row| row[3].clone()),
            ("heading error", Right, &|row| row[4].clone()),
            ("reached", Left, &|row| row[5].clone()),
        ],
    )
}

fn reached(outcome: &Outcome, fault: Option<&Warning>) -> String {
    match (outcome.reached, fault) {
        (true, _) => "yes".to_owned(),
        (false, None) => "no".to_owned(),
        (false, Some(fault)) => format!("no, {}", fault.word()),
    }
}

/// Returns a table of the goal object's lying state, one row per source.
fn lying_table(
    object: usize,
    outcomes: Vec<(String, &Outcome, Option<&Warning>)>,
    end: &dyn Fn(&Outcome) -> String,
) -> Table {
    let raised = |outcome: &Outcome| {
        let raised = outcome.goals.iter().find_map(|goal| goal.raised);
        millimetres(raised.unwrap_or(0.0))
    };
    Table::of(
        outcomes,
        &[
            ("", Left, &|(source, ..)| source.clone()),
            ("edge raised", Right, &|(_, outcome, _)| raised(outcome)),
            ("at rest", Left, &|(_, outcome, _)| outcome.side(object).to_string()),
            ("final position", Left, &|(_, outcome, _)| end(outcome)),
            ("reached", Left, &|(_, outcome, fault)| reached(outcome, *fault)),
        ],
    )
}

/// Returns the name of an engine for a sentence or a table.
pub(super) fn engine_name(engine: Engine) -> &'static str {
    match engine {
        Engine::Planar => "2-D",
        Engine::Spatial => "3-D",
        Engine::Upright => "3-D, upright",
    }
}

/// Formats all goals in one line.
pub(super) fn goal_line(task: &Task) -> String {
    task.goals.iter().map(|goal| goal.line(&task.scene)).collect::<Vec<_>>().join("; ")
}

/// Formats a position on the table.
pub(super) fn point(position: Vector) -> String {
    format!("({}, {}) m", fixed(position.x, 3), fixed(position.y, 3))
}

/// Formats a direction in degrees, in (-180, 180] as shown.
fn direction(radians: f64) -> String {
    // The threshold is half of the last digit, so that -180.0 is never shown.
    let wrapped = wrap_angle(radians);
    let half_turn = wrapped <= -(179.95f64.to_radians());
    degrees(if half_turn { std::f64::consts::PI } else { wrapped })
}

fn whole_degrees(radians: f64) -> String {
    format!("{}\u{00b0}", fixed(radians.to_degrees(), 0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pushplan::task::{Push, PushForm};

    #[test]
    fn a_plan_reads_as_a_table() {
        let push = Push { start: Vector::new(0.42, -0.0), direction: 3.2, length: 0.2, speed: 0.1 };
        let yaw = -std::f64::consts::FRAC_PI_2;
        let plan = Plan::pushing("l-hook", yaw, PushForm::Placed, 0.002, [push]);
        insta::assert_snapshot!(plan_line(&plan), @"l-hook, grip yaw -90°, 1 push");
        insta::assert_snapshot!(plan_sections(&plan)[0].table.to_text(), @r"
        push  end effector starts at  direction  length     speed
           1  (0.420, 0.000) m          -176.7°  200 mm  0.10 m/s
        ");
    }
}
