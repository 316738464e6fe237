//! Efforts: measured levels of planning.
//!
//! `pushplan-lab tradeoff` measures robustness and cost of every level and says which of those on its
//! front each effort is (`crates/lab/results/tradeoff.json`): of those in which the network decides. A test
//! compares the rows below with that file, and fails when another such level is both cheaper and more
//! robust.

use std::num::NonZeroU16;

use crate::scene::{Engine, ModelKind, ModelSpec, Models, Rate};

use super::{Effort, LeverSettings, Settings};

/// The planar engine that pushes into crowds are left to: among touching objects it is off by less
/// in the plane than the prior, and costs a quarter of the engine at its default step.
const CROWD_ENGINE: ModelKind = planar(60);

/// The most objects that a push can set in motion for which the prior is clearly cheaper than
/// [`CROWD_ENGINE`]: where their costs cross, by straight lines in logarithms between the numbers
/// of objects that were measured, or the largest of these where they do not.
const FEW_FOR_PRIOR: u16 = 9;

/// The planar engine at this many steps a second, at least one.
const fn planar(rate: u16) -> ModelKind {
    let rate = Rate(NonZeroU16::MIN.saturating_add(rate.saturating_sub(1)));
    ModelKind::Simulated { engine: Engine::Planar, rate }
}

/// Coarse search, usual refinement, up to 8 verified, 4 disturbed.
const COARSE: Settings = Settings {
    offsets: 3,
    beam: 8,
    search_rollouts: 500,
    refined: 8,
    refine_rounds: 4,
    refine_extra: 2,
    decided_rounds: 1,
    short_list: 4,
    verified_at_once: 2,
    verify_batches: 4,
    disturbed: 4,
    levers: LeverSettings::DRAFT,
};

/// Medium search, strong refinement, up to 24 verified, 8 disturbed.
const MEDIUM: Settings = Settings {
    offsets: 5,
    beam: 24,
    search_rollouts: 2000,
    refined: 24,
    refine_rounds: 8,
    refine_extra: 4,
    decided_rounds: 2,
    short_list: 4,
    verified_at_once: 2,
    verify_batches: 12,
    disturbed: 8,
    levers: LeverSettings::STANDARD,
};

impl Effort {
    /// What screens, what decides, the budgets, and the disturbed replays of the winning plan in each
    /// engine: what a first look, a usual answer and a thorough one take. More replays than a level
    /// was measured with do not make its plans better, but measure their robustness more finely.
    const fn level(self) -> (ModelKind, ModelKind, Settings, usize) {
        match self {
            Effort::Draft => (ModelKind::PRIOR, ModelKind::NETWORK, COARSE, 4),
            Effort::Standard => (ModelKind::PRIOR, ModelKind::NETWORK, MEDIUM, 8),
            Effort::Thorough => (ModelKind::NETWORK, ModelKind::NETWORK, MEDIUM, 16),
        }
    }

    /// Its numbers: the budgets of its level, and the replays that tell how robust the plan is.
    pub fn settings(self) -> Settings {
        let (.., settings, disturbed) = self.level();
        let levers = match self {
            Effort::Draft => LeverSettings::DRAFT,
            Effort::Standard => LeverSettings::STANDARD,
            Effort::Thorough => LeverSettings::THOROUGH,
        };
        Settings { disturbed, levers, ..settings }
    }

    /// The effect models of its level: the prior screens, the network decides, and the planar engine
    /// does both for pushes that reach so many objects that the prior is no longer clearly cheaper.
    pub fn models(self) -> Models {
        let (screened, decided, ..) = self.level();
        let [screened, decided] = [screened, decided]
            .map(|model| ModelSpec::of(model).up_to(FEW_FOR_PRIOR).or(CROWD_ENGINE));
        Models { screened, decided }
    }
}
