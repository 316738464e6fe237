//! What several models say of one lever-up.

use serde_json::json;

use crate::report::document::{Document, Figure, Section};
use crate::report::number::{millimetres, seconds};
use crate::report::table::{Align, NONE, Table};
use crate::scene::{LeverOutcome, LeverPlan, LeverTrajectory, Task};

use super::words::{goal_line, lever_section, outcome_table, plan_line};

/// What a model says, and what that cost.
#[derive(Clone, Debug)]
pub struct PredictedLever {
    /// Name of the model.
    pub by: String,
    /// Frame by frame.
    pub trajectory: LeverTrajectory,
    /// What comes of it.
    pub outcome: LeverOutcome,
    /// Wall-clock time, seconds.
    pub seconds: f64,
}

/// What several models say of one lever-up, the last of them being the one that they are compared
/// with.
pub fn lever_prediction_document(
    task: &Task,
    plan: &LeverPlan,
    predicted: &[PredictedLever],
    figures: Vec<Figure>,
) -> Document {
    let outcomes = predicted.iter().map(|found| (found.by.clone(), &found.outcome));
    let truth = predicted.last();
    let off = |found: &PredictedLever, last: bool| {
        let truth = truth.filter(|truth| truth.by != found.by)?;
        let gap = |a: &crate::geometry::Pose3, b: &crate::geometry::Pose3| {
            (a.position - b.position).norm()
        };
        let pairs = || found.trajectory.lift.iter().zip(&truth.trajectory.lift);
        let count = pairs().count().max(1) as f64;
        let square: f64 = pairs().map(|(a, b)| gap(a, b).powi(2)).sum();
        Some(match last {
            true => gap(&found.trajectory.rest, &truth.trajectory.rest),
            false => (square / count).sqrt(),
        })
    };
    let shown = |gap: Option<f64>| gap.map_or(NONE.to_owned(), millimetres);
    let errors = Table::of(
        predicted,
        &[
            ("", Align::Left, &|found| found.by.clone()),
            ("off during the turn", Align::Right, &|found| shown(off(found, false))),
            ("off at rest", Align::Right, &|found| shown(off(found, true))),
            ("time", Align::Right, &|found| seconds(found.seconds)),
        ],
    );
    Document {
        title: format!("{}: {}", task.name, plan_line(task, plan)),
        notes: vec![format!("goal: {}", goal_line(task))],
        sections: vec![
            lever_section(plan),
            Section { table: outcome_table(outcomes), figures, ..Section::default() },
            Section { table: errors, ..Section::default() },
        ],
        json: json!({
            "task": task.name,
            "plan": plan,
            "predictions": predicted.iter().map(|found| json!({
                "by": found.by, "outcome": found.outcome, "trajectory": found.trajectory,
                "seconds": found.seconds,
            })).collect::<Vec<_>>(),
        }),
        ..Document::default()
    }
}
