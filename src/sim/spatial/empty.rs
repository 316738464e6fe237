//! The settings of rapier shared by all 3-D worlds.

use rapier3d_f64::prelude::{
    FrictionModel, PhysicsWorld, SpringCoefficients, Vector as RapierVector,
};

use crate::scene::GRAVITY;
use crate::sim::parameters::{ALLOWED_ERROR, ARTICULATED_ITERATIONS};

/// Returns a world with gravity and without bodies. `softness` sets the contact springs (natural
/// frequency in Hz and damping ratio); `None` keeps rapier's default.
pub(in crate::sim) fn empty_world(articulated: bool, softness: Option<(f64, f64)>) -> PhysicsWorld {
    let gravity = RapierVector::Z * -GRAVITY;
    let mut world = PhysicsWorld { gravity, ..PhysicsWorld::default() };
    let settings = &mut world.integration_parameters;
    // One friction constraint per contact point: the simplified model has an error of 2 cm on
    // pushed cuboids, and lets levered plates flip.
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
