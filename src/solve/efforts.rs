//! What the efforts stand for: measured levels of planning.
//!
//! `pushplan tradeoff` measures success and cost of every level and says which of those on its
//! front each effort is (`models/tradeoff.json`). A test compares the rows below with that file,
//! and fails when another measured level is both cheaper and more successful.

use std::num::NonZeroU16;

use crate::effect::{EffectModels, ModelError, Routed};
use crate::scene::{Engine, ModelKind, ModelSpec, Rate};

use super::{Effort, Settings};

/// The planar engine that pushes into crowds are left to: among touching objects it is off by less
/// in the plane than network and prior (in 3-D the network is nearer: 5.7 and 6.3 mm), and costs a
/// quarter of what the engine does at its default step.
const CROWD_ENGINE: ModelKind =
    ModelKind::Simulated { engine: Engine::Planar, rate: Rate(NonZeroU16::MIN.saturating_add(59)) };

/// The most objects that a push can set in motion for which prior and network are clearly cheaper
/// than [`CROWD_ENGINE`]: where their costs cross, by straight lines in logarithms between the
/// numbers of objects that were measured.
const FEW_FOR_PRIOR: u16 = 2;
const FEW_FOR_NETWORK: u16 = 1;

/// Coarse search, usual refinement, up to 8 verified.
const COARSE: Settings = Settings {
    offsets: 3,
    beam: 8,
    search_rollouts: 500,
    refined: 8,
    refine_rounds: 4,
    refine_extra: 2,
    verified_at_once: 4,
    verify_batches: 2,
    disturbed: 0,
};

/// Medium search, strong refinement, up to 24 verified.
const MEDIUM: Settings = Settings {
    offsets: 5,
    beam: 24,
    search_rollouts: 2000,
    refined: 24,
    refine_rounds: 8,
    refine_extra: 4,
    verified_at_once: 8,
    verify_batches: 3,
    disturbed: 0,
};

/// Fine search, strong refinement, up to 24 verified.
const FINE: Settings = Settings { offsets: 9, beam: 64, search_rollouts: 8000, ..MEDIUM };

impl Effort {
    /// The model for few objects and how many those are, the budgets, and the disturbed replays of
    /// the winning plan in each engine: what a look, a usual answer, a careful one and a thorough
    /// study are worth.
    const fn level(self) -> ((ModelKind, u16), Settings, usize) {
        let prior = (ModelKind::PRIOR, FEW_FOR_PRIOR);
        let network = (ModelKind::NETWORK, FEW_FOR_NETWORK);
        match self {
            Effort::Draft => (prior, COARSE, 4),
            Effort::Standard => (prior, MEDIUM, 8),
            Effort::Thorough => (network, MEDIUM, 16),
            Effort::Exhaustive => (network, FINE, 64),
        }
    }

    /// What it means in numbers: the budgets of its level, and the replays that tell how robust
    /// the plan is.
    pub fn settings(self) -> Settings {
        let (_, settings, disturbed) = self.level();
        Settings { disturbed, ..settings }
    }

    /// The effect model of its level, and the planar engine for pushes that reach so many objects
    /// that the model is no longer clearly cheaper.
    pub fn spec(self) -> ModelSpec {
        let ((model, few), ..) = self.level();
        ModelSpec::of(model).up_to(few).or(CROWD_ENGINE)
    }

    /// [`Effort::spec`], ready to use.
    ///
    /// # Errors
    /// [`ModelError`] if the library was built around a damaged weights file.
    pub fn model(self) -> Result<Routed, ModelError> {
        EffectModels::build(&self.spec())
    }
}
