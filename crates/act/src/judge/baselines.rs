//! Models that a model is compared with where its errors are measured, such as the planar engine with
//! wrong assumptions about a scene.

use pushplan::scene::{Assumptions, JointBelief, ModelKind, ModelSpec};

/// Percentages of the true friction that the planar engine is told.
const FRICTION: [u16; 2] = [70, 130];

/// The start that the planar engine is told is off by 0.1 mm: the engine's own spread.
pub const SHIFTED_START: Assumptions =
    Assumptions { joints: None, friction: None, start: Some(100) };

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
    let others = [ModelKind::PRIOR, ModelKind::Still, ModelKind::PLANAR].map(ModelSpec::of);
    let others = others.into_iter().filter(|other| other != spec);
    others.chain(mistaken_frictions()).collect()
}
