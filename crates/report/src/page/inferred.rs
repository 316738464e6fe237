//! The page of a recording: observations and the resulting belief, on one clock.

use serde_json::Value as Json;

use crate::document::{Document, Section};
use pushplan::recording::{RecordedFrame, Recording};
use pushplan::{outcome::Frame, scene::State};
use pushplan_act::belief::Belief;

use super::believed::over_time;
use super::data::{Data, File, Found, Layer, Plan, Run, Standing, Stroke, fine, length, pose};
use super::html::{self, PageView};
use super::recipe::Recipe;
use super::replay::replay_of;
use super::stage;

/// Returns the page of a recording and its belief. `before` holds the initial probabilities, in the
/// order of [`Belief::pairs`]. `document` contains the belief as tables, and `recipe` repeats the
/// inference.
pub fn recording_page(
    recording: &Recording,
    (before, belief): (&[[f64; 4]], &Belief),
    document: &Document,
    recipe: Recipe,
    view: PageView,
) -> String {
    let names: Vec<&str> =
        recording.scene.objects.iter().map(|object| object.name.as_str()).collect();
    let (seen, types, joints) = over_time(belief, before, &names);
    let observed = recording.observed_frames();
    let time = |count: &usize| {
        let frame =
            count.checked_sub(1).and_then(|last| recording.frames.get(*observed.get(last)?));
        fine(frame.map_or(0.0, |frame| frame.time))
    };
    let frames = frames(recording);
    let plan = Plan {
        tool: 0,
        tools: vec![0],
        name: recording.name.clone(),
        standing: Standing::Inferred,
        verdict: document.title.clone(),
        cells: Vec::new(),
        strokes: strokes(recording),
        hand: None,
        lift: length(recording.lift),
        replays: replay_of(Layer::Seen, "the recording".into(), &frames, false)
            .into_iter()
            .collect(),
        ends: Vec::new(),
        command: recipe.command,
        python: recipe.python,
        file: Json::Null,
    };
    let data = Data {
        task: recording.name.clone(),
        description: recording.description.clone(),
        models: String::new(),
        headline: document.title.clone(),
        stage: stage::table(&recording.scene),
        measure: None,
        tools: vec![stage::tool(&recording.tool, Json::Null)],
        plans: vec![plan],
        columns: Vec::new(),
        choice: Vec::new(),
        candidates: None,
        found: found(document),
        run: Some(Run {
            kind: "Recording",
            words: "Initial belief, updated after every observation.",
            columns: Vec::new(),
            numeric: Vec::new(),
            made: Vec::new(),
            times: seen.iter().map(time).collect(),
            types,
            joints,
            numbers: Vec::new(),
        }),
        warnings: document.notes.clone(),
        file: File { schema_version: 0, task: Json::Null },
        drawing: None,
    };
    html::page(&data, view)
}

/// Returns the tables of a document; a table without a title gets a default one.
fn found(document: &Document) -> Vec<Found> {
    let shown = document.sections.iter().filter(|section| !section.table.is_empty());
    let table = |section: &Section| {
        let title = if section.title.is_empty() { "Final belief" } else { &section.title };
        Found::of(title, &section.table)
    };
    shown.map(table).collect()
}

/// Returns the observations, frame by frame; a stroke lasts until the tool is lifted.
fn frames(recording: &Recording) -> Vec<Frame> {
    let mut stroke = 0;
    let frame = |recorded: &RecordedFrame| {
        stroke += usize::from(recorded.lifted);
        Frame {
            blade: None,
            time: recorded.time,
            stroke,
            tool: recorded.tool,
            state: State::at_rest(recorded.poses.clone()),
        }
    };
    recording.frames.iter().map(frame).collect()
}

/// Returns the strokes, each from lowering to lifting the tool.
fn strokes(recording: &Recording) -> Vec<Stroke> {
    let mut strokes: Vec<Stroke> = Vec::new();
    for frame in &recording.frames {
        let at = pose(&frame.tool);
        match strokes.last_mut().filter(|_| !frame.lifted) {
            Some(stroke) => stroke.to = at,
            None => strokes.push(Stroke { tool: 0, from: at, to: at, lowered: true }),
        }
    }
    strokes
}
