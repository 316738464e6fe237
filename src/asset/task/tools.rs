//! Tools of a task file: the allowed tools and their costs.

use std::collections::BTreeMap;

use serde_json::{Value as Json, json};

use crate::asset::node::Node;
use crate::asset::spec::{Key, Range, Value};
use crate::asset::strict::Ledger;
use crate::task::{Task, ToolChoice};

/// Key of the allowed tools.
pub(super) const TOOLS: Key = Key::required(
    "tools",
    Value::Either(&[
        Value::Word(&["all"]),
        Value::List {
            of: &Value::Either(&[Value::Name, Value::Map(&[NAME, COST])]),
            items: "tools",
            min: 1,
            max: 64,
        },
    ]),
    "Names of the tools to choose from, or `all`; a cost is given by `{name: hook, cost: 2}` \
     instead of the name.",
);

const NAME: Key = Key::required("name", Value::Name, "The tool's name.");

const COST: Key = Key::optional(
    "cost",
    Value::Number(Range {
        what: "a cost",
        low: 0.0,
        high: 1e6,
        advice: "only the order of the costs matters",
    }),
    "Cost of using the tool: among equally good plans with the same number of pushes, the cheaper \
     one ranks first; default 0. Tools for levering have none.",
);

/// Returns the name of a tool in the list.
pub(super) fn tool_name(node: &Node) -> Option<&str> {
    node.text().or_else(|| node.get("name")?.text())
}

/// Returns the allowed tools.
pub(in crate::asset) fn tools(node: &Node) -> ToolChoice {
    match node.text() {
        Some(_) => ToolChoice::All,
        None => {
            ToolChoice::Named(node.items().iter().filter_map(tool_name).map(Into::into).collect())
        }
    }
}

/// Returns the positive costs of tools, by name.
pub(super) fn costs(node: &Node) -> BTreeMap<String, f64> {
    let cost = |node: &Node| Some((tool_name(node)?.to_owned(), node.get("cost")?.number()?));
    node.items().iter().filter_map(cost).filter(|(_, cost)| *cost > 0.0).collect()
}

/// Returns the tools as in a file.
pub(in crate::asset) fn emitted_tools(task: &Task) -> Json {
    let ToolChoice::Named(names) = &task.tools else { return json!("all") };
    let tool = |name: &String| match task.tool_costs.get(name) {
        Some(cost) => json!({"name": name, "cost": cost}),
        None => json!(name),
    };
    names.iter().map(tool).collect()
}

/// Reports tools that are named twice.
pub(super) fn check_tools(tools: &Node, ledger: &mut Ledger) {
    for (k, node) in tools.items().iter().enumerate() {
        let name = tool_name(node);
        if name.is_some() && tools.items()[..k].iter().any(|other| tool_name(other) == name) {
            ledger.fault(node, "this tool is named twice", "remove one of the two");
        }
    }
}

/// Reports costs where they have no effect.
pub(super) fn check_free(tools: &Node, ledger: &mut Ledger) {
    for tool in tools.items().iter().filter(|node| node.get("name").is_some()) {
        let advice = "write its name only; only tools of tasks of pushes have costs";
        ledger.fault(tool, "a tool for levering has no cost", advice);
    }
}
