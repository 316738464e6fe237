//! Families of lever-ups.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Places around the disc at which it is levered, at even angles.
pub const DISC_PLACES: usize = 100;

/// The family of lever-ups to sample.
///
/// Polygons are those of Tekden 2020, section 6.1: 3 to 10 corners on a circle of 10 cm, each count
/// equally often; levered at any place 12 mm or more from a corner.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LeverPreset {
    /// Polygons 8 mm thick, all by one motion: 15 mm under the edge, 75 degrees about an axis
    /// 16 cm in front of it.
    #[default]
    Fixed,
    /// Polygons of any thickness and friction, by motions of any depth, axis and angle.
    Varied,
    /// The disc of chapter 5, 10 cm in radius and 2 cm thick, by one motion at one of
    /// [`DISC_PLACES`]: episode `i` at place `i` modulo their number.
    Disc,
    /// One outline, about that of a drive's circuit board, by one motion at any place.
    Board,
    /// Drives built of cuboids, each another, whose board lies in a pocket: lifted out of it, or
    /// pried over its wall in one of three.
    Drive,
    /// Boxes and lying cylinders that look alike from above, by one motion.
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
