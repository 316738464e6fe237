//! A rigid group as the unknown of a frame's equations, and how it resists being moved.
//!
//! Every point under an object drags with its share of the weight against its own motion (Coulomb;
//! Goyal, Ruina and Papadopoulos 1991): a point that moves by d and carries the share n of an
//! object of mass m answers with mu n m g d / |d|. Written with a weight K that depends on the motion
//! xi = (shift, turn), that is K xi, the sum of mu n m g / |d| J^T J over all points, J giving d from
//! xi. Where contacts press, the load moves ahead (see [`crate::scene::Physics::lean`]). Inertia M
//! adds, with velocities v0 at the start of the frame of T seconds,
//!
//! ```text
//! (K + 2 M / T^2) xi     = 2 M v0 / T + f      for the displacement
//! (K +   M / T^2) (v T)  =   M v0 / T + f      for the velocity at the end
//! ```
//!
//! the first because displacements are the mean of both velocities times T, which keeps their
//! errors of second order in T. A free object must coast exactly as [`super::coast`] says, even if
//! it comes to rest within the frame; so 2 m v0 / T is written as what makes it so.

use nalgebra::{Matrix3, Vector3};

use crate::{
    geometry::{Turn, Vector},
    scene::Drag,
};

use super::{
    bodies::{Bodies, Movable},
    points::Scenery,
    tally::Tally,
    twist::{along, shift},
};

/// What the unknowns are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Quantity {
    /// Displacements in the frame.
    #[default]
    Displacement,
    /// Velocities at its end, times its duration.
    Velocity,
}

impl Quantity {
    /// Smallest length s, metres: what moves less in a frame counts as stuck. Velocities need a
    /// finer one, as what is left of them must count as rest.
    #[inline(always)]
    pub fn stuck(self) -> f64 {
        match self {
            Self::Displacement => 1e-4,
            Self::Velocity => 1e-5,
        }
    }

    /// What inertia adds to the resistance of `body` in a frame of that duration, N/m.
    #[inline]
    fn inertia_of(self, body: &Movable, duration: f64) -> f64 {
        let inertia = body.mass / (duration * duration);
        match self {
            Self::Displacement => 2.0 * inertia,
            Self::Velocity => inertia,
        }
    }
}

/// Updates of the weights in which the load follows what presses; then it stays, as where it goes
/// and what then presses could otherwise alternate for ever. Of 400 held-out pushes of one object
/// the mean error against the planar engine is 2.85 mm with 1, 2.33 with 2, 1.70 with 4, 1.60 with
/// 5, 1.63 with 6 and 1.8 without end.
pub(super) const FOLLOWING: usize = 5;

/// Weights are kept while motion (metres, radians) and pressing have changed by less.
pub(super) const SAME: f64 = 1e-9;

/// What does not change while a member's frame is solved.
#[derive(Clone, Copy, Debug)]
struct Member {
    /// Where its own x axis points at the start of the frame, a unit vector.
    axis: Vector,
    /// What its inertia adds to the resistance to shifts, N/m, and to turns, N m.
    inertia: (f64, f64),
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
    /// The pull on it without contacts and joints, force and torque, if that has been computed.
    pull: Option<Vector3<f64>>,
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
    pub fn place(&mut self, members: &[usize], Scenery { state, turns, .. }: Scenery) {
        let positions = members.iter().map(|&k| state.poses[k].position);
        self.centre = positions.sum::<Vector>() / members.len() as f64;
        self.members.clear();
        let member = |&k: &usize| Member { axis: turns[k].axis(), inertia: (0.0, 0.0) };
        self.members.extend(members.iter().map(member));
        (self.share, self.turn) = (0.0, Turn::NONE);
        self.updates = 0;
        self.pull = None;
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
        self.pull = None;
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

    /// What pulls the group: friction and inertia of members that coast.
    fn pull(
        &mut self,
        members: &[usize],
        Scenery { bodies, state, step, coasts, .. }: Scenery,
        quantity: Quantity,
    ) -> Vector3<f64> {
        let duration = step.duration;
        let mut pull = Vector3::zeros();
        for (&k, member) in members.iter().zip(&mut self.members) {
            let body = &bodies.objects[k];
            member.inertia = inertias(body, quantity.inertia_of(body, duration));
            let (slide, turn) = member.inertia;
            let arm = state.poses[k].position - self.centre;
            let own = match quantity {
                Quantity::Displacement => {
                    let coast = &coasts[k];
                    let moved = Vector3::new(coast.shift.x, coast.shift.y, coast.turn);
                    if moved == Vector3::zeros() {
                        continue;
                    }
                    let motion = (coast.shift, coast.turn);
                    let rub = rub((bodies, k), member.axis, motion, quantity, Vector::zeros());
                    rub.about(Vector::zeros()) * moved
                        + Vector3::new(slide, slide, turn).component_mul(&moved)
                }
                Quantity::Velocity => {
                    let start = &state.velocities[k];
                    let pull = slide * duration * start.linear;
                    Vector3::new(pull.x, pull.y, turn * duration * start.angular)
                }
            };
            pull += along(own.xy(), arm) + Vector3::new(0.0, 0.0, own.z);
        }
        pull
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
        let pull = self.pull.unwrap_or_else(|| {
            self.weighed = None;
            self.pull(members, scenery, quantity)
        });
        self.pull = Some(pull);
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
        let mut weight = Matrix3::zeros();
        for (&k, Member { axis, inertia: (slide, turn) }) in members.iter().zip(&self.members) {
            let body = &bodies.objects[k];
            tally.weigh(bodies.feet(k).count);
            let arm = state.poses[k].position - self.centre;
            let mut rub = match reach {
                Some(moved) => {
                    Rub::new(body, bodies.feet(k).even_drag(moved.max(quantity.stuck())))
                }
                None => {
                    let moved = shift(&self.twist, arm);
                    let lean = body.lean * self.pressing;
                    rub((bodies, k), *axis, (moved, self.twist.z), quantity, lean)
                }
            };
            rub.sum += slide;
            rub.second += turn;
            weight += rub.about(arm);
        }
        self.resistance = weight;
        self.inverse = inverse(&weight);
        self.free = self.inverse * pull;
    }
}

/// How the support of object `k`, whose own x axis points along `axis` and whose load has moved by
/// `lean`, resists a shift and a turn.
#[inline]
fn rub(
    (bodies, k): (&Bodies, usize),
    axis: Vector,
    (shift, turn): (Vector, f64),
    quantity: Quantity,
    lean: Vector,
) -> Rub {
    let drag = bodies.feet(k).drag(axis, (shift, turn), quantity.stuck(), lean);
    Rub::new(&bodies.objects[k], drag)
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

/// The part of the resistance to shifts, N/m, and to turns, N m, that inertia makes; `inertia` in
/// N/m.
#[inline]
fn inertias(body: &Movable, inertia: f64) -> (f64, f64) {
    (inertia, inertia * body.support * body.support / body.spin)
}
