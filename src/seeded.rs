//! Seeded random numbers: one independent generator for each item.

use rand::SeedableRng;
use rand_pcg::Pcg64;

/// Returns the generator of item `index` under `seed`. It does not depend on the number of items,
/// on their order or on the thread.
pub fn generator(seed: u64, index: u64) -> Pcg64 {
    Pcg64::seed_from_u64(mix(mix(seed).wrapping_add(index)))
}

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014, doi:10.1145/2660193.2660195):
/// adjacent indices give unrelated generators.
fn mix(value: u64) -> u64 {
    let mut z = value.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}
