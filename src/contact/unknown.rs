//! A rigid group as the unknown of a frame's equations, and its resistance to motion.
//!
//! Every support point of an object opposes its own motion with its share of the weight (Coulomb;
//! Goyal, Ruina and Papadopoulos 1991). A point that moves by d and carries the share n of an
//! object of mass m resists with mu n m g d / |d|.
//!
//! This is K xi for the motion xi = (displacement, rotation). The weight K, which depends on xi, is
//! the sum of mu n m g / |d| J^T J over all points, and J gives d from xi. K is evaluated with the
//! points at half the motion (for the velocity: at its end), like contacts. Otherwise the far
//! points of a long object would drag in a direction wrong by half its rotation. The load moves
//! ahead under contact forces (see [`crate::scene::Physics::lean`]).
//!
//! Inertia M adds, with velocities v0 at the start of the frame of T seconds, of which the group
//! moves for t,
//!
//! ```text
//! (K + 2 M / t^2) xi   = 2 M v0 / t + f    for the displacement
//! (K +   M / T^2) (v T)  =   M v0 / T + f    for the velocity at the end
//! ```
//!
//! The first equation follows because displacements are the mean of both velocities times the time,
//! which makes their errors second order in T. A group that travels less than half of v0 T has come
//! to rest within the frame, at t = 2 |xi| / |v0| (lengths weighted by M). Other groups move for
//! the whole frame. Without forces this is the distance v0^2 / (2 mu g) of free sliding, for which
//! [`super::free_sliding`] is exact.

use nalgebra::{Matrix3, Vector3};
use pushplan_kernel::{
    SolverStats,
    settings::{FOLLOWING, HALF, LEAST, Quantity, SAME},
};

use crate::{
    geometry::{Turn, Vector},
    scene::{Drag, Velocity},
};

use super::{
    bodies::Movable,
    points::Scenery,
    twist::{along, shift},
};

/// Constants of a member during the solution of a frame.
#[derive(Clone, Copy, Debug)]
struct Member {
    /// Initial direction of its own x axis, a unit vector.
    axis: Vector,
    /// Mass, kg, and moment of inertia, kg m^2.
    inertia: (f64, f64),
}

/// Initial momentum of a group.
#[derive(Clone, Copy, Debug)]
struct Momentum {
    /// Momentum of the centre, kg m/s, and angular momentum about it, kg m^2/s.
    sum: Vector3<f64>,
    /// Sum of m v^2 over the members, J.
    square: f64,
}

/// A rigid group and its motion.
#[derive(Debug, Default)]
pub(super) struct Unknown {
    /// Mean initial position of the members.
    pub centre: Vector,
    members: Vec<Member>,
    /// Force and torque per displacement.
    pub resistance: Matrix3<f64>,
    /// Displacement per force and torque: the inverse of the resistance.
    pub inverse: Matrix3<f64>,
    /// Initial momentum, if computed.
    momentum: Option<Momentum>,
    /// Motion without contacts and joints.
    pub free: Vector3<f64>,
    /// Displacement of the centre, metres, and rotation, radians.
    pub twist: Vector3<f64>,
    /// Force and torque of all contacts and joints.
    pub pressed: Vector3<f64>,
    /// Whether any contact presses.
    pub touched: bool,
    /// Whether the group may do more than slide freely even if no contact presses.
    pub held: bool,
    /// Force of contacts and joints relative to the maximum friction, at most one. It moves the
    /// load ahead.
    pressing: Vector,
    /// Number of updates of the weights in this frame, and the motion of the last update, if any.
    updates: usize,
    weighed: Option<Vector3<f64>>,
    /// Share of the motion at which the group is evaluated, see [`Self::look`], and its rotation
    /// there.
    pub share: f64,
    pub turn: Turn,
}

impl Clone for Unknown {
    fn clone(&self) -> Self {
        Self { members: self.members.clone(), ..*self }
    }

    /// Reuses the memory, because this happens in every frame.
    fn clone_from(&mut self, other: &Self) {
        let mut members = std::mem::take(&mut self.members);
        members.clone_from(&other.members);
        *self = Self { members, ..*other };
    }
}

impl Unknown {
    /// Initialises the group from its `members`, without displacement.
    pub fn place(&mut self, members: &[usize], Scenery { bodies, state, turns, .. }: Scenery) {
        let positions = members.iter().map(|&k| state.poses[k].position);
        self.centre = positions.sum::<Vector>() / members.len() as f64;
        self.members.clear();
        let member = |&k: &usize| {
            let body = &bodies.objects[k];
            let turning = body.mass * body.support * body.support / body.spin;
            Member { axis: turns[k].axis(), inertia: (body.mass, turning) }
        };
        self.members.extend(members.iter().map(member));
        (self.share, self.turn) = (0.0, Turn::NONE);
        self.updates = 0;
        self.momentum = None;
        self.held = members.len() > 1;
    }

    /// Returns `true` if the group slides freely, so that its equations are not needed.
    #[inline]
    pub fn coasts(&self) -> bool {
        !self.touched && !self.held
    }

    /// Sets the motion to the free sliding of its only `member`.
    pub fn coast(&mut self, member: usize, scenery: Scenery, quantity: Quantity) {
        let (coast, duration) = (&scenery.coasts[member], scenery.step.duration);
        self.free = match quantity {
            Quantity::Displacement => Vector3::new(coast.shift.x, coast.shift.y, coast.turn),
            Quantity::Velocity => {
                let end = duration * coast.velocity;
                Vector3::new(end.x, end.y, duration * coast.spin)
            }
        };
        self.twist = self.free;
    }

    /// Evaluates the group at `share` of its present motion.
    #[inline]
    pub fn look(&mut self, share: f64) {
        self.share = share;
        self.turn = Turn::by(share * self.twist.z);
    }

    /// Returns the position of a point of the group at the evaluated instant.
    #[inline]
    pub fn moved(&self, point: Vector) -> Vector {
        self.centre + self.share * self.twist.xy() + self.turn.of(point - self.centre)
    }

    /// Resets the contact forces to zero.
    #[inline]
    pub fn forget(&mut self) {
        self.pressed = Vector3::zeros();
        self.pressing = Vector::zeros();
        self.touched = false;
    }

    /// Prepares for another quantity, which is unknown without the equations if anything but the
    /// table has held the group.
    #[inline]
    pub fn turn_to_another(&mut self) {
        self.weighed = None;
        self.held |= self.touched;
    }

    /// Returns the displacement of the group at the initial velocities of its `members`. The mean
    /// of all members is taken, because after a rotation their motions are not exactly rigid.
    #[inline]
    pub fn as_it_began(
        &self,
        members: &[usize],
        Scenery { state, step, .. }: Scenery,
    ) -> Vector3<f64> {
        let velocities = members.iter().map(|&k| &state.velocities[k]);
        let sum: Vector3<f64> = velocities.map(|v| v.linear.push(v.angular)).sum();
        step.duration * sum / members.len() as f64
    }

    /// Sets the motion from the forces on the group.
    #[inline]
    pub fn settle(&mut self) {
        self.twist = self.free + self.inverse * self.pressed;
    }

    /// Returns the initial momentum of its `members`.
    fn momentum(&self, members: &[usize], Scenery { state, .. }: Scenery) -> Momentum {
        let mut momentum = Momentum { sum: Vector3::zeros(), square: 0.0 };
        for (&k, Member { inertia: (mass, inertia), .. }) in members.iter().zip(&self.members) {
            let Velocity { linear, angular } = state.velocities[k];
            let arm = state.poses[k].position - self.centre;
            let turning = inertia * angular;
            momentum.sum += along(*mass * linear, arm) + Vector3::new(0.0, 0.0, turning);
            let (x, y) = (linear.x, linear.y);
            momentum.square += mass * (x * x + y * y) + turning * angular;
        }
        momentum
    }

    /// Returns the number of seconds for which the group moves, given its present motion, or a
    /// displacement of its members by `reach` metres.
    fn moving(
        &self,
        members: &[usize],
        Scenery { state, step, .. }: Scenery,
        reach: Option<f64>,
        start: &Momentum,
    ) -> f64 {
        let mut square = 0.0;
        for (&k, Member { inertia: (mass, inertia), .. }) in members.iter().zip(&self.members) {
            square += match reach {
                Some(reach) => mass * reach * reach,
                None => {
                    let moved = shift(&self.twist, state.poses[k].position - self.centre);
                    let (x, y, turn) = (moved.x, moved.y, self.twist.z);
                    mass * (x * x + y * y) + inertia * turn * turn
                }
            };
        }
        moving(square, start.square, step.duration)
    }

    /// Computes resistance and free motion from the present motion of the members, or for
    /// displacements by `reach` metres each.
    pub fn weigh(
        &mut self,
        members: &[usize],
        scenery: Scenery,
        quantity: Quantity,
        reach: Option<f64>,
        tally: &mut SolverStats,
    ) {
        let Scenery { bodies, state, .. } = scenery;
        let momentum = self.momentum.unwrap_or_else(|| {
            self.weighed = None;
            self.momentum(members, scenery)
        });
        self.momentum = Some(momentum);
        let before = self.pressing;
        if self.updates < FOLLOWING {
            let load: f64 = members.iter().map(|&k| bodies.objects[k].load()).sum();
            let pressed = self.pressed.xy();
            self.pressing = pressed / pressed.norm().max(load).max(f64::MIN_POSITIVE);
        }
        self.updates += 1;
        let near = |before: Vector3<f64>| (self.twist - before).amax() < SAME;
        if self.weighed.is_some_and(near) && (self.pressing - before).amax() < SAME {
            return;
        }
        self.weighed = reach.is_none().then_some(self.twist);
        let duration = scenery.step.duration;
        let (stiff, pull) = match quantity {
            Quantity::Displacement => {
                let moving = self.moving(members, scenery, reach, &momentum);
                (2.0 / (moving * moving), momentum.sum * (2.0 / moving))
            }
            Quantity::Velocity => (1.0 / (duration * duration), momentum.sum / duration),
        };
        // The velocity is evaluated at the end of the displacement, which is already set.
        if let (Quantity::Displacement, None) = (quantity, reach) {
            self.look(HALF);
        }
        let mut weight = Matrix3::zeros();
        for (&k, Member { axis, inertia: (mass, inertia) }) in members.iter().zip(&self.members) {
            let body = &bodies.objects[k];
            tally.weigh(bodies.feet(k).count);
            let arm = state.poses[k].position - self.centre;
            let (rub, arm_then) = match reach {
                Some(moved) => {
                    let drag = bodies.feet(k).even_drag(*axis, moved.max(quantity.stuck()));
                    (Rub::new(body, drag), arm)
                }
                None => {
                    let (axis, arm) = (self.turn.of(*axis), self.turn.of(arm));
                    let motion = (shift(&self.twist, arm), self.twist.z);
                    let lean = body.lean * self.pressing;
                    let drag = bodies.feet(k).drag(axis, motion, quantity.stuck(), lean);
                    (Rub::new(body, drag), arm)
                }
            };
            let (sum, second) = (stiff * mass, stiff * inertia);
            let slow = Rub { sum, first: Vector::zeros(), second };
            weight += rub.about(arm_then) + slow.about(arm);
        }
        self.resistance = weight;
        self.inverse = inverse(&weight);
        self.free = self.inverse * pull;
    }
}

/// Returns the number of seconds for which a group moves within a frame. `square` is the squared
/// displacement, and `start` the squared displacement at the initial speed; lengths are weighted by
/// inertia.
#[inline]
fn moving(square: f64, start: f64, duration: f64) -> f64 {
    if start == 0.0 {
        return duration;
    }
    (2.0 * (square / start).sqrt()).max(LEAST * duration).min(duration)
}

/// Moments of the resistance of an object about its centre, world axes: N/m, N, N m.
struct Rub {
    sum: f64,
    first: Vector,
    second: f64,
}

impl Rub {
    #[inline]
    fn new(body: &Movable, drag: Drag) -> Self {
        let rub = body.load();
        Self { sum: rub * drag.sum, first: rub * drag.first, second: rub * drag.second }
    }

    /// Returns the resistance to displacements of a point and rotations about it. `arm` leads from
    /// the point to the object's centre.
    #[inline]
    fn about(&self, arm: Vector) -> Matrix3<f64> {
        let first = self.first + self.sum * arm;
        let second = self.second + 2.0 * self.first.dot(&arm) + self.sum * arm.norm_squared();
        let (x, y) = (first.x, first.y);
        Matrix3::new(self.sum, 0.0, -y, 0.0, self.sum, x, -y, x, second)
    }
}

/// Inverts a resistance [[s, 0, -y], [0, s, x], [-y, x, t]] in closed form.
#[inline]
fn inverse(weight: &Matrix3<f64>) -> Matrix3<f64> {
    let (s, x, y, t) = (weight.m11, weight.m23, -weight.m13, weight.m33);
    let (p, q) = (-x / s, y / s);
    // Compliance of a rotation about the centre of resistance.
    let turn = 1.0 / (t - (x * x + y * y) / s);
    Matrix3::new(
        1.0 / s + q * q * turn,
        q * p * turn,
        q * turn,
        q * p * turn,
        1.0 / s + p * p * turn,
        p * turn,
        q * turn,
        p * turn,
        turn,
    )
}
