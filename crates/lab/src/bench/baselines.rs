//! What stands beside a model in an evaluation: what it must beat, and what the truth's own engine
//! makes of a scene that it is told something wrong of.

use pushplan::internals::scene::{Assumptions, JointBelief, ModelKind, ModelSpec};

/// What a model must beat, on any scenes.
const RIVALS: [ModelKind; 4] =
    [ModelKind::PRIOR, ModelKind::Projection, ModelKind::Follow, ModelKind::Still];

/// Percentages of the true friction that the planar engine is told.
const FRICTION: [u16; 2] = [70, 130];

/// The start that the planar engine is told is off by 0.1 mm: the engine's own spread.
pub(super) const SHIFTED_START: Assumptions =
    Assumptions { joints: None, friction: None, start: Some(100) };

/// What stands beside `spec` on held-out pushes: the other engine, and what it must beat.
pub fn push_baselines(spec: &ModelSpec) -> Vec<ModelSpec> {
    let others = std::iter::once(ModelKind::SPATIAL).chain(RIVALS).map(ModelSpec::of);
    others.filter(|other| other != spec).collect()
}

/// `spec` under other assumptions about joints, for scenes that have some.
pub fn assumed(spec: &ModelSpec) -> Vec<ModelSpec> {
    let beliefs = [JointBelief::Guessed, JointBelief::None, JointBelief::Fixed];
    let told = |joints| Assumptions { joints: Some(joints), ..Assumptions::default() };
    beliefs.map(|joints| spec.clone().assuming(told(joints))).to_vec()
}

/// What stands beside `spec` on crowds, or on recordings: of those the planar engine is no truth,
/// so it is there as itself, and its own spread is no error that could stand in a row.
pub fn crowd_baselines(spec: &ModelSpec, recorded: bool) -> Vec<ModelSpec> {
    let planar = ModelSpec::of(ModelKind::PLANAR);
    let mut others: Vec<ModelSpec> = RIVALS.map(ModelSpec::of).to_vec();
    if recorded {
        others.push(planar.clone());
    }
    others.retain(|other| other != spec);
    let told = Assumptions::default();
    let mut mistakes =
        FRICTION.map(|percent| Assumptions { friction: Some(percent), ..told }).to_vec();
    if !recorded {
        mistakes.push(SHIFTED_START);
    }
    others.extend(mistakes.into_iter().map(|told| planar.clone().assuming(told)));
    others
}
