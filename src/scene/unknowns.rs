//! Unknown properties of a scene, and their distributions.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::Span;

/// The unknown properties of the objects of a scene. The values in the scene are then only the
/// centres of their distributions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Unknowns {
    /// Whether the joints between neighbouring objects (gap below [`JOINABLE`](super::JOINABLE))
    /// are unknown: their existence, type and place.
    pub joints: bool,
    /// Whether the masses of all objects are unknown, see [`Self::MASS_FACTOR`].
    pub masses: bool,
    /// Whether the friction values of all objects and of the table are unknown, see
    /// [`Self::FRICTION_FACTOR`].
    pub frictions: bool,
    /// Whether the supports of all objects are unknown, see [`Self::SPREADS`].
    pub support: bool,
}

impl Unknowns {
    /// Everything is known.
    pub const NONE: Self = Self { joints: false, masses: false, frictions: false, support: false };

    /// Only shapes and poses are known.
    pub const ALL: Self = Self { joints: true, masses: true, frictions: true, support: true };

    /// Factor up or down within which an unknown mass is with 90 % probability; its logarithm is
    /// normal.
    pub const MASS_FACTOR: f64 = 2.0;

    /// Factor up or down within which an unknown friction value is with 90 % probability; its
    /// logarithm is normal.
    pub const FRICTION_FACTOR: f64 = 1.5;

    /// Range of unknown supports, as shares of the corners' distance; the distribution is uniform.
    /// Even pressure is like 0.5 to 0.7, the corners are 1.
    pub const SPREADS: Span = Span::new(0.5, 1.0);

    /// Returns each property with its word in files.
    pub fn words(self) -> [(&'static str, bool); 4] {
        [
            ("joints", self.joints),
            ("masses", self.masses),
            ("frictions", self.frictions),
            ("support", self.support),
        ]
    }

    /// Adds an unknown property by its word; `None` if there is no such word.
    pub fn with(mut self, word: &str) -> Option<Self> {
        *match word {
            "joints" => &mut self.joints,
            "masses" => &mut self.masses,
            "frictions" => &mut self.frictions,
            "support" => &mut self.support,
            _ => return None,
        } = true;
        Some(self)
    }

    /// Returns `true` if anything is unknown.
    pub fn any(self) -> bool {
        self != Self::NONE
    }

    /// Returns `true` if a number is unknown: a mass, a friction value or a support.
    pub fn numbers(self) -> bool {
        self.masses || self.frictions || self.support
    }
}

/// Prints the words of the unknown properties as a list in a sentence.
impl fmt::Display for Unknowns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words: Vec<&str> =
            self.words().iter().filter(|(_, unknown)| *unknown).map(|(word, _)| *word).collect();
        match words[..] {
            [] => f.write_str("nothing"),
            [ref before @ .., last] if !before.is_empty() => {
                write!(f, "{} and {last}", before.join(", "))
            }
            [last, ..] => f.write_str(last),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_unknowns_are_the_same_thing() {
        let all = Unknowns::ALL
            .words()
            .iter()
            .try_fold(Unknowns::NONE, |so_far, (word, _)| so_far.with(word));
        assert_eq!(all, Some(Unknowns::ALL));
        assert_eq!(Unknowns::NONE.with("shape"), None);
        assert_eq!(Unknowns::ALL.to_string(), "joints, masses, frictions and support");
        assert_eq!(Unknowns { masses: true, ..Unknowns::NONE }.to_string(), "masses");
    }
}
