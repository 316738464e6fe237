//! Reading of a recording: the scene, the pusher and the frames.

use std::path::Path;
use std::sync::Arc;

use crate::asset::diagnostic::Faults;
use crate::asset::node::{Content, Node};
use crate::asset::shapes::shape;
use crate::asset::strict::{Ledger, check};
use crate::asset::take::{name_of, number_or, vector};
use crate::asset::text::{Source, named_after};
use crate::asset::{read_text, task, tool};
use crate::geometry::{Pose, Vector};
use crate::recording::Recording;
use crate::{
    scene::{Object, Part, Scene, Tool, Velocity},
    task::PushRules,
};

use super::spec::{PUSHER_KEYS, RECORDING, default};
use super::{frames, units};

impl Recording {
    /// Reads a recording, in JSON if the file's name ends in `.json`, otherwise in YAML.
    ///
    /// # Errors
    /// Returns all faults of the file, each with its place.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Faults> {
        let (file, text) = read_text(path.as_ref())?;
        Self::parse(&text, &file)
    }

    /// Parses the text of a recording. `file` is its name in faults; the stem of `file` becomes the
    /// name of a recording without `name`.
    ///
    /// # Errors
    /// Returns all faults of the text, each with its place.
    pub fn parse(text: &str, file: &str) -> Result<Self, Faults> {
        let source = Source::of(file, text);
        let mut root = Node::parse(source)?;
        let mut ledger = Ledger::new(source);
        if units::check(&root, &mut ledger) {
            return ledger.finish(None);
        }
        check(&mut root, &RECORDING, &mut ledger);
        let recording = read(&root, file, &mut ledger);
        ledger.finish(recording)
    }
}

fn read(root: &Node, file: &str, ledger: &mut Ledger) -> Option<Recording> {
    let times = frames::times(root, ledger);
    let (tool, lift) = root.get("pusher").and_then(|node| pusher(node, ledger)).unzip();
    let objects = root.get("scene")?.get("objects")?.items();
    let read = frames::frames(root, objects, times.as_deref(), ledger);
    let scene = scene(root, ledger);
    let (frames, headings) = read?;
    let velocities = objects.iter().map(velocity).collect::<Option<_>>()?;
    let recording = Recording {
        name: name_of(root).map_or_else(|| stem(file), str::to_owned),
        description: root.get("description").and_then(Node::text).unwrap_or_default().into(),
        scene: scene?,
        tool: tool?,
        lift: lift?,
        headings,
        velocities,
        frames,
    };
    frames::set_down(root, &recording, ledger);
    frames::starts(root, &recording, ledger);
    Some(recording)
}

/// Returns the name without folder and extensions, such as `push` for `data/push.recording.json`.
fn stem(file: &str) -> String {
    let name = Path::new(file).file_name().unwrap_or_default().to_string_lossy().into_owned();
    named_after(name.split('.').next().unwrap_or_default())
}

/// Returns the scene with the poses of the first frame, and defaults for missing values.
fn scene(root: &Node, ledger: &mut Ledger) -> Option<Scene> {
    let mut scene = root.get("scene")?.clone();
    let first = root.get("frames")?.items().first()?.get("objects")?.items();
    if let Content::Map(pairs) = &mut scene.content {
        let objects = pairs.iter_mut().find(|(key, _)| key.text() == Some("objects"));
        if let Some(Content::List(objects)) = objects.map(|(_, objects)| &mut objects.content) {
            for (object, pose) in objects.iter_mut().zip(first) {
                complete(object, pose, ledger);
            }
        }
    }
    task::scene_of(&scene, Recording::NOISE, ledger)
}

/// Fills in missing values of an object; faults of its position are reported at the first frame.
fn complete(object: &mut Node, pose: &Node, ledger: &mut Ledger) {
    let id = object.id;
    let [Some(x), Some(y), yaw] = [0, 1, 2].map(|k| pose.items().get(k)) else { return };
    let position = Node { id: pose.id, content: Content::List(vec![x.clone(), y.clone()]) };
    if let Some(stated) = object.get("position") {
        let differs = |k: usize, found: &Node| {
            let stated = stated.items().get(k).and_then(Node::number);
            // Positions that differ by less than a tenth of the contact distance count as equal.
            matches!((stated, found.number()), (Some(a), Some(b)) if (a - b).abs() > 1e-3)
        };
        if differs(0, x) || differs(1, y) {
            let message = "`position` differs from the object's position in the first frame";
            ledger.fault(stated, message, "remove `position`; the first frame defines it");
        }
    }
    let Content::Map(pairs) = &mut object.content else { return };
    let mut put = |name: &str, value: Option<Node>, always: bool| {
        let there = pairs.iter_mut().find(|(key, _)| key.text() == Some(name));
        match (there, value) {
            (Some((_, node)), Some(value)) if always => *node = value,
            (None, Some(value)) => {
                pairs.push((Node { id, content: Content::Text(name.into()) }, value));
            }
            _ => {}
        }
    };
    put("position", Some(position), true);
    put("yaw_deg", yaw.cloned(), true);
    put("mass", Some(Node { id, content: Content::Number(default::MASS) }), false);
    put("friction", Some(Node { id, content: Content::Number(Object::FRICTION) }), false);
}

/// Returns the velocity of an object in the first frame.
fn velocity(object: &Node) -> Option<Velocity> {
    let linear = object.get("velocity").map_or(Some(Vector::zeros()), vector)?;
    Some(Velocity { linear, angular: number_or(object, "spin_deg", 0.0)?.to_radians() })
}

/// Returns the pusher as a tool, and its lift.
fn pusher(node: &Node, ledger: &mut Ledger) -> Option<(Arc<Tool>, f64)> {
    let lift = number_or(node, "lift", PushRules::LIFT);
    let solids: Vec<&Node> =
        ["cylinder", "cuboid", "tool"].iter().filter_map(|key| node.get(key)).collect();
    let known = |key: &Node| PUSHER_KEYS.iter().any(|known| key.text() == Some(known.name));
    match solids[..] {
        [_] => {}
        // A misspelled key is one fault, not two.
        [] if !node.pairs().iter().all(|(key, _)| known(key)) => return None,
        _ => {
            let advice = "write one of `cylinder: {radius: r, height: h}`, `cuboid: {size: [x, y, \
                          z]}` and `tool: {...}`";
            ledger.fault(node, "a pusher has exactly one solid", advice);
            return None;
        }
    }
    if let Some(tool) = node.get("tool") {
        if let Some(friction) = node.get("friction") {
            let advice = "remove it; the tool has its own friction value";
            ledger.fault(friction, "`friction` is given in addition to a tool", advice);
        }
        return Some((Arc::new(tool::tool_of(tool, ledger)?), lift?));
    }
    let friction = number_or(node, "friction", Tool::FRICTION)?;
    let part = Part::new("pusher", shape(node)?, Pose::default());
    let tool = Tool::new("pusher", [part]).ok()?.friction(friction);
    Some((Arc::new(tool), lift?))
}
