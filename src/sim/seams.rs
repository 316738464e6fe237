//! No contacts at the seams of a tool.
//!
//! The engines look at each piece of a tool alone, so a body that slides along the tool would be
//! caught by the corner of the next piece. Contacts where a piece cannot be touched, because
//! another one continues its face or covers it, are taken away before they are solved.

use rapier2d::prelude as planar;
use rapier3d_f64::prelude as spatial;

use crate::geometry::{Rim, Vector};

/// Normals that rise more steeply than this (sine) are those of top or underside.
const STEEP: f64 = 0.5;

/// Where the colliders can be touched, by their labels; nowhere said means everywhere.
#[derive(Debug, Default)]
pub(super) struct Seams(Vec<Option<Rim>>);

impl Seams {
    /// Lets the collider with this label be touched at its `rim` only.
    pub fn set(&mut self, label: usize, rim: &Rim) {
        self.0.resize(self.0.len().max(label + 1), None);
        self.0[label] = Some(rim.clone());
    }

    fn rim(&self, label: u128) -> Option<&Rim> {
        self.0.get(usize::try_from(label).ok()?)?.as_ref()
    }
}

impl planar::PhysicsHooks for Seams {
    fn modify_solver_contacts(&self, context: &mut planar::ContactModificationContext<'_>) {
        let label = |collider: planar::ColliderHandle| context.colliders[collider].user_data;
        let (manifold, contacts) = (context.manifold, &mut *context.solver_contacts);
        let vector = |v: planar::Vector| Vector::new(v.x.into(), v.y.into());
        if let Some(rim) = self.rim(label(context.collider1)) {
            contacts.retain(|contact| {
                let point = manifold.points[contact.contact_id[0] as usize].local_p1;
                rim.shows(vector(point), vector(manifold.local_n1))
            });
        }
        if let Some(rim) = self.rim(label(context.collider2)) {
            contacts.retain(|contact| {
                let point = manifold.points[contact.contact_id[0] as usize].local_p2;
                rim.shows(vector(point), vector(manifold.local_n2))
            });
        }
    }
}

impl spatial::PhysicsHooks for Seams {
    fn modify_solver_contacts(&self, context: &mut spatial::ContactModificationContext<'_>) {
        let label = |collider: spatial::ColliderHandle| context.colliders[collider].user_data;
        let (manifold, contacts) = (context.manifold, &mut *context.solver_contacts);
        let shows = |rim: &Rim, point: spatial::Vector, normal: spatial::Vector| {
            normal.z.abs() > STEEP
                || rim.shows(Vector::new(point.x, point.y), Vector::new(normal.x, normal.y))
        };
        if let Some(rim) = self.rim(label(context.collider1)) {
            contacts.retain(|contact| {
                let point = manifold.points[contact.contact_id[0] as usize].local_p1;
                shows(rim, point, manifold.local_n1)
            });
        }
        if let Some(rim) = self.rim(label(context.collider2)) {
            contacts.retain(|contact| {
                let point = manifold.points[contact.contact_id[0] as usize].local_p2;
                shows(rim, point, manifold.local_n2)
            });
        }
    }
}
