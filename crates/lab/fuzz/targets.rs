//! The kinds of files, and the conditions on their readers.

use std::path::Path;

use clap::ValueEnum;
use pushplan::asset::{Faults, PlanFile, TrajectoryFile, check};
use pushplan::network::{PredictorWeights, WeightsError};
use pushplan::recording::Recording;
use pushplan::{scene::Tool, task::Task};
use pushplan_import::{Wanted, objects, parse, tool};

use crate::{levers, survive};

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Target {
    Tool,
    Task,
    Plan,
    Trajectory,
    Recording,
    Weights,
    Blade,
    LeverTask,
    LeverPlan,
    /// Files of other programs: MJCF and URDF.
    Foreign,
}

impl Target {
    pub const ALL: [Self; 10] = [
        Self::Tool,
        Self::Task,
        Self::Plan,
        Self::Trajectory,
        Self::Recording,
        Self::Weights,
        Self::Blade,
        Self::LeverTask,
        Self::LeverPlan,
        Self::Foreign,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::Tool => "tool",
            Self::Task => "task",
            Self::Plan => "plan",
            Self::Trajectory => "trajectory",
            Self::Recording => "recording",
            Self::Weights => "weights",
            Self::Blade => "blade",
            Self::LeverTask => "lever-task",
            Self::LeverPlan => "lever-plan",
            Self::Foreign => "foreign",
        }
    }

    /// Returns the extension of such files.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Tool | Self::Task | Self::Blade | Self::LeverTask => ".yaml",
            Self::LeverPlan | Self::Plan | Self::Trajectory | Self::Recording => ".json",
            Self::Weights => ".safetensors",
            Self::Foreign => ".xml",
        }
    }

    /// Reads `input` and uses its content. Returns `true` if it was accepted.
    pub fn run(self, input: &[u8]) -> bool {
        if self == Self::Weights {
            return match sealed(input) {
                Ok(weights) => {
                    survive::weights(weights);
                    true
                }
                Err(error) => {
                    assert!(!error.to_string().is_empty());
                    false
                }
            };
        }
        let Ok(text) = std::str::from_utf8(input) else {
            refused_as_file(input, self.ending());
            return false;
        };
        let file = format!("fuzz{}", self.ending());
        match self {
            Self::Tool => read(Tool::parse(text, &file), text, survive::tool),
            Self::Task => read(Task::parse(text, &file), text, survive::task),
            Self::Plan => read(PlanFile::parse(text, &file), text, survive::plan),
            Self::Trajectory => read(TrajectoryFile::parse(text, &file), text, survive::trajectory),
            Self::Recording => read(Recording::parse(text, &file), text, survive::recording),
            Self::Blade => read(Tool::parse(text, &file), text, levers::blade),
            Self::LeverTask => read(Task::parse(text, &file), text, levers::task),
            Self::LeverPlan => read(PlanFile::parse(text, &file), text, levers::plan),
            Self::Foreign => foreign(text, &file),
            Self::Weights => false,
        }
    }
}

/// Reads a file of another program as a tool and as a scene; the results are used like any other.
fn foreign(text: &str, file: &str) -> bool {
    let wanted = Wanted::default();
    let spoken = |faults: Faults| {
        assert!(!faults.0.is_empty(), "refused without a fault");
        assert!(faults.0.iter().all(|fault| !fault.message.trim().is_empty()));
    };
    let model = match parse(text, file) {
        Ok((model, ..)) => model,
        Err(faults) => {
            explained(&faults, text);
            return false;
        }
    };
    let tool = tool(&model, file, &wanted).map(|made| survive::tool(made.value)).map_err(spoken);
    let scene = objects(&model, file, &wanted).map(|made| survive::task(made.value.task));
    tool.is_ok() | scene.map_err(spoken).is_ok()
}

/// Reads weights from `input`, with the checksum corrected so that damage is not hidden behind it.
fn sealed(input: &[u8]) -> Result<PredictorWeights, WeightsError> {
    let result = PredictorWeights::from_bytes(input);
    let Err(WeightsError::Checksum { written, found }) = &result else { return result };
    let at = input.windows(written.len().max(1)).position(|bytes| bytes == written.as_bytes());
    match at {
        Some(at) if written.len() == found.len() => {
            let mut input = input.to_vec();
            input[at..at + found.len()].copy_from_slice(found.as_bytes());
            PredictorWeights::from_bytes(&input)
        }
        _ => result,
    }
}

fn read<T>(result: Result<T, Faults>, text: &str, survive: impl FnOnce(T)) -> bool {
    match result {
        Ok(value) => {
            survive(value);
            true
        }
        Err(faults) => {
            explained(&faults, text);
            false
        }
    }
}

/// Asserts that every fault has a message, advice and a place within the text.
fn explained(faults: &Faults, text: &str) {
    assert!(!faults.0.is_empty(), "refused without a fault");
    let lines: Vec<&str> = text.split('\n').collect();
    for fault in &faults.0 {
        assert!(!fault.message.trim().is_empty(), "a fault without words");
        let Some(place) = fault.place else {
            // A summary of many faults has no place of its own.
            let many = fault.message.starts_with("and ") && fault.message.ends_with(" more");
            assert!(many, "no place: {fault}");
            continue;
        };
        assert!(place.line >= 1 && place.column >= 1, "{place:?}: {fault}");
        assert!(place.line <= lines.len() + 1, "behind the last line: {fault}");
        // YAML has further line ends.
        if text.contains(['\r', '\u{85}', '\u{2028}', '\u{2029}']) {
            continue;
        }
        // A tab, or the end of the line, may count for one more.
        let length = lines.get(place.line - 1).map_or(0, |line| line.chars().count());
        assert!(place.column <= length + 2, "behind the end of the line: {fault}");
    }
}

/// Asserts that a file that is not a text is refused by its path.
fn refused_as_file(input: &[u8], ending: &str) {
    let folder = tempfile::tempdir().expect("a folder for a moment");
    let path = folder.path().join(format!("fuzz{ending}"));
    std::fs::write(&path, input).expect("a file for a moment");
    let faults = check(&path, None).expect_err("not text");
    assert!(faults.to_string().contains("UTF-8"), "{faults}");
    unchanged(&path, input);
}

fn unchanged(path: &Path, input: &[u8]) {
    assert_eq!(std::fs::read(path).ok().as_deref(), Some(input), "reading changed the file");
}
