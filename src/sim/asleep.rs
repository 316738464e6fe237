//! Sleep of bodies that nothing has approached yet: they cost nothing, and keep their poses
//! bitwise.
//!
//! rapier skips sleeping bodies and wakes them at contact with an awake body. But it wakes them
//! within a step, in which a body in 3-D has no table yet and falls by 0.17 mm. Bodies are
//! therefore woken here, before the step in which contact is possible. They never sleep again,
//! because a body that is pushed slowly, or reverses, is slow without being at rest.
//!
//! The contacts of a sleeping body with the table are still listed in every step. A body far from
//! all awake ones is therefore not in the engine's world at all, unless a joint holds it.

use super::groups::Group;
use crate::scene::Velocity;

/// Distance to an awake body below which a body wakes, metres; rapier detects contacts up to 2 mm
/// away.
const NEAR: f64 = 4e-3;

/// Distance to an awake body below which a body is in the engine's world, metres: more than any
/// body moves in a step.
const FAR: f64 = 0.1;

/// A bounding box of a body on the table, in the engine's coordinates, metres.
#[derive(Clone, Copy)]
pub(super) struct Extent {
    low: [f64; 2],
    high: [f64; 2],
}

impl Extent {
    /// The empty box.
    const EMPTY: Self = Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };

    fn grown(mut self, low: [f64; 2], high: [f64; 2]) -> Self {
        for axis in 0..2 {
            self.low[axis] = self.low[axis].min(low[axis]);
            self.high[axis] = self.high[axis].max(high[axis]);
        }
        self
    }

    fn is_near(&self, other: &Self, margin: f64) -> bool {
        (0..2).all(|axis| {
            self.low[axis] - margin <= other.high[axis]
                && other.low[axis] - margin <= self.high[axis]
        })
    }
}

/// The operations on an engine's world that sleep needs. The two implementations are alike, but use
/// types of two crates.
pub(super) trait Sleepable {
    /// Handle of a body.
    type Handle: Copy;

    /// Returns the bounding box of a body.
    fn extent(&self, body: Self::Handle) -> Extent;

    /// Returns the distance that a body moves in a step at its present speed, metres.
    fn stride(&self, body: Self::Handle) -> f64;

    /// Returns `true` if a body sleeps.
    fn sleeps(&self, body: Self::Handle) -> bool;

    /// Lets a resting body sleep from the next step on.
    fn let_sleep(&mut self, body: Self::Handle);

    /// Wakes a body permanently.
    fn wake(&mut self, body: Self::Handle);

    /// Takes a body out of the world, or puts it back at rest.
    fn set_present(&mut self, body: Self::Handle, present: bool);
}

/// Speed below which a body rests, m/s and rad/s.
const AT_REST: f64 = 1e-9;

/// Resting time before a body sleeps, seconds: less than a step. With zero, rapier would also let
/// moving bodies sleep.
const AT_ONCE: f64 = 1e-9;

/// The sleeping and the awake bodies of a world.
pub(super) struct Asleep<H> {
    asleep: Vec<Sleeper<H>>,
    /// Bodies out of the world.
    away: Vec<Sleeper<H>>,
    awake: Vec<H>,
}

struct Sleeper<H> {
    body: H,
    around: Extent,
    /// Whether the engine has put it to sleep by now.
    sleeps: bool,
}

impl<H: Copy> Asleep<H> {
    /// Lets the resting groups of `groups` sleep; `bodies` are their handles, and the tool is
    /// awake. Only groups that `stands` selects may leave the world.
    pub fn new<W: Sleepable<Handle = H>>(
        world: &mut W,
        (groups, bodies): (&[Group], impl Iterator<Item = H>),
        tool: H,
        stands: impl Fn(&Group) -> bool,
    ) -> Self {
        let mut this = Self { asleep: Vec::new(), away: Vec::new(), awake: vec![tool] };
        for (group, body) in groups.iter().zip(bodies) {
            if group.velocity == Velocity::default() {
                let around = world.extent(body);
                world.let_sleep(body);
                let sleeper = Sleeper { body, around, sleeps: false };
                if stands(group) {
                    world.set_present(body, false);
                    this.away.push(sleeper);
                } else {
                    this.asleep.push(sleeper);
                }
            } else {
                this.awake.push(body);
            }
        }
        this
    }

    /// Creates an instance in which no body ever sleeps.
    pub fn none() -> Self {
        Self { asleep: Vec::new(), away: Vec::new(), awake: Vec::new() }
    }

    /// Keeps a body awake, because a spring may move it.
    pub fn keep_awake<W: Sleepable<Handle = H>>(&mut self, world: &mut W, body: H)
    where
        H: PartialEq,
    {
        self.asleep.retain(|sleeper| sleeper.body != body);
        if !self.awake.contains(&body) {
            self.awake.push(body);
        }
        world.wake(body);
    }

    /// Wakes the bodies near an awake body, now or within this step.
    pub fn wake_near<W: Sleepable<Handle = H>>(&mut self, world: &mut W) {
        let mut k = 0;
        // A woken body also wakes its neighbours.
        while k < self.awake.len() && !(self.asleep.is_empty() && self.away.is_empty()) {
            let body = self.awake[k];
            let (extent, stride) = (world.extent(body), world.stride(body));
            for near in self.away.extract_if(.., |one| extent.is_near(&one.around, FAR + stride)) {
                world.set_present(near.body, true);
                self.asleep.push(near);
            }
            let margin = NEAR + stride;
            self.asleep.retain_mut(|sleeper| {
                let sleeps = world.sleeps(sleeper.body);
                // Bodies woken by the engine were hit by a body faster than the look-ahead.
                let woken = sleeper.sleeps && !sleeps;
                sleeper.sleeps = sleeps;
                let wakes = woken || extent.is_near(&sleeper.around, margin);
                if wakes {
                    world.wake(sleeper.body);
                    self.awake.push(sleeper.body);
                }
                !wakes
            });
            k += 1;
        }
    }
}

impl Sleepable for rapier2d_f64::prelude::PhysicsWorld {
    type Handle = rapier2d_f64::prelude::RigidBodyHandle;

    fn extent(&self, body: Self::Handle) -> Extent {
        let colliders = self.bodies[body].colliders().iter();
        colliders.fold(Extent::EMPTY, |extent, collider| {
            let around = self.colliders[*collider].compute_aabb();
            extent.grown([around.mins.x, around.mins.y], [around.maxs.x, around.maxs.y])
        })
    }

    fn stride(&self, body: Self::Handle) -> f64 {
        self.bodies[body].linvel().length() * self.integration_parameters.dt
    }

    fn sleeps(&self, body: Self::Handle) -> bool {
        self.bodies[body].is_sleeping()
    }

    fn let_sleep(&mut self, body: Self::Handle) {
        let activation = self.bodies[body].activation_mut();
        activation.normalized_linear_threshold = AT_REST;
        activation.angular_threshold = AT_REST;
        activation.time_until_sleep = AT_ONCE;
    }

    fn wake(&mut self, body: Self::Handle) {
        let body = &mut self.bodies[body];
        body.activation_mut().normalized_linear_threshold = -1.0;
        body.activation_mut().angular_threshold = -1.0;
        body.wake_up(true);
    }

    fn set_present(&mut self, body: Self::Handle, present: bool) {
        self.bodies[body].set_enabled(present);
    }
}

impl Sleepable for rapier3d_f64::prelude::PhysicsWorld {
    type Handle = rapier3d_f64::prelude::RigidBodyHandle;

    fn extent(&self, body: Self::Handle) -> Extent {
        let colliders = self.bodies[body].colliders().iter();
        colliders.fold(Extent::EMPTY, |extent, collider| {
            let around = self.colliders[*collider].compute_aabb();
            extent.grown([around.mins.x, around.mins.y], [around.maxs.x, around.maxs.y])
        })
    }

    fn stride(&self, body: Self::Handle) -> f64 {
        self.bodies[body].linvel().length() * self.integration_parameters.dt
    }

    fn sleeps(&self, body: Self::Handle) -> bool {
        self.bodies[body].is_sleeping()
    }

    fn let_sleep(&mut self, body: Self::Handle) {
        let activation = self.bodies[body].activation_mut();
        activation.normalized_linear_threshold = AT_REST;
        activation.angular_threshold = AT_REST;
        activation.time_until_sleep = AT_ONCE;
    }

    fn wake(&mut self, body: Self::Handle) {
        let body = &mut self.bodies[body];
        body.activation_mut().normalized_linear_threshold = -1.0;
        body.activation_mut().angular_threshold = -1.0;
        body.wake_up(true);
    }

    fn set_present(&mut self, body: Self::Handle, present: bool) {
        self.bodies[body].set_enabled(present);
    }
}

#[cfg(test)]
mod tests;
