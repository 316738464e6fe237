//! The levels of the ladder: predictors, and budgets of planning with them.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::{
    effect::{EffectModel, Follow, Network, Prior, Projection, Simulated, Still},
    network::Weights,
    sim::{DEFAULT_STEP, Simulator},
    solve::Settings,
};

/// Strides besides 1 that the shipped network and its prior are measured with.
const STRIDES: [usize; 2] = [2, 4];

/// Steps a second besides the default that the engines are measured with.
const PLANAR_STEPS: [f64; 3] = [120.0, 60.0, 30.0];
const SPATIAL_STEPS: [f64; 1] = [120.0];

/// A predictor to measure.
#[derive(Clone)]
pub enum Level {
    /// A network.
    Network(Arc<Network>),
    /// Anything else.
    Other(Arc<dyn EffectModel>),
}

impl Level {
    /// The predictor.
    pub fn model(&self) -> Arc<dyn EffectModel> {
        match self {
            Level::Network(model) => Arc::clone(model) as Arc<dyn EffectModel>,
            Level::Other(model) => Arc::clone(model),
        }
    }

    /// Its name.
    pub fn name(&self) -> &str {
        match self {
            Level::Network(model) => model.name(),
            Level::Other(model) => model.name(),
        }
    }

    /// Whether jobs of one scene share work: then a push costs less in a batch.
    pub(super) fn batches(&self) -> bool {
        matches!(self, Level::Network(_)) || self.name().starts_with("quasi-static")
    }

    /// Whether it is measured on scenes of several objects too: whole models, and engines.
    pub(super) fn is_plain(&self) -> bool {
        let simulated = self.name().starts_with("planar") || self.name().starts_with("3d");
        simulated || (self.batches() && !self.name().contains(','))
    }
}

/// All predictors: the `shipped` network with its variants, `others` (with the names of their
/// files), the prior, the engines at several steps, and the trivial ones.
pub fn levels(shipped: &Weights, others: &[(String, Weights)]) -> Vec<Level> {
    let learned = |model: Network| Level::Network(Arc::new(model));
    let base = || Network::new(shipped.clone());
    let mut levels = vec![learned(base())];
    levels.extend(STRIDES.map(|stride| learned(base().with_stride(stride))));
    levels.extend((0..shipped.card.config.steps).map(|steps| learned(base().with_steps(steps))));
    for (file, weights) in others {
        let model = Network::new(weights.clone());
        let taken = levels.iter().any(|level| level.name() == model.name());
        let name = format!("{} ({file})", model.name());
        levels.push(learned(if taken { model.named(name) } else { model }));
    }
    levels.push(Level::Other(Arc::new(Prior::default())));
    for stride in STRIDES {
        levels.push(Level::Other(Arc::new(Prior::default().with_stride(stride))));
    }
    let step = |rate: f64| 1.0 / rate;
    let planar = [DEFAULT_STEP].into_iter().chain(PLANAR_STEPS.map(step));
    let spatial = [DEFAULT_STEP].into_iter().chain(SPATIAL_STEPS.map(step));
    let engines = planar.map(Simulator::planar_with_step);
    let engines = engines.chain(spatial.map(Simulator::spatial_with_step));
    levels.extend(engines.map(|engine| Level::Other(Arc::new(Simulated::new(engine)))));
    levels.push(Level::Other(Arc::new(Projection)));
    levels.push(Level::Other(Arc::new(Follow)));
    levels.push(Level::Other(Arc::new(Still)));
    levels
}

/// A predictor with the budgets of a planner.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanLevel {
    /// Model and budgets in words.
    pub name: String,
    /// Name of the effect model.
    pub model: String,
    /// The budgets. Disturbed replays are none: they tell how robust a plan is and change
    /// nothing in its choice.
    pub settings: Settings,
}

/// Density of a search: its name, lateral offsets, beam and rollouts.
type Search = (&'static str, usize, usize, usize);

/// Refinement: its name, candidates, rounds and extra samples.
type Refinement = (&'static str, usize, usize, usize);

const COARSE: Search = ("coarse", 3, 8, 500);
const MEDIUM: Search = ("medium", 5, 24, 2000);
const FINE: Search = ("fine", 9, 64, 8000);
const FINEST: Search = ("finest", 15, 192, 40_000);

const NONE: Refinement = ("none", 8, 0, 0);
const LIGHT: Refinement = ("light", 3, 2, 0);
const USUAL: Refinement = ("usual", 8, 4, 2);
const STRONG: Refinement = ("strong", 24, 8, 4);
const UTMOST: Refinement = ("utmost", 64, 16, 8);

/// Plans verified at once and batches of them. One at least: without any nobody knows whether a
/// plan works.
type Verified = (usize, usize);

/// What the shipped network and its prior are planned with: all budgets one by one, then
/// together.
const EVERY: [(Search, Refinement, Verified); 15] = [
    (COARSE, NONE, (1, 1)),
    (MEDIUM, NONE, (1, 1)),
    (FINE, NONE, (1, 1)),
    (COARSE, NONE, (4, 1)),
    (MEDIUM, NONE, (4, 2)),
    (COARSE, LIGHT, (1, 1)),
    (COARSE, LIGHT, (4, 1)),
    (COARSE, USUAL, (4, 2)),
    (MEDIUM, LIGHT, (4, 1)),
    (MEDIUM, USUAL, (1, 1)),
    (MEDIUM, USUAL, (4, 2)),
    (MEDIUM, STRONG, (8, 3)),
    (FINE, USUAL, (4, 2)),
    (FINE, STRONG, (8, 3)),
    (FINEST, UTMOST, (16, 4)),
];

/// What other networks and the planar engine at a coarse step are planned with.
const SOME: [(Search, Refinement, Verified); 6] = [
    (COARSE, NONE, (1, 1)),
    (COARSE, LIGHT, (1, 1)),
    (COARSE, LIGHT, (4, 1)),
    (MEDIUM, USUAL, (4, 2)),
    (MEDIUM, STRONG, (8, 3)),
    (FINE, STRONG, (8, 3)),
];

/// What the dear and the trivial are planned with.
const FEW: [(Search, Refinement, Verified); 2] = [(COARSE, LIGHT, (1, 1)), (COARSE, LIGHT, (4, 1))];

/// The levels of planning with those of `levels` that are worth it.
pub fn plan_levels(levels: &[Level]) -> Vec<PlanLevel> {
    let mut plans = Vec::new();
    let mut networks = 0;
    for level in levels {
        let name = level.name();
        let budgets: &[_] = match level {
            Level::Network(_) if name.contains(',') => &[],
            Level::Network(_) => {
                networks += 1;
                if networks == 1 { &EVERY } else { &SOME }
            }
            Level::Other(_) => match name {
                "quasi-static" => &EVERY,
                "planar, 1/60 s" | "planar, 1/30 s" => &SOME,
                "planar" | "projection" => &FEW,
                "3d" => &FEW[..1],
                _ => &[],
            },
        };
        plans.extend(budgets.iter().map(|budget| plan_level(name, *budget)));
    }
    plans
}

fn plan_level(model: &str, budget: (Search, Refinement, Verified)) -> PlanLevel {
    let ((density, offsets, beam, search_rollouts), refinement, (at_once, batches)) = budget;
    let (effort, refined, refine_rounds, refine_extra) = refinement;
    PlanLevel {
        name: format!(
            "{model}: {density} search, {effort} refinement, up to {} verified",
            at_once * batches
        ),
        model: model.to_owned(),
        settings: Settings {
            offsets,
            beam,
            search_rollouts,
            refined,
            refine_rounds,
            refine_extra,
            verified_at_once: at_once,
            verify_batches: batches,
            disturbed: 0,
        },
    }
}
