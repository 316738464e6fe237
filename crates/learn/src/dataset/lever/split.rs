//! Random split over lever-ups, as in Tekden (2020); parts share shapes.

use pushplan::internals::seeded::generator;
use rand::Rng;

use super::episode::LeverEpisode;

/// Constant that separates the seeds of the split and the lever-ups.
const SPLIT: u64 = 0x5350_4c54;

/// Shares of training and validation episodes in 18 parts: 1400 and 100 of 1800 (Tekden 2020,
/// section 6.3).
const LEARNED: u32 = 14;
const CHOSEN_BY: u32 = 1;
const ALL: u32 = 18;

/// Part of a random split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeverPart {
    /// Training part.
    Learned,
    /// Validation part, for choosing the best network.
    ChosenBy,
    /// Test part.
    Asked,
}

impl LeverPart {
    /// Returns the part of an episode in the set with this seed.
    pub fn of(seed: u64, episode: &LeverEpisode) -> Self {
        match generator(seed ^ SPLIT, episode.index).random_range(0..ALL) {
            0..LEARNED => Self::Learned,
            part if part < LEARNED + CHOSEN_BY => Self::ChosenBy,
            _ => Self::Asked,
        }
    }
}
