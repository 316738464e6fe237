//! Reading a task of levering and checking it against the tools.

use std::path::Path;
use std::sync::Arc;

use crate::asset::fault::{Fault, Faults, did_you_mean};
use crate::asset::library::ToolLibrary;
use crate::asset::node::Node;
use crate::asset::strict::{Ledger, check};
use crate::asset::task;
use crate::asset::text::Source;
use crate::scene::{BladeTool, LeverTask, Task, ToolChoice};

use super::{build, rules, spec::LEVER_TASK};

/// What a task file may be.
#[derive(Clone, Debug, PartialEq)]
pub enum AnyTask {
    /// A task of pushes.
    Pushes(Task),
    /// A task of levering.
    Levers(LeverTask),
}

/// Reads a task file of either kind and checks the tools it names against `library`, if one is
/// given.
///
/// # Errors
/// All faults of the file, each with its place.
pub fn load_any_task(
    path: impl AsRef<Path>,
    library: Option<&ToolLibrary>,
) -> Result<AnyTask, Faults> {
    let (file, text) = crate::asset::read_text(path.as_ref())?;
    if is_lever_task(&Node::parse(Source::yaml(&file, &text))?) {
        parse_lever_task(&text, &file, library).map(AnyTask::Levers)
    } else {
        task::parse_with(&text, &file, library).map(AnyTask::Pushes)
    }
}

impl LeverTask {
    /// Reads a file of a task of levering. Whether the named tools exist is for
    /// [`LeverTask::blades`] to say.
    ///
    /// # Errors
    /// All faults of the file, each with its place.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Faults> {
        let (file, text) = crate::asset::read_text(path.as_ref())?;
        Self::parse(&text, &file)
    }

    /// Reads a task of levering from `text`; `file` names it in faults, and its stem names a task
    /// that has no `name`.
    ///
    /// # Errors
    /// All faults of the text, each with its place.
    pub fn parse(text: &str, file: &str) -> Result<Self, Faults> {
        parse_lever_task(text, file, None)
    }

    /// The tools with blades that the task allows, in its order (all: in the library's order).
    ///
    /// # Errors
    /// A fault for every name that the library does not know, or one if there is no such tool.
    pub fn blades(&self, library: &ToolLibrary) -> Result<Vec<Arc<BladeTool>>, Faults> {
        let names = match &self.tools {
            ToolChoice::All if library.blades().is_empty() => {
                let message = "all tools with blades are allowed, but the library has none";
                let advice = "add a tool file with a `blade` to the folder";
                return Err(Fault::of_file(&self.name, message, advice).into());
            }
            ToolChoice::All => return Ok(library.blades().to_vec()),
            ToolChoice::Named(names) => names,
        };
        let mut faults = Vec::new();
        let mut tools = Vec::new();
        for name in names {
            match library.blade(name) {
                Some(tool) => tools.push(Arc::clone(tool)),
                None if self.pushes.is_some() && library.get(name).is_some() => {}
                None => {
                    let (message, advice) = unknown_blade(name, library);
                    faults.push(Fault::of_file(&self.name, message, advice));
                }
            }
        }
        if faults.is_empty() { Ok(tools) } else { Err(Faults(faults)) }
    }

    /// The tools that it allows for pushes that follow: those without blades.
    pub fn pushers(&self, library: &ToolLibrary) -> ToolChoice {
        match &self.tools {
            ToolChoice::All => ToolChoice::All,
            ToolChoice::Named(names) => {
                let pushes = |name: &&String| library.blade(name).is_none();
                ToolChoice::Named(names.iter().filter(pushes).cloned().collect())
            }
        }
    }
}

/// Whether the tree is a task of levering rather than one of pushes.
pub(in crate::asset) fn is_lever_task(root: &Node) -> bool {
    let goal = |key| root.get("goal").and_then(|goal| goal.get(key)).is_some();
    root.get("levers").is_some() || ["outside", "raised", "flipped"].into_iter().any(goal)
}

/// Reads a task of levering from `text`, with the tools it names checked against `library`, if one
/// is given.
pub(in crate::asset) fn parse_lever_task(
    text: &str,
    file: &str,
    library: Option<&ToolLibrary>,
) -> Result<LeverTask, Faults> {
    let source = Source::yaml(file, text);
    let mut root = Node::parse(source)?;
    let mut ledger = Ledger::new(source);
    check(&mut root, &LEVER_TASK, &mut ledger);
    let task = lever_task_of(&root, file, &mut ledger);
    if let Some(library) = library {
        rules::blades(&root, library, &mut ledger, unknown_blade);
    }
    ledger.finish(task)
}

/// Applies the rules that span several keys; `None` if anything needed is missing.
pub(in crate::asset) fn lever_task_of(
    root: &Node,
    file: &str,
    ledger: &mut Ledger,
) -> Option<LeverTask> {
    rules::check(root, ledger);
    build::lever_task(root, file)
}

fn unknown_blade(name: &str, library: &ToolLibrary) -> (String, String) {
    if library.get(name).is_some() {
        let message = format!("`{name}` has no blade, so it cannot lever");
        let known = library.blades().iter().map(|tool| format!("`{}`", tool.name));
        return (message, format!("use {}", known.collect::<Vec<_>>().join(" or ")));
    }
    let known = library.blades().iter().map(|tool| tool.name.as_str());
    (format!("unknown tool `{name}`"), did_you_mean(name, known))
}
