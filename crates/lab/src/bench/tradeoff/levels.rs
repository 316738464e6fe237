//! The levels of the ladder: predictors, and budgets of planning with them.

use std::num::{NonZeroU8, NonZeroU16};
use std::sync::Arc;

use pushplan::internals::effect::{EffectModel, EffectModels, ModelError};
use pushplan::internals::scene::{Engine, ModelKind, ModelSpec, Models, Rate, Stride};
use pushplan::internals::solve::Settings;
use serde::{Deserialize, Serialize};

use crate::trivial::{self, Follow, Projection};

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
        Ok(Self { name: spec.to_string(), model: Arc::new(trivial::load(spec)?) })
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
    kinds.extend([Projection::KIND, Follow::KIND, ModelKind::Still]);
    kinds.into_iter().map(|kind| Level::new(&kind.into())).collect()
}

/// A predictor with the budgets of a planner.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanLevel {
    /// Model and budgets in words.
    pub name: String,
    /// The effect model that decides.
    pub model: ModelSpec,
    /// The one that screens, if it is another.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub screen: Option<ModelSpec>,
    /// The budgets.
    pub settings: Settings,
}

impl PlanLevel {
    /// What screens and what decides.
    pub fn models(&self) -> Models {
        let models = Models::from(self.model.clone());
        match &self.screen {
            Some(screen) => models.screened_by(screen.clone()),
            None => models,
        }
    }
}

/// Density of a search: its name, lateral offsets, beam and rollouts.
type Search = (&'static str, usize, usize, usize);

/// Refinement: its name, candidates, rounds and extra samples; and, where another model screens, the
/// rounds of the one that decides and the candidates that go through them.
type Refinement = (&'static str, usize, usize, usize, (usize, usize));

const COARSE: Search = ("coarse", 3, 8, 500);
const MEDIUM: Search = ("medium", 5, 24, 2000);
const FINE: Search = ("fine", 9, 64, 8000);

const LIGHT: Refinement = ("light", 3, 2, 0, (1, 2));
const USUAL: Refinement = ("usual", 8, 4, 2, (1, 4));
const STRONG: Refinement = ("strong", 24, 8, 4, (2, 4));

/// Plans verified at once, batches of them, and disturbed replays of those that work, in each
/// engine. One plan at least: without one it is unknown whether the plan works.
type Verified = (usize, usize, usize);

/// What the shipped network, alone or screened for by its prior, and the prior are planned with.
const EVERY: [(Search, Refinement, Verified); 7] = [
    (COARSE, LIGHT, (1, 1, 0)),
    (COARSE, LIGHT, (2, 2, 4)),
    (COARSE, USUAL, (2, 4, 4)),
    (COARSE, USUAL, (2, 4, 8)),
    (MEDIUM, USUAL, (2, 4, 8)),
    (MEDIUM, STRONG, (2, 12, 8)),
    (FINE, STRONG, (2, 12, 16)),
];

/// The prior once more with more plans verified at once.
const MANY_AT_ONCE: (Search, Refinement, Verified) = (MEDIUM, STRONG, (8, 3, 8));

/// What other networks and the planar engine at a coarse step are planned with.
const SOME: [(Search, Refinement, Verified); 3] =
    [(COARSE, LIGHT, (2, 2, 4)), (COARSE, USUAL, (2, 4, 8)), (MEDIUM, STRONG, (2, 12, 8))];

/// What the planar engine at its usual step is planned with.
const FEW: [(Search, Refinement, Verified); 1] = [(COARSE, LIGHT, (2, 2, 4))];

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
        let models = Models::from(spec.clone());
        plans.extend(budgets.iter().map(|budget| plan_level(&models, *budget)));
        match spec.first().kind {
            ModelKind::NETWORK => {
                let models = models.screened_by(ModelKind::PRIOR);
                plans.extend(EVERY.iter().map(|budget| plan_level(&models, *budget)));
            }
            ModelKind::PRIOR => plans.push(plan_level(&models, MANY_AT_ONCE)),
            _ => {}
        }
    }
    plans
}

fn plan_level(models: &Models, budget: (Search, Refinement, Verified)) -> PlanLevel {
    let (search, refinement, (verified_at_once, verify_batches, disturbed)) = budget;
    let (density, offsets, beam, search_rollouts) = search;
    let (effort, refined, refine_rounds, refine_extra, last) = refinement;
    let (decided_rounds, short_list) = if models.is_one() { (0, 0) } else { last };
    PlanLevel {
        name: format!(
            "{models}: {density} search, {effort} refinement, up to {} verified, {} at a time, {} disturbed",
            verified_at_once * verify_batches,
            verified_at_once,
            disturbed
        ),
        model: models.decided.clone(),
        screen: (!models.is_one()).then(|| models.screened.clone()),
        settings: Settings {
            levers: pushplan::internals::solve::LeverSettings::STANDARD,
            offsets,
            beam,
            search_rollouts,
            refined,
            refine_rounds,
            refine_extra,
            decided_rounds,
            short_list,
            verified_at_once,
            verify_batches,
            disturbed,
        },
    }
}
