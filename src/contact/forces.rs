//! The forces of a frame, and the effect of each alone.

use nalgebra::Vector3;
use pushplan_kernel::SingleBodySolution;

use crate::{geometry::Vector, scene::State};

use super::{bodies::Bodies, prior::Prior, twist::shift};

/// The forces of a frame, taken as constant over its duration.
#[derive(Clone, Copy, Debug)]
pub struct FrameForces<'a> {
    bodies: &'a Bodies,
    state: &'a State,
    found: Found<'a>,
}

/// Solver that found the forces.
#[derive(Clone, Copy, Debug)]
enum Found<'a> {
    Alone(&'a SingleBodySolution),
    Together(&'a Prior),
}

impl<'a> FrameForces<'a> {
    pub(super) fn new(bodies: &'a Bodies, state: &'a State, prior: &'a Prior) -> Self {
        Self { bodies, state, found: Found::Together(prior) }
    }

    /// Creates the forces of a frame of one object.
    pub(super) fn alone(
        bodies: &'a Bodies,
        state: &'a State,
        solution: &'a SingleBodySolution,
    ) -> Self {
        Self { bodies, state, found: Found::Alone(solution) }
    }

    /// Returns the force of contact `index` along its normal, newtons.
    pub fn normal(&self, index: usize) -> f64 {
        match self.found {
            Found::Alone(solution) => solution.normal[index],
            Found::Together(prior) => prior.system.constraints[index].force.x,
        }
    }

    /// Returns the motion of `object` under the force of contact `index` alone: displacement
    /// (metres) and rotation (radians).
    pub fn by_contact(&self, index: usize, object: usize) -> (Vector, f64) {
        let prior = match self.found {
            Found::Alone(solution) => {
                let twist = solution.moved(&solution.pressed[index]);
                return (shift(&twist, Vector::zeros()), twist.z);
            }
            Found::Together(prior) => prior,
        };
        let c = &prior.system.constraints[index];
        let pressed = if c.a == self.bodies.groups.of[object] {
            c.to[0] * c.force.x + c.to[1] * c.force.y
        } else {
            -(c.from[0] * c.force.x + c.from[1] * c.force.y)
        };
        self.moved(prior, object, &pressed)
    }

    /// Returns the motion of `object` under the force of joint `index` alone; zero for a joint
    /// within a rigid group.
    pub fn by_joint(&self, index: usize, object: usize) -> (Vector, f64) {
        let none = (Vector::zeros(), 0.0);
        let Found::Together(prior) = self.found else { return none };
        let Some(tie) = prior.joints[index].map(|tie| &prior.system.ties[tie]) else { return none };
        let pressed = if tie.b == self.bodies.groups.of[object] {
            tie.to[0] * tie.force.x + tie.to[1] * tie.force.y
        } else {
            -(tie.from[0] * tie.force.x + tie.from[1] * tie.force.y)
        };
        self.moved(prior, object, &pressed)
    }

    fn moved(&self, prior: &Prior, object: usize, pressed: &Vector3<f64>) -> (Vector, f64) {
        let unknown = &prior.system.unknowns[self.bodies.groups.of[object].0];
        let twist = unknown.inverse * pressed;
        (shift(&twist, self.state.poses[object].position - unknown.centre), twist.z)
    }
}
