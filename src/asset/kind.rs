//! Recognition and checking of any user file.

use std::fmt;
use std::path::Path;

use crate::recording::Recording;
use crate::scene::Tool;

use super::blade::BLADE_TOOL_KEYS;
use super::diagnostic::{Fault, Faults};
use super::library::ToolLibrary;
use super::node::Node;
use super::recording::RECORDING_KEYS;
use super::saved::{PlanFile, TrajectoryFile};
use super::text::{Source, read_text};
use super::{spec::Key, task, tool, world};

/// Kind of a user file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Tool file.
    Tool,
    /// Task file.
    Task,
    /// Plan file.
    Plan,
    /// Trajectory file.
    Trajectory,
    /// Recording.
    Recording,
    /// World file.
    World,
    /// Saved run.
    Run,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Kind::Tool => "tool",
            Kind::Task => "task",
            Kind::Plan => "plan",
            Kind::Trajectory => "trajectory",
            Kind::Recording => "recording",
            Kind::World => "world",
            Kind::Run => "run",
        })
    }
}

/// Recognises the file at `path` by its content and checks it fully, except for a run. If `library`
/// is given, it must contain the tools that a task names.
///
/// # Errors
/// Returns all faults of the file, each with its place.
pub fn check(path: impl AsRef<Path>, library: Option<&ToolLibrary>) -> Result<Kind, Faults> {
    let (file, text) = read_text(path.as_ref())?;
    let kind = recognise(&file, &text)?;
    match kind {
        Kind::Tool => Tool::parse(&text, &file).map(|_| kind),
        Kind::Task => task::parse_with(&text, &file, library).map(|_| kind),
        Kind::Plan => PlanFile::parse(&text, &file).map(|_| kind),
        Kind::Trajectory => TrajectoryFile::parse(&text, &file).map(|_| kind),
        Kind::Recording => Recording::parse(&text, &file).map(|_| kind),
        // Entries on a task's objects can be checked only together with the task.
        Kind::World => world::check_world(&text, &file).map(|()| kind),
        // Recognised only; crate `act` reads the content.
        Kind::Run => Ok(kind),
    }
}

fn recognise(file: &str, text: &str) -> Result<Kind, Faults> {
    let root = Node::parse(Source::of(file, text))?;
    match root.get("kind").and_then(Node::text) {
        Some("plan") => return Ok(Kind::Plan),
        Some("trajectory") => return Ok(Kind::Trajectory),
        Some("recording") => return Ok(Kind::Recording),
        Some("run") => return Ok(Kind::Run),
        _ => {}
    }
    // Decided by the number of matching keys, so that a misspelled key does not hide the intended
    // kind.
    let fitting = |keys: &[Key]| keys.iter().filter(|key| root.get(key.name).is_some()).count();
    let kinds = [
        (fitting(tool::TOOL_KEYS).max(fitting(BLADE_TOOL_KEYS)), Kind::Tool),
        (fitting(task::TASK_KEYS), Kind::Task),
        (fitting(RECORDING_KEYS), Kind::Recording),
        (fitting(world::WORLD_KEYS), Kind::World),
    ];
    let most = kinds.iter().map(|(keys, _)| *keys).max().unwrap_or(0);
    let mut best = kinds.into_iter().filter(|(keys, _)| *keys == most).map(|(_, kind)| kind);
    match (best.next(), best.next()) {
        (Some(kind), None) => Ok(kind),
        _ => {
            let message = "this is not a tool, task, plan, trajectory, recording or world file";
            let advice = "`pushplan check --schema KIND` prints the format of such files";
            Err(Fault::of_file(file, message, advice).into())
        }
    }
}
