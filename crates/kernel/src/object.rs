//! The resistance of an object without joints, several frames side by side.

use crate::{
    Vector,
    drag::Drag,
    feet::Feet,
    lanes::{Lanes, Pair, Triple, Turns, Which, minus, norm, plus, times},
    settings::{FOLLOWING, LEAST, Quantity, SAME},
    stats::SolverStats,
};

/// The object of each frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Object<'a, const N: usize> {
    pub feet: [Option<&'a Feet>; N],
    /// Centre, metres, and unit vector along the object's own x axis.
    pub place: Pair<N>,
    pub axis: Pair<N>,
    pub mass: Lanes<N>,
    /// Largest friction of the table, N, and largest distance by which the load leans, metres.
    pub load: Lanes<N>,
    pub lean: Lanes<N>,
    /// Radius of a disc, and the frames whose object is a disc.
    pub radius: Lanes<N>,
    pub round: Which<N>,
    /// Mean distance c of the support's points from the centre, metres, and (c / rho)^2: see
    /// [`crate::SingleBodyFrame`].
    pub support: Lanes<N>,
    pub spin: Lanes<N>,
    /// Shift, metres, and rotation of the object if it coasts.
    pub coast: Triple<N>,
    /// Velocity as the frame begins, m/s and rad/s.
    pub velocity: Triple<N>,
    /// Duration of the frame, seconds.
    pub duration: Lanes<N>,
    /// Distance that the object is first assumed to move, metres.
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
    /// Returns the mass, kg, and the moment of inertia, kg m^2.
    #[inline(always)]
    fn inertia(&self) -> (Lanes<N>, Lanes<N>) {
        (self.mass, self.mass * self.support * self.support / self.spin)
    }
}

/// Motion and resistance of the object.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Moves<const N: usize> {
    /// Shift, metres, and rotation.
    pub twist: Triple<N>,
    /// Force and torque of all contacts.
    pub pressed: Triple<N>,
    /// Motion without contacts.
    pub free: Triple<N>,
    pub inverse: Inverse<N>,
    /// Momentum as the frame begins, kg m/s and kg m^2/s, and m v^2, J.
    momentum: Triple<N>,
    square: Lanes<N>,
    /// Force of the contacts as a share of the largest friction.
    pressing: Pair<N>,
    /// Number of updates so far, the motion that weights were last computed for, and the frames in
    /// which this motion is known.
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

/// Moments of the resistance about the centre: N/m, N, N m.
#[derive(Clone, Copy)]
struct Rub<const N: usize> {
    sum: Lanes<N>,
    first: Pair<N>,
    second: Lanes<N>,
}

impl<const N: usize> Rub<N> {
    /// Computes the moments for the motion `moved` of `object` in the frames `wanted`. The own x
    /// axis points along `axis`, and the load is displaced by `lean`.
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
        // Adding zero removes minus zeros.
        let first = [load * x + Lanes::ZERO, load * y + Lanes::ZERO];
        Self { sum: load * sum, first, second: load * second }
    }

    /// Computes the inverse of the resistance, in closed form.
    #[inline(always)]
    fn inverse(&self) -> Inverse<N> {
        let Self { sum: s, first: [x, y], second: t } = *self;
        let y = -(Lanes::ZERO - y);
        let (p, q) = (-x / s, y / s);
        let one = Lanes::all(1.0);
        // Rotation about the point that a pure torque leaves in place.
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
    /// Returns the state at rest, before any contact force.
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
                // A lone object has no parts, so its load is centred.
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

    /// Invalidates the weights because another quantity is solved next.
    #[inline(always)]
    pub fn turn_to_another(&mut self) {
        self.known = Which::NONE;
    }

    /// Updates resistance and free motion for the present motion in the frames `of`, where the
    /// object has rotated by `turn`.
    #[inline(always)]
    pub fn weigh(
        &mut self,
        object: &Object<N>,
        quantity: Quantity,
        turn: &Turns<N>,
        of: Which<N>,
        tally: &mut SolverStats,
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

    /// Computes resistance and free motion from the moments `rub`. For displacements, the object
    /// moves by the root of `square`, lengths being weighted by its inertia.
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

    /// Returns the duration of the motion within the frame, seconds.
    #[inline(always)]
    fn moving(&self, square: Lanes<N>, duration: Lanes<N>) -> Lanes<N> {
        let way = Lanes::all(2.0) * (square / self.square).sqrt();
        let way = way.max(Lanes::all(LEAST) * duration);
        let rests = way.below(duration) & !self.square.equals(Lanes::ZERO);
        rests.pick(way, duration)
    }

    /// Computes the motion from the contact forces.
    #[inline(always)]
    pub fn settle(&mut self) {
        self.twist = plus(self.free, self.inverse.by(self.pressed));
    }

    /// Copies the state of `other` in the frames `of`.
    #[inline(always)]
    pub fn take(&mut self, of: Which<N>, other: &Self) {
        self.twist = of.pick_each(other.twist, self.twist);
        self.pressed = of.pick_each(other.pressed, self.pressed);
        self.pressing = of.pick_each(other.pressing, self.pressing);
        self.inverse.0 = of.pick_each(other.inverse.0, self.inverse.0);
        self.updates = of.pick(other.updates, self.updates);
    }
}
