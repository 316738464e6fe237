//! A body that nothing has come near yet sleeps: it costs nothing, and stays where it is to the
//! last bit.
//!
//! rapier leaves out what sleeps and wakes it when something awake touches it. But it does so in
//! the middle of a step, in which a body in 3-D has no table yet and falls by 0.17 mm. So bodies
//! are woken here, before the step in which that could happen; and they never sleep again, as a
//! body that is pushed slowly, or turns back, is slow without being at rest.

use super::groups::Group;
use crate::scene::Velocity;

/// A body this near to something awake wakes, metres: rapier looks for contacts up to 2 mm away.
const NEAR: f64 = 4e-3;

/// A box around a body on the table, in the engine's coordinates: metres.
#[derive(Clone, Copy)]
pub(super) struct Extent {
    low: [f64; 2],
    high: [f64; 2],
}

impl Extent {
    /// Around nothing yet.
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

/// What sleep needs of an engine's world. The two that implement it look alike, but belong to two
/// crates with types of their own.
pub(super) trait Sleepable {
    /// Names a body.
    type Handle: Copy;

    /// Where a body is.
    fn extent(&self, body: Self::Handle) -> Extent;

    /// How far it goes in a step, metres, as fast as it is.
    fn stride(&self, body: Self::Handle) -> f64;

    /// Whether it sleeps.
    fn sleeps(&self, body: Self::Handle) -> bool;

    /// Lets a body that rests sleep from the next step on.
    fn let_sleep(&mut self, body: Self::Handle);

    /// Wakes a body for good.
    fn wake(&mut self, body: Self::Handle);
}

/// A slower body rests, m/s and rad/s.
const AT_REST: f64 = 1e-9;

/// How long a body must rest before it sleeps, seconds: less than a step. With no time at all
/// rapier would let moving bodies sleep, too.
const AT_ONCE: f64 = 1e-9;

/// The bodies of a world by whether they sleep.
pub(super) struct Asleep<H> {
    asleep: Vec<Sleeper<H>>,
    awake: Vec<H>,
}

struct Sleeper<H> {
    body: H,
    around: Extent,
    /// Whether it fell asleep by now.
    sleeps: bool,
}

impl<H: Copy> Asleep<H> {
    /// Lets all of `groups` sleep that rest, whose `bodies` these are; the tool is awake.
    pub fn new<W: Sleepable<Handle = H>>(
        world: &mut W,
        (groups, bodies): (&[Group], impl Iterator<Item = H>),
        tool: H,
    ) -> Self {
        let mut this = Self { asleep: Vec::new(), awake: vec![tool] };
        for (group, body) in groups.iter().zip(bodies) {
            if group.velocity == Velocity::default() {
                let around = world.extent(body);
                this.asleep.push(Sleeper { body, around, sleeps: false });
                world.let_sleep(body);
            } else {
                this.awake.push(body);
            }
        }
        this
    }

    /// Nothing sleeps, ever.
    pub fn none() -> Self {
        Self { asleep: Vec::new(), awake: Vec::new() }
    }

    /// Wakes what something awake is near to, or will be in this step.
    pub fn wake_near<W: Sleepable<Handle = H>>(&mut self, world: &mut W) {
        let mut k = 0;
        // A body that wakes also wakes those near it.
        while k < self.awake.len() && !self.asleep.is_empty() {
            let body = self.awake[k];
            let (extent, margin) = (world.extent(body), NEAR + world.stride(body));
            self.asleep.retain_mut(|sleeper| {
                let sleeps = world.sleeps(sleeper.body);
                // Bodies woken by the engine were hit by something faster than we look ahead.
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

impl Sleepable for rapier2d::prelude::PhysicsWorld {
    type Handle = rapier2d::prelude::RigidBodyHandle;

    fn extent(&self, body: Self::Handle) -> Extent {
        let colliders = self.bodies[body].colliders().iter();
        colliders.fold(Extent::EMPTY, |extent, collider| {
            let around = self.colliders[*collider].compute_aabb();
            let of = |x: f32, y: f32| [f64::from(x), f64::from(y)];
            extent.grown(of(around.mins.x, around.mins.y), of(around.maxs.x, around.maxs.y))
        })
    }

    fn stride(&self, body: Self::Handle) -> f64 {
        f64::from(self.bodies[body].linvel().length() * self.integration_parameters.dt)
    }

    fn sleeps(&self, body: Self::Handle) -> bool {
        self.bodies[body].is_sleeping()
    }

    fn let_sleep(&mut self, body: Self::Handle) {
        let activation = self.bodies[body].activation_mut();
        activation.normalized_linear_threshold = AT_REST as f32;
        activation.angular_threshold = AT_REST as f32;
        activation.time_until_sleep = AT_ONCE as f32;
    }

    fn wake(&mut self, body: Self::Handle) {
        let body = &mut self.bodies[body];
        body.activation_mut().normalized_linear_threshold = -1.0;
        body.activation_mut().angular_threshold = -1.0;
        body.wake_up(true);
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
}

#[cfg(test)]
mod tests;
