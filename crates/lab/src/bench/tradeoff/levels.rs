//! The levels of the ladder: predictors, and budgets of planning with them.

use std::num::{NonZeroU8, NonZeroU16};
use std::sync::Arc;

use pushplan::internals::effect::{EffectModel, EffectModels, ModelError};
use pushplan::internals::scene::{Engine, ModelKind, ModelSpec, Rate, Stride};
use pushplan::internals::solve::Settings;
use serde::{Deserialize, Serialize};

use crate::trivial::{self, Follow, Projection};

/// Numbers of frames predicted as one, in addition to single frames, for the shipped network and
/// its analytic model.
const STRIDES: [u8; 2] = [2, 4];

/// Rates of the engines in addition to the default, steps per second.
const PLANAR_RATES: [u16; 3] = [120, 60, 30];
const SPATIAL_RATES: [u16; 1] = [120];

/// A predictor to measure.
#[derive(Clone)]
pub struct Level {
    name: String,
    model: Arc<dyn EffectModel>,
}

impl Level {
    /// Creates the predictor of `spec`.
    ///
    /// # Errors
    /// Returns [`ModelError`] if it needs weights that cannot be used.
    pub fn new(spec: &ModelSpec) -> Result<Self, ModelError> {
        Ok(Self { name: spec.to_string(), model: Arc::new(trivial::load(spec)?) })
    }

    /// Returns the predictor.
    pub fn model(&self) -> Arc<dyn EffectModel> {
        Arc::clone(&self.model)
    }

    /// Returns its identifier and settings.
    pub fn spec(&self) -> &ModelSpec {
        self.model.spec()
    }

    /// Returns its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns `true` if jobs of one scene share work, so that a push costs less in a batch.
    pub(super) fn batches(&self) -> bool {
        matches!(self.kind(), ModelKind::Network { .. } | ModelKind::Prior { .. })
    }

    /// Returns `true` if it is also measured on scenes of several objects: engines and unreduced
    /// models.
    pub(super) fn is_plain(&self) -> bool {
        matches!(self.kind(), ModelKind::Simulated { .. })
            || (self.batches() && is_whole(self.kind()))
    }

    fn kind(&self) -> &ModelKind {
        &self.spec().first().kind
    }
}

/// Returns `true` if nothing is left out to reduce the cost.
fn is_whole(kind: &ModelKind) -> bool {
    match kind {
        ModelKind::Network { steps, stride, .. } => steps.is_none() && *stride == Stride::ONE,
        ModelKind::Prior { stride } => *stride == Stride::ONE,
        _ => true,
    }
}

/// Returns all predictors: the shipped network with its variants, the networks of `other` weights
/// files, the analytic model, the engines at several rates, and the trivial models.
///
/// # Errors
/// Returns [`ModelError`] if weights cannot be used.
pub fn levels(other: &[String]) -> Result<Vec<Level>, ModelError> {
    let strides = || STRIDES.into_iter().filter_map(NonZeroU8::new).map(Stride);
    let network = |weights, steps, stride| ModelKind::Network { weights, steps, stride };
    let rates = |engine: Engine, rates: &[u16]| {
        let rates = rates.iter().filter_map(|rate| NonZeroU16::new(*rate)).map(Rate);
        let rates = std::iter::once(Rate::DEFAULT).chain(rates);
        rates.map(|rate| ModelKind::Simulated { engine, rate }).collect::<Vec<_>>()
    };
    let trained = EffectModels::weights()?.card.config.steps as u8;
    let mut kinds = vec![ModelKind::NETWORK];
    kinds.extend(strides().map(|stride| network(None, None, stride)));
    kinds.extend((0..trained).map(|steps| network(None, Some(steps), Stride::ONE)));
    kinds.extend(other.iter().map(|file| network(Some(file.clone()), None, Stride::ONE)));
    kinds.push(ModelKind::PRIOR);
    kinds.extend(strides().map(|stride| ModelKind::Prior { stride }));
    kinds.extend(rates(Engine::Planar, &PLANAR_RATES));
    kinds.extend(rates(Engine::Spatial, &SPATIAL_RATES));
    kinds.extend([Projection::KIND, Follow::KIND, ModelKind::Still]);
    kinds.into_iter().map(|kind| Level::new(&kind.into())).collect()
}

/// A predictor with the budgets of a planner.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanLevel {
    /// Name of the models and budgets.
    pub name: String,
    /// Effect model.
    pub model: ModelSpec,
    /// Budgets of the planner.
    pub settings: Settings,
}

/// Density of a search: its name, lateral offsets, beam and rollouts.
type Search = (&'static str, usize, usize, usize);

/// Refinement: its name, candidates, rounds and extra samples.
type Refinement = (&'static str, usize, usize, usize);

const COARSE: Search = ("coarse", 3, 8, 500);
const MEDIUM: Search = ("medium", 5, 24, 2000);
const FINE: Search = ("fine", 9, 64, 8000);

const LIGHT: Refinement = ("light", 3, 2, 0);
const USUAL: Refinement = ("usual", 8, 4, 2);
const STRONG: Refinement = ("strong", 24, 8, 4);

/// Number of plans verified at once, of batches of them, and of perturbed replays of those that
/// work, in each engine. At least one plan is verified, because it is otherwise unknown whether the
/// plan works.
type Verified = (usize, usize, usize);

/// Budgets of the shipped network and of the analytic model.
const EVERY: [(Search, Refinement, Verified); 7] = [
    (COARSE, LIGHT, (1, 1, 0)),
    (COARSE, LIGHT, (2, 2, 4)),
    (COARSE, USUAL, (2, 4, 4)),
    (COARSE, USUAL, (2, 4, 8)),
    (MEDIUM, USUAL, (2, 4, 8)),
    (MEDIUM, STRONG, (2, 12, 8)),
    (FINE, STRONG, (2, 12, 16)),
];

/// Additional budget of the analytic model with more plans verified at once.
const MANY_AT_ONCE: (Search, Refinement, Verified) = (MEDIUM, STRONG, (8, 3, 8));

/// Budgets of other networks and of the 2-D engine at a coarse step.
const SOME: [(Search, Refinement, Verified); 3] =
    [(COARSE, LIGHT, (2, 2, 4)), (COARSE, USUAL, (2, 4, 8)), (MEDIUM, STRONG, (2, 12, 8))];

/// Budgets of the 2-D engine at its usual step.
const FEW: [(Search, Refinement, Verified); 1] = [(COARSE, LIGHT, (2, 2, 4))];

/// Returns the levels of planning with those predictors of `levels` that have budgets.
pub fn plan_levels(levels: &[Level]) -> Vec<PlanLevel> {
    let mut plans = Vec::new();
    for spec in levels.iter().map(Level::spec) {
        let budgets: &[_] = match spec.first().kind {
            ModelKind::NETWORK | ModelKind::PRIOR => &EVERY,
            ModelKind::Network { steps: None, stride: Stride::ONE, .. } => &SOME,
            ModelKind::PLANAR => &FEW,
            ModelKind::Simulated { engine: Engine::Planar, rate } if rate.0.get() <= 60 => &SOME,
            _ => &[],
        };
        plans.extend(budgets.iter().map(|budget| plan_level(spec, *budget)));
        if spec.first().kind == ModelKind::PRIOR {
            plans.push(plan_level(spec, MANY_AT_ONCE));
        }
    }
    plans
}

fn plan_level(model: &ModelSpec, budget: (Search, Refinement, Verified)) -> PlanLevel {
    let (search, refinement, (verified_at_once, verify_batches, replays)) = budget;
    let (density, offsets, beam, search_rollouts) = search;
    let (effort, refined, refine_rounds, refine_extra) = refinement;
    PlanLevel {
        name: format!(
            "{model}: {density} search, {effort} refinement, up to {} verified, {} at a time, \
             {} disturbed",
            verified_at_once * verify_batches,
            verified_at_once,
            replays
        ),
        model: model.clone(),
        settings: Settings {
            levers: pushplan::internals::solve::LeverSettings::STANDARD,
            offsets,
            beam,
            search_rollouts,
            refined,
            refine_rounds,
            refine_extra,
            verified_at_once,
            verify_batches,
            replays,
        },
    }
}
