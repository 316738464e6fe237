//! Contacts that the 3-D engine's solver used.

use rapier3d_f64::prelude::{ContactData, ContactManifold, TrackedContact};

/// Returns the solved points of a manifold, without points removed at seams. Other points may still
/// have an impulse of an earlier step.
pub(super) fn solved(
    manifold: &ContactManifold,
) -> impl Iterator<Item = (&ContactManifold, &TrackedContact<ContactData>)> {
    let contacts = manifold.data.solver_contacts.iter();
    contacts.map(move |contact| (manifold, &manifold.points[contact.contact_id[0] as usize]))
}
