//! A rigid group as the unknown of a frame's equations, and how it resists being moved.
//!
//! Every point under an object drags with its share of the weight against its own motion (Coulomb;
//! Goyal, Ruina and Papadopoulos 1991): a point that moves by d and carries the share n of an
//! object of mass m answers with mu n m g d / |d|. Written with a weight K that depends on the motion
//! xi = (shift, turn), that is K xi, the sum of mu n m g / |d| J^T J over all points, J giving d from
//! xi. All of it is taken where the points are half-way (for the velocity: where they end), as
//! contacts are: a long object's far points otherwise drag the wrong way by half of its turn. Where
//! contacts press, the load moves ahead (see [`crate::scene::Physics::lean`]). Inertia M adds, with
//! velocities v0 at the start of the frame of T seconds, of which it moves for t,
//!
//! ```text
//! (K + 2 M / t^2) xi     = 2 M v0 / t + f      for the displacement
//! (K +   M / T^2) (v T)  =   M v0 / T + f      for the velocity at the end
//! ```
//!
//! the first because displacements are the mean of both velocities times the time, which keeps their
//! errors of second order in T. What goes less far than half of v0 T has come to rest on the way, at t
//! = 2 |xi| / |v0| (lengths weighted by M); anything else moves all the time. Without forces that is
//! the way v0^2 / (2 mu g) that a free object slides, and [`super::coast`] says it exactly.

use nalgebra::{Matrix3, Vector3};
use pushplan_kernel::{
    Tally,
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

/// What does not change while a member's frame is solved.
#[derive(Clone, Copy, Debug)]
struct Member {
    /// Where its own x axis points at the start of the frame, a unit vector.
    axis: Vector,
    /// Its mass, kg, and its moment of inertia, kg m^2.
    inertia: (f64, f64),
}

/// How a group moves when a frame begins.
#[derive(Clone, Copy, Debug)]
struct Momentum {
    /// Of its centre, kg m/s, and of turning about it, kg m^2/s.
    sum: Vector3<f64>,
    /// The sum of m v^2 over its members, J.
    square: f64,
}

/// A rigid group and its motion.
#[derive(Debug, Default)]
pub(super) struct Unknown {
    /// Mean position of its members at the start of the frame.
    pub centre: Vector,
    members: Vec<Member>,
    /// Force and torque per displacement.
    pub resistance: Matrix3<f64>,
    /// Displacement per force and torque, the inverse of the resistance.
    pub inverse: Matrix3<f64>,
    /// How it moved as the frame began, if that has been computed.
    momentum: Option<Momentum>,
    /// Its motion without contacts and joints.
    pub free: Vector3<f64>,
    /// Shift of the centre, metres, and turn, radians.
    pub twist: Vector3<f64>,
    /// Force and torque of all contacts and joints.
    pub pressed: Vector3<f64>,
    /// Whether any contact presses.
    pub touched: bool,
    /// Whether it may do anything but coast where none does.
    pub held: bool,
    /// How hard contacts and joints press, as a share of the largest friction, at most one: what
    /// moves the load ahead.
    pressing: Vector,
    /// Updates of the weights in this frame, and the motion that they were last taken for, if they
    /// were.
    updates: usize,
    weighed: Option<Vector3<f64>>,
    /// The share of its motion that is looked at, see [`Self::look`], and the turn then.
    pub share: f64,
    pub turn: Turn,
}

impl Clone for Unknown {
    fn clone(&self) -> Self {
        Self { members: self.members.clone(), ..*self }
    }

    /// On the memory that is there: it happens in every frame.
    fn clone_from(&mut self, other: &Self) {
        let mut members = std::mem::take(&mut self.members);
        members.clone_from(&other.members);
        *self = Self { members, ..*other };
    }
}

impl Unknown {
    /// Puts the group where its `members` are; it has not moved yet.
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

    /// Whether it does what it would do alone on the table, so that its equations need not be known.
    #[inline]
    pub fn coasts(&self) -> bool {
        !self.touched && !self.held
    }

    /// Moves as its only `member` coasts.
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

    /// Looks at the group when `share` of its present motion is done.
    #[inline]
    pub fn look(&mut self, share: f64) {
        self.share = share;
        self.turn = Turn::by(share * self.twist.z);
    }

    /// Where a point of the group has come to then.
    #[inline]
    pub fn moved(&self, point: Vector) -> Vector {
        self.centre + self.share * self.twist.xy() + self.turn.of(point - self.centre)
    }

    /// Nothing presses on it, as far as is known.
    #[inline]
    pub fn forget(&mut self) {
        self.pressed = Vector3::zeros();
        self.pressing = Vector::zeros();
        self.touched = false;
    }

    /// Another quantity is wanted now, which is unknown without the equations where anything but
    /// the table has held the group.
    #[inline]
    pub fn turn_to_another(&mut self) {
        self.weighed = None;
        self.held |= self.touched;
    }

    /// How far it comes if it goes on as its `members` move when the frame begins. After a turn these do
    /// not quite move as one any more, so all of them count.
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

    /// Moves as what presses makes it.
    #[inline]
    pub fn settle(&mut self) {
        self.twist = self.free + self.inverse * self.pressed;
    }

    /// How its `members` move when the frame begins.
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

    /// For how many of the frame's seconds it moves, if it comes as far as it does now or its
    /// members come by `reach` metres.
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

    /// Takes resistance and free motion when its members move as they do now, or by `reach`
    /// metres each.
    pub fn weigh(
        &mut self,
        members: &[usize],
        scenery: Scenery,
        quantity: Quantity,
        reach: Option<f64>,
        tally: &mut Tally,
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
        // Velocities are those of where displacements have brought it, at which it is looked already.
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

/// For how many of a frame's seconds a group moves that comes as far as the root of `square`, when
/// in each of them the speed it began with would bring it as far as the root of `start`; lengths are
/// weighted by its inertia.
#[inline]
fn moving(square: f64, start: f64, duration: f64) -> f64 {
    if start == 0.0 {
        return duration;
    }
    (2.0 * (square / start).sqrt()).max(LEAST * duration).min(duration)
}

/// The moments of what resists an object, about its centre in world axes: N/m, N, N m.
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

    /// The resistance against shifts of a point and turns about it, `arm` leading from there to the
    /// object's centre.
    #[inline]
    fn about(&self, arm: Vector) -> Matrix3<f64> {
        let first = self.first + self.sum * arm;
        let second = self.second + 2.0 * self.first.dot(&arm) + self.sum * arm.norm_squared();
        let (x, y) = (first.x, first.y);
        Matrix3::new(self.sum, 0.0, -y, 0.0, self.sum, x, -y, x, second)
    }
}

/// The inverse of a resistance [[s, 0, -y], [0, s, x], [-y, x, t]], in closed form.
#[inline]
fn inverse(weight: &Matrix3<f64>) -> Matrix3<f64> {
    let (s, x, y, t) = (weight.m11, weight.m23, -weight.m13, weight.m33);
    let (p, q) = (-x / s, y / s);
    // Turning about the point that turning alone leaves in place.
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
