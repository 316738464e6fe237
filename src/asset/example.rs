//! The tasks shipped with the program, which need no files.

use crate::task::Task;

use super::fault::{Fault, Faults, did_you_mean};
use super::library::ToolLibrary;
use super::task::parse_with;

/// Their files in `tasks`, without the ending.
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
    /// A shipped task; [`Task::examples`] lists them. Needs no files.
    ///
    /// # Errors
    /// If there is none of this name.
    pub fn example(name: &str) -> Result<Self, Faults> {
        read(name, None)
    }

    /// Names of the shipped tasks: those of pushes, then those of levering.
    pub fn examples() -> impl Iterator<Item = &'static str> {
        SHIPPED.iter().map(|(file, _)| name_of(file))
    }
}

/// A shipped task, with the tools it names checked against `library`.
///
/// # Errors
/// If there is none of this name; names of tools that `library` does not have.
pub fn load_example(name: &str, library: &ToolLibrary) -> Result<Task, Faults> {
    read(name, Some(library))
}

/// The text of a shipped task.
///
/// # Errors
/// If there is none of this name.
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

/// The last part of its path.
fn name_of(file: &'static str) -> &'static str {
    file.rsplit('/').next().unwrap_or(file)
}
