//! Recomputation of contacts in every step.
//!
//! parry reuses the contact points of two solids while their relative motion *in a step* is small:
//! a rotation by less than a degree and a slide by less than a millimetre. Reused points do not end
//! at the end of a face. A plate whose edge has slid off the blade then hangs 5 mm in the air
//! before it, the longer the finer the steps.

use rapier3d_f64::parry::query::details::{ContactManifoldsWorkspace, NormalConstraints};
use rapier3d_f64::parry::query::{
    ClosestPoints, Contact, ContactManifold as Manifold, DefaultQueryDispatcher,
    NonlinearRigidMotion, PersistentQueryDispatcher, QueryDispatcher, ShapeCastHit,
    ShapeCastOptions, Unsupported,
};
use rapier3d_f64::parry::shape::Shape;
use rapier3d_f64::prelude::{ContactData, ContactManifoldData, NarrowPhase, Pose3, Real, Vector};

/// Returns a narrow phase that reuses no contact points, but keeps the impulses of points that are
/// found again.
pub(super) fn fresh_contacts() -> NarrowPhase {
    NarrowPhase::with_query_dispatcher(Fresh.chain(DefaultQueryDispatcher))
}

/// A dispatcher for contacts only; it leaves other queries to the next dispatcher.
struct Fresh;

impl PersistentQueryDispatcher<ContactManifoldData, ContactData> for Fresh {
    fn contact_manifolds(
        &self,
        pos12: &Pose3,
        g1: &dyn Shape,
        g2: &dyn Shape,
        prediction: Real,
        manifolds: &mut Vec<Manifold<ContactManifoldData, ContactData>>,
        workspace: &mut Option<ContactManifoldsWorkspace>,
    ) -> Result<(), Unsupported> {
        // No normal agrees with a zero normal.
        manifolds.iter_mut().for_each(|manifold| manifold.local_n2 = Vector::ZERO);
        let found = &DefaultQueryDispatcher;
        found.contact_manifolds(pos12, g1, g2, prediction, manifolds, workspace)
    }

    fn contact_manifold_convex_convex(
        &self,
        _: &Pose3,
        _: &dyn Shape,
        _: &dyn Shape,
        _: Option<&dyn NormalConstraints>,
        _: Option<&dyn NormalConstraints>,
        _: Real,
        _: &mut Manifold<ContactManifoldData, ContactData>,
    ) -> Result<(), Unsupported> {
        Err(Unsupported)
    }
}

impl QueryDispatcher for Fresh {
    fn intersection_test(
        &self,
        _: &Pose3,
        _: &dyn Shape,
        _: &dyn Shape,
    ) -> Result<bool, Unsupported> {
        Err(Unsupported)
    }

    fn distance(&self, _: &Pose3, _: &dyn Shape, _: &dyn Shape) -> Result<Real, Unsupported> {
        Err(Unsupported)
    }

    fn contact(
        &self,
        _: &Pose3,
        _: &dyn Shape,
        _: &dyn Shape,
        _: Real,
    ) -> Result<Option<Contact>, Unsupported> {
        Err(Unsupported)
    }

    fn closest_points(
        &self,
        _: &Pose3,
        _: &dyn Shape,
        _: &dyn Shape,
        _: Real,
    ) -> Result<ClosestPoints, Unsupported> {
        Err(Unsupported)
    }

    fn cast_shapes(
        &self,
        _: &Pose3,
        _: Vector,
        _: &dyn Shape,
        _: &dyn Shape,
        _: ShapeCastOptions,
    ) -> Result<Option<ShapeCastHit>, Unsupported> {
        Err(Unsupported)
    }

    fn cast_shapes_nonlinear(
        &self,
        _: &NonlinearRigidMotion,
        _: &dyn Shape,
        _: &NonlinearRigidMotion,
        _: &dyn Shape,
        _: Real,
        _: Real,
        _: bool,
    ) -> Result<Option<ShapeCastHit>, Unsupported> {
        Err(Unsupported)
    }
}
