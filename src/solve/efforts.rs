//! What the efforts stand for: measured levels of planning.
//!
//! `pushplan-lab tradeoff` measures robustness and cost of every level and says which of those on its
//! front each effort is (`crates/lab/results/tradeoff.json`). A test compares the rows below with that file,
//! and fails when another measured level is both cheaper and more robust.

use std::num::NonZeroU16;

use crate::effect::{EffectModels, ModelError, Routed};
use crate::scene::{Engine, ModelKind, ModelSpec, Rate};

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
    verified_at_once: 4,
    verify_batches: 2,
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
    verified_at_once: 8,
    verify_batches: 3,
    disturbed: 8,
    levers: LeverSettings::STANDARD,
};

impl Effort {
    /// The model, the budgets, and the disturbed replays of the winning plan in each engine: what a
    /// first look, a usual answer and a thorough one take. More replays than a level was measured
    /// with do not make its plans better, but measure their robustness more finely.
    const fn level(self) -> (ModelKind, Settings, usize) {
        match self {
            Effort::Draft => (ModelKind::PRIOR, COARSE, 4),
            Effort::Standard => (ModelKind::PRIOR, MEDIUM, 8),
            Effort::Thorough => (planar(30), MEDIUM, 16),
        }
    }

    /// Its numbers: the budgets of its level, and the replays that tell how robust the plan is.
    pub fn settings(self) -> Settings {
        let (_, settings, disturbed) = self.level();
        let levers = match self {
            Effort::Draft => LeverSettings::DRAFT,
            Effort::Standard => LeverSettings::STANDARD,
            Effort::Thorough => LeverSettings::THOROUGH,
        };
        Settings { disturbed, levers, ..settings }
    }

    /// The effect model of its level; where that is the prior, the planar engine for pushes that
    /// reach so many objects that the prior is no longer clearly cheaper.
    pub fn spec(self) -> ModelSpec {
        let (model, ..) = self.level();
        match model {
            ModelKind::PRIOR => ModelSpec::of(model).up_to(FEW_FOR_PRIOR).or(CROWD_ENGINE),
            _ => ModelSpec::of(model),
        }
    }

    /// [`Effort::spec`], ready to use.
    ///
    /// # Errors
    /// [`ModelError`] if the library was built around a damaged weights file.
    pub fn model(self) -> Result<Routed, ModelError> {
        EffectModels::build(&self.spec())
    }
}
