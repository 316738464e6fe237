//! Whether a lever-up works, with the evidence, and why not.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::scene::Disturbance;

use super::{LeverOutcome, LeverTrajectory, LeverWarning};

/// What a lever-up does that no robot can do or its task does not allow.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeverFault {
    /// A tool that the task does not name.
    ForbiddenTool {
        /// Its name.
        tool: String,
    },
    /// A depth, angle, axis or plate that the task does not allow.
    ForbiddenLever {
        /// Which of them.
        what: String,
    },
    /// A lever point that is nearer to a corner than blades are set.
    NearCorner,
    /// The blade is thicker than the free height below the edge.
    TooThick,
    /// The tip would come out at the other side of the plate, or has no room beneath it.
    TooDeep,
    /// The blade would go through something fixed.
    Meets {
        /// The name of what it meets.
        body: String,
    },
    /// The tool of a push that follows would go through something fixed.
    PushMeets {
        /// The name of what it meets.
        body: String,
    },
    /// The shaft would go through the table.
    BelowTable,
    /// The end effector cannot be everywhere where it would have to be.
    OutOfReach,
    /// There is no support line that the axis could lie on.
    NoSupport,
    /// It takes longer than [`LeverUp::LONGEST`](super::LeverUp::LONGEST).
    TooLong,
}

impl fmt::Display for LeverFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ForbiddenTool { tool } => write!(f, "the task does not allow the {tool}"),
            Self::ForbiddenLever { what } => write!(f, "the task does not allow this {what}"),
            Self::NearCorner => f.write_str("the lever point is too close to a corner"),
            Self::TooThick => f.write_str("the blade is thicker than the clearance below the edge"),
            Self::TooDeep => f.write_str("the blade would reach through under the whole plate"),
            Self::Meets { body } => write!(f, "the blade would go through {body}"),
            Self::PushMeets { body } => write!(f, "the tool that pushes would go through {body}"),
            Self::BelowTable => f.write_str("the shaft would go through the table"),
            Self::OutOfReach => f.write_str("the end effector would leave its reach"),
            Self::TooLong => f.write_str("it would take more than two minutes"),
            Self::NoSupport => f.write_str("no support line to turn about"),
        }
    }
}

/// One replay of a lever-up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverEvidence {
    /// What was changed against the task as written.
    pub disturbance: Disturbance,
    /// What came of it.
    pub outcome: LeverOutcome,
    /// How the plate moved, of a nominal replay. Not written to files: replaying brings it back.
    #[serde(skip)]
    pub trajectory: Option<LeverTrajectory>,
}

/// Why a lever-up does not pass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeverReason {
    /// It does what its task or a robot does not allow.
    Forbidden(LeverFault),
    /// Something goes wrong on the way when it is replayed as written.
    GoesWrong(LeverWarning),
    /// It does not reach the goal when it is replayed as written.
    Misses,
    /// It works as written, but too seldom when the world is a little different.
    Fragile {
        /// Disturbed replays that reach the goal.
        reached: usize,
        /// How many were made.
        replays: usize,
        /// Share that was asked for.
        wanted: f64,
    },
    /// Verification was stopped before all replays were made.
    Stopped,
}

/// Whether a lever-up works, with what shows it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverVerdict {
    /// It breaks no rule, its replay as written reaches the goal, and so does the wanted share of
    /// the disturbed ones.
    pub passed: bool,
    /// Why not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<LeverReason>,
    /// What it does that it must not.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub forbidden: Vec<LeverFault>,
    /// All replays, the nominal one first.
    pub evidence: Vec<LeverEvidence>,
    /// Share of the disturbed replays that reach the goal, 0 to 1; `None` if none was made.
    pub robustness: Option<f64>,
}

impl LeverVerdict {
    /// The verdict by these replays, `wanted` being the share of the disturbed ones that must
    /// reach the goal.
    pub fn judge(forbidden: Vec<LeverFault>, evidence: Vec<LeverEvidence>, wanted: f64) -> Self {
        let disturbed = || evidence.iter().filter(|e| e.disturbance != Disturbance::Nominal);
        let replays = disturbed().count();
        let reached = disturbed().filter(|e| e.outcome.reached).count();
        let robustness = (replays > 0).then(|| reached as f64 / replays as f64);
        let mut verdict = Self { passed: false, reason: None, forbidden, evidence, robustness };
        verdict.reason = match (verdict.forbidden.first(), verdict.nominal()) {
            (Some(fault), _) => Some(LeverReason::Forbidden(fault.clone())),
            (None, Some(nominal)) if !nominal.outcome.reached => {
                let fault = nominal.outcome.fault();
                Some(fault.map_or(LeverReason::Misses, LeverReason::GoesWrong))
            }
            (None, None) => Some(LeverReason::Misses),
            _ if robustness.is_some_and(|share| share < wanted) => {
                Some(LeverReason::Fragile { reached, replays, wanted })
            }
            _ => None,
        };
        verdict.passed = verdict.reason.is_none();
        verdict
    }

    /// The verdict if not all replays were made: it does not pass.
    #[must_use]
    pub fn stopped(mut self) -> Self {
        self.reason = self.reason.or(Some(LeverReason::Stopped));
        self.passed = false;
        self
    }

    /// Whether it works as written; too seldom under disturbances, perhaps.
    pub fn works(&self) -> bool {
        matches!(self.reason, None | Some(LeverReason::Fragile { .. }))
    }

    /// The replay as written.
    pub fn nominal(&self) -> Option<&LeverEvidence> {
        self.evidence.iter().find(|e| e.disturbance == Disturbance::Nominal)
    }

    /// The disturbed replays, in the order of their draws.
    pub fn disturbed(&self) -> impl Iterator<Item = &LeverEvidence> {
        self.evidence.iter().filter(|e| e.disturbance != Disturbance::Nominal)
    }
}
