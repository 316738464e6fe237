//! A random split over lever-ups, as in the thesis: shapes of one part are found in the others, too.

use pushplan::internals::seeded::generator;
use rand::Rng;

use super::episode::LeverEpisode;

/// The split is drawn under another seed than lever-ups.
const SPLIT: u64 = 0x5350_4c54;

/// Parts of 18 of the lever-ups that are learned from, and that the best network is chosen by: 1400
/// and 100 of 1800 (Tekden 2020, section 6.3).
const LEARNED: u32 = 14;
const CHOSEN_BY: u32 = 1;
const ALL: u32 = 18;

/// A part of a random split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeverPart {
    /// What is learned from.
    Learned,
    /// What the best network is chosen by.
    ChosenBy,
    /// What is asked.
    Asked,
}

impl LeverPart {
    /// Where an episode of the set with this seed belongs.
    pub fn of(seed: u64, episode: &LeverEpisode) -> Self {
        match generator(seed ^ SPLIT, episode.index).random_range(0..ALL) {
            0..LEARNED => Self::Learned,
            part if part < LEARNED + CHOSEN_BY => Self::ChosenBy,
            _ => Self::Asked,
        }
    }
}
