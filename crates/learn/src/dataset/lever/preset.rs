//! Families of lever-ups.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Number of places around the disc, at equal angles.
pub const DISC_PLACES: usize = 100;

/// Family of lever-ups to sample.
///
/// Polygons follow Tekden 2020, section 6.1: 3 to 10 corners on a circle of 10 cm, each number
/// equally often. They are levered at any place at least 12 mm from a corner.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeverPreset {
    /// Polygons 8 mm thick with a fixed motion: 15 mm under the edge, 75 degrees about an axis 16
    /// cm in front of it.
    #[default]
    Fixed,
    /// Polygons of random thickness and friction, with random depth, axis and angle of the motion.
    Varied,
    /// Disc of chapter 5, 10 cm in radius and 2 cm thick, with a fixed motion at one of
    /// [`DISC_PLACES`]. Episode `i` uses place `i` modulo their number.
    Disc,
    /// Outline similar to a drive's circuit board, with a fixed motion at any place.
    Board,
    /// Random drives built of cuboids, whose board lies in a pocket. It is lifted out of the
    /// pocket, or pried over the wall in a third of the episodes.
    Drive,
    /// Boxes and lying cylinders that look equal from above, with a fixed motion.
    Lying,
}

impl fmt::Display for LeverPreset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Fixed => "levers",
            Self::Varied => "levers-varied",
            Self::Disc => "disc",
            Self::Board => "pcb",
            Self::Drive => "hdd",
            Self::Lying => "lying",
        })
    }
}
