//! Baselines for measured model errors, such as the 2-D engine with wrong assumptions about a
//! scene.

use pushplan::scene::{Assumptions, JointBelief, ModelKind, ModelSpec};

/// Assumed friction of the 2-D engine in percent of the true one.
const FRICTION: [u16; 2] = [70, 130];

/// Assumption of a start that is off by 0.1 mm, which measures the spread of the 2-D engine itself.
pub const SHIFTED_START: Assumptions =
    Assumptions { joints: None, friction: None, start: Some(100) };

/// Returns the 2-D engine with too little and with too much friction.
pub fn mistaken_frictions() -> [ModelSpec; 2] {
    FRICTION.map(|percent| {
        let assumptions = Assumptions { friction: Some(percent), ..Assumptions::default() };
        ModelSpec::of(ModelKind::PLANAR).assuming(assumptions)
    })
}

/// Returns `spec` with three other assumptions about joints, for scenes with joints.
pub fn assumed(spec: &ModelSpec) -> [ModelSpec; 3] {
    [JointBelief::Guessed, JointBelief::None, JointBelief::Fixed].map(|joints| {
        spec.clone().assuming(Assumptions { joints: Some(joints), ..Assumptions::default() })
    })
}

/// Returns the baselines for `spec` on recordings.
///
/// The 2-D engine is a baseline because it is not the ground truth there. Its own spread is left
/// out because it is no error.
pub fn recorded_baselines(spec: &ModelSpec) -> Vec<ModelSpec> {
    let others = [ModelKind::PRIOR, ModelKind::Still, ModelKind::PLANAR].map(ModelSpec::of);
    let others = others.into_iter().filter(|other| other != spec);
    others.chain(mistaken_frictions()).collect()
}
