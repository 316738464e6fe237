//! Files of tools with blades.

use std::path::Path;

use crate::asset::fault::Faults;
use crate::asset::node::Node;
use crate::asset::spec::{FRICTION, Key, Range, SIZE, Value};
use crate::asset::strict::{Ledger, check};
use crate::asset::take::{name_of, number_or};
use crate::asset::text::Source;
use crate::scene::{Blade, BladeTool};

/// What a file of a tool with a blade may hold.
pub(in crate::asset) static BLADE_TOOL: Value = Value::Map(BLADE_TOOL_KEYS);

/// The keys of a tool with a blade.
pub(in crate::asset) const BLADE_TOOL_KEYS: &[Key] = &[
    Key::required("name", Value::Name, "The tool's name, unique in its folder."),
    Key::optional("description", Value::Text, "One line for people; by default empty."),
    Key::optional(
        "friction",
        FRICTION,
        "Friction value; the coefficient of a pair is the mean of the two values; default 0.4.",
    ),
    Key::required(
        "blade",
        Value::Map(&[
            Key::required(
                "length",
                SIZE,
                "From the tip to where the end effector holds the tool, metres.",
            ),
            Key::required("width", SIZE, "Along the edge that it goes under, metres."),
            Key::required(
                "thickness",
                Value::Number(Range {
                    what: "a thickness in metres",
                    low: 0.000_5,
                    high: 0.1,
                    advice: "2 mm is 0.002",
                }),
                "Height in metres; must fit below the edge.",
            ),
        ]),
        "The blade that goes under an edge; a tool that has one levers and does not push.",
    ),
];

impl BladeTool {
    /// The tool in the keys of its file, which [`BladeTool::parse`] reads back.
    pub fn to_json(&self) -> serde_json::Value {
        super::emit::blade_tool(self)
    }

    /// Reads a file of a tool with a blade.
    ///
    /// # Errors
    /// All faults of the file, each with its place.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Faults> {
        let (file, text) = crate::asset::read_text(path.as_ref())?;
        Self::parse(&text, &file)
    }

    /// Reads a tool with a blade from `text`; `file` names it in faults.
    ///
    /// # Errors
    /// All faults of the text, each with its place.
    pub fn parse(text: &str, file: &str) -> Result<Self, Faults> {
        let source = Source::yaml(file, text);
        let mut root = Node::parse(source)?;
        let mut ledger = Ledger::new(source);
        check(&mut root, &BLADE_TOOL, &mut ledger);
        let tool = blade_tool_of(&root, &mut ledger);
        ledger.finish(tool)
    }
}

/// Whether a tool file is one of a tool with a blade.
pub(in crate::asset) fn is_blade_tool(root: &Node) -> bool {
    root.get("blade").is_some()
}

/// Applies the rules that span several keys; `None` if anything needed is missing.
pub(in crate::asset) fn blade_tool_of(root: &Node, ledger: &mut Ledger) -> Option<BladeTool> {
    let node = root.get("blade")?;
    let number = |key| node.get(key)?.number();
    let blade = Blade {
        length: number("length")?,
        width: number("width")?,
        thickness: number("thickness")?,
        friction: number_or(root, "friction", BladeTool::FRICTION)?,
    };
    if blade.thickness >= blade.length {
        let advice = "the length runs from the tip to the grip; a screwdriver has 0.12";
        ledger.fault(node, "the blade is thicker than it is long", advice);
    }
    Some(BladeTool {
        name: name_of(root)?.to_owned(),
        description: root.get("description").and_then(Node::text).unwrap_or_default().to_owned(),
        blade,
    })
}
