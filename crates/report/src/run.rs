//! Report on a run: its pushes, the belief over time, and the outcome.

use serde_json::json;

use pushplan::geometry::Pose;
use pushplan::{
    outcome::{Frame, Trajectory},
    scene::{ModelKind, Physics, Scene, State},
    task::ToolMotion,
};
use pushplan_act::act::{End, Step, Trace, Why};
use pushplan_act::belief::JointType;

use super::chart::{Axis, Chart, Mark, Series};
use super::document::{Document, Figure, Section};
use super::number::{degrees, millimetres};
use super::picture::{ScenePicture, Source, Track};
use super::plan_text::goal_line;
use super::table::{
    Align::{Left, Right},
    NONE, Table,
};

/// Returns a report on a run. Its figures are `<task>.run.svg` (pushes) and `<task>.belief.svg`
/// (belief).
pub fn run_document(trace: &Trace) -> Document {
    let task = &trace.task;
    let steps = Section {
        table: steps(trace),
        lines: notes(trace),
        figures: vec![picture(trace)],
        ..Section::default()
    };
    let mut sections = vec![steps];
    sections.extend(joints(trace));
    sections.extend(numbers(trace));
    let real = trace.real().map(|state| task.goals[0].error(&state));
    Document {
        title: format!("{}: {}", task.name, headline(trace)),
        notes: vec![format!("goal: {}", goal_line(task)), format!("unknown: {}", task.unknown)],
        sections,
        json: json!({
            "task": task.name,
            "end": trace.end,
            "broken": trace.broken,
            "pushes": trace.pushes(),
            "probes": trace.steps.iter().filter(|step| step.why == Why::Probe).count(),
            "seen_error": seen(trace).map(|state| task.goals[0].error(&state)),
            "real_error": real,
            "really_reached": trace.real().map(|state| task.goals[0].reached(&state)),
            "steps": trace.steps.iter().map(|step| json!({
                "why": step.why,
                "tool": step.tool.name,
                "pushes": step.plan.pushes().get(..step.pushes),
                "grip_yaw": step.plan.grip_yaw(),
                "chance": step.chance,
                "notes": step.notes,
                "state": step.state,
                "probabilities": step.probabilities,
                "numbers": step.numbers,
            })).collect::<Vec<_>>(),
        }),
        ..Document::default()
    }
}

/// Formats the outcome in one line.
pub fn headline(trace: &Trace) -> String {
    let pushes = match trace.pushes() {
        0 => "without a push".to_owned(),
        1 => "after 1 push".to_owned(),
        count => format!("after {count} pushes"),
    };
    let end = match trace.end {
        Some(End::Reached) => "reached",
        Some(End::BudgetExhausted | End::NoImprovingPush) => "not reached",
        Some(End::RuleBroken) => "stopped",
        None => "not finished",
    };
    let reason = match (trace.end, &trace.broken) {
        (Some(End::BudgetExhausted), _) => ", because the push budget is exhausted".to_owned(),
        (Some(End::NoImprovingPush), _) => ", because no push reduces the error".to_owned(),
        (_, Some(rule)) => format!(", because {rule}"),
        _ => String::new(),
    };
    let off = |what: &str, state: Option<State>| {
        state.map(|state| format!("{} ({what})", millimetres(trace.task.goals[0].error(&state))))
    };
    let off: Vec<String> =
        [off("observed", seen(trace)), off("true", trace.real())].into_iter().flatten().collect();
    match off.is_empty() {
        true => format!("{end} {pushes}{reason}"),
        false => format!("{end} {pushes}{reason}; error {}", off.join(", ")),
    }
}

/// Returns the estimated final state.
fn seen(trace: &Trace) -> Option<State> {
    trace.steps.last().map(|step| step.state.clone())
}

/// Returns a table of the pushes.
pub fn steps(trace: &Trace) -> Table {
    let goal = &trace.task.goals[0];
    let push = |step: &Step| step.plan.pushes().first().copied();
    let real = |step: &Step| step.world.as_ref().map(|world| goal.error(&world.state));
    Table::of(
        trace.steps.iter().enumerate(),
        &[
            ("push", Right, &|(k, _)| (k + 1).to_string()),
            ("why", Left, &|(_, step)| why(step.why).to_owned()),
            ("tool", Left, &|(_, step)| step.tool.name.clone()),
            ("direction", Right, &|(_, step)| {
                push(step).map_or(NONE.to_owned(), |push| degrees(push.direction))
            }),
            ("length", Right, &|(_, step)| {
                push(step).map_or(NONE.to_owned(), |push| millimetres(push.length))
            }),
            ("pushes remaining", Right, &|(_, step)| {
                step.plan.pushes().len().saturating_sub(step.pushes).to_string()
            }),
            ("success probability", Right, &|(_, step)| {
                format!("{:.0} %", 100.0 * step.chance.share)
            }),
            ("error, observed", Right, &|(_, step)| millimetres(goal.error(&step.state))),
            ("error, true", Right, &|(_, step)| real(step).map_or(NONE.to_owned(), millimetres)),
        ],
    )
}

fn why(why: Why) -> &'static str {
    match why {
        Why::Plan => "plan",
        Why::Rest => "remaining plan",
        Why::Best => "best on average",
        Why::Approach => "approach",
        Why::Probe => "exploratory",
    }
}

/// Returns the warnings about observations.
pub fn notes(trace: &Trace) -> Vec<String> {
    let steps = trace.steps.iter().enumerate();
    let of = |(k, step): (usize, &Step)| {
        step.notes
            .iter()
            .map(|note| format!("push {}: {}", k + 1, note.words(&trace.task.scene)))
            .collect::<Vec<_>>()
    };
    steps.flat_map(of).collect()
}

/// Returns a section on the belief about joints, with its history.
fn joints(trace: &Trace) -> Option<Section> {
    let last = trace.steps.last()?;
    let count = trace.task.scene.objects.len();
    let pairs: Vec<[usize; 2]> =
        trace.pairs.iter().copied().filter(|pair| pair.iter().all(|&k| k < count)).collect();
    if pairs.is_empty() || pairs.len() != last.probabilities.len() {
        return None;
    }
    let name = |[a, b]: [usize; 2]| {
        let objects = &trace.task.scene.objects;
        format!("{} and {}", objects[a].name, objects[b].name)
    };
    let share = |k: usize| move |shares: &[f64; 4]| format!("{:.1} %", 1e2 * shares[k]);
    let truth = |between: [usize; 2]| {
        let truth = trace.truth.as_ref()?;
        let mut joints = truth.scene.joints.iter();
        let is = |joint: [usize; 2]| joint == between || joint == [between[1], between[0]];
        Some(JointType::of(joints.find(|joint| is(joint.between))).to_string())
    };
    let mut table = Table::new([
        ("objects", Left),
        ("none", Right),
        ("fixed", Right),
        ("revolute", Right),
        ("prismatic", Right),
        ("true joint", Left),
    ]);
    for (between, shares) in pairs.iter().zip(&last.probabilities) {
        let mut cells = vec![name(*between)];
        cells.extend((0..4).map(|k| share(k)(shares)));
        cells.push(truth(*between).unwrap_or(NONE.to_owned()));
        table.row(cells);
    }
    let series = pairs.iter().zip(&last.probabilities).enumerate().map(|(p, (between, shares))| {
        let most = (0..4).max_by(|&a, &b| shares[a].total_cmp(&shares[b])).unwrap_or(0);
        let over_time = std::iter::once(&trace.prior)
            .chain(trace.steps.iter().map(|step| &step.probabilities))
            .enumerate()
            .filter_map(|(k, shares)| Some([k as f64, 1e2 * shares.get(p)?[most]]));
        Series {
            name: format!("{}: {}", name(*between), JointType::ALL[most]),
            points: over_time.collect(),
            mark: Mark::DottedLine,
            labels: Vec::new(),
        }
    });
    let chart = Chart {
        title: "Probability of the final joint estimate".into(),
        x: Axis { label: "pushes".into(), log: false },
        y: Axis { label: "probability, %".into(), log: false },
        series: series.collect(),
    };
    let figures = vec![Figure::chart(format!("{}.belief", trace.task.name), chart)];
    Some(Section { title: "joints".into(), table, figures, ..Section::default() })
}

/// Returns a section on the belief about masses, frictions and supports.
fn numbers(trace: &Trace) -> Option<Section> {
    let (last, unknown) = (trace.steps.last()?, trace.task.unknown);
    if !unknown.numbers() {
        return None;
    }
    let scene = &trace.task.scene;
    let truth = trace.truth.as_ref().map(|truth| Physics::stated(&truth.scene));
    let believed = |[mean, sd]: [f64; 2]| format!("{mean:.2} \u{00b1} {sd:.2}");
    let really = |value: &dyn Fn(&Physics) -> f64| {
        truth.as_ref().map_or(NONE.to_owned(), |truth| format!("{:.2}", value(truth)))
    };
    let mut table = Table::new([
        ("", Left),
        ("mass, kg", Right),
        ("true", Right),
        ("friction", Right),
        ("true", Right),
    ]);
    for (k, object) in scene.things() {
        let (Some(mass), Some(friction)) =
            (last.numbers.masses.get(k), last.numbers.frictions.get(k))
        else {
            continue;
        };
        table.row([
            object.name.clone(),
            believed(*mass),
            really(&|truth| scene.mass_in(truth, k)),
            believed(*friction),
            really(&|truth| truth.frictions[k]),
        ]);
    }
    table.row([
        "table".to_owned(),
        NONE.to_owned(),
        NONE.to_owned(),
        believed(last.numbers.table_friction),
        really(&|truth| truth.table_friction),
    ]);
    Some(Section { title: "masses and friction values".into(), table, ..Section::default() })
}

/// Draws the pushes and the final poses of the objects.
fn picture(trace: &Trace) -> Figure {
    let task = &trace.task;
    let start = trace.before.as_ref().map_or(task.scene.start(), |before| before.state.clone());
    let states = trace.steps.iter().map(|step| match &step.world {
        Some(world) => world.state.clone(),
        None => step.state.clone(),
    });
    let states: Vec<State> = std::iter::once(start).chain(states).collect();
    let motions: Vec<ToolMotion> = trace.steps.iter().map(Step::motion).collect();
    let first = motions.iter().find_map(|motion| motion.strokes.first());
    let frames = states.iter().enumerate().map(|(k, state)| Frame {
        blade: None,
        time: k as f64,
        stroke: k.saturating_sub(1),
        tool: first.map_or(Pose::default(), |stroke| stroke.from),
        state: state.clone(),
    });
    let trajectory =
        Trajectory { frames: frames.collect(), ..Trajectory::new(ModelKind::Still.into()) };
    let source = match &trace.truth {
        Some(truth) => Source::Simulated(truth.engine),
        None => Source::Seen,
    };
    // Hidden joints are drawn from ground truth.
    let joints = trace.truth.as_ref().map_or(&task.scene.joints, |truth| &truth.scene.joints);
    let scene = Scene { joints: joints.clone(), ..task.scene.clone() };
    let picture = ScenePicture {
        title: format!("{}: {}", task.name, headline(trace)),
        notes: vec![format!("unknown: {}", task.unknown)],
        scene: &scene,
        goals: task.shown_goals(),
        reach: Some(task.annulus()),
        motions: &motions,
        tracks: vec![Track { source, trajectory: &trajectory }],
    };
    Figure::svg(format!("{}.run", task.name), picture.to_svg())
}
