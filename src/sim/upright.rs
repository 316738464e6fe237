//! Supports of bodies that cannot tip, in the 3-D engine.
//!
//! rapier loads all feet of such a body alike. The coefficients of friction of the feet therefore
//! represent the load, and the shift of the load under a push is computed as in the 2-D engine.

use rapier3d_f64::prelude::{ColliderHandle, ColliderSet};

use crate::geometry::Vector;
use crate::scene::State;

use super::groups::Group;
use super::slowing::{Inertia, Resistance, Twist};
use super::support::{Pressed, Support};

/// The support of an object.
pub(super) struct Standing {
    pub support: Support,
    pub feet: Vec<ColliderHandle>,
    /// Coefficient of friction with the table.
    pub friction: f64,
}

/// The supports of all objects.
#[derive(Default)]
pub(super) struct Upright {
    objects: Vec<Standing>,
    bodies: Vec<Body>,
}

/// A body of one or more objects.
struct Body {
    objects: Vec<usize>,
    masses: Vec<f64>,
    /// Number of feet over mass, 1/kg.
    feet: f64,
    pressed: Pressed,
}

impl Upright {
    /// Adds the next object.
    pub fn add(&mut self, standing: Standing) {
        self.objects.push(standing);
    }

    /// Joins the objects of each group to one body; `masses` are the masses of all objects in kg.
    pub fn join(&mut self, groups: &[Group], masses: &[f64]) {
        let body = |group: &Group| {
            let objects = group.objects.clone();
            let mut pressed = Pressed::default();
            objects.iter().for_each(|&k| pressed.add(&self.objects[k].support));
            let masses: Vec<f64> = objects.iter().map(|&k| masses[k]).collect();
            let feet: usize = objects.iter().map(|&k| self.objects[k].feet.len()).sum();
            let feet = feet as f64 / masses.iter().sum::<f64>();
            Body { objects, masses, feet, pressed }
        };
        self.bodies = groups.iter().map(body).collect();
    }

    /// Sets the loads of all feet for the motion of their bodies, in a step of `dt` seconds.
    pub fn load(&mut self, state: &State, colliders: &mut ColliderSet, dt: f64) {
        for Body { objects, masses, feet, pressed } in &mut self.bodies {
            let weighed = objects.iter().zip(&*masses);
            let momentum: Vector =
                weighed.map(|(&k, mass)| *mass * state.velocities[k].linear).sum();
            // The shift of the load depends on forces alone.
            let inertia = Inertia { mass: masses.iter().sum(), spin: 0.0 };
            let velocity = Twist { linear: momentum / inertia.mass, angular: 0.0 };
            let force = pressed.look(&inertia, &velocity, dt).linear;
            let pressing = pressed.share(force);
            for (&k, mass) in objects.iter().zip(&*masses) {
                let Standing { support, feet: handles, friction } = &self.objects[k];
                let (velocity, heading) = (&state.velocities[k], state.poses[k].heading);
                let twist = Twist { linear: velocity.linear, angular: velocity.angular };
                let mut against = Resistance::default();
                let drag = support.drag(heading, (twist.linear, twist.angular), pressing, dt);
                against.add(support.load(), &drag, Vector::zeros());
                pressed.rub(&against.against(&twist));
                for (foot, load) in handles.iter().zip(support.loads(heading, pressing)) {
                    colliders[*foot].set_friction(friction * load * mass * *feet * support.share());
                }
            }
        }
    }
}
