//! The levels of the ladder: predictors, and budgets of planning with them.

use std::num::{NonZeroU8, NonZeroU16};
use std::sync::Arc;

use pushplan::internals::effect::{EffectModel, EffectModels, ModelError};
use pushplan::internals::scene::{Engine, ModelKind, ModelSpec, Rate, Stride};
use pushplan::internals::solve::Settings;
use serde::{Deserialize, Serialize};

/// Frames predicted as one, besides single frames, that the shipped network and its prior are
/// measured with.
const STRIDES: [u8; 2] = [2, 4];

/// Steps a second besides the default that the engines are measured with.
const PLANAR_RATES: [u16; 3] = [120, 60, 30];
const SPATIAL_RATES: [u16; 1] = [120];

/// A predictor to measure.
#[derive(Clone)]
pub struct Level {
    name: String,
    model: Arc<dyn EffectModel>,
}

impl Level {
    /// The predictor that `spec` describes.
    ///
    /// # Errors
    /// [`ModelError`] if it needs weights that cannot be used.
    pub fn new(spec: &ModelSpec) -> Result<Self, ModelError> {
        Ok(Self { name: spec.to_string(), model: Arc::new(EffectModels::build(spec)?) })
    }

    /// The predictor.
    pub fn model(&self) -> Arc<dyn EffectModel> {
        Arc::clone(&self.model)
    }

    /// What it is.
    pub fn spec(&self) -> &ModelSpec {
        self.model.spec()
    }

    /// The same in words.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether jobs of one scene share work: then a push costs less in a batch.
    pub(super) fn batches(&self) -> bool {
        matches!(self.kind(), ModelKind::Network { .. } | ModelKind::Prior { .. })
    }

    /// Whether it is measured on scenes of several objects too: engines and whole models.
    pub(super) fn is_plain(&self) -> bool {
        matches!(self.kind(), ModelKind::Simulated { .. })
            || (self.batches() && is_whole(self.kind()))
    }

    fn kind(&self) -> &ModelKind {
        &self.spec().first().kind
    }
}

/// Whether nothing is left out to make it cheaper.
fn is_whole(kind: &ModelKind) -> bool {
    match kind {
        ModelKind::Network { steps, stride, .. } => steps.is_none() && *stride == Stride::ONE,
        ModelKind::Prior { stride } => *stride == Stride::ONE,
        _ => true,
    }
}

/// All predictors: the shipped network with its variants, those of `other` weights files, the
/// prior, the engines at several steps, and the trivial ones.
///
/// # Errors
/// [`ModelError`] if weights cannot be used.
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
    kinds.extend([ModelKind::Projection, ModelKind::Follow, ModelKind::Still]);
    kinds.into_iter().map(|kind| Level::new(&kind.into())).collect()
}

/// A predictor with the budgets of a planner.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanLevel {
    /// Model and budgets in words.
    pub name: String,
    /// The effect model.
    pub model: ModelSpec,
    /// The budgets.
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

/// Plans verified at once, batches of them, and disturbed replays of those that work, in each
/// engine. One plan at least: without one it is unknown whether the plan works.
type Verified = (usize, usize, usize);

/// What the shipped network and its prior are planned with.
const EVERY: [(Search, Refinement, Verified); 8] = [
    (COARSE, LIGHT, (1, 1, 0)),
    (COARSE, LIGHT, (4, 1, 0)),
    (COARSE, LIGHT, (4, 1, 4)),
    (COARSE, USUAL, (4, 2, 4)),
    (COARSE, USUAL, (4, 2, 8)),
    (MEDIUM, USUAL, (4, 2, 8)),
    (MEDIUM, STRONG, (8, 3, 8)),
    (FINE, STRONG, (8, 3, 16)),
];

/// What other networks and the planar engine at a coarse step are planned with.
const SOME: [(Search, Refinement, Verified); 3] =
    [(COARSE, LIGHT, (4, 1, 4)), (COARSE, USUAL, (4, 2, 8)), (MEDIUM, STRONG, (8, 3, 8))];

/// What the planar engine at its usual step is planned with.
const FEW: [(Search, Refinement, Verified); 1] = [(COARSE, LIGHT, (4, 1, 4))];

/// The levels of planning with those of `levels` that are worth it.
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
    }
    plans
}

fn plan_level(model: &ModelSpec, budget: (Search, Refinement, Verified)) -> PlanLevel {
    let (search, refinement, (verified_at_once, verify_batches, disturbed)) = budget;
    let (density, offsets, beam, search_rollouts) = search;
    let (effort, refined, refine_rounds, refine_extra) = refinement;
    PlanLevel {
        name: format!(
            "{model}: {density} search, {effort} refinement, up to {} verified, {disturbed} disturbed",
            verified_at_once * verify_batches
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
            disturbed,
        },
    }
}
