//! Reading of a task file, and its check against the tools.

use std::path::Path;
use std::sync::Arc;

use crate::{
    scene::{Scene, Tool},
    task::{Task, ToolChoice},
};

use crate::asset::arm;
use crate::asset::diagnostic::{Fault, Faults, did_you_mean};
use crate::asset::library::ToolLibrary;
use crate::asset::node::Node;
use crate::asset::strict::{Ledger, check};
use crate::asset::text::Source;

use super::blades::{check_blades, unknown_blade};
use super::tools::tool_name;
use super::{build, levers, rules, spec::TASK};

impl Task {
    /// Reads a task file. [`Task::tools`] checks whether the named tools exist.
    ///
    /// # Errors
    /// Returns all faults of the file, each with its place.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Faults> {
        let (file, text) = crate::asset::read_text(path.as_ref())?;
        Self::parse(&text, &file)
    }

    /// Reads a task from `text`. `file` is its name in faults; the stem of `file` becomes the name
    /// of a task without `name`.
    ///
    /// # Errors
    /// Returns all faults of the text, each with its place.
    pub fn parse(text: &str, file: &str) -> Result<Self, Faults> {
        parse_with(text, file, None)
    }

    /// Returns the allowed pushing tools in the order of the task; if all are allowed, in the order
    /// of the library.
    ///
    /// # Errors
    /// A fault for every name that is not in the library, or one fault if there is no tool.
    pub fn tools(&self, library: &ToolLibrary) -> Result<Vec<Arc<Tool>>, Faults> {
        if self.tools == ToolChoice::All && library.is_empty() {
            let advice = "add a tool file to the folder, or name another folder";
            let message = "all tools are allowed, but the library has none";
            return Err(Fault::of_file(&self.name, message, advice).into());
        }
        let held =
            |tool: &&Arc<Tool>| self.arm.as_ref().is_none_or(|arm| arm.refuses(tool).is_none());
        let all = library.iter().filter(held);
        if self.tools == ToolChoice::All && all.clone().next().is_none() {
            let message = "all tools are allowed, but all are higher than `tool_mount` is long";
            let advice = "write a larger `length` of `tool_mount`";
            return Err(Fault::of_file(&self.name, message, advice).into());
        }
        // A task that allows levering may name tools that cannot push.
        self.chosen(library, all, self.levers.is_some(), |tool| tool.pushes())
    }

    /// Returns the allowed blade tools in the order of the task; if all are allowed, in the order
    /// of the library.
    ///
    /// # Errors
    /// A fault for every name that is not in the library, or one fault if there is no such tool.
    pub fn blades(&self, library: &ToolLibrary) -> Result<Vec<Arc<Tool>>, Faults> {
        if self.tools == ToolChoice::All && library.blades().is_empty() {
            let message = "all tools with blades are allowed, but the library has none";
            let advice = "add a tool file with a `blade` to the folder";
            return Err(Fault::of_file(&self.name, message, advice).into());
        }
        let mixed = self.pushes.max_count > 0;
        self.chosen(library, library.blades().iter(), mixed, |tool| tool.blade().is_some())
    }

    /// Returns the choice of tools for pushes that follow lever-ups: the tools without blades.
    pub fn pushers(&self, library: &ToolLibrary) -> ToolChoice {
        match &self.tools {
            ToolChoice::All => ToolChoice::All,
            ToolChoice::Named(names) => {
                let pushes = |name: &&String| library.get(name).is_none_or(|tool| tool.pushes());
                ToolChoice::Named(names.iter().filter(pushes).cloned().collect())
            }
        }
    }

    /// Returns the allowed tools that satisfy `wanted`, or `all` if the task names none. In a
    /// `mixed` choice, other tools are no fault.
    fn chosen<'a>(
        &self,
        library: &'a ToolLibrary,
        all: impl Iterator<Item = &'a Arc<Tool>>,
        mixed: bool,
        wanted: impl Fn(&Tool) -> bool,
    ) -> Result<Vec<Arc<Tool>>, Faults> {
        let ToolChoice::Named(names) = &self.tools else { return Ok(all.cloned().collect()) };
        let (mut faults, mut tools) = (Vec::new(), Vec::new());
        for name in names {
            match library.get(name) {
                Some(tool) if wanted(tool) => tools.push(Arc::clone(tool)),
                Some(_) if mixed => {}
                _ => {
                    let (message, advice) = match self.levers {
                        Some(_) => unknown_blade(name, library),
                        None => unknown_tool(name, library),
                    };
                    faults.push(Fault::of_file(&self.name, message, advice));
                }
            }
        }
        if faults.is_empty() { Ok(tools) } else { Err(Faults(faults)) }
    }
}

/// Reads a task file and checks the tools it names against `library`, so that an unknown tool is
/// reported at its place together with all other faults.
///
/// # Errors
/// Returns all faults of the file, each with its place.
pub fn load_task(path: impl AsRef<Path>, library: &ToolLibrary) -> Result<Task, Faults> {
    let (file, text) = crate::asset::read_text(path.as_ref())?;
    parse_task(&text, &file, library)
}

/// Reads a task from `text`, as [`load_task`] does from a file; `file` is its name in faults.
///
/// # Errors
/// Returns all faults of the text, each with its place.
pub fn parse_task(text: &str, file: &str, library: &ToolLibrary) -> Result<Task, Faults> {
    parse_with(text, file, Some(library))
}

/// Reads a task from `text` and checks the tools it names against `library`, if given.
pub(in crate::asset) fn parse_with(
    text: &str,
    file: &str,
    library: Option<&ToolLibrary>,
) -> Result<Task, Faults> {
    let source = Source::yaml(file, text);
    let mut root = Node::parse(source)?;
    let mut ledger = Ledger::new(source);
    check(&mut root, &TASK, &mut ledger);
    let task = task_of(&root, file, &mut ledger);
    if let Some(library) = library {
        check_tools(&root, library, &mut ledger);
        check_mounts(&root, task.as_ref(), library, &mut ledger);
    }
    ledger.finish(task)
}

/// Reports named tools that are not in the library or cannot be used in the task.
fn check_tools(root: &Node, library: &ToolLibrary, ledger: &mut Ledger) {
    if levers::allowed(root) {
        return check_blades(root, library, ledger);
    }
    let pushes = |name: &str| library.get(name).is_some_and(|tool| tool.pushes());
    for node in root.get("tools").map(Node::items).unwrap_or_default() {
        if let Some(name) = tool_name(node).filter(|name| !pushes(name)) {
            let (message, advice) = unknown_tool(name, library);
            ledger.fault(node, message, advice);
        }
    }
}

/// Reports named tools that the arm of the task cannot hold.
fn check_mounts(root: &Node, task: Option<&Task>, library: &ToolLibrary, ledger: &mut Ledger) {
    let Some(arm) = task.and_then(|task| task.arm.as_deref()) else { return };
    for node in root.get("tools").map(Node::items).unwrap_or_default() {
        let tool = tool_name(node).and_then(|name| library.get(name));
        if let Some((message, advice)) = tool.and_then(|tool| arm.refuses(tool)) {
            ledger.fault(node, message, advice);
        }
    }
}

/// Applies the rules that span several keys; returns `None` if a required value is missing.
pub(in crate::asset) fn task_of(root: &Node, file: &str, ledger: &mut Ledger) -> Option<Task> {
    rules::check(root, ledger);
    let robot = root.get("robot");
    let arm = robot.and_then(|robot| arm::arm(robot, root.get("pushes"), file, ledger));
    build::task(root, file, arm)
}

/// Returns the scene of another kind of file, checked by the rules for tasks. Bodies may penetrate
/// each other by up to `slack` metres. Returns `None` if a required value is missing.
pub(in crate::asset) fn scene_of(node: &Node, slack: f64, ledger: &mut Ledger) -> Option<Scene> {
    rules::check_scene(node, slack, ledger);
    build::scene(node)
}

fn unknown_tool(name: &str, library: &ToolLibrary) -> (String, String) {
    if library.get(name).is_some() {
        let message =
            format!("`{name}` has a blade, so it levers, but this task allows only pushes");
        return (message, "name a tool that pushes, or add `levers` to allow levering".into());
    }
    let known = library.iter().map(|tool| tool.name.as_str());
    (format!("unknown tool `{name}`"), did_you_mean(name, known))
}
