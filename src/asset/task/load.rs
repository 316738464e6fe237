//! Reading a task file and checking it against the tools.

use std::path::Path;
use std::sync::Arc;

use crate::scene::{Scene, Task, Tool, ToolChoice};

use crate::asset::fault::{Fault, Faults, did_you_mean};
use crate::asset::lever::is_lever_task;
use crate::asset::library::ToolLibrary;
use crate::asset::node::Node;
use crate::asset::strict::{Ledger, check};
use crate::asset::text::Source;

use super::{build, rules, spec::TASK};

impl Task {
    /// Reads a task file. Whether the named tools exist is for [`Task::tools`] to say.
    ///
    /// # Errors
    /// All faults of the file, each with its place.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Faults> {
        let (file, text) = crate::asset::read_text(path.as_ref())?;
        Self::parse(&text, &file)
    }

    /// Reads a task from `text`; `file` names it in faults, and its stem names a task that has
    /// no `name`.
    ///
    /// # Errors
    /// All faults of the text, each with its place.
    pub fn parse(text: &str, file: &str) -> Result<Self, Faults> {
        parse_with(text, file, None)
    }

    /// The tools that the task allows, in its order (all: in the library's order).
    ///
    /// # Errors
    /// A fault for every name that the library does not know, or one if there is no tool.
    pub fn tools(&self, library: &ToolLibrary) -> Result<Vec<Arc<Tool>>, Faults> {
        let names = match &self.tools {
            ToolChoice::All if library.is_empty() => {
                let advice = "add a tool file to the folder, or name another folder";
                let message = "all tools are allowed, but the library has none";
                return Err(Fault::of_file(&self.name, message, advice).into());
            }
            ToolChoice::All => return Ok(library.iter().cloned().collect()),
            ToolChoice::Named(names) => names,
        };
        let mut faults = Vec::new();
        let mut tools = Vec::new();
        for name in names {
            match library.get(name) {
                Some(tool) => tools.push(tool.clone()),
                None => {
                    let (message, advice) = unknown_tool(name, library);
                    faults.push(Fault::of_file(&self.name, message, advice));
                }
            }
        }
        if faults.is_empty() { Ok(tools) } else { Err(Faults(faults)) }
    }
}

/// Reads a task file and checks the tools it names against `library`, so that an unknown one
/// is reported at its place with all other faults.
///
/// # Errors
/// All faults of the file, each with its place.
pub fn load_task(path: impl AsRef<Path>, library: &ToolLibrary) -> Result<Task, Faults> {
    let (file, text) = crate::asset::read_text(path.as_ref())?;
    parse_with(&text, &file, Some(library))
}

/// Reads a task from `text`, with the tools it names checked against `library`, if one is given.
pub(in crate::asset) fn parse_with(
    text: &str,
    file: &str,
    library: Option<&ToolLibrary>,
) -> Result<Task, Faults> {
    let source = Source::yaml(file, text);
    let mut root = Node::parse(source)?;
    let mut ledger = Ledger::new(source);
    if is_lever_task(&root) {
        let node = root.get("levers").or_else(|| root.get("goal")).unwrap_or(&root);
        let advice = "`solve`, `predict` and `verify` take such tasks";
        ledger.fault(node, "this is a task of levering, and pushes are asked for", advice);
        return ledger.finish(None);
    }
    check(&mut root, &TASK, &mut ledger);
    if let Some(library) = library {
        for node in root.get("tools").map(Node::items).unwrap_or_default() {
            if let Some(name) = node.text().filter(|name| library.get(name).is_none()) {
                let (message, advice) = unknown_tool(name, library);
                ledger.fault(node, message, advice);
            }
        }
    }
    let task = task_of(&root, file, &mut ledger);
    ledger.finish(task)
}

/// Applies the rules that span several keys; `None` if anything needed is missing.
pub(in crate::asset) fn task_of(root: &Node, file: &str, ledger: &mut Ledger) -> Option<Task> {
    rules::check(root, ledger);
    build::task(root, file)
}

/// The scene of another kind of file, by the rules of a task's; bodies may be `slack` metres
/// deep in each other. `None` if anything needed is missing.
pub(in crate::asset) fn scene_of(node: &Node, slack: f64, ledger: &mut Ledger) -> Option<Scene> {
    rules::check_scene(node, slack, ledger);
    build::scene(node)
}

fn unknown_tool(name: &str, library: &ToolLibrary) -> (String, String) {
    if library.blade(name).is_some() {
        let message = format!("`{name}` has a blade: it levers, and this task is one of pushes");
        return (message, "name a tool that pushes, or add `levers` for a task of levering".into());
    }
    let known = library.iter().map(|tool| tool.name.as_str());
    (format!("unknown tool `{name}`"), did_you_mean(name, known))
}
