//! MCAP export of a plan and its trajectory, a recording for Foxglove, Rerun and others.

use std::collections::BTreeMap;
use std::io::Cursor;

use mcap::records::MessageHeader;
use mcap::{Attachment, WriteOptions, Writer, records::Metadata};
use serde_json::{Value as Json, json};

use pushplan::asset::PlanFile;
use pushplan::geometry::{Pose, Shape};
use pushplan::{
    outcome::{Frame, Outcome, Trajectory},
    scene::{Blade, Object},
    task::{Mark, Step},
};

use super::ExportError;
use super::foxglove::{self, Colour, TABLE, entity, list, object, titled, transform, transform_3d};

const OBJECT: Colour = [0.45, 0.60, 0.80, 1.0];
const WANTED: Colour = [0.90, 0.55, 0.20, 1.0];
const OBSTACLE: Colour = [0.45, 0.45, 0.45, 1.0];
const REGION: Colour = [0.80, 0.20, 0.20, 0.25];
const TOOL: Colour = [0.30, 0.65, 0.40, 1.0];
const GOAL: Colour = [0.90, 0.55, 0.20, 0.25];

/// Height of the goal's disc, metres: visible, but not obstructing.
const DISC: f64 = 1e-3;

/// Returns `plan` and its `trajectory` as the bytes of an MCAP file.
///
/// | topic | schema | when | content |
/// |---|---|---|---|
/// | `/scene` | `foxglove.SceneUpdate` | at the start | solids of objects, obstacles, tool and goal, each in its frame |
/// | `/tf` | `foxglove.FrameTransforms` | every frame | frames `object/NAME` and `tool` in `table` |
/// | `/state` | `pushplan.State` | every frame | poses as x, y (metres) and unwrapped heading (radians), the push, and the distance from the first goal (metres) |
///
/// Messages are JSON with JSON schemas; times count from the start, in nanoseconds. The attachment
/// `plan.json` is the complete plan file, and the metadata `pushplan` contains tool, model and
/// outcome. Data is not compressed, and equal plans give equal bytes.
///
/// # Errors
/// Returns [`ExportError::Mcap`] if the trajectory contains data that an MCAP file cannot hold.
pub fn mcap(plan: &PlanFile, trajectory: &Trajectory) -> Result<Vec<u8>, ExportError> {
    written(plan, trajectory).map_err(|error| ExportError::Mcap(error.to_string()))
}

fn written(plan: &PlanFile, trajectory: &Trajectory) -> Result<Vec<u8>, mcap::McapError> {
    let library = format!("pushplan {}", env!("CARGO_PKG_VERSION"));
    let options = WriteOptions::new().compression(None).library(library);
    let mut file = File { writer: options.create(Cursor::new(Vec::new()))?, sequence: 0 };
    let scene = file.channel("/scene", "foxglove.SceneUpdate", &foxglove::scene_schema())?;
    let frames = file.channel("/tf", "foxglove.FrameTransforms", &foxglove::transforms_schema())?;
    let state = file.channel("/state", "pushplan.State", &state_schema())?;
    file.message(scene, 0, &json!({"deletions": [], "entities": entities(plan)}))?;
    for frame in &trajectory.frames {
        let at = nanoseconds(frame.time);
        file.message(frames, at, &json!({"transforms": transforms(plan, frame, at)}))?;
        file.message(state, at, &numbers(plan, frame))?;
    }
    let outcome = Outcome::judge(&plan.task.scene, &plan.task, trajectory);
    let entries = [
        ("task", plan.task.name.clone()),
        ("tool", plan.plan.tools().join(", ")),
        ("model", trajectory.by.to_string()),
        ("reached", outcome.reached.to_string()),
        ("error_m", outcome.error().to_string()),
    ];
    let metadata = entries.map(|(key, value)| (key.to_owned(), value)).into_iter().collect();
    file.writer.write_metadata(&Metadata { name: "pushplan".to_owned(), metadata })?;
    // The format equals the plan file format, so that the attachment can be extracted and verified.
    let data = serde_json::to_vec_pretty(plan).map_err(std::io::Error::from)?;
    file.writer.attach(&Attachment {
        log_time: 0,
        create_time: 0,
        name: "plan.json".to_owned(),
        media_type: "application/json".to_owned(),
        data: data.into(),
    })?;
    file.writer.finish()?;
    Ok(file.writer.into_inner().into_inner())
}

/// File under construction.
struct File {
    writer: Writer<Cursor<Vec<u8>>>,
    sequence: u32,
}

impl File {
    fn channel(&mut self, topic: &str, name: &str, schema: &Json) -> mcap::McapResult<u16> {
        let schema = self.writer.add_schema(name, "jsonschema", schema.to_string().as_bytes())?;
        self.writer.add_channel(schema, topic, "json", &BTreeMap::new())
    }

    fn message(&mut self, channel_id: u16, at: u64, message: &Json) -> mcap::McapResult<()> {
        let header =
            MessageHeader { channel_id, sequence: self.sequence, log_time: at, publish_time: at };
        self.sequence += 1;
        self.writer.write_to_known_channel(&header, message.to_string().as_bytes())
    }
}

fn nanoseconds(seconds: f64) -> u64 {
    (1e9 * seconds).round() as u64
}

/// Returns all drawn entities.
fn entities(plan: &PlanFile) -> Vec<Json> {
    let scene = &plan.task.scene;
    let mut found = Vec::new();
    for (index, object) in drawn(plan) {
        let name = format!("object/{}", object.name);
        let colour = if plan.task.has_goal(index) { WANTED } else { OBJECT };
        let middle = if in_space(plan) { object.shape.height() / 2.0 } else { 0.0 };
        let mut solids = vec![(object.shape, Pose::default(), middle)];
        if in_space(plan) {
            let parts = scene.parts_of(index).map(|k| &scene.objects[k]);
            solids.extend(parts.filter_map(fixed));
        }
        found.push(entity(&name, &name, &solids, colour));
    }
    for obstacle in &scene.obstacles {
        let name = format!("obstacle/{}", obstacle.name);
        let solid = (obstacle.shape(), obstacle.pose, obstacle.z + obstacle.size[2] / 2.0);
        found.push(entity(TABLE, &name, &[solid], OBSTACLE));
    }
    for region in &scene.keep_out {
        let name = format!("region/{}", region.name);
        let sheet = (region.sheet(DISC), region.pose, DISC / 2.0);
        found.push(entity(TABLE, &name, &[sheet], REGION));
    }
    let part = |part: &pushplan::scene::Part| (part.shape, part.pose, part.shape.height() / 2.0);
    for (k, tool) in plan.tools.iter().enumerate() {
        let mut parts: Vec<_> = tool.parts().iter().map(part).collect();
        parts.extend(tool.blade().map(|Blade { length, width, thickness, .. }| {
            (Shape::Cuboid { size: [length, width, thickness] }, Pose::default(), 0.0)
        }));
        found.push(entity(&frame_of(k), &frame_of(k), &parts, TOOL));
    }
    for (k, goal) in plan.task.shown_goals().iter().enumerate() {
        let name = match k {
            0 => "goal".to_owned(),
            _ => format!("goal/{}", scene.objects[goal.objects[0]].name),
        };
        let sheets: Vec<_> = goal.marks.iter().filter_map(sheet).collect();
        if !sheets.is_empty() {
            found.push(entity(TABLE, &name, &sheets, GOAL));
        }
    }
    found
}

/// Returns an area mark as a sheet on the table.
fn sheet(mark: &Mark) -> Option<(Shape, Pose, f64)> {
    let (shape, pose) = match mark {
        Mark::Disc { centre, radius } => {
            let shape = Shape::Cylinder { radius: *radius, height: DISC };
            (shape, Pose { position: *centre, heading: 0.0 })
        }
        Mark::Area(area) => (area.flat(DISC), area.pose),
        _ => return None,
    };
    Some((shape, pose, DISC / 2.0))
}

/// Returns the frame name of the tool of this index.
fn frame_of(tool: usize) -> String {
    if tool == 0 { "tool".to_owned() } else { format!("tool/{tool}") }
}

/// Returns the bodies with their own frames; in 3-D plans, a compound object has one frame.
fn drawn(plan: &PlanFile) -> impl Iterator<Item = (usize, &Object)> {
    let together = in_space(plan);
    let solids = plan.task.scene.objects.iter().enumerate();
    solids.filter(move |(_, object)| !(together && object.is_part()))
}

/// Returns a part relative to the underside of its object.
fn fixed(part: &Object) -> Option<(Shape, Pose, f64)> {
    Some((part.shape, part.whole?.place, part.z + part.shape.height() / 2.0))
}

fn in_space(plan: &PlanFile) -> bool {
    plan.task.in_space() || plan.plan.levers()
}

/// Returns the transforms of all bodies in one frame.
fn transforms(plan: &PlanFile, frame: &Frame, at: u64) -> Vec<Json> {
    let mut found: Vec<Json> = Vec::new();
    for ((k, object), pose) in drawn(plan).zip(&frame.state.poses) {
        let name = format!("object/{}", object.name);
        found.push(match frame.state.space.as_ref().and_then(|space| space.get(k)) {
            Some(pose) => transform_3d(at, &name, pose),
            None => transform(at, &name, pose, object.middle()),
        });
    }
    let steps = &plan.plan.steps;
    let at_work = steps
        .get(frame.stroke)
        .and_then(|step| plan.tools.iter().position(|tool| tool.name == step.tool()));
    let lift = match steps.get(frame.stroke) {
        Some(Step::Push(step)) => step.lift,
        _ => plan.plan.lift(),
    };
    let name = frame_of(at_work.unwrap_or(0));
    found.push(match &frame.blade {
        Some(blade) => transform_3d(at, &name, blade),
        None => transform(at, &name, &frame.tool, lift),
    });
    found
}

/// Returns the poses of all bodies in one frame as plain numbers.
fn numbers(plan: &PlanFile, frame: &Frame) -> Json {
    let place =
        |pose: &Pose| json!({"x": pose.position.x, "y": pose.position.y, "heading": pose.heading});
    let objects = plan.task.scene.objects.iter().zip(&frame.state.poses).map(|(object, pose)| {
        let mut numbers = place(pose);
        numbers["name"] = json!(object.name);
        numbers
    });
    json!({
        "time": frame.time,
        "push": frame.stroke,
        "error": plan.task.goals[0].error(&frame.state),
        "tool": place(&frame.tool),
        "objects": objects.collect::<Vec<_>>(),
    })
}

fn state_schema() -> Json {
    let number = json!({"type": "number"});
    let place = || json!({"x": number, "y": number, "heading": number});
    let mut named = place();
    named["name"] = json!({"type": "string"});
    let fields = json!({
        "time": number,
        "push": {"type": "integer"},
        "error": number,
        "tool": object(place()),
        "objects": list(object(named)),
    });
    titled("pushplan.State", object(fields))
}
