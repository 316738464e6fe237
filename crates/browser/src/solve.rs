//! Solving of a task.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use pushplan::asset::{PlanFile, parse_task};
use pushplan::solve::Settings;
use pushplan::{Effort, Planner, Situation, Solution, Task};
use pushplan_report::{
    Origin, PageView, TaskSource, plan_stage, solution_document, solution_page, solution_title,
};
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
/// task, or empty. `effort` is `first look`, `draft`, `standard` or `thorough`.
///
/// # Errors
/// Returns the faults of the task, or an error for an unknown effort.
#[wasm_bindgen]
pub fn solve(text: &str, file: &str, example: &str, effort: &str) -> Result<Solved, String> {
    let library = library()?;
    let task = parse_task(text, file, library).map_err(|faults| faults.to_string())?;
    let planner = planner(effort)?;
    let solution = match effort {
        // Without the cause of a failure, which takes longer than the look itself.
        FIRST_LOOK => {
            let situation = Situation::stated(&task.scene);
            planner.solve_from(&situation, &task, library, &WorkerProgress)
        }
        _ => planner.solve_with(&task, library, &WorkerProgress),
    };
    let solution = solution.map_err(|error| error.to_string())?;
    let source = match example {
        "" => TaskSource::File(file.to_owned()),
        name => TaskSource::Example(name.to_owned()),
    };
    Ok(Solved { task, source, solution })
}

/// Name of the effort with [`Settings::FIRST_LOOK`], for tasks that are being edited.
const FIRST_LOOK: &str = "first look";

/// Returns the planner of an effort; each is built once, because reading the weights takes longer
/// than some drafts.
fn planner(effort: &str) -> Result<Arc<Planner>, String> {
    static BUILT: Mutex<BTreeMap<String, Arc<Planner>>> = Mutex::new(BTreeMap::new());
    let mut built = BUILT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(planner) = built.get(effort) {
        return Ok(Arc::clone(planner));
    }
    let known = Effort::ALL.into_iter().find(|one| one.to_string() == effort);
    let known = known.or((effort == FIRST_LOOK).then_some(Effort::Draft));
    let known = known.ok_or("the effort must be first look, draft, standard or thorough")?;
    let builder = Planner::for_effort(known).map_err(|error| error.to_string())?;
    let builder = match effort {
        FIRST_LOOK => builder.settings(Settings::FIRST_LOOK),
        _ => builder,
    };
    let planner = Arc::new(builder.build());
    built.insert(effort.to_owned(), Arc::clone(&planner));
    Ok(planner)
}

#[wasm_bindgen]
impl Solved {
    /// Returns a summary as JSON: `status`, a `headline`, the best plan as drawn by a page, and its
    /// final state in metres and radians.
    pub fn summary(&self) -> String {
        let best = self.solution.best();
        json!({
            "status": self.solution.status,
            "headline": solution_title(&self.task, &self.solution),
            "tool": best.map(|best| best.plan.tools().join(", ")),
            "drawn": best.map(|best| plan_stage(&self.task, &best.plan, &best.tools)),
            "ends": best.map(|best| &best.outcome.state),
            "error": best.map(|best| best.outcome.error()),
            "seconds": self.solution.statistics.timing.total,
        })
        .to_string()
    }

    /// Returns the text that the command prints.
    pub fn text(&self) -> String {
        solution_document(&self.task, &self.solution).to_text()
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
}
