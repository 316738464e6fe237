//! The resistance of an object that nothing is joined to, several frames side by side.

use crate::{
    Vector,
    drag::Drag,
    feet::Feet,
    lanes::{Lanes, Pair, Triple, Turns, Which, minus, norm, plus, times},
    settings::{FOLLOWING, LEAST, Quantity, SAME},
    tally::Tally,
};

/// The object of each frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Object<'a, const N: usize> {
    pub feet: [Option<&'a Feet>; N],
    /// Where it is, metres, and where its own x axis points.
    pub place: Pair<N>,
    pub axis: Pair<N>,
    pub mass: Lanes<N>,
    /// Largest friction of the table, N, and how far the load leans at most, metres.
    pub load: Lanes<N>,
    pub lean: Lanes<N>,
    /// The radius of a disc, and which are discs.
    pub radius: Lanes<N>,
    pub round: Which<N>,
    /// Radius of gyration of the support over that of the mass, and its square: see [`crate::Lone`].
    pub support: Lanes<N>,
    pub spin: Lanes<N>,
    /// How it would coast: shift, metres, and turn.
    pub coast: Triple<N>,
    /// How it moves as the frame begins, m/s and rad/s.
    pub velocity: Triple<N>,
    /// Of the frame, seconds.
    pub duration: Lanes<N>,
    /// How far it is first assumed to move, metres.
    pub reach: Lanes<N>,
}

impl<const N: usize> Default for Object<'_, N> {
    fn default() -> Self {
        Self {
            feet: [None; N],
            place: Default::default(),
            axis: Default::default(),
            mass: Lanes::ZERO,
            load: Lanes::ZERO,
            lean: Lanes::ZERO,
            radius: Lanes::ZERO,
            round: Which::NONE,
            support: Lanes::ZERO,
            spin: Lanes::ZERO,
            coast: Default::default(),
            velocity: Default::default(),
            duration: Lanes::ZERO,
            reach: Lanes::ZERO,
        }
    }
}

impl<const N: usize> Object<'_, N> {
    /// Its mass, kg, and its moment of inertia, kg m^2.
    #[inline(always)]
    fn inertia(&self) -> (Lanes<N>, Lanes<N>) {
        (self.mass, self.mass * self.support * self.support / self.spin)
    }
}

/// What it does, and how it resists.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Moves<const N: usize> {
    /// Shift, metres, and turn.
    pub twist: Triple<N>,
    /// Force and torque of all contacts.
    pub pressed: Triple<N>,
    /// What it does without them.
    pub free: Triple<N>,
    pub inverse: Inverse<N>,
    /// How it moved as the frame began, kg m/s and kg m^2/s, and m v^2, J.
    momentum: Triple<N>,
    square: Lanes<N>,
    /// How hard contacts press, as a share of the largest friction.
    pressing: Pair<N>,
    /// Updates so far, and the motion that weights were last taken for, where they were.
    pub updates: Lanes<N>,
    weighed: Triple<N>,
    known: Which<N>,
}

/// Displacement per force and torque: a symmetric matrix, xx, xy, xz, yy, yz and zz.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Inverse<const N: usize>(pub [Lanes<N>; 6]);

impl<const N: usize> Inverse<N> {
    #[inline(always)]
    pub fn by(&self, [x, y, z]: Triple<N>) -> Triple<N> {
        let Self([xx, xy, xz, yy, yz, zz]) = *self;
        [xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z]
    }
}

/// The moments of what resists, about the centre: N/m, N, N m.
#[derive(Clone, Copy)]
struct Rub<const N: usize> {
    sum: Lanes<N>,
    first: Pair<N>,
    second: Lanes<N>,
}

impl<const N: usize> Rub<N> {
    /// Of `object` where it moves by `moved` in the frames that are `wanted`, its own x axis pointing
    /// along `axis` and its load having moved by `lean`.
    #[inline(always)]
    fn new(
        object: &Object<N>,
        axis: Pair<N>,
        moved: Triple<N>,
        stuck: f64,
        lean: Pair<N>,
        wanted: Which<N>,
    ) -> Self {
        let [mut sum, mut x, mut y, mut second] = [Lanes::ZERO; 4];
        for k in 0..N {
            if let Some(feet) = object.feet[k].filter(|_| wanted.has(k)) {
                let at = |pair: &Pair<N>| Vector::new(pair[0].0[k], pair[1].0[k]);
                let motion = (Vector::new(moved[0].0[k], moved[1].0[k]), moved[2].0[k]);
                let drag = feet.drag_here(at(&axis), motion, stuck, at(&lean));
                let Drag { sum: s, first, second: t } = drag;
                (sum.0[k], x.0[k], y.0[k], second.0[k]) = (s, first.x, first.y, t);
            }
        }
        let load = object.load;
        // Of zeros none is a minus zero.
        let first = [load * x + Lanes::ZERO, load * y + Lanes::ZERO];
        Self { sum: load * sum, first, second: load * second }
    }

    /// The inverse of the resistance, in closed form.
    #[inline(always)]
    fn inverse(&self) -> Inverse<N> {
        let Self { sum: s, first: [x, y], second: t } = *self;
        let y = -(Lanes::ZERO - y);
        let (p, q) = (-x / s, y / s);
        let one = Lanes::all(1.0);
        // Turning about the point that turning alone leaves in place.
        let turn = one / (t - (x * x + y * y) / s);
        Inverse([
            one / s + q * q * turn,
            q * p * turn,
            q * turn,
            one / s + p * p * turn,
            p * turn,
            turn,
        ])
    }
}

impl<const N: usize> Moves<N> {
    /// At rest, before anything presses.
    #[inline(always)]
    pub fn begin(object: &Object<N>) -> Self {
        let mut moves = Self::default();
        let (mass, inertia) = object.inertia();
        let [x, y, spin] = object.velocity;
        let turning = inertia * spin;
        moves.momentum = plus([mass * x, mass * y, turning], [Lanes::ZERO; 3]);
        moves.square = mass * (x * x + y * y) + turning * spin;
        moves.updates = Lanes::all(1.0);
        let moved = object.reach.max(Lanes::all(Quantity::Displacement.stuck()));
        let (mut sum, mut second) = (Lanes::ZERO, Lanes::ZERO);
        for k in 0..N {
            if let Some(feet) = object.feet[k] {
                // A lone object has no parts, so its load is about its middle.
                let drag = feet.even_drag(Vector::x(), moved.0[k]);
                (sum.0[k], second.0[k]) = (drag.sum, drag.second);
            }
        }
        let first = [Lanes::ZERO; 2];
        let rub = Rub { sum: object.load * sum, first, second: object.load * second };
        let square = mass * object.reach * object.reach;
        moves.answer(object, rub, Quantity::Displacement, square);
        moves.twist = moves.free;
        moves
    }

    /// Another quantity is wanted now.
    #[inline(always)]
    pub fn turn_to_another(&mut self) {
        self.known = Which::NONE;
    }

    /// Takes resistance and free motion as it moves now, in the frames `of` interest, where it has
    /// made that `turn`.
    #[inline(always)]
    pub fn weigh(
        &mut self,
        object: &Object<N>,
        quantity: Quantity,
        turn: &Turns<N>,
        of: Which<N>,
        tally: &mut Tally,
    ) {
        let before = self.pressing;
        let pressed = [self.pressed[0], self.pressed[1]];
        let most = norm(pressed).max(object.load).max(Lanes::all(f64::MIN_POSITIVE));
        let follows = self.updates.below(Lanes::all(FOLLOWING as f64));
        let share = [pressed[0] / most, pressed[1] / most];
        self.pressing = follows.pick_each(share, before);
        self.updates += Lanes::all(1.0);
        let same = Lanes::all(SAME);
        let mut near = self.known;
        for change in minus(self.twist, self.weighed) {
            near = near & change.abs().below(same);
        }
        for change in minus(self.pressing, before) {
            near = near & change.abs().below(same);
        }
        let stale = of & !near;
        if !stale.any() {
            return;
        }
        for k in 0..N {
            if let Some(feet) = object.feet[k].filter(|_| stale.has(k)) {
                tally.weigh(feet.count);
            }
        }
        self.weighed = near.pick_each(self.weighed, self.twist);
        self.known = Which::ALL;
        let lean = [object.lean * self.pressing[0], object.lean * self.pressing[1]];
        let axis = turn.of(object.axis);
        let rub = Rub::new(object, axis, self.twist, quantity.stuck(), lean, stale);
        let (kept, free) = (self.inverse.0, self.free);
        let (mass, inertia) = object.inertia();
        let [x, y, z] = self.twist;
        self.answer(object, rub, quantity, mass * (x * x + y * y) + inertia * z * z);
        self.inverse.0 = near.pick_each(kept, self.inverse.0);
        self.free = near.pick_each(free, self.free);
    }

    /// Takes resistance and free motion from what rubs. If the displacement is wanted and the object
    /// comes as far as the root of `square`, lengths being weighted by its inertia.
    #[inline(always)]
    fn answer(
        &mut self,
        object: &Object<N>,
        mut rub: Rub<N>,
        quantity: Quantity,
        square: Lanes<N>,
    ) {
        let (one, two) = (Lanes::all(1.0), Lanes::all(2.0));
        let (stiff, pull) = match quantity {
            Quantity::Displacement => {
                let moving = self.moving(square, object.duration);
                (two / (moving * moving), times(self.momentum, two / moving))
            }
            Quantity::Velocity => {
                let duration = object.duration;
                let [x, y, z] = self.momentum;
                (one / (duration * duration), [x / duration, y / duration, z / duration])
            }
        };
        let (mass, inertia) = object.inertia();
        rub.sum += stiff * mass;
        rub.second += stiff * inertia;
        self.inverse = rub.inverse();
        self.free = self.inverse.by(pull);
    }

    /// For how many of the frame's seconds it moves.
    #[inline(always)]
    fn moving(&self, square: Lanes<N>, duration: Lanes<N>) -> Lanes<N> {
        let way = Lanes::all(2.0) * (square / self.square).sqrt();
        let way = way.max(Lanes::all(LEAST) * duration);
        let rests = way.below(duration) & !self.square.equals(Lanes::ZERO);
        rests.pick(way, duration)
    }

    /// Moves as what presses makes it.
    #[inline(always)]
    pub fn settle(&mut self) {
        self.twist = plus(self.free, self.inverse.by(self.pressed));
    }

    /// Takes the state of another in the frames `of` interest.
    #[inline(always)]
    pub fn take(&mut self, of: Which<N>, other: &Self) {
        self.twist = of.pick_each(other.twist, self.twist);
        self.pressed = of.pick_each(other.pressed, self.pressed);
        self.pressing = of.pick_each(other.pressing, self.pressing);
        self.inverse.0 = of.pick_each(other.inverse.0, self.inverse.0);
        self.updates = of.pick(other.updates, self.updates);
    }
}
