//! Baselines of a model in an evaluation on random scenes.

use pushplan::internals::scene::{ModelKind, ModelSpec};
use pushplan_act::judge::{SHIFTED_START, mistaken_frictions};

use crate::trivial::{Follow, Projection};

/// Models that any model must beat, on all scenes.
const RIVALS: [ModelKind; 4] = [ModelKind::PRIOR, Projection::KIND, Follow::KIND, ModelKind::Still];

/// Returns the models that `spec` must beat.
fn rivals(spec: &ModelSpec) -> impl Iterator<Item = ModelSpec> {
    RIVALS.map(ModelSpec::of).into_iter().filter(move |other| other != spec)
}

/// Returns the baselines of `spec` on held-out pushes: the other engine, and the models to beat.
pub fn push_baselines(spec: &ModelSpec) -> Vec<ModelSpec> {
    let engine = Some(ModelSpec::of(ModelKind::SPATIAL)).filter(|engine| engine != spec);
    engine.into_iter().chain(rivals(spec)).collect()
}

/// Returns the baselines of `spec` on crowds, where the 2-D engine is the ground truth.
pub fn crowd_baselines(spec: &ModelSpec) -> Vec<ModelSpec> {
    let shifted = ModelSpec::of(ModelKind::PLANAR).assuming(SHIFTED_START);
    rivals(spec).chain(mistaken_frictions()).chain([shifted]).collect()
}
