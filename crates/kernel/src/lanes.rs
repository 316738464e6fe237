//! Numbers of several frames side by side.
//!
//! The compiler turns the plain loops over arrays into the processor's vectors. Every lane goes
//! through the operations of a single number in the same order, none of them fused, so that no bit
//! depends on the number of lanes. Everything is inlined into the one function that is compiled for
//! wide vectors, because functions called from there are not.

use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// A number of each frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes<const N: usize>(pub [f64; N]);

/// A subset of the frames, as masks: all bits are set for its members, none for others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Which<const N: usize>(pub [u64; N]);

/// A planar vector of each frame.
pub(crate) type Pair<const N: usize> = [Lanes<N>; 2];

/// Shift and rotation, or force and torque, of each frame.
pub(crate) type Triple<const N: usize> = [Lanes<N>; 3];

macro_rules! operations {
    ($($of:ident, $call:ident, $sign:tt;)*) => {$(
        impl<const N: usize> $of for Lanes<N> {
            type Output = Self;

            #[inline(always)]
            fn $call(mut self, other: Self) -> Self {
                for k in 0..N {
                    self.0[k] $sign other.0[k];
                }
                self
            }
        }
    )*};
}

operations! {
    Add, add, +=;
    Sub, sub, -=;
    Mul, mul, *=;
    Div, div, /=;
}

impl<const N: usize> AddAssign for Lanes<N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const N: usize> Neg for Lanes<N> {
    type Output = Self;

    #[inline(always)]
    fn neg(mut self) -> Self {
        for k in 0..N {
            self.0[k] = -self.0[k];
        }
        self
    }
}

impl<const N: usize> Lanes<N> {
    pub const ZERO: Self = Self::all(0.0);

    /// Returns the number in every frame.
    #[inline(always)]
    pub const fn all(value: f64) -> Self {
        Self([value; N])
    }

    /// Returns the larger number, or `other` where this one is not a number.
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        other.below(self).pick(self, other)
    }

    #[inline(always)]
    pub fn abs(mut self) -> Self {
        for k in 0..N {
            self.0[k] = self.0[k].abs();
        }
        self
    }

    #[inline(always)]
    pub fn sqrt(mut self) -> Self {
        for k in 0..N {
            self.0[k] = self.0[k].sqrt();
        }
        self
    }

    /// Returns one with the sign of the number.
    #[inline(always)]
    pub fn sign(mut self) -> Self {
        for k in 0..N {
            self.0[k] = 1f64.copysign(self.0[k]);
        }
        self
    }

    /// Returns the frames in which the number is less than the other.
    #[inline(always)]
    pub fn below(self, other: Self) -> Which<N> {
        let mut which = Which::NONE;
        for k in 0..N {
            which.0[k] = if self.0[k] < other.0[k] { !0 } else { 0 };
        }
        which
    }

    /// Returns the frames in which the number is at most the other.
    #[inline(always)]
    pub fn within(self, other: Self) -> Which<N> {
        let mut which = Which::NONE;
        for k in 0..N {
            which.0[k] = if self.0[k] <= other.0[k] { !0 } else { 0 };
        }
        which
    }

    /// Returns the frames in which both are equal.
    #[inline(always)]
    pub fn equals(self, other: Self) -> Which<N> {
        let mut which = Which::NONE;
        for k in 0..N {
            which.0[k] = if self.0[k] == other.0[k] { !0 } else { 0 };
        }
        which
    }
}

impl<const N: usize> Default for Lanes<N> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<const N: usize> Which<N> {
    pub const NONE: Self = Self([0; N]);
    pub const ALL: Self = Self([!0; N]);

    pub fn set(&mut self, frame: usize, is: bool) {
        self.0[frame] = if is { !0 } else { 0 };
    }

    #[inline(always)]
    pub fn has(&self, frame: usize) -> bool {
        self.0[frame] != 0
    }

    /// Returns the number of frames in the subset.
    #[inline(always)]
    pub fn count(&self) -> u64 {
        let mut count = 0;
        for k in 0..N {
            count += self.0[k] & 1;
        }
        count
    }

    #[inline(always)]
    pub fn any(&self) -> bool {
        let mut bits = 0;
        for k in 0..N {
            bits |= self.0[k];
        }
        bits != 0
    }

    /// Returns `one` in these frames and `other` elsewhere.
    #[inline(always)]
    pub fn pick(self, one: Lanes<N>, other: Lanes<N>) -> Lanes<N> {
        let mut picked = Lanes::ZERO;
        for k in 0..N {
            picked.0[k] = if self.0[k] != 0 { one.0[k] } else { other.0[k] };
        }
        picked
    }

    /// Returns [`Self::pick`] for several numbers each.
    #[inline(always)]
    pub fn pick_each<const K: usize>(
        self,
        one: [Lanes<N>; K],
        mut other: [Lanes<N>; K],
    ) -> [Lanes<N>; K] {
        for k in 0..K {
            other[k] = self.pick(one[k], other[k]);
        }
        other
    }

    /// Returns the members of `one` in these frames and of `other` elsewhere.
    #[inline(always)]
    pub fn either(self, one: Self, other: Self) -> Self {
        (self & one) | (!self & other)
    }
}

impl<const N: usize> Default for Which<N> {
    fn default() -> Self {
        Self::NONE
    }
}

impl<const N: usize> BitAnd for Which<N> {
    type Output = Self;

    #[inline(always)]
    fn bitand(mut self, other: Self) -> Self {
        for k in 0..N {
            self.0[k] &= other.0[k];
        }
        self
    }
}

impl<const N: usize> BitOr for Which<N> {
    type Output = Self;

    #[inline(always)]
    fn bitor(mut self, other: Self) -> Self {
        for k in 0..N {
            self.0[k] |= other.0[k];
        }
        self
    }
}

impl<const N: usize> Not for Which<N> {
    type Output = Self;

    #[inline(always)]
    fn not(mut self) -> Self {
        for k in 0..N {
            self.0[k] = !self.0[k];
        }
        self
    }
}

#[inline(always)]
pub(crate) fn plus<const K: usize, const N: usize>(
    mut a: [Lanes<N>; K],
    b: [Lanes<N>; K],
) -> [Lanes<N>; K] {
    for k in 0..K {
        a[k] += b[k];
    }
    a
}

#[inline(always)]
pub(crate) fn minus<const K: usize, const N: usize>(
    mut a: [Lanes<N>; K],
    b: [Lanes<N>; K],
) -> [Lanes<N>; K] {
    for k in 0..K {
        a[k] = a[k] - b[k];
    }
    a
}

/// Returns a vector times a number.
#[inline(always)]
pub(crate) fn times<const K: usize, const N: usize>(
    mut a: [Lanes<N>; K],
    by: Lanes<N>,
) -> [Lanes<N>; K] {
    for value in &mut a {
        *value = *value * by;
    }
    a
}

#[inline(always)]
pub(crate) fn dot<const K: usize, const N: usize>(a: [Lanes<N>; K], b: [Lanes<N>; K]) -> Lanes<N> {
    let mut sum = a[0] * b[0];
    for k in 1..K {
        sum += a[k] * b[k];
    }
    sum
}

#[inline(always)]
pub(crate) fn norm<const N: usize>(a: Pair<N>) -> Lanes<N> {
    dot(a, a).sqrt()
}

/// Rotates by a quarter turn counter-clockwise.
#[inline(always)]
pub(crate) fn left_of<const N: usize>([x, y]: Pair<N>) -> Pair<N> {
    [-y, x]
}

/// A rotation of each frame, see [`crate::Turn`].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Turns<const N: usize> {
    sin: Lanes<N>,
    cos: Lanes<N>,
}

impl<const N: usize> Turns<N> {
    #[inline(always)]
    pub fn by(angle: Lanes<N>) -> Self {
        let [sin, cos] = crate::turn::sines(angle.0);
        Self { sin: Lanes(sin), cos: Lanes(cos) }
    }

    #[inline(always)]
    pub fn of(&self, [x, y]: Pair<N>) -> Pair<N> {
        [self.cos * x - self.sin * y, self.sin * x + self.cos * y]
    }
}
