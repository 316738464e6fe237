//! Report on a proposed tool and its effect on the task.

use serde_json::json;

use pushplan::geometry::Vector;
use pushplan::solve::PlanStatus;
use pushplan::{
    scene::{Part, Tool},
    task::{Task, ToolChoice},
};
use pushplan_design::Design;

use super::document::{Document, Section};
use super::number::{degrees, millimetres};
use super::plan_text::point;
use super::solution::{headline, solution_document};
use super::table::{Align, Table};

/// Returns a report on the proposed tool, or the reason why none is proposed.
pub fn design_document(task: &Task, design: &Design) -> Document {
    let mut document = solution_document(task, design.best());
    let solution = std::mem::take(&mut document.json);
    let tool = design.proposal.as_ref().map(|proposal| &*proposal.tool);
    let known = headline(task, &design.known);
    match tool {
        Some(tool) => {
            let mut section = parts(tool);
            if task.tools != ToolChoice::All {
                section.lines.push(format!("to use it, add {} to `tools` in the task", tool.name));
            }
            document.sections.insert(0, section);
            document.notes.push(format!("existing tools: {known}"));
        }
        None => document.title = format!("{}: no new tool; {known}{}", task.name, why_none(design)),
    }
    let spent = &design.spent;
    if spent.looked_at > 0 {
        let line = format!(
            "tools: {} screened in {} rollouts, {} of them promising; task solved with {} of these",
            spent.looked_at, spent.rollouts, spent.promising, spent.solved
        );
        document.sections.push(Section { lines: vec![line], ..Section::default() });
    }
    document.json = json!({
        "task": task.name,
        "status": design.status(),
        "stopped": design.stopped,
        "tool": tool.map(Tool::to_json),
        "solution": solution,
        "known": solution_document(task, &design.known).json,
        "spent": design.spent,
    });
    document
}

/// Returns the reason why no tool is proposed, a clause after the result of the known tools.
fn why_none(design: &Design) -> &'static str {
    match (design.known.status, design.spent.looked_at) {
        _ if design.stopped => "; stopped before the search finished",
        (PlanStatus::Solved, 0) => "; no tool can solve it with more margin",
        (PlanStatus::Solved, _) => "; the search found no tool with more margin",
        _ => "; the search found no better tool",
    }
}

pub(crate) fn parts(tool: &Tool) -> Section {
    let size = |part: &&Part| {
        let across = |axis: Vector| part.footprint().extent(axis) + part.footprint().extent(-axis);
        let [x, y] = [Vector::x(), Vector::y()].map(across);
        [x, y, part.shape.height()].map(millimetres).join(" x ")
    };
    Section {
        title: format!(
            "Tool {}, gripped at its origin with a yaw of {}",
            tool.name,
            degrees(tool.grip.heading)
        ),
        table: Table::of(
            tool.parts(),
            &[
                ("part", Align::Left, &|part| part.name.clone()),
                ("size", Align::Left, &size),
                ("centre", Align::Left, &|part| point(part.pose.position)),
                ("rotation", Align::Right, &|part| degrees(part.pose.heading)),
            ],
        ),
        ..Section::default()
    }
}
