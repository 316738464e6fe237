//! Efforts and budgets of a planner.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::plan::SearchSettings;
use crate::task::Task;

use super::LeverSettings;

/// Effort of a planner.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(rename_all = "snake_case")]
pub enum Effort {
    /// Quick draft.
    Draft,
    /// Default effort: a one-push task takes well under half a second on two cores.
    #[default]
    Standard,
    /// The network in every rollout, and twice as many replays to measure robustness.
    Thorough,
}

impl Effort {
    /// Efforts, cheapest first.
    pub const ALL: [Effort; 3] = [Effort::Draft, Effort::Standard, Effort::Thorough];
}

impl fmt::Display for Effort {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Effort::Draft => "draft",
            Effort::Standard => "standard",
            Effort::Thorough => "thorough",
        })
    }
}

/// Budgets of a planner, as counts and not in seconds, so that results do not depend on the
/// machine. A push of one object costs about twice as much in the network as in the analytic model,
/// tens of times as much in 2-D simulation, and hundreds of times as much in 3-D simulation
/// (`crates/lab/results/tradeoff.md`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Settings {
    /// Number of lateral offsets per contacting face. Three distinguish left, right and middle;
    /// with five or more, neighbours are closer than the range of refinement.
    pub offsets: usize,
    /// Number of states from which sequences are continued. Each costs about a hundred rollouts.
    pub beam: usize,
    /// Maximum number of rollouts of the search for each number of pushes. It bounds the cost of a
    /// large tool rack or a fine list of directions.
    pub search_rollouts: usize,
    /// Number of candidates refined for each number of pushes. They are of different kinds (tool,
    /// grip, faces, directions), because the linear model cannot change the kind.
    pub refined: usize,
    /// Number of rounds of refinement. One push needs eleven to thirteen rollouts a round, and an
    /// error of centimetres two to four rounds.
    pub refine_rounds: usize,
    /// Number of random samples per round in addition to two for each parameter. They average out
    /// contact noise.
    pub refine_extra: usize,
    /// Number of plans verified together. The nearest two nearly always hold one that works, and
    /// replays are a third to a half of the cost. Numbers above two are reduced if there are more
    /// than four objects.
    pub verified_at_once: usize,
    /// Maximum number of batches verified for each number of pushes.
    pub verify_batches: usize,
    /// Number of perturbed replays of the winning plan in each engine.
    pub replays: usize,
    /// Budgets of lever-ups; measured files of pushes may lack them.
    #[serde(default)]
    pub levers: LeverSettings,
}

/// Maximum number of objects in all plans replayed together, because the cost of a replay grows
/// with its objects: with four on the table, eight plans.
const REPLAYED_AT_ONCE: usize = 32;

/// Maximum number of refined candidates for which a level of the search ends early.
const GATED: usize = 8;

impl Settings {
    /// Returns the number of plans verified together with this many objects on the table. It is
    /// smaller in a crowd, where the first plans are often good and their replays are most of the
    /// cost.
    pub(super) fn at_once(&self, objects: usize) -> usize {
        self.verified_at_once.min((REPLAYED_AT_ONCE / objects.max(1)).max(2)).max(1)
    }

    /// Returns these budgets with this many perturbed replays of the winning plan, in each engine.
    #[must_use]
    pub fn replaying(self, replays: usize) -> Self {
        Self { replays, levers: LeverSettings { replays, ..self.levers }, ..self }
    }

    /// Returns the budgets of a first attempt: a draft's, with as many replays. Most tasks need no
    /// more, but a comparison of the tools' costs does.
    #[must_use]
    pub fn first_attempt(&self, task: &Task) -> Self {
        if !task.tool_costs.is_empty() {
            return *self;
        }
        let draft = Effort::Draft.settings();
        Self {
            offsets: self.offsets.min(draft.offsets),
            beam: self.beam.min(draft.beam),
            search_rollouts: self.search_rollouts.min(draft.search_rollouts),
            refined: self.refined.min(draft.refined),
            refine_rounds: self.refine_rounds.min(draft.refine_rounds),
            refine_extra: self.refine_extra.min(draft.refine_extra),
            verify_batches: self.verify_batches.min(draft.verify_batches),
            ..*self
        }
    }

    /// Smallest budgets that still search, refine and verify.
    pub const FIRST_LOOK: Settings = Settings {
        offsets: 3,
        beam: 8,
        search_rollouts: 500,
        refined: 3,
        refine_rounds: 2,
        refine_extra: 0,
        verified_at_once: 1,
        verify_batches: 1,
        replays: 0,
        levers: LeverSettings::DRAFT,
    };

    /// Returns the settings of the search for a model with an occasional error of `model_error`
    /// metres.
    pub fn search(&self, model_error: f64) -> SearchSettings {
        SearchSettings {
            offsets: self.offsets,
            fine_offsets: false,
            beam: self.beam,
            rollouts: self.search_rollouts,
            // Variants of one kind have close ranks; this number suffices to get past them.
            kept: self.refined.saturating_mul(64),
            // With all budgets a level is rolled out whole: in two of 300 random tasks the plan
            // that works is not of the kinds that come first.
            kinds: if self.refined <= GATED { self.refined } else { usize::MAX },
            model_error,
        }
    }
}
