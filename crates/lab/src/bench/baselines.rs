//! What stands beside a model in an evaluation on scenes that are drawn.

use pushplan::internals::judge::{SHIFTED_START, mistaken_frictions, rivals};
use pushplan::internals::scene::{ModelKind, ModelSpec};

/// What stands beside `spec` on held-out pushes: the other engine, and what it must beat.
pub fn push_baselines(spec: &ModelSpec) -> Vec<ModelSpec> {
    let engine = Some(ModelSpec::of(ModelKind::SPATIAL)).filter(|engine| engine != spec);
    engine.into_iter().chain(rivals(spec)).collect()
}

/// What stands beside `spec` on crowds, which the planar engine is the truth of.
pub fn crowd_baselines(spec: &ModelSpec) -> Vec<ModelSpec> {
    let shifted = ModelSpec::of(ModelKind::PLANAR).assuming(SHIFTED_START);
    rivals(spec).into_iter().chain(mistaken_frictions()).chain([shifted]).collect()
}
