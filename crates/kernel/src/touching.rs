//! Contacts of an object with bodies whose motion is given, part-way through a frame, for several
//! frames side by side.

use crate::{
    Vector,
    lanes::{Lanes, Pair, Triple, Turns, Which, dot, left_of, minus, norm, plus, times},
    object::{Moves, Object},
    settings::NEAR,
};

/// The feature that the normal of a contact turns with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Follows {
    /// A face of the first body.
    First,
    /// A face of the second body.
    Second,
    /// Flush faces of both bodies, end to end.
    Both,
    /// The line between two points of the bodies: centres of discs, or corners. World frame,
    /// metres.
    Between(Vector, Vector),
    /// Nothing: two corners, the line between which may change its direction arbitrarily.
    Nothing,
}

/// A contact of each frame that has as many contacts. World axes, metres, at the frame's start.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Touching<const N: usize> {
    /// Frames that have the contact.
    pub present: Which<N>,
    /// Unit vector into the object.
    pub normal: Pair<N>,
    pub gap: Lanes<N>,
    pub friction: Lanes<N>,
    /// Vector from the object's centre to the point on it.
    pub arm: Pair<N>,
    /// Displacement of the point on the other body, and rotation of that body, radians.
    pub given: Pair<N>,
    pub given_turn: Lanes<N>,
    /// Radius of the other body, and the frames in which it is a disc.
    pub radius: Lanes<N>,
    pub round: Which<N>,
    /// Feature that the normal turns with, see [`Follows`]: a face of the object, of the other,
    /// of both, or two points.
    pub first: Which<N>,
    pub second: Which<N>,
    pub both: Which<N>,
    pub between: Which<N>,
    pub points: [Pair<N>; 2],
}

/// Displacement of an object part-way through a frame.
#[derive(Clone, Copy)]
pub(crate) struct Look<const N: usize> {
    share: Lanes<N>,
    shift: Pair<N>,
    /// Rotation so far.
    pub turn: Turns<N>,
    /// Centre at that moment.
    centre: Pair<N>,
}

impl<const N: usize> Look<N> {
    #[inline(always)]
    pub fn new(object: &Object<N>, moves: &Moves<N>, share: f64) -> Self {
        let share = Lanes::all(share);
        let [x, y, turn] = times(moves.twist, share);
        let mut look = Self { share, shift: [x, y], turn: Turns::by(turn), centre: object.place };
        look.centre = look.moved(object, object.place);
        look
    }

    /// Returns the displaced point of the object.
    #[inline(always)]
    fn moved(&self, object: &Object<N>, point: Pair<N>) -> Pair<N> {
        plus(plus(object.place, self.shift), self.turn.of(minus(point, object.place)))
    }
}

/// A contact at some moment of a frame.
#[derive(Clone, Copy)]
pub(crate) struct Met<const N: usize> {
    pub normal: Pair<N>,
    /// Vector from the object's centre to the point.
    arm: Pair<N>,
}

impl<const N: usize> Met<N> {
    /// Returns the displacements along normal and tangent per unit of twist.
    #[inline(always)]
    pub fn rows(&self) -> [Triple<N>; 2] {
        let [ax, ay] = self.arm;
        let [n, t] = [self.normal, left_of(self.normal)];
        [[n[0], n[1], ax * n[1] - ay * n[0]], [t[0], t[1], ax * t[1] - ay * t[0]]]
    }
}

impl<const N: usize> Touching<N> {
    /// Returns the contact at the moment of `look`.
    #[inline(always)]
    pub fn at(&self, object: &Object<N>, look: &Look<N>) -> Met<N> {
        let own = plus(object.place, self.arm);
        let about = minus(own, times(self.normal, self.gap));
        let by = plus(about, times(self.given, look.share));
        let turn = Turns::by(look.share * self.given_turn);
        let given = |point: Pair<N>| plus(by, turn.of(minus(point, about)));

        let mut normal = self.normal;
        let faced = self.first | self.both | self.second;
        if faced.any() {
            let (one, other) = (look.turn.of(self.normal), turn.of(self.normal));
            normal = self.first.pick_each(one, normal);
            normal = self.second.pick_each(other, normal);
            if self.both.any() {
                let sum = plus(one, other);
                let length = norm(sum);
                normal = self.both.pick_each([sum[0] / length, sum[1] / length], normal);
            }
        }
        if self.between.any() {
            let [p, q] = self.points;
            let between = minus(look.moved(object, p), given(q));
            let (before, now) = (norm(minus(p, q)), norm(between));
            let nearer = before.below(now).pick(before, now);
            let ahead = (Lanes::all(0.5) * now).below(dot(between, self.normal));
            let usable = self.between & Lanes::all(NEAR).below(nearer) & ahead;
            normal = usable.pick_each([between[0] / now, between[1] / now], normal);
        }

        // A contact on a face follows the other body's point. A disc rolls beneath its own point.
        let mut point = object.round.pick_each(object.place, own);
        point = look.moved(object, point);
        let rim = plus(point, times([-normal[0], -normal[1]], object.radius));
        point = object.round.pick_each(rim, point);
        if self.first.any() {
            let centre = minus(about, times(self.normal, self.radius));
            let other = given(self.round.pick_each(centre, about));
            let rim = plus(other, times(normal, self.radius));
            point = self.first.pick_each(self.round.pick_each(rim, other), point);
        }
        Met { normal, arm: minus(point, look.centre) }
    }

    /// Returns the displacement of the object along normal and tangent without overlap and without
    /// sliding. Friction acts only after the gap has closed, so earlier sliding is not held back.
    #[inline(always)]
    pub fn target(&self, object: &Object<N>, moves: &Moves<N>, met: &Met<N>) -> Pair<N> {
        let (normal, tangent) = (met.normal, left_of(met.normal));
        let closed = dot(self.given, normal);
        let held = dot(self.given, tangent);
        let coast = shift(object.coast, self.arm);
        let own = shift(moves.twist, met.arm);
        // Larger of the overlaps after free coasting and after the present motion.
        let closing =
            dot(minus(self.given, coast), normal).max(dot(minus(self.given, own), normal));
        let one = Lanes::all(1.0);
        let before = self.gap.below(closing).pick(self.gap / closing, one);
        let slid = held + before * dot(minus(coast, self.given), tangent);
        [closed - self.gap, self.gap.within(Lanes::ZERO).pick(held, slid)]
    }
}

/// Returns the displacement of a point `arm` metres from the centre, to first order, metres.
#[inline(always)]
fn shift<const N: usize>([x, y, turn]: Triple<N>, arm: Pair<N>) -> Pair<N> {
    plus([x, y], times(left_of(arm), turn))
}
