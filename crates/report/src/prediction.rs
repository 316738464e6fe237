//! Predictions of one plan by several models.

use serde_json::{Value as Json, json};

use pushplan::{
    outcome::Outcome,
    scene::State,
    task::{Plan, Task},
};
use pushplan_bench::TimedEffect;

use super::document::{Document, Section};
use super::number::{degrees, millimetres, seconds};
use super::plan_text::{goal_line, moves, outcome_table, plan_line, plan_sections, point};
use super::table::{
    Align::{Left, Right},
    NONE, Table,
};

/// Smallest displacement of an object that is listed in the table, metres.
const STILL: f64 = 1e-4;

/// Returns a report on the effect of a plan on a task's objects, by several models.
pub fn prediction_document(task: &Task, plan: &Plan, effects: &[TimedEffect]) -> Document {
    let json: Vec<Json> = effects
        .iter()
        .map(|effect| {
            let end = effect.trajectory.outcome();
            json!({
                "model": effect.trajectory.by,
                "state": end,
                "goal_error": task.goals[0].error(end),
                "warnings": effect.warnings,
                "seconds": effect.seconds,
            })
        })
        .collect();
    let objects: Vec<&str> = task.scene.objects.iter().map(|o| o.name.as_str()).collect();
    let outcomes: Vec<Outcome> = effects
        .iter()
        .map(|effect| Outcome::judge(&task.scene, task, &effect.trajectory))
        .collect();
    let lying = outcomes.iter().any(|outcome| outcome.state.space.is_some()).then(|| {
        let fault = |effect: &TimedEffect| {
            effect.trajectory.warnings.iter().find(|warning| warning.forbids_success()).cloned()
        };
        let faults: Vec<_> = effects.iter().map(fault).collect();
        let rows = effects.iter().zip(&outcomes).zip(&faults).map(|((effect, outcome), fault)| {
            (effect.trajectory.by.to_string(), outcome, fault.as_ref())
        });
        Section { table: outcome_table(task, rows), ..Section::default() }
    });
    let first = effects.first().map(|effect| &effect.trajectory);
    let moves = moves(task, plan, first, None);
    let ends = Section {
        table: effect_table(task, effects),
        lines: vec![format!("goal: {}", goal_line(task))],
        ..Section::default()
    };
    Document {
        title: plan_line(plan),
        sections: plan_sections(plan, &moves).into_iter().chain(lying).chain([ends]).collect(),
        json: json!({
            "task": task.name, "plan": plan, "moves": moves, "objects": objects, "effects": json,
        }),
        ..Document::default()
    }
}

/// Returns a table with one row per model and moving object; the goal's object is always included.
fn effect_table(task: &Task, effects: &[TimedEffect]) -> Table {
    let start = task.scene.start();
    let moved =
        |state: &State, k: usize| (state.poses[k].position - start.poses[k].position).norm();
    let mut rows = Vec::new();
    for k in task.scene.things().map(|(k, _)| k) {
        let ends = effects.iter().map(|effect| effect.trajectory.outcome());
        if task.has_goal(k) || ends.into_iter().any(|end| moved(end, k) >= STILL) {
            rows.extend(effects.iter().map(|effect| (k, effect, effect.trajectory.outcome())));
        }
    }
    let turned = |k: usize, end: &State| match task.scene.objects[k].shape.is_cylinder() {
        true => NONE.to_owned(),
        false => degrees(end.poses[k].heading - start.poses[k].heading),
    };
    let error = |k: usize, end: &State| {
        let goal = task.goals.iter().find(|goal| goal.movers().contains(&k));
        goal.map_or(String::new(), |goal| millimetres(goal.error(end)))
    };
    Table::of(
        rows,
        &[
            ("object", Left, &|(k, _, _)| task.scene.objects[*k].name.clone()),
            ("model", Left, &|(_, effect, _)| effect.trajectory.by.to_string()),
            ("final position", Left, &|(k, _, end)| point(end.poses[*k].position)),
            ("moved", Right, &|(k, _, end)| millimetres(moved(end, *k))),
            ("rotated", Right, &|(k, _, end)| turned(*k, end)),
            ("goal error", Right, &|(k, _, end)| error(*k, end)),
            ("computing time", Right, &|(_, effect, _)| seconds(effect.seconds)),
        ],
    )
}
