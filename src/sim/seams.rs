//! Contact hooks: no contacts at the seams of a tool or, in the 2-D engine, between bodies that
//! pass below each other; and frictions stated for pairs.
//!
//! The engines handle each piece of a tool alone, so a body that slides along the tool would catch
//! on the corner of the next piece. Contacts on covered or continued faces of a piece are removed
//! before they are solved.

use std::collections::HashSet;

use rapier2d_f64::prelude as planar;
use rapier3d_f64::prelude as spatial;

use crate::geometry::{Rim, Vector};
use crate::{
    scene::{Body, PairFriction, Scene, Surface},
    task::ToolMotion,
};

/// Sine of the slope above which a normal belongs to a top or underside.
const STEEP: f64 = 0.5;

/// Changes of contacts before they are solved, by the colliders' labels.
#[derive(Debug, Default)]
pub(super) struct Seams {
    /// Touchable part of the boundary; `None` for all of it.
    rims: Vec<Option<Rim>>,
    /// Coefficients of friction of pairs.
    frictions: Vec<([u128; 2], f64)>,
    /// Pairs of a body above the table and a body that passes below or over it, seen from above.
    passing: HashSet<[u128; 2]>,
}

impl Seams {
    /// Restricts contacts of the collider with this label to its `rim`.
    pub fn set(&mut self, label: usize, rim: &Rim) {
        self.rims.resize(self.rims.len().max(label + 1), None);
        self.rims[label] = Some(rim.clone());
    }

    /// Sets the friction of colliders with these `labels` to the frictions stated in `pairs`; other
    /// pairs keep theirs. Returns the labels of colliders whose contacts need the hook.
    pub fn rub(&mut self, labels: &[Body], pairs: &[PairFriction]) -> Vec<usize> {
        let mut asking = Vec::new();
        self.frictions.clear();
        for pair in pairs {
            let rubs = |body: &Body| match (pair.with, *body) {
                (Surface::Object(other), Body::Object(index)) => other == index,
                (Surface::Obstacle(other), Body::Obstacle(index)) => other == index,
                (Surface::Tool, Body::Part(_)) => true,
                _ => false,
            };
            let own = |body: &Body| *body == Body::Object(pair.object);
            for first in (0..labels.len()).filter(|&k| own(&labels[k])) {
                asking.push(first);
                for second in (0..labels.len()).filter(|&k| rubs(&labels[k])) {
                    self.frictions.push(([first as u128, second as u128], pair.coefficient));
                }
            }
        }
        asking
    }

    /// Sets the friction of colliders with these `labels` against the table, which has a label of
    /// its own, to the frictions stated in `pairs`. Returns labels as [`Self::rub`].
    pub fn rub_table(
        &mut self,
        labels: &[Body],
        pairs: &[PairFriction],
        table: u128,
    ) -> Vec<usize> {
        let mut asking = Vec::new();
        for pair in pairs.iter().filter(|pair| pair.with == Surface::Table) {
            let own = |k: &usize| labels[*k] == Body::Object(pair.object);
            for label in (0..labels.len()).filter(own) {
                asking.push(label);
                self.frictions.push(([label as u128, table], pair.coefficient));
            }
        }
        asking
    }

    /// Disables contacts between bodies and the raised bodies above or below them, obstacles and
    /// parts of objects, in a world seen from above.
    pub fn pass(&mut self, labels: &[Body], scene: &Scene, motion: &ToolMotion) {
        let span = |body: &Body| match *body {
            Body::Object(index) => scene.objects[index].span(),
            Body::Obstacle(index) => {
                let obstacle = &scene.obstacles[index];
                [obstacle.z, obstacle.top()]
            }
            Body::Part(index) => {
                let height = motion.tool.outline()[index].shape.height();
                [motion.lift, motion.lift + height]
            }
        };
        let hangs = |body: &Body| match *body {
            Body::Object(index) => scene.objects[index].is_raised(),
            Body::Obstacle(_) => true,
            Body::Part(_) => false,
        };
        for (first, above) in labels.iter().enumerate().filter(|(_, body)| hangs(body)) {
            let [low, high] = span(above);
            for (second, below) in labels.iter().enumerate() {
                let [underside, top] = span(below);
                if !(low < top && underside < high) {
                    self.passing
                        .extend([[first, second], [second, first]].map(|k| k.map(|k| k as u128)));
                }
            }
        }
    }

    fn friction(&self, first: u128, second: u128) -> Option<f64> {
        let is_it = |pair: &[u128; 2]| *pair == [first, second] || *pair == [second, first];
        self.frictions.iter().find(|(pair, _)| is_it(pair)).map(|(_, friction)| *friction)
    }

    fn rim(&self, label: u128) -> Option<&Rim> {
        self.rims.get(usize::try_from(label).ok()?)?.as_ref()
    }
}

impl planar::PhysicsHooks for Seams {
    fn filter_contact_pair(
        &self,
        context: &planar::PairFilterContext<'_>,
    ) -> Option<planar::SolverFlags> {
        let label = |collider: planar::ColliderHandle| context.colliders[collider].user_data;
        let pair = [context.collider1, context.collider2].map(label);
        (!self.passing.contains(&pair)).then(planar::SolverFlags::default)
    }

    fn modify_solver_contacts(&self, context: &mut planar::ContactModificationContext<'_>) {
        let label = |collider: planar::ColliderHandle| context.colliders[collider].user_data;
        let [first, second] = [context.collider1, context.collider2].map(label);
        let (manifold, contacts) = (context.manifold, &mut *context.solver_contacts);
        if let Some(friction) = self.friction(first, second) {
            contacts.iter_mut().for_each(|contact| contact.friction = friction);
        }
        let vector = |v: planar::Vector| Vector::new(v.x, v.y);
        if let Some(rim) = self.rim(first) {
            contacts.retain(|contact| {
                let point = manifold.points[contact.contact_id[0] as usize].local_p1;
                rim.shows(vector(point), vector(manifold.local_n1))
            });
        }
        if let Some(rim) = self.rim(second) {
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
        let [first, second] = [context.collider1, context.collider2].map(label);
        let (manifold, contacts) = (context.manifold, &mut *context.solver_contacts);
        if let Some(friction) = self.friction(first, second) {
            contacts.iter_mut().for_each(|contact| contact.friction = friction);
        }
        let shows = |rim: &Rim, point: spatial::Vector, normal: spatial::Vector| {
            normal.z.abs() > STEEP
                || rim.shows(Vector::new(point.x, point.y), Vector::new(normal.x, normal.y))
        };
        if let Some(rim) = self.rim(first) {
            contacts.retain(|contact| {
                let point = manifold.points[contact.contact_id[0] as usize].local_p1;
                shows(rim, point, manifold.local_n1)
            });
        }
        if let Some(rim) = self.rim(second) {
            contacts.retain(|contact| {
                let point = manifold.points[contact.contact_id[0] as usize].local_p2;
                shows(rim, point, manifold.local_n2)
            });
        }
    }
}
