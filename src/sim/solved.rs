//! What the 3-D engine's solver saw of its contacts.

use rapier3d_f64::prelude::{ContactData, ContactManifold, TrackedContact};

/// The points of a manifold that were solved, and not taken away as those of a seam.
/// Others may still carry an impulse of an earlier step.
pub(super) fn solved(
    manifold: &ContactManifold,
) -> impl Iterator<Item = (&ContactManifold, &TrackedContact<ContactData>)> {
    let contacts = manifold.data.solver_contacts.iter();
    contacts.map(move |contact| (manifold, &manifold.points[contact.contact_id[0] as usize]))
}
