//! Efforts and budgets of a planner.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::plan::SearchSettings;

use super::LeverSettings;

/// Effort of a planner.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(rename_all = "snake_case")]
pub enum Effort {
    /// A first look.
    Draft,
    /// The default: a one-push task in well under half a second on two cores.
    #[default]
    Standard,
    /// The network in every rollout, and twice as many replays to tell how robust the plan is.
    Thorough,
}

impl Effort {
    /// The efforts, cheapest first.
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

/// Budgets of a planner, all counted and none in seconds, so that results do not depend on the
/// machine. A push of one object costs about 0.04 ms of one core in the prior, 0.16 in the network,
/// 1.1 in the planar engine and 9 in the 3-D one (`crates/lab/results/tradeoff.md`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Settings {
    /// Lateral offsets per contacting face. Three tell left, right and middle; from five on,
    /// neighbours are closer than refinement moves them.
    pub offsets: usize,
    /// States from which sequences are continued. Each costs about a hundred rollouts.
    pub beam: usize,
    /// Most rollouts of the search for each number of pushes: bounds what a large tool rack or
    /// a fine list of directions costs.
    pub search_rollouts: usize,
    /// Candidates refined, for each number of pushes. They are of different kinds (tool, grip,
    /// faces, directions), as the linear model cannot change kind.
    pub refined: usize,
    /// Rounds of refinement; one push needs eleven to thirteen rollouts a round, and an error of
    /// centimetres two to four rounds.
    pub refine_rounds: usize,
    /// Random samples a round besides two for each parameter: they average out contact noise.
    pub refine_extra: usize,
    /// Of the rounds of refinement, how many are left to the model that decides, where another one
    /// screens; the rounds before are the screening model's. Measured files from before that may
    /// lack it.
    #[serde(default)]
    pub decided_rounds: usize,
    /// Candidates that go through these rounds: the best after the model that decides has predicted
    /// them all.
    #[serde(default)]
    pub short_list: usize,
    /// Plans verified together. The nearest two nearly always hold one that works, and replays are a
    /// third to a half of the cost. More than two become fewer where there are more than four objects.
    pub verified_at_once: usize,
    /// Batches verified for each number of pushes before giving up on it.
    pub verify_batches: usize,
    /// Disturbed replays of the winning plan in each engine.
    pub disturbed: usize,
    /// Budgets of lever-ups; measured files of pushes may lack them.
    #[serde(default)]
    pub levers: LeverSettings,
}

/// A replay costs more the more objects there are, so at most this many, of all plans, are replayed
/// together: with four on the table, eight plans.
const REPLAYED_AT_ONCE: usize = 32;

impl Settings {
    /// Plans verified together where this many objects are on the table: fewer in a crowd, where
    /// the first ones are often good and their replays are most of the cost.
    pub(super) fn at_once(&self, objects: usize) -> usize {
        self.verified_at_once.min((REPLAYED_AT_ONCE / objects.max(1)).max(2)).max(1)
    }

    /// Returns these budgets with this many perturbed replays of the winning plan, in each engine.
    #[must_use]
    pub fn replaying(self, disturbed: usize) -> Self {
        Self { disturbed, levers: LeverSettings { disturbed, ..self.levers }, ..self }
    }

    /// The least that still searches, refines and verifies.
    pub const FIRST_LOOK: Settings = Settings {
        offsets: 3,
        beam: 8,
        search_rollouts: 500,
        refined: 3,
        refine_rounds: 2,
        refine_extra: 0,
        decided_rounds: 1,
        short_list: 1,
        verified_at_once: 1,
        verify_batches: 1,
        disturbed: 0,
        levers: LeverSettings::DRAFT,
    };

    /// The settings of the search, with a model that is off by `model_error` metres at times.
    pub fn search(&self, model_error: f64) -> SearchSettings {
        SearchSettings {
            offsets: self.offsets,
            beam: self.beam,
            rollouts: self.search_rollouts,
            // Variants of one kind stand close together in the ranking; enough to get past them.
            kept: self.refined.saturating_mul(64),
            model_error,
        }
    }
}
