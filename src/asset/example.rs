//! Tasks shipped with the program, embedded so that no files are needed.

use crate::task::Task;

use super::diagnostic::{Fault, Faults, did_you_mean};
use super::library::ToolLibrary;
use super::task::parse_with;

/// Files in `tasks`, without the extension.
macro_rules! shipped {
    ($($file:literal)*) => {
        &[$(($file, include_str!(concat!("../../tasks/", $file, ".yaml")))),*]
    };
}

const SHIPPED: &[(&str, &str)] = shipped! {
    "around-corner"
    "blocks-by-the-wall"
    "books-together"
    "boxed-in"
    "bracket"
    "cabinet-door"
    "cluster-neighbour"
    "cork-over-the-edge"
    "coupled-or-not"
    "cover-the-mark"
    "crowd"
    "diagonal"
    "drawer-above-a-saucer"
    "drawer-behind-a-cup"
    "drawer-or-box"
    "drawer"
    "everything-hidden"
    "fence-flush"
    "fork-beside-plate"
    "glide"
    "handle-to-the-front"
    "heavy-crate"
    "heavy-or-light"
    "hexagon-any-side"
    "hidden-hinge"
    "hinged-train"
    "into-the-tray"
    "jointed-pair"
    "keep-heading"
    "left-with-hook"
    "narrow-gap"
    "one-or-two"
    "open-door"
    "plate-to-the-edge"
    "pull-back-behind-wall"
    "pull-back-twice"
    "pull-back"
    "pull-drawer"
    "push-out-of-reach"
    "reference-chain"
    "shut-drawer"
    "sideways-sweep"
    "taken-place"
    "too-far"
    "triangle-turned"
    "turn-the-box"
    "two-places"
    "two-tools"
    "unknown-slide"
    "unknown-train"
    "wide-sweep"
    "levers/drive-board"
    "levers/drive-two-notches"
    "levers/flip-plate"
    "levers/move-plate"
    "levers/raise-plate"
    "levers/turn-and-push"
    "levers/walled-in"
};

impl Task {
    /// Returns a shipped task by name; no files are needed. [`Task::examples`] lists the names.
    ///
    /// # Errors
    /// Returns an error if no shipped task has this name.
    pub fn example(name: &str) -> Result<Self, Faults> {
        read(name, None)
    }

    /// Returns the names of the shipped tasks: pushing tasks first, then levering tasks.
    pub fn examples() -> impl Iterator<Item = &'static str> {
        SHIPPED.iter().map(|(file, _)| name_of(file))
    }
}

/// Returns a shipped task and checks its tool names against `library`.
///
/// # Errors
/// Returns an error if no shipped task has this name, or `library` lacks a tool that the task
/// names.
pub fn load_example(name: &str, library: &ToolLibrary) -> Result<Task, Faults> {
    read(name, Some(library))
}

/// Returns the text of a shipped task.
///
/// # Errors
/// Returns an error if no shipped task has this name.
pub fn example_text(name: &str) -> Result<&'static str, Faults> {
    match SHIPPED.iter().find(|(file, _)| name_of(file) == name) {
        Some((_, text)) => Ok(text),
        None => {
            let advice = did_you_mean(name, Task::examples());
            Err(Fault::of_file(&format!("example `{name}`"), "there is no such task", advice)
                .into())
        }
    }
}

fn read(name: &str, library: Option<&ToolLibrary>) -> Result<Task, Faults> {
    parse_with(example_text(name)?, &format!("{name}.yaml"), library)
}

/// Returns the last component of the path.
fn name_of(file: &'static str) -> &'static str {
    file.rsplit('/').next().unwrap_or(file)
}
