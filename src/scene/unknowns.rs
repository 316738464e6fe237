//! What a task does not know about its scene, and what that may be.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::Span;

/// What is unknown of the objects of a scene. What the scene states about it is only the middle of
/// what it may be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Unknowns {
    /// Which of the objects that stand near each other (gap below [`JOINABLE`](super::JOINABLE))
    /// are joined, how and where.
    pub joints: bool,
    /// Masses of all objects: see [`Self::MASS_FACTOR`].
    pub masses: bool,
    /// Friction values of all objects and of the table: see [`Self::FRICTION_FACTOR`].
    pub frictions: bool,
    /// What all objects rest on: see [`Self::SPREADS`].
    pub support: bool,
}

impl Unknowns {
    /// Everything is known.
    pub const NONE: Self = Self { joints: false, masses: false, frictions: false, support: false };

    /// Nothing but shapes and places is known.
    pub const ALL: Self = Self { joints: true, masses: true, frictions: true, support: true };

    /// An unknown mass is the stated one times or over at most this, nine times in ten; its
    /// logarithm is normal.
    pub const MASS_FACTOR: f64 = 2.0;

    /// The same for friction values.
    pub const FRICTION_FACTOR: f64 = 1.5;

    /// What an object rests on where that is unknown, as shares of its corners' distance: evenly
    /// in here. Even pressure is like 0.5 to 0.7, the corners are 1.
    pub const SPREADS: Span = Span::new(0.5, 1.0);

    /// Each with its word in files.
    pub fn words(self) -> [(&'static str, bool); 4] {
        [
            ("joints", self.joints),
            ("masses", self.masses),
            ("frictions", self.frictions),
            ("support", self.support),
        ]
    }

    /// The same with one more unknown, by its word; `None` for an unknown word.
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

    /// Whether anything is unknown.
    pub fn any(self) -> bool {
        self != Self::NONE
    }

    /// Whether a number is unknown: a mass, a friction value or a support.
    pub fn numbers(self) -> bool {
        self.masses || self.frictions || self.support
    }
}

/// The words of what is unknown, as in a sentence.
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
