//! The pages of one plan: replayed for a verdict, or predicted next to simulated.

use std::sync::Arc;

use serde_json::Value as Json;

use crate::asset::{PlanFile, SCHEMA_VERSION};
use crate::report::number::millimetres;
use crate::report::plan_text::plan_line;
use crate::report::verdict::{replay_warnings, verdict_line};
use crate::scene::{Outcome, Plan, Task, Tool, ToolMotion, Trajectory, Verdict};

use super::data::{self, Data, File, Layer, Standing, Stroke, length, pose};
use super::html::{self, PageView};
use super::recipe::Recipe;
use super::replay::{ends, layer_of, replay, replays};
use super::stage;

/// The page of a plan that was replayed. `predicted` is what its effect model says, if that was
/// asked; `recipe` makes the replays again.
pub fn verdict_page(
    file: &PlanFile,
    predicted: Option<&Trajectory>,
    verdict: &Verdict,
    recipe: Recipe,
    view: PageView,
) -> String {
    let task = &file.task;
    let mut making = Making::of(task, plan_line(&file.plan));
    let plan = making.plan(&file.tool, &file.plan, recipe);
    plan.standing = standing(verdict);
    plan.verdict = verdict_line(task, Some(verdict));
    plan.replays.extend(predicted.and_then(|trajectory| {
        replay(Layer::Predicted, trajectory, Outcome::judge(&task.goal, trajectory).reached)
    }));
    plan.replays.extend(replays(verdict));
    plan.ends = ends(task, verdict);
    making.data.warnings = replay_warnings(verdict);
    html::page(&making.data, view)
}

/// The page of pushes as several models see them, each frame by frame; `recipe` makes it again.
pub fn prediction_page(
    task: &Task,
    tool: &Arc<Tool>,
    plan: &Plan,
    trajectories: &[Trajectory],
    recipe: Recipe,
    view: PageView,
) -> String {
    let mut making = Making::of(task, plan_line(plan));
    let page = making.plan(tool, plan, recipe);
    let mut ends = Vec::new();
    for (k, trajectory) in trajectories.iter().enumerate() {
        let outcome = Outcome::judge(&task.goal, trajectory);
        ends.push(format!("{} {}", trajectory.by, millimetres(outcome.error)));
        // A model that hands a job to an engine is still the one that predicts.
        let own = layer_of(trajectory);
        let twice = trajectories[k + 1..].iter().any(|other| layer_of(other) == own);
        let layer = if twice { Layer::Predicted } else { own };
        page.replays.extend(replay(layer, trajectory, outcome.reached));
    }
    let allowed = millimetres(task.goal.tolerance);
    page.verdict = format!("error: {}; allowed {allowed}", ends.join(", "));
    for trajectory in trajectories {
        let line = |warning| format!("{}: {warning}", trajectory.by);
        making.data.warnings.extend(trajectory.warnings.iter().map(line));
    }
    html::page(&making.data, view)
}

/// How good a plan is by its verdict.
pub fn standing(verdict: &Verdict) -> Standing {
    match (verdict.passed, verdict.works()) {
        (true, _) => Standing::Passed,
        (false, true) => Standing::Fragile,
        (false, false) => Standing::Failed,
    }
}

/// A page in the making.
pub struct Making<'a> {
    task: &'a Task,
    pub data: Data,
}

impl<'a> Making<'a> {
    /// A page without plans.
    pub fn of(task: &'a Task, headline: String) -> Self {
        let data = Data {
            task: task.name.clone(),
            description: task.description.clone(),
            headline,
            stage: stage::stage(task),
            measure: None,
            tools: Vec::new(),
            plans: Vec::new(),
            columns: Vec::new(),
            choice: Vec::new(),
            candidates: None,
            run: None,
            warnings: Vec::new(),
            file: File { schema_version: SCHEMA_VERSION, task: Json::Null },
            drawing: None,
        };
        Self { task, data }
    }

    /// Index of a tool, whose file this is; it is added if it is new.
    pub fn tool(&mut self, tool: &Tool, file: Json) -> usize {
        let known = self.data.tools.iter().position(|known| known.name == tool.name);
        known.unwrap_or_else(|| {
            self.data.tools.push(stage::tool(tool, file));
            self.data.tools.len() - 1
        })
    }

    /// Adds a plan, whose replays and verdict are to be filled in.
    pub fn plan(&mut self, tool: &Arc<Tool>, plan: &Plan, recipe: Recipe) -> &mut data::Plan {
        let file = PlanFile {
            task: self.task.clone(),
            tool: Arc::clone(tool),
            plan: plan.clone(),
            model: None,
            predicted: None,
            verdict: None,
        };
        let mut file = serde_json::to_value(&file).unwrap_or_default();
        let mut part = |key: &str| file.get_mut(key).map_or(Json::Null, Json::take);
        self.data.file.task = part("task");
        let index = self.tool(tool, part("tool"));
        self.data.plans.push(data::Plan {
            tool: index,
            name: plan_line(plan),
            standing: Standing::Open,
            verdict: String::new(),
            cells: Vec::new(),
            strokes: strokes(&plan.motion(tool), index),
            replays: Vec::new(),
            ends: Vec::new(),
            lift: length(plan.lift),
            command: recipe.command,
            python: recipe.python,
            file: part("plan"),
        });
        let last = self.data.plans.len() - 1;
        &mut self.data.plans[last]
    }
}

/// The strokes of a motion with the tool of this index.
pub fn strokes(motion: &ToolMotion, tool: usize) -> Vec<Stroke> {
    let mut lowered = true;
    let stroke = |stroke: &crate::scene::Stroke| Stroke {
        tool,
        from: pose(&stroke.from),
        to: pose(&stroke.to),
        lowered: std::mem::replace(&mut lowered, stroke.settle),
    };
    motion.strokes.iter().map(stroke).collect()
}
