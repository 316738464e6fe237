//! What a model is compared with in an evaluation on random scenes.

use pushplan::internals::judge::{SHIFTED_START, mistaken_frictions, rivals};
use pushplan::internals::scene::{ModelKind, ModelSpec};

/// What `spec` is compared with on held-out pushes: the other engine, and what it must beat.
pub fn push_baselines(spec: &ModelSpec) -> Vec<ModelSpec> {
    let engine = Some(ModelSpec::of(ModelKind::SPATIAL)).filter(|engine| engine != spec);
    engine.into_iter().chain(rivals(spec)).collect()
}

/// What `spec` is compared with on crowds, where the planar engine is the truth.
pub fn crowd_baselines(spec: &ModelSpec) -> Vec<ModelSpec> {
    let shifted = ModelSpec::of(ModelKind::PLANAR).assuming(SHIFTED_START);
    rivals(spec).into_iter().chain(mistaken_frictions()).chain([shifted]).collect()
}
