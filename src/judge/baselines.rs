//! What a model is compared with where its errors are measured: what it must beat, and what the
//! planar engine predicts when it is told something wrong about a scene.

use crate::scene::{Assumptions, JointBelief, ModelKind, ModelSpec};

/// What a model must beat, on any scenes.
const RIVALS: [ModelKind; 4] =
    [ModelKind::PRIOR, ModelKind::Projection, ModelKind::Follow, ModelKind::Still];

/// Percentages of the true friction that the planar engine is told.
const FRICTION: [u16; 2] = [70, 130];

/// The start that the planar engine is told is off by 0.1 mm: the engine's own spread.
pub const SHIFTED_START: Assumptions =
    Assumptions { joints: None, friction: None, start: Some(100) };

/// What `spec` must beat.
pub fn rivals(spec: &ModelSpec) -> Vec<ModelSpec> {
    RIVALS.map(ModelSpec::of).into_iter().filter(|other| other != spec).collect()
}

/// The planar engine, told too little friction, and too much.
pub fn mistaken_frictions() -> [ModelSpec; 2] {
    FRICTION.map(|percent| {
        let told = Assumptions { friction: Some(percent), ..Assumptions::default() };
        ModelSpec::of(ModelKind::PLANAR).assuming(told)
    })
}

/// `spec` under other assumptions about joints, for scenes that have some.
pub fn assumed(spec: &ModelSpec) -> [ModelSpec; 3] {
    [JointBelief::Guessed, JointBelief::None, JointBelief::Fixed].map(|joints| {
        spec.clone().assuming(Assumptions { joints: Some(joints), ..Assumptions::default() })
    })
}

/// What `spec` is compared with on recordings. There the planar engine is not the truth, so it is
/// there as itself, and its own spread is no error that could stand in a row.
pub fn recorded_baselines(spec: &ModelSpec) -> Vec<ModelSpec> {
    let planar = ModelSpec::of(ModelKind::PLANAR);
    let engine = (planar != *spec).then_some(planar);
    rivals(spec).into_iter().chain(engine).chain(mistaken_frictions()).collect()
}
