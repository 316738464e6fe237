//! Solving of a task.

use pushplan::asset::{PlanFile, parse_task};
use pushplan::{Effort, Planner, Situation, Solution, Task};
use pushplan_report::{Origin, PageView, TaskSource, solution_document, solution_page};
use serde_json::json;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::library;
use crate::progress::WorkerProgress;

/// A task and its solution.
#[wasm_bindgen]
pub struct Solved {
    task: Task,
    source: TaskSource,
    solution: Solution,
}

/// Solves the task of a text. `file` is the name of the text, and `example` the name of the shipped
/// task, or empty. `effort` is `draft`, `standard` or `thorough`.
///
/// # Errors
/// Returns the faults of the task.
#[wasm_bindgen]
pub fn solve(text: &str, file: &str, example: &str, effort: &str) -> Result<Solved, String> {
    let library = library()?;
    let task = parse_task(text, file, library).map_err(|faults| faults.to_string())?;
    let effort = Effort::ALL.into_iter().find(|one| one.to_string() == effort);
    let effort = effort.ok_or("the effort must be draft, standard or thorough")?;
    let planner = Planner::for_effort(effort).map_err(|error| error.to_string())?.build();
    let solution =
        planner.solve_with(&task, library, &WorkerProgress).map_err(|error| error.to_string())?;
    let source = match example {
        "" => TaskSource::File(file.to_owned()),
        name => TaskSource::Example(name.to_owned()),
    };
    Ok(Solved { task, source, solution })
}

#[wasm_bindgen]
impl Solved {
    /// Returns a summary as JSON: `status`, a `headline`, the pushes of the best plan in metres and
    /// radians, and their final state.
    pub fn summary(&self) -> String {
        let best = self.solution.best();
        json!({
            "status": self.solution.status,
            "headline": self.document().title,
            "tool": best.map(|best| best.plan.tools().join(", ")),
            "pushes": best.map(|best| best.plan.pushes()),
            "ends": best.map(|best| &best.outcome.state),
            "error": best.map(|best| best.outcome.error()),
            "seconds": self.solution.statistics.timing.total,
        })
        .to_string()
    }

    /// Returns the text that the command prints.
    pub fn text(&self) -> String {
        self.document().to_text()
    }

    /// Returns the page that plays the best plan and explains why others were rejected; empty
    /// without a plan.
    pub fn page(&self) -> String {
        let Some(best) = self.solution.best() else { return String::new() };
        let replays = best.replays(&self.task, &Situation::stated(&self.task.scene));
        let recipe = |ranked: &pushplan::RankedPlan| {
            let model = Some(ranked.predicted.by.clone());
            Origin { task: self.source.clone(), model, ..Origin::default() }.plan(&ranked.plan)
        };
        solution_page(&self.task, &self.solution, &replays, &recipe, PageView::Above)
    }

    /// Returns the best plan as a file; empty without a plan.
    pub fn plan(&self) -> String {
        let Some(best) = self.solution.best() else { return String::new() };
        let file = PlanFile {
            model: Some(best.predicted.by.clone()),
            predicted: Some(best.outcome.clone()),
            verdict: best.verdict.clone(),
            joints: best.joints.clone(),
            ..PlanFile::new(self.task.clone(), best.tools.clone(), best.plan.clone())
        };
        serde_json::to_string(&file).unwrap_or_default()
    }

    fn document(&self) -> pushplan_report::Document {
        solution_document(&self.task, &self.solution)
    }
}
