//! The page of a run: successive pushes on one clock, with the prediction at selection, the
//! outcome, and the belief over time.

use serde_json::Value as Json;

use crate::plan_text::engine_name;
use crate::run::{headline, notes, steps};
use crate::table::Align;
use pushplan::geometry::{Pose, wrap_angle};
use pushplan::{
    outcome::{Frame, Trajectory},
    scene::{ObservedPose, State},
    task::{Stroke, ToolMotion},
};
use pushplan_act::act::{End, Look, Step, Trace, Why};

use super::believed::{joints, numbers};
use super::data::{self, Layer, Made, Run, Standing, fine, length};
use super::html::{self, PageView};
use super::recipe::Recipe;
use super::replay::replay_of;
use super::replayed::{Making, strokes};
use super::stage;

/// Returns the page of a run. `real` is the ground truth of every step in a simulated world;
/// otherwise the observations are shown. `recipe` repeats the run.
pub fn run_page(trace: &Trace, real: &[Trajectory], recipe: Recipe, view: PageView) -> String {
    let mut making = Making::of(&trace.task, headline(trace));
    let motions: Vec<ToolMotion> = trace.steps.iter().map(Step::motion).collect();
    let mut drawn = Vec::new();
    for motion in &motions {
        let tool = making.tool(&motion.tool, Json::Null);
        drawn.extend(strokes(motion, tool));
    }
    let clock = Clock::new(trace, &motions, real);
    making.data.plans.push(data::Plan {
        tools: Vec::new(),
        tool: drawn.first().map_or(0, |stroke: &data::Stroke| stroke.tool),
        name: name(trace),
        standing: match trace.end {
            Some(End::Reached) => Standing::Reached,
            Some(End::BudgetExhausted | End::NoImprovingPush | End::RuleBroken) => {
                Standing::GivenUp
            }
            None => Standing::Open,
        },
        verdict: headline(trace),
        cells: Vec::new(),
        strokes: drawn,
        replays: replays(trace, &clock),
        ends: Vec::new(),
        command: recipe.command,
        python: recipe.python,
        hand: trace.steps.first().and_then(|one| stage::hand(&trace.task, &one.tool, &one.plan)),
        lift: trace.steps.first().map_or(0, |step| length(step.plan.lift())),
        file: Json::Null,
    });
    making.data.run = Some(run(trace, &clock.starts));
    making.data.warnings = notes(trace);
    html::page(&making.data, view)
}

fn run(trace: &Trace, starts: &[f64]) -> Run {
    let table = steps(trace);
    let rows = table.rows().iter().zip(starts);
    let (types, joints) = joints(trace);
    Run {
        kind: "Run",
        words: "Initial belief, updated after every push.",
        columns: table.columns().iter().map(|(name, _)| name.clone()).collect(),
        numeric: table.columns().iter().map(|(_, side)| *side == Align::Right).collect(),
        made: rows.map(|(cells, at)| Made { at: fine(*at), cells: cells.clone() }).collect(),
        times: starts.iter().map(|at| fine(*at)).collect(),
        types,
        joints,
        numbers: numbers(trace),
    }
}

/// Describes pushes and tools in one line.
fn name(trace: &Trace) -> String {
    let mut tools: Vec<&str> = Vec::new();
    for step in &trace.steps {
        if !tools.contains(&step.tool.name.as_str()) {
            tools.push(&step.tool.name);
        }
    }
    let probes = trace.steps.iter().filter(|step| step.why == Why::Probe).count();
    let pushes = match trace.pushes() {
        0 => return "no push".to_owned(),
        1 => "1 push".to_owned(),
        count => format!("{count} pushes"),
    };
    let probes = match probes {
        0 => String::new(),
        1 => ", 1 of them exploratory".to_owned(),
        count => format!(", {count} of them exploratory"),
    };
    format!("{pushes} with {}{probes}", tools.join(" and "))
}

/// Successive steps with their trajectories and start times.
struct Clock {
    predicted: Vec<Vec<Frame>>,
    /// Ground truth, or observations without it.
    came: Vec<Vec<Frame>>,
    layer: Layer,
    /// Start time of every step, then the end of the run, seconds.
    starts: Vec<f64>,
    /// Index of the first stroke of every step.
    strokes: Vec<usize>,
}

impl Clock {
    fn new(trace: &Trace, motions: &[ToolMotion], real: &[Trajectory]) -> Self {
        let simulated = trace.truth.is_some() && real.len() == trace.steps.len();
        let came: Vec<Vec<Frame>> = match simulated {
            true => real.iter().map(|trajectory| trajectory.frames.clone()).collect(),
            false => (0..motions.len()).map(|k| seen(trace, k, &motions[k])).collect(),
        };
        let predicted: Vec<Vec<Frame>> =
            trace.steps.iter().map(|step| step.predicted.clone()).collect();
        let last = |frames: &[Frame]| frames.last().map_or(0.0, |frame| frame.time);
        let (mut starts, mut first) = (vec![0.0], Vec::new());
        for (k, motion) in motions.iter().enumerate() {
            let whole = motion.strokes.iter().map(|stroke: &Stroke| stroke.duration).sum::<f64>();
            starts.push(starts[k] + whole.max(last(&came[k])).max(last(&predicted[k])));
            first.push(motions[..k].iter().map(|motion| motion.strokes.len()).sum());
        }
        let layer = if simulated { Layer::Real } else { Layer::Seen };
        Self { predicted, came, layer, starts, strokes: first }
    }

    /// Joins the frames of every step on one clock. Objects at rest stay so until the next push.
    fn joined(&self, parts: &[Vec<Frame>]) -> Vec<Frame> {
        let mut all: Vec<Frame> = Vec::new();
        for (k, part) in parts.iter().enumerate() {
            all.extend(part.iter().map(|frame| Frame {
                time: self.starts[k] + frame.time,
                stroke: self.strokes[k] + frame.stroke,
                ..frame.clone()
            }));
            let rest = all.last().map(|last| Frame { time: self.starts[k + 1], ..last.clone() });
            all.extend(rest);
        }
        all
    }
}

fn replays(trace: &Trace, clock: &Clock) -> Vec<data::Replay> {
    let goal = &trace.task.goals[0];
    let mut replays = Vec::new();
    let predicted = clock.joined(&clock.predicted);
    let reached = predicted.last().is_some_and(|last| goal.reached(&last.state));
    replays.extend(replay_of(Layer::Predicted, trace.planner.clone(), &predicted, reached));
    let by = match (&trace.truth, clock.layer) {
        (Some(truth), Layer::Real) => format!("{} simulation", engine_name(truth.engine)),
        _ => "observations".to_owned(),
    };
    let mut came = clock.joined(&clock.came);
    if came.is_empty() {
        let state = trace.real().unwrap_or_else(|| thought(trace, 0));
        came.push(Frame { time: 0.0, stroke: 0, tool: Pose::default(), state, blade: None });
    }
    let reached = came.last().is_some_and(|last| goal.reached(&last.state));
    replays.extend(replay_of(clock.layer, by, &came, reached));
    replays
}

/// Returns the observations of a step, frame by frame; unobserved objects keep their last pose.
fn seen(trace: &Trace, step: usize, motion: &ToolMotion) -> Vec<Frame> {
    let mut state = thought(trace, step);
    let frame = |time: f64, state: &State| {
        let (stroke, tool) = motion.at(time)?;
        Some(Frame { time, stroke, tool, state: state.clone(), blade: None })
    };
    let mut frames: Vec<Frame> = frame(0.0, &state).into_iter().collect();
    let own = &trace.steps[step];
    let mut looks: Vec<&Look> = own.looks.iter().filter(|look| look.time > 0.0).collect();
    looks.sort_by(|a, b| a.time.total_cmp(&b.time));
    for look in looks {
        for (pose, sight) in state.poses.iter_mut().zip(&look.seen) {
            if let Some(ObservedPose { position, heading }) = sight {
                let turn = heading.map_or(0.0, |heading| wrap_angle(heading - pose.heading));
                *pose = Pose { position: *position, heading: pose.heading + turn };
            }
        }
        frames.extend(frame(look.time, &state));
    }
    let end = frames.last().map_or(0.0, |last| last.time);
    frames.extend(frame(end, &own.state));
    frames
}

/// Returns the estimated state before a step.
fn thought(trace: &Trace, step: usize) -> State {
    if let Some(before) = step.checked_sub(1) {
        return trace.steps[before].state.clone();
    }
    let mut state = trace.task.scene.start();
    let seen = trace.first.iter().flat_map(|look| &look.seen);
    for (pose, sight) in state.poses.iter_mut().zip(seen) {
        if let Some(sight) = sight {
            *pose =
                Pose { position: sight.position, heading: sight.heading.unwrap_or(pose.heading) };
        }
    }
    state
}
