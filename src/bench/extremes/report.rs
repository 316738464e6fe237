//! What was measured, as plain data.

use serde::{Deserialize, Serialize};

use crate::{bench::statistics::Summary, plan::QpStatus, solve::PlanStatus};

/// Which ordinary pushes the errors of a cell are measured by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ExtremeKind {
    /// One cylinder.
    Cylinder,
    /// One cuboid.
    Cuboid,
    /// Several objects that touch.
    Several,
    /// Objects in a row, joined.
    Jointed,
}

impl ExtremeKind {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Cylinder, Self::Cuboid, Self::Several, Self::Jointed];

    /// A word or two for tables.
    pub fn title(self) -> &'static str {
        match self {
            Self::Cylinder => "cylinder",
            Self::Cuboid => "cuboid",
            Self::Several => "three touching",
            Self::Jointed => "three joined",
        }
    }
}

/// Errors of the ordinary pushes of a kind: what the extremes are measured by.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExtremeYardstick {
    /// Which kind.
    pub kind: ExtremeKind,
    /// Largest error of a push, metres.
    pub error: Summary,
    /// Largest motion of a push, metres.
    pub motion: Summary,
    /// Share of the pushes that the rule calls wrong.
    pub wrong: f64,
}

/// What became of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Right, and no warning.
    Right,
    /// Right, and the model warned: it did not know that it would be.
    RightFlagged,
    /// Wrong, and the model warned.
    WrongFlagged,
    /// The planar engine itself cannot be trusted, and the model warned.
    Undecided,
    /// Wrong or undecided without a warning, not finite or not bounded.
    Defect,
}

impl Verdict {
    /// A word or two for tables.
    pub fn title(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::RightFlagged => "right, flagged",
            Self::WrongFlagged => "wrong, flagged",
            Self::Undecided => "no truth, flagged",
            Self::Defect => "DEFECT",
        }
    }
}

/// Pushes with one extreme in common.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExtremeCell {
    /// What is extreme.
    pub factor: String,
    /// How extreme it is.
    pub value: String,
    /// Which ordinary pushes its errors are measured by.
    pub kind: ExtremeKind,
    /// Number of pushes.
    pub pushes: usize,
    /// Of them, how many had a finite answer in every frame.
    pub finite: usize,
    /// Of them, how many kept within what the tool could do.
    pub bounded: usize,
    /// Largest true motion of a push, metres; nothing where no push had a finite answer.
    pub motion: Option<Summary>,
    /// Largest error of a push, metres.
    pub error: Option<Summary>,
    /// The planar engine against itself with half the time step, metres.
    pub own: Option<Summary>,
    /// Pushes that the rule calls wrong.
    pub wrong: usize,
    /// Pushes for which the truth's own uncertainty is larger than the rule's bound.
    pub undecided: usize,
    /// Pushes that the model warned of.
    pub flagged: usize,
    /// Pushes that are wrong and not flagged.
    pub silent: usize,
    /// What the model warned of, each once.
    pub warnings: Vec<String>,
    /// Why the planar engine cannot be trusted, where that is known.
    pub doubt: Option<String>,
    /// What became of it.
    pub verdict: Verdict,
}

/// A quadratic programme with extreme numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProgrammeCell {
    /// What is extreme.
    pub name: String,
    /// How solving ended.
    pub status: QpStatus,
    /// Largest violation of a constraint, in units of its row's size; nothing without an answer.
    pub violation: Option<f64>,
    /// By how much the objective is above the reference's, relative to its range; nothing
    /// without an answer or a reference.
    pub excess: Option<f64>,
    /// Whether that is what it should be.
    pub sound: bool,
}

/// A task with extreme numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TaskCell {
    /// What is extreme.
    pub name: String,
    /// How solving ended; nothing where the task was refused.
    pub status: Option<PlanStatus>,
    /// Why the task was refused.
    pub refused: Option<String>,
    /// Pushes of the first plan.
    pub pushes: Option<usize>,
    /// Its predicted error, metres.
    pub error: Option<f64>,
    /// Rollouts that were spent.
    pub rollouts: usize,
    /// Whether that is what it should be.
    pub sound: bool,
}

/// Everything that was measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExtremesReport {
    /// Name of the model.
    pub model: String,
    /// Seed of the pushes.
    pub seed: u64,
    /// Pushes a cell, where they are not few because they are long.
    pub pushes: usize,
    /// What the cells are measured by.
    pub yardsticks: Vec<ExtremeYardstick>,
    /// The rollouts.
    pub cells: Vec<ExtremeCell>,
    /// The quadratic programmes.
    pub programmes: Vec<ProgrammeCell>,
    /// The tasks.
    pub tasks: Vec<TaskCell>,
}

impl ExtremesReport {
    /// Number of cells that must be mended.
    pub fn defects(&self) -> usize {
        let cells = self.cells.iter().filter(|cell| cell.verdict == Verdict::Defect).count();
        let programmes = self.programmes.iter().filter(|cell| !cell.sound).count();
        let tasks = self.tasks.iter().filter(|cell| !cell.sound).count();
        cells + programmes + tasks
    }
}
