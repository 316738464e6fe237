//! One simulation of a lever-up.

use serde_json::json;

use crate::asset::LeverTrajectoryFile;
use crate::report::document::{Document, Section};
use crate::scene::LeverOutcome;

use super::figure::lever_figure;
use super::words::{goal_line, lever_section, outcome_table, plan_line};

/// A simulation with its picture, whose file is named `name`.
pub fn lever_simulation_document(
    file: &LeverTrajectoryFile,
    outcome: &LeverOutcome,
    name: &str,
) -> Document {
    let LeverTrajectoryFile { task, tool, plan, motion, .. } = file;
    let time = motion.frames.last().map_or(0.0, |frame| frame.time);
    let force = motion.frames.iter().map(|frame| frame.force).fold(0.0, f64::max);
    let figure = lever_figure(task, (tool, plan), motion, &[], name);
    let end = Section {
        table: outcome_table([("3-D".to_owned(), outcome)]),
        lines: vec![format!(
            "{} frames, {time:.2} s; at most {force:.1} N on the blade; {}",
            motion.frames.len(),
            goal_line(task)
        )],
        figures: vec![figure],
        ..Section::default()
    };
    Document {
        title: plan_line(task, plan),
        sections: vec![lever_section(plan), end],
        json: json!({
            "task": task.name, "plan": plan, "frames": motion.frames.len(), "outcome": outcome,
        }),
        ..Document::default()
    }
}
