//! Pages of one plan: replayed for a verdict, or predicted next to simulated.

use std::sync::Arc;

use serde_json::{Value as Json, json};

use crate::number::millimetres;
use crate::plan_picture::space_figures;
use crate::plan_text::plan_line;
use crate::second_opinion::Judged;
use crate::verdict::{replay_warnings, verdict_line};
use pushplan::asset::{PLAN_VERSION, PlanFile};
use pushplan::{
    outcome::{Outcome, Trajectory, Verdict},
    scene::{Engine, Tool},
    task::{Job, Mark, Plan, Task, ToolMotion},
};

use super::data::{self, Data, File, Layer, Replay, Standing, Stroke, length, pose};
use super::html::{self, PageView};
use super::recipe::Recipe;
use super::replay::{ends, graph, layer_of, replay, replays, sound};
use super::{space, stage};

/// Returns the page of a replayed plan. `predicted` is the trajectory of its effect model, if it
/// was computed, and `recipe` repeats the replays.
pub fn verdict_page<'a>(
    file: &PlanFile,
    predicted: Option<&Trajectory>,
    judged: impl Into<Judged<'a>>,
    recipe: Recipe,
    view: PageView,
) -> String {
    let Judged { verdict, second } = judged.into();
    let task = &file.task;
    let mut making = Making::of(task, plan_line(&file.plan));
    let space = making.drawing(&file.plan, &file.tools, verdict);
    let plan = making.plan(&file.tools, &file.plan, recipe);
    plan.standing = standing(verdict);
    plan.verdict = verdict_line(task, Some(verdict));
    if let Some(second) = second {
        plan.verdict += &format!(". {}", second.line());
    }
    let shown = predicted.map(|trajectory| {
        let reached = Outcome::judge(&task.scene, task, trajectory).reached;
        (Layer::Predicted, trajectory, reached)
    });
    let own = (&file.plan, &file.tools[..]);
    let shown = shown.into_iter().chain(replays(verdict));
    plan.replays.extend(shown.filter_map(|one| shown_replay(task, own, one)));
    plan.ends = ends(task, verdict);
    making.data.warnings = replay_warnings(verdict);
    making.data.drawing = space;
    html::page(&making.data, view)
}

/// Returns a trajectory as shown on the page; with 3-D poses if an object leaves the plane.
pub(super) fn shown_replay(
    task: &Task,
    (plan, tools): (&Plan, &[Arc<Tool>]),
    (layer, trajectory, reached): (Layer, &Trajectory, bool),
) -> Option<Replay> {
    if trajectory.outcome().space.is_some() {
        return space::replay(layer, task, plan, trajectory, reached);
    }
    let mut replay = replay(layer, trajectory, reached)?;
    let goal = &task.goals[0];
    // The script measures distances from a position only, so other errors are included.
    let marks = goal.shown(&task.scene).marks;
    let measured = marks.iter().filter(|mark| matches!(mark, Mark::Disc { .. })).count() == 1;
    if !measured || goal.is_relation() || goal.relative().is_some() {
        replay.measure = sound(&trajectory.frames).map(|f| length(goal.error(&f.state))).collect();
    }
    // With a single tool, the graph's part nodes are the parts of that tool.
    if let (Layer::Predicted, Some([motion])) = (layer, plan.slides(tools).as_deref()) {
        let job = Job::stated(&task.scene, motion.clone());
        replay.graph = graph(&task.scene, &job, trajectory);
    }
    Some(replay)
}

fn is_in_space(task: &Task, plan: &Plan) -> bool {
    task.in_space() || plan.levers()
}

/// Returns the page of pushes predicted by several models, frame by frame; `recipe` repeats the
/// predictions.
pub fn prediction_page(
    task: &Task,
    tools: &[Arc<Tool>],
    plan: &Plan,
    trajectories: &[Trajectory],
    recipe: Recipe,
    view: PageView,
) -> String {
    let mut making = Making::of(task, plan_line(plan));
    let drawing = trajectories.last().and_then(|last| making.drawn(plan, tools, last, ""));
    let page = making.plan(tools, plan, recipe);
    let mut ends = Vec::new();
    for (k, trajectory) in trajectories.iter().enumerate() {
        let outcome = Outcome::judge(&task.scene, task, trajectory);
        let end = match (outcome.state.space.is_some(), outcome.reached) {
            (false, _) => millimetres(outcome.error()),
            (true, true) => "reaches the goal".to_owned(),
            (true, false) => "misses the goal".to_owned(),
        };
        ends.push(format!("{} {end}", trajectory.by));
        // A model that delegates a job to an engine still counts as the predicting model.
        let own = layer_of(trajectory);
        let twice = trajectories[k + 1..].iter().any(|other| layer_of(other) == own);
        let layer = if twice { Layer::Predicted } else { own };
        let one = (layer, trajectory, outcome.reached);
        page.replays.extend(shown_replay(task, (plan, tools), one));
    }
    page.verdict = match task.goals[0].has_place() {
        true => {
            let allowed = millimetres(task.goals[0].tolerance());
            format!("error: {}; allowed {allowed}", ends.join(", "))
        }
        false => ends.join(", "),
    };
    making.data.drawing = drawing;
    for trajectory in trajectories {
        let line = |warning| format!("{}: {warning}", trajectory.by);
        making.data.warnings.extend(trajectory.warnings.iter().map(line));
    }
    html::page(&making.data, view)
}

/// Returns the status of a plan according to its verdict.
pub fn standing(verdict: &Verdict) -> Standing {
    match (verdict.passed, verdict.nominal_ok()) {
        (true, _) => Standing::Passed,
        (false, true) => Standing::Fragile,
        (false, false) => Standing::Failed,
    }
}

/// Page under construction.
pub struct Making<'a> {
    task: &'a Task,
    pub data: Data,
}

impl<'a> Making<'a> {
    /// Returns a page without plans.
    pub fn of(task: &'a Task, headline: String) -> Self {
        let data = Data {
            task: task.name.clone(),
            description: task.description.clone(),
            models: String::new(),
            headline,
            stage: stage::stage(task),
            measure: None,
            tools: Vec::new(),
            plans: Vec::new(),
            columns: Vec::new(),
            choice: Vec::new(),
            candidates: None,
            found: Vec::new(),
            run: None,
            warnings: Vec::new(),
            file: File { schema_version: PLAN_VERSION, task: Json::Null },
            drawing: None,
        };
        Self { task, data }
    }

    /// Returns the index of a tool with this file; a new tool is added.
    pub fn tool(&mut self, tool: &Tool, file: Json) -> usize {
        let known = self.data.tools.iter().position(|known| known.name == tool.name);
        known.unwrap_or_else(|| {
            self.data.tools.push(stage::tool(tool, file));
            self.data.tools.len() - 1
        })
    }

    /// Returns a drawing of the 3-D replay of a verdict.
    pub fn drawing(&self, plan: &Plan, tools: &[Arc<Tool>], verdict: &Verdict) -> Option<String> {
        let replay = verdict.nominal(Engine::Spatial)?.trajectory.as_ref()?;
        self.drawn(plan, tools, replay, &verdict_line(self.task, Some(verdict)))
    }

    /// Returns a drawing of a 3-D motion, with a line below its title.
    fn drawn(
        &self,
        plan: &Plan,
        tools: &[Arc<Tool>],
        trajectory: &Trajectory,
        line: &str,
    ) -> Option<String> {
        if !is_in_space(self.task, plan) {
            return None;
        }
        let lines: Vec<String> =
            Some(line).filter(|line| !line.is_empty()).map(str::to_owned).into_iter().collect();
        let named = ("", false);
        let figures = space_figures(self.task, (plan, tools), trajectory, &lines, named);
        figures.first().map(|figure| figure.to_svg())
    }

    /// Adds a plan; the caller sets its replays and verdict.
    pub fn plan(&mut self, tools: &[Arc<Tool>], plan: &Plan, recipe: Recipe) -> &mut data::Plan {
        let file = PlanFile::new(self.task.clone(), tools.to_vec(), plan.clone());
        let mut file = serde_json::to_value(&file).unwrap_or_default();
        let mut part = |key: &str| file.get_mut(key).map_or(Json::Null, Json::take);
        self.data.file.task = part("task");
        let files = part("tools");
        let known: Vec<usize> = tools
            .iter()
            .enumerate()
            .map(|(k, tool)| self.tool(tool, files.get(k).cloned().unwrap_or_default()))
            .collect();
        let index = |name: &str| {
            let place = tools.iter().position(|tool| tool.name == name);
            place.map_or(0, |place| known[place])
        };
        let first = known.first().copied().unwrap_or(0);
        let in_space = is_in_space(self.task, plan);
        if in_space {
            self.data.measure = Some(space::measure(plan));
        }
        let strokes = strokes_of(self.task, (plan, tools), &index);
        self.data.plans.push(data::Plan {
            tool: first,
            tools: known,
            name: plan_line(plan),
            standing: Standing::Open,
            verdict: String::new(),
            cells: Vec::new(),
            strokes,
            replays: Vec::new(),
            ends: Vec::new(),
            lift: if in_space { 0 } else { length(plan.lift()) },
            hand: tools.first().and_then(|tool| stage::hand(self.task, tool, plan)),
            command: recipe.command,
            python: recipe.python,
            file: part("plan"),
        });
        let last = self.data.plans.len() - 1;
        &mut self.data.plans[last]
    }
}

/// Returns the strokes of a plan, with the indices of tools by name.
fn strokes_of(
    task: &Task,
    (plan, tools): (&Plan, &[Arc<Tool>]),
    index: &dyn Fn(&str) -> usize,
) -> Vec<Stroke> {
    if is_in_space(task, plan) {
        return space::strokes(plan, tools, index);
    }
    let motions = plan.slides(tools).unwrap_or_default();
    let own = |motion: &ToolMotion| strokes(motion, index(&motion.tool.name));
    motions.iter().flat_map(own).collect()
}

/// Returns tools, strokes and hand of a plan as JSON, for drawing outside the page: lengths in
/// hundredths of a millimetre, angles in ten-thousandths of a radian. A plan with lever-ups has no
/// strokes.
pub fn plan_stage(task: &Task, plan: &Plan, tools: &[Arc<Tool>]) -> Json {
    let index = |name: &str| tools.iter().position(|tool| tool.name == name).unwrap_or(0);
    let strokes = match plan.levers() {
        true => Vec::new(),
        false => strokes_of(task, (plan, tools), &index),
    };
    let drawn: Vec<data::Tool> = tools.iter().map(|tool| stage::tool(tool, Json::Null)).collect();
    let hand = tools.first().and_then(|tool| stage::hand(task, tool, plan));
    json!({"tools": drawn, "strokes": strokes, "hand": hand})
}

/// Returns the strokes of a motion with the tool of this index.
pub fn strokes(motion: &ToolMotion, tool: usize) -> Vec<Stroke> {
    let mut lowered = true;
    let stroke = |stroke: &pushplan::task::Stroke| Stroke {
        tool,
        from: pose(&stroke.from),
        to: pose(&stroke.to),
        lowered: std::mem::replace(&mut lowered, stroke.settle),
    };
    motion.strokes.iter().map(stroke).collect()
}
