//! Tool files with a blade.

use crate::scene::{Blade, Tool};

use super::node::Node;
use super::spec::{FRICTION, Key, Range, SIZE, Value};
use super::strict::Ledger;
use super::take::{name_of, number_or};

/// Specification of a blade tool file.
pub(super) static BLADE_TOOL: Value = Value::Map(BLADE_TOOL_KEYS);

/// Keys of a blade tool file.
pub(super) const BLADE_TOOL_KEYS: &[Key] = &[
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
                "Distance from the tip to the end effector's grip, metres.",
            ),
            Key::required("width", SIZE, "Width along the edge that the blade lifts, metres."),
            Key::required(
                "thickness",
                Value::Number(Range {
                    what: "a thickness in metres",
                    low: 0.000_5,
                    high: 0.1,
                    advice: "2 mm is 0.002",
                }),
                "Thickness in metres; must be less than the clearance below the edge.",
            ),
        ]),
        "The blade that lifts an edge; a tool with a blade levers and does not push.",
    ),
];

/// Returns `true` if a tool file describes a tool with a blade.
pub(super) fn is_blade_tool(root: &Node) -> bool {
    root.get("blade").is_some()
}

/// Applies the rules that span several keys; returns `None` if a required value is missing.
pub(super) fn blade_tool_of(root: &Node, ledger: &mut Ledger) -> Option<Tool> {
    let node = root.get("blade")?;
    let number = |key| node.get(key)?.number();
    let blade = Blade {
        length: number("length")?,
        width: number("width")?,
        thickness: number("thickness")?,
        friction: number_or(root, "friction", Tool::FRICTION)?,
    };
    if blade.thickness >= blade.length {
        let advice = "the length is measured from the tip to the grip; a screwdriver has 0.12";
        ledger.fault(node, "the blade is thicker than it is long", advice);
    }
    let description = root.get("description").and_then(Node::text).unwrap_or_default();
    Some(Tool::with_blade(name_of(root)?, blade).described(description))
}
