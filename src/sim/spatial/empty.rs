//! The settings of rapier that all 3-D worlds share.

use rapier3d_f64::prelude::{
    FrictionModel, PhysicsWorld, SpringCoefficients, Vector as RapierVector,
};

use crate::scene::GRAVITY;
use crate::sim::parameters::{ALLOWED_ERROR, ARTICULATED_ITERATIONS};

/// Returns a world without anything in it but gravity, its contacts as soft as these springs (natural
/// frequency in Hz and damping ratio), or as rapier's own.
pub(in crate::sim) fn empty_world(articulated: bool, softness: Option<(f64, f64)>) -> PhysicsWorld {
    let gravity = RapierVector::Z * -GRAVITY;
    let mut world = PhysicsWorld { gravity, ..PhysicsWorld::default() };
    let settings = &mut world.integration_parameters;
    // One friction constraint per contact point: the simplified model is 2 cm off on cuboids that are
    // pushed, and makes plates flip that are levered.
    settings.friction_model = FrictionModel::Coulomb;
    settings.normalized_allowed_linear_error = ALLOWED_ERROR;
    if articulated {
        settings.num_solver_iterations = ARTICULATED_ITERATIONS;
    }
    if let Some((frequency, damping)) = softness {
        settings.contact_softness = SpringCoefficients::new(frequency, damping);
    }
    world
}
