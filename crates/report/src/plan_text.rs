//! Plans and their outcomes as sentences and tables for the terminal.

use pushplan::decimals::fixed;
use pushplan::geometry::{Vector, wrap_angle};
use pushplan::{
    outcome::{MovedObject, Outcome, StepMoves, Trajectory, Verdict, Warning, step_moves},
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

/// Returns the objects that each step moves as predicted, otherwise as in the nominal 3-D or 2-D
/// replay; empty if none of them recorded every step. A stored solution keeps no replays, so text,
/// page and JSON agree only on the prediction.
pub(super) fn moves(
    task: &Task,
    plan: &Plan,
    predicted: Option<&Trajectory>,
    verdict: Option<&Verdict>,
) -> Vec<StepMoves> {
    let nominal = |engine| verdict?.nominal(engine)?.trajectory.as_ref();
    let replayed = Engine::ALL.into_iter().rev().filter_map(nominal);
    let found =
        predicted.into_iter().chain(replayed).map(|one| step_moves(task, plan.steps.len(), one));
    let mut moves = found.into_iter().find(|moves| !moves.is_empty()).unwrap_or_default();
    for (step, moved) in plan.steps.iter().zip(&mut moves) {
        // A raised plate may end where it began.
        if let (Step::LeverUp(step), None) = (step, &moved.object) {
            let name = task.scene.objects.get(step.lever.plate).map(|plate| plate.name.clone());
            moved.object = name.map(|object| MovedObject { object, moved: 0.0, turned: 0.0 });
        }
    }
    moves
}

/// Formats the objects that each step moves in one line; empty if they are unknown.
pub(super) fn moves_line(moves: &[StepMoves]) -> String {
    let words = |step: &StepMoves| {
        let also = also(step);
        let also = if also == NONE { String::new() } else { format!(" and also {also}") };
        format!("{}{also}", object(step))
    };
    match moves {
        [] => String::new(),
        [one] => format!("moves {}", words(one)),
        _ => {
            let of =
                |(k, step): (usize, &StepMoves)| format!("step {} moves {}", k + 1, words(step));
            moves.iter().enumerate().map(of).collect::<Vec<String>>().join("; ")
        }
    }
}

/// Formats the object that a step is for.
fn object(step: &StepMoves) -> String {
    step.object.as_ref().map_or("nothing".to_owned(), |one| one.object.clone())
}

/// Formats the other objects that a step moves.
fn also(step: &StepMoves) -> String {
    let of = |one: &MovedObject| format!("{} by {}", one.object, millimetres(one.moved));
    let also: Vec<String> = step.also.iter().map(of).collect();
    if also.is_empty() { NONE.to_owned() } else { also.join(", ") }
}

/// Returns the steps in full, one table for each tool and grip, with the objects that they move.
pub(super) fn plan_sections(plan: &Plan, moves: &[StepMoves]) -> Vec<Section> {
    let rows = rows(plan);
    let mut rest = moves;
    let section = |(k, row): (usize, &&[Step])| {
        let own = rest.split_off(..row.len().min(rest.len())).unwrap_or_default();
        let title = match k {
            0 => String::new(),
            _ => format!("Then, once everything is at rest: {}", row_line(row)),
        };
        let table = match &row[0] {
            Step::Push(_) => push_table(row, own),
            Step::LeverUp(step) => lever_table(&step.lever, own),
        };
        Section { title, table, ..Section::default() }
    };
    rows.iter().enumerate().map(section).collect()
}

/// Step of a table with the objects that it moves, if known.
type Shown<'a, T> = (usize, &'a T, Option<&'a StepMoves>);

/// Returns a table of `steps`; columns on moved objects are added to `columns` if there are any.
fn step_table<'a, T>(
    steps: impl Iterator<Item = &'a T>,
    moves: &'a [StepMoves],
    columns: &[Column<Shown<'a, T>>],
) -> Table {
    let known = |of: fn(&StepMoves) -> String| {
        move |(.., moves): &Shown<'a, T>| moves.map_or(NONE.to_owned(), of)
    };
    let [object, also] = [known(object), known(also)];
    let mut columns: Vec<Column<Shown<'a, T>>> = columns.to_vec();
    if !moves.is_empty() {
        columns.push(("moves", Left, &object));
    }
    if moves.iter().any(|step| !step.also.is_empty()) {
        columns.push(("also moves", Left, &also));
    }
    Table::of(steps.enumerate().map(|(k, step)| (k, step, moves.get(k))), &columns)
}

fn push_table(row: &[Step], moves: &[StepMoves]) -> Table {
    let pushes = row.iter().filter_map(|step| match step {
        Step::Push(step) => Some(&step.push),
        Step::LeverUp(_) => None,
    });
    step_table(
        pushes,
        moves,
        &[
            ("push", Right, &|(k, ..)| (k + 1).to_string()),
            ("end effector starts at", Left, &|(_, push, _)| point(push.start)),
            ("direction", Right, &|(_, push, _)| direction(push.direction)),
            ("length", Right, &|(_, push, _)| millimetres(push.length)),
            ("speed", Right, &|(_, push, _)| format!("{:.2} m/s", push.speed)),
        ],
    )
}

fn lever_table(lever: &LeverUp, moves: &[StepMoves]) -> Table {
    let share = |fraction: f64| format!("{:.0} %", 100.0 * fraction);
    step_table(
        [lever].into_iter(),
        moves,
        &[
            ("edge", Right, &|(_, lever, _)| lever.place.edge.to_string()),
            ("along the edge", Right, &|(_, lever, _)| share(lever.place.fraction)),
            ("depth", Right, &|(_, lever, _)| millimetres(lever.depth)),
            ("pivot", Right, &|(_, lever, _)| millimetres(lever.pivot)),
            ("rotation", Right, &|(_, lever, _)| degrees(lever.angle)),
            ("speed", Right, &|(_, lever, _)| format!("{:.2} m/s", lever.speed)),
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
        return lying_table(task, outcomes, &end);
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
    task: &Task,
    outcomes: Vec<(String, &Outcome, Option<&Warning>)>,
    end: &dyn Fn(&Outcome) -> String,
) -> Table {
    let object = task.goals[0].object;
    let raised = |outcome: &Outcome| {
        let raised = outcome.goals.iter().find_map(|goal| goal.raised);
        millimetres(raised.unwrap_or(0.0))
    };
    type Row<'r> = (String, &'r Outcome, Option<&'r Warning>);
    let height = |(_, outcome, _): &Row| raised(outcome);
    let side = |(_, outcome, _): &Row| outcome.side(object).to_string();
    let position = |(_, outcome, _): &Row| end(outcome);
    let there = |(_, outcome, fault): &Row| reached(outcome, *fault);
    let mut columns: Vec<Column<Row>> = vec![("", Left, &|(source, ..)| source.clone())];
    // A plate that turns over is in free fall at the end of the rotation.
    if task.goals.iter().any(|goal| goal.raises()) {
        columns.push(("edge raised", Right, &height));
    }
    columns.push(("at rest", Left, &side));
    columns.push(("final position", Left, &position));
    columns.push(("reached", Left, &there));
    Table::of(outcomes, &columns)
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
        insta::assert_snapshot!(plan_sections(&plan, &[])[0].table.to_text(), @r"
        push  end effector starts at  direction  length     speed
           1  (0.420, 0.000) m          -176.7°  200 mm  0.10 m/s
        ");
    }

    #[test]
    fn every_step_names_what_it_moves() {
        let push = Push { start: Vector::new(0.42, 0.0), direction: 0.0, length: 0.2, speed: 0.1 };
        let plan = Plan::pushing("stick", 0.0, PushForm::Placed, 0.002, [push, push]);
        let moved =
            |object: &str, moved| MovedObject { object: object.to_owned(), moved, turned: 0.0 };
        let first = StepMoves { object: Some(moved("b", 0.1)), also: vec![moved("vase", 0.0123)] };
        let moves = [first, StepMoves::default()];
        insta::assert_snapshot!(plan_sections(&plan, &moves)[0].table.to_text(), @r"
        push  end effector starts at  direction  length     speed  moves    also moves
           1  (0.420, 0.000) m             0.0°  200 mm  0.10 m/s  b        vase by 12.3 mm
           2  (0.420, 0.000) m             0.0°  200 mm  0.10 m/s  nothing  –
        ");
        let line = "step 1 moves b and also vase by 12.3 mm; step 2 moves nothing";
        assert_eq!(moves_line(&moves), line);
        assert_eq!(moves_line(&moves[1..]), "moves nothing");
    }
}
