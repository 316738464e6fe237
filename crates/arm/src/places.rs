//! Where an arm can hold a tool over the table: a cheap test that comes before all others.

use std::f64::consts::TAU;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use pushplan::geometry::Vector;

/// No arm over a table reaches farther, metres.
const FARTHEST: f64 = 10.0;

/// Nobody tries distances that are nearer to each other, metres.
const FINEST: f64 = 1e-3;

/// By distance from the base and by how the tool is turned against the way there. No arm has any until
/// they are found.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Places {
    /// The least and the largest distance from the base at which it can at some turn, metres.
    pub ring: [f64; 2],
    /// Between two distances, metres.
    pub step: f64,
    /// Turns that were tried at each distance, evenly spread.
    pub turns: usize,
    /// Whether it can, for each distance from zero on and each turn; empty where that depends on more. A
    /// text of 0 and 1 in files.
    #[serde(with = "bits")]
    pub free: Vec<bool>,
}

impl Places {
    /// Whether they were found, and are sound.
    pub fn known(&self) -> bool {
        let [near, far] = self.ring;
        let sound = near >= 0.0 && near < far && far <= FARTHEST;
        let counted = self.turns > 0 && self.free.len().is_multiple_of(self.turns);
        sound && (self.free.is_empty() || self.step >= FINEST && counted)
    }

    /// Whether a tool may be held at a position, its end effector turned by `yaw` radians: no where none
    /// of what was tried around it can.
    pub fn allow(&self, position: Vector, yaw: f64) -> bool {
        if self.free.is_empty() {
            return true;
        }
        let turn = (yaw - position.y.atan2(position.x)).rem_euclid(TAU) / TAU * self.turns as f64;
        let (ring, turn) = (position.norm() / self.step, turn.floor() as usize);
        let at = |ring: usize, turn: usize| {
            self.free.get(ring * self.turns + turn % self.turns).copied().unwrap_or(false)
        };
        let ring = ring.floor() as usize;
        [ring, ring + 1].iter().any(|ring| at(*ring, turn) || at(*ring, turn + 1))
    }
}

/// Yes and no as a text of 1 and 0.
mod bits {
    use super::{Deserialize, Deserializer, Serializer};

    pub fn serialize<S: Serializer>(bits: &[bool], serializer: S) -> Result<S::Ok, S::Error> {
        let text: String = bits.iter().map(|bit| if *bit { '1' } else { '0' }).collect();
        serializer.serialize_str(&text)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<bool>, D::Error> {
        let bit = |letter| match letter {
            '0' => Ok(false),
            '1' => Ok(true),
            _ => Err(serde::de::Error::custom("expected a text of 0 and 1")),
        };
        String::deserialize(deserializer)?.chars().map(bit).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_refused_only_where_nothing_around_them_is_free() {
        let mut free = vec![false; 4 * 8];
        free[2 * 8] = true;
        let places = Places { ring: [0.2, 0.3], step: 0.1, turns: 8, free };
        let text = serde_json::to_string(&places).expect("JSON");
        assert!(places.known() && text.contains("00010000"), "{text}");
        assert_eq!(serde_json::from_str::<Places>(&text).expect("places"), places);
        assert!(serde_json::from_str::<Places>(&text.replace("0001", "0002")).is_err());
        let at = |x: f64, yaw: f64| places.allow(Vector::new(x, 0.0), yaw);
        assert!(at(0.2, 0.0) && at(0.15, 0.1) && at(0.25, -0.1));
        assert!(!at(0.05, 0.0) && !at(0.35, 0.0) && !at(0.2, 1.6) && !at(9.0, 0.0));
        // Only the turn against the way there counts.
        assert!(places.allow(Vector::new(0.0, 0.2), TAU / 4.0));
        assert!(Places::default().allow(Vector::new(9.0, 0.0), 0.0));
    }
}
