//! The random choices of a case.

use rand::{Rng, RngCore, SeedableRng};
use rand_pcg::Pcg64;

use crate::targets::Target;

pub struct Random(Pcg64);

impl Random {
    /// Returns the choices of case `index` under `seed`.
    pub fn new(target: Target, seed: u64, index: u64) -> Self {
        let mut mixed = Pcg64::seed_from_u64(seed ^ (target as u64) << 56);
        let other = mixed.next_u64();
        Self(Pcg64::seed_from_u64(other.wrapping_add(index.wrapping_mul(0x9E37_79B9_7F4A_7C15))))
    }

    /// Returns a number below `bound`, which must not be zero.
    pub fn below(&mut self, bound: usize) -> usize {
        self.0.random_range(0..bound)
    }

    /// Returns `true` once in `times`.
    pub fn once_in(&mut self, times: usize) -> bool {
        self.below(times) == 0
    }

    pub fn pick<'a, T>(&mut self, list: &'a [T]) -> &'a T {
        &list[self.below(list.len())]
    }

    pub fn byte(&mut self) -> u8 {
        self.0.random()
    }
}
