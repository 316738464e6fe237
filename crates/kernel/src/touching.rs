//! Contacts of an object with bodies whose motion is given, part-way through a frame, for several frames
//! side by side.

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
    /// A face of both: they lie flush, end to end.
    Both,
    /// The line between two points that belong to the bodies: centres of discs, or corners.
    /// World frame, metres.
    Between(Vector, Vector),
    /// Nothing: two corners, whose line may point anywhere a moment later.
    Nothing,
}

/// A contact of each frame, where the frame has that many. World axes, metres, as the frame begins.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Touching<const N: usize> {
    /// Which frames have it.
    pub present: Which<N>,
    /// Unit, into the object.
    pub normal: Pair<N>,
    pub gap: Lanes<N>,
    pub friction: Lanes<N>,
    /// From the object's centre to the point on it.
    pub arm: Pair<N>,
    /// Displacement of the point on the other body, and its turn, radians.
    pub given: Pair<N>,
    pub given_turn: Lanes<N>,
    /// The radius of the other body, and which are discs.
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

/// How far an object has come part-way through a frame.
#[derive(Clone, Copy)]
pub(crate) struct Look<const N: usize> {
    share: Lanes<N>,
    shift: Pair<N>,
    /// How far it has turned.
    pub turn: Turns<N>,
    /// Where its centre is then.
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

    /// Where a point of the object has come to.
    #[inline(always)]
    fn moved(&self, object: &Object<N>, point: Pair<N>) -> Pair<N> {
        plus(plus(object.place, self.shift), self.turn.of(minus(point, object.place)))
    }
}

/// A contact at some moment of a frame.
#[derive(Clone, Copy)]
pub(crate) struct Met<const N: usize> {
    pub normal: Pair<N>,
    /// From the object's centre to the point.
    arm: Pair<N>,
}

impl<const N: usize> Met<N> {
    /// The displacements along normal and tangent by a twist.
    #[inline(always)]
    pub fn rows(&self) -> [Triple<N>; 2] {
        let [ax, ay] = self.arm;
        let [n, t] = [self.normal, left_of(self.normal)];
        [[n[0], n[1], ax * n[1] - ay * n[0]], [t[0], t[1], ax * t[1] - ay * t[0]]]
    }
}

impl<const N: usize> Touching<N> {
    /// Where it has come to.
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

        // A face is met wherever the other's point has come to. A disc rolls beneath its own.
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

    /// What the object must be displaced by along normal and tangent, so as not to overlap and not to
    /// slide. Friction acts only after the gap has closed: the sliding before is not held back.
    #[inline(always)]
    pub fn target(&self, object: &Object<N>, moves: &Moves<N>, met: &Met<N>) -> Pair<N> {
        let (normal, tangent) = (met.normal, left_of(met.normal));
        let closed = dot(self.given, normal);
        let held = dot(self.given, tangent);
        let coast = shift(object.coast, self.arm);
        let own = shift(moves.twist, met.arm);
        // How far the two would have come into each other had either only coasted.
        let closing =
            dot(minus(self.given, coast), normal).max(dot(minus(self.given, own), normal));
        let one = Lanes::all(1.0);
        let before = self.gap.below(closing).pick(self.gap / closing, one);
        let slid = held + before * dot(minus(coast, self.given), tangent);
        [closed - self.gap, self.gap.within(Lanes::ZERO).pick(held, slid)]
    }
}

/// Displacement of a point `arm` metres from the centre, to first order, metres.
#[inline(always)]
fn shift<const N: usize>([x, y, turn]: Triple<N>, arm: Pair<N>) -> Pair<N> {
    plus([x, y], times(left_of(arm), turn))
}
