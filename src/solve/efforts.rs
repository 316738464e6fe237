//! Efforts: model and budgets of each level of planning.
//!
//! `pushplan-lab tradeoff` measures robustness and cost of levels, and
//! `crates/lab/results/tradeoff.json` holds the published measurement. A test compares the rows
//! below with that file. If they differ, the published page must be marked stale; if they agree, no
//! other level with the network may be both cheaper and more robust.

use std::num::NonZeroU16;

use crate::scene::{Engine, ModelKind, ModelSpec, Rate};

use super::{Effort, LeverSettings, Settings};

/// 2-D engine for pushes into crowds. Among many objects it is cheaper than the network, and it
/// costs a quarter of the engine at its default step.
const CROWD_ENGINE: ModelKind = planar(60);

/// Maximum number of objects in motion for which the network replaces [`CROWD_ENGINE`]. While the
/// network is more accurate among touching objects, it is the largest measured number. Otherwise it
/// is the intersection of the costs of the network's analytic model and the engine, interpolated in
/// logarithms.
const FEW_FOR_NETWORK: u16 = 9;

/// Returns the 2-D engine at this many steps per second, at least one.
const fn planar(rate: u16) -> ModelKind {
    let rate = Rate(NonZeroU16::MIN.saturating_add(rate.saturating_sub(1)));
    ModelKind::Simulated { engine: Engine::Planar, rate }
}

/// Coarse search, usual refinement, up to 8 plans verified, 4 perturbed replays.
const COARSE: Settings = Settings {
    offsets: 3,
    beam: 8,
    search_rollouts: 500,
    refined: 8,
    refine_rounds: 4,
    refine_extra: 2,
    verified_at_once: 2,
    verify_batches: 4,
    replays: 4,
    levers: LeverSettings::DRAFT,
};

/// Medium search, strong refinement, up to 24 plans verified, 8 perturbed replays.
const MEDIUM: Settings = Settings {
    offsets: 5,
    beam: 24,
    search_rollouts: 2000,
    refined: 24,
    refine_rounds: 8,
    refine_extra: 4,
    verified_at_once: 2,
    verify_batches: 12,
    replays: 8,
    levers: LeverSettings::STANDARD,
};

impl Effort {
    /// Returns the budgets, and the number of perturbed replays of the winning plan in each engine.
    /// More replays than a level was measured with do not improve its plans, but measure their
    /// robustness more precisely.
    const fn level(self) -> (Settings, usize) {
        match self {
            Effort::Draft => (COARSE, 4),
            Effort::Standard => (MEDIUM, 8),
            Effort::Thorough => (MEDIUM, 16),
        }
    }

    /// Returns the budgets of the level and the number of replays that measure robustness.
    pub fn settings(self) -> Settings {
        let (settings, replays) = self.level();
        let levers = match self {
            Effort::Draft => LeverSettings::DRAFT,
            Effort::Standard => LeverSettings::STANDARD,
            Effort::Thorough => LeverSettings::THOROUGH,
        };
        Settings { replays, levers, ..settings }
    }

    /// Returns the effect model of the level: the network. The 2-D engine replaces it for pushes
    /// that move so many objects that the network is no longer clearly cheaper.
    pub fn model(self) -> ModelSpec {
        ModelSpec::of(ModelKind::NETWORK).up_to(FEW_FOR_NETWORK).or(CROWD_ENGINE)
    }
}
