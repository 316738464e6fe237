//! Tool files.

use std::path::Path;

use crate::geometry::{Pose, Shape};
use crate::scene::{Part, Tool, ToolError};

use super::blade::{BLADE_TOOL, blade_tool_of, is_blade_tool};
use super::diagnostic::{Fault, Faults, did_you_mean};

use super::node::Node;
use super::shapes::{self, SHAPE, shape};
use super::spec::{ANGLE, COORDINATE, EXTENTS, FRICTION, Key, POSITION, Value};
use super::strict::{Ledger, check};
use super::take::{angle, name_of, pose, position, triple, unique_names};
use super::text::Source;

/// Specification of a pushing tool file.
pub(super) static TOOL: Value = Value::Map(TOOL_KEYS);

/// Specification of a tool file of either kind.
pub(super) static TOOL_FILE: Value = Value::Dependent { by: of, of: &[&TOOL, &BLADE_TOOL] };

/// Maximum number of parts of a tool.
pub const MAX_PARTS: usize = 32;

/// Keys of a pushing tool file.
pub(super) const TOOL_KEYS: &[Key] = &[
    Key::required("name", Value::Name, "The tool's name, unique in its folder."),
    Key::optional("description", Value::Text, "One line for people; by default empty."),
    Key::optional(
        "grip",
        Value::Map(&[
            Key::required(
                "position",
                POSITION,
                "Position of the end effector, [x, y] in metres in the tool frame.",
            ),
            Key::optional(
                "yaw_deg",
                ANGLE,
                "Rotation of the end effector in the tool frame, degrees; default 0.",
            ),
        ]),
        "The end effector's pose in the tool frame; by default its origin, not rotated.",
    ),
    Key::required(
        "friction",
        FRICTION,
        "Friction value; the coefficient of a pair is the mean of the two values.",
    ),
    Key::required(
        "parts",
        Value::List { of: &PART, items: "parts", min: 1, max: MAX_PARTS },
        "The solids of the tool; parts that touch (gap up to 0.1 mm) are joined rigidly.",
    ),
    Key::optional(
        "joints",
        Value::List {
            of: &Value::List { of: &Value::Name, items: "part names", min: 2, max: 2 },
            items: "pairs of part names",
            min: 0,
            max: 64,
        },
        "Pairs of parts that are joined rigidly although they do not touch; by default none.",
    ),
];

const PART: Value = Value::Map(PART_KEYS);

const PART_KEYS: &[Key] = &[
    Key::required("name", Value::Name, "The part's name, unique in the tool."),
    Key::optional(
        "size",
        EXTENTS,
        "Full extents [x, y, z] of a cuboid in metres; no default, a part has either this or \
         `shape`.",
    ),
    Key::optional(
        "shape",
        SHAPE,
        "The part's solid, which stands upright; no default, a part has either this or `size`.",
    ),
    Key::required(
        "position",
        Value::List { of: &COORDINATE, items: "numbers", min: 2, max: 3 },
        "The part's centre in the tool frame, [x, y] or [x, y, 0] in metres.",
    ),
    Key::optional("yaw_deg", ANGLE, "Rotation of the part in the tool frame, degrees; default 0."),
];

impl Tool {
    /// Returns the tool as JSON with the keys of its file; [`Tool::parse`] reads it back.
    pub fn to_json(&self) -> serde_json::Value {
        super::saved::emit::tool(self)
    }

    /// Returns the tool as a YAML file that [`Tool::parse`] reads back. The result is identical bit
    /// for bit if the angles came from a file or are round in degrees.
    ///
    /// # Errors
    /// Returns an error if the tool holds a value that a file cannot represent.
    pub fn to_yaml(&self) -> Result<String, Faults> {
        serde_yaml::to_string(&self.to_json()).map_err(|error| {
            let message = format!("the tool cannot be written as YAML: {error}");
            Fault::of_file(&self.name, message, "check its numbers").into()
        })
    }

    /// Reads a tool file.
    ///
    /// # Errors
    /// Returns all faults of the file, each with its place.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Faults> {
        let (file, text) = super::read_text(path.as_ref())?;
        Self::parse(&text, &file)
    }

    /// Reads a tool from `text`; `file` is its name in faults.
    ///
    /// # Errors
    /// Returns all faults of the text, each with its place.
    pub fn parse(text: &str, file: &str) -> Result<Self, Faults> {
        let source = Source::yaml(file, text);
        let mut root = Node::parse(source)?;
        let mut ledger = Ledger::new(source);
        check(&mut root, &TOOL_FILE, &mut ledger);
        let tool = tool_of(&root, &mut ledger);
        ledger.finish(tool)
    }
}

/// Returns the specification for the kind of tool that `root` describes.
fn of(root: &Node) -> &'static Value {
    if is_blade_tool(root) { &BLADE_TOOL } else { &TOOL }
}

/// Applies the rules that span several keys; returns `None` if a required value is missing.
pub(super) fn tool_of(root: &Node, ledger: &mut Ledger) -> Option<Tool> {
    if is_blade_tool(root) {
        return blade_tool_of(root, ledger);
    }
    let list = root.get("parts")?;
    unique_names(list.items(), "parts", ledger);
    for part in list.items() {
        one_solid(part, ledger);
        shapes::check(part.get("shape"), ledger);
        let height = part.get("position").and_then(|position| position.items().get(2));
        if let Some(node) = height.filter(|node| node.number().is_some_and(|z| z != 0.0)) {
            ledger.fault(
                node,
                "parts at different heights are not supported",
                "write 0; all parts stand side by side, and the push's `lift` is the height of \
                 their undersides",
            );
        }
    }
    let by_hand = joints(root, list, ledger);
    let parts: Vec<Part> = list.items().iter().filter_map(part).collect();
    if parts.len() < list.items().len() {
        return None;
    }
    let grip = match root.get("grip") {
        Some(grip) => Pose { position: position(grip)?, heading: angle(grip, "yaw_deg", 0.0)? },
        None => Pose::default(),
    };
    let name = name_of(root).unwrap_or_default().to_owned();
    let description = root.get("description").and_then(Node::text).unwrap_or_default().to_owned();
    let friction = root.get("friction").and_then(Node::number);
    match Tool::joined(name, parts, &by_hand) {
        Ok(tool) => Some(tool.held_at(grip).friction(friction?).described(description)),
        Err(error) => {
            let advice = match error {
                ToolError::Apart { .. } => {
                    "move the pieces until they touch, or name a pair under `joints`"
                }
                ToolError::NoParts => "add a part",
            };
            ledger.fault(list, error.to_string(), advice);
            None
        }
    }
}

fn part(node: &Node) -> Option<Part> {
    let name = name_of(node)?.to_owned();
    let shape = match node.get("shape") {
        Some(node) => shape(node)?,
        None => Shape::Cuboid { size: triple(node, "size")? },
    };
    Some(Part { name, shape, pose: pose(node)? })
}

/// Checks that the solid of a part is given exactly once.
fn one_solid(part: &Node, ledger: &mut Ledger) {
    match (part.get("size"), part.get("shape")) {
        (Some(_), Some(shape)) => {
            let advice = "keep one of the two; `size` is short for a cuboid";
            ledger.fault(shape, "this part has both `size` and `shape`", advice);
        }
        // A misspelled key is one fault, not two.
        (None, None) if part.pairs().iter().all(|(key, _)| is_key(key)) => {
            let advice = "add `size: [x, y, z]` in metres, or `shape: {cylinder: {radius: r, \
                          height: h}}`";
            ledger.fault(part, "this part has neither `size` nor `shape`", advice);
        }
        _ => {}
    }
}

fn is_key(key: &Node) -> bool {
    PART_KEYS.iter().any(|known| key.text() == Some(known.name))
}

/// Returns the explicitly joined pairs of parts, by index.
fn joints(root: &Node, parts: &Node, ledger: &mut Ledger) -> Vec<[usize; 2]> {
    let names: Vec<&str> = parts.items().iter().map(|part| name_of(part).unwrap_or("")).collect();
    let mut pairs = Vec::new();
    for pair in root.get("joints").map(Node::items).unwrap_or_default() {
        let mut indices = Vec::new();
        for node in pair.items() {
            let Some(name) = node.text() else { continue };
            match names.iter().position(|known| *known == name) {
                Some(index) => indices.push(index),
                None => {
                    let known = names.iter().copied().filter(|known| !known.is_empty());
                    ledger.fault(
                        node,
                        format!("no part is called `{name}`"),
                        did_you_mean(name, known),
                    );
                }
            }
        }
        match indices[..] {
            [a, b] if a == b => {
                ledger.fault(pair, "a joint of a part with itself", "name two different parts");
            }
            [a, b] => pairs.push([a, b]),
            _ => {}
        }
    }
    pairs
}
