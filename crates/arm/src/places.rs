//! Feasible tool poses of an arm over the table: a cheap test that precedes all others.
//!
//! The planner measures reach from the origin of the world. The annulus of an arm that stands
//! elsewhere is therefore also checked here.

use std::f64::consts::TAU;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use pushplan::geometry::Vector;
use pushplan::scene::Annulus;

/// Largest plausible reach of an arm over a table, metres.
const FARTHEST: f64 = 10.0;

/// Smallest plausible step of distances, metres.
const FINEST: f64 = 1e-3;

/// Feasible tool poses, by distance from the base and by rotation of the tool relative to the
/// radial direction. The default stands for unknown poses.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Places {
    /// Smallest and largest distance from the base that is feasible for some rotation, metres.
    pub ring: [f64; 2],
    /// Step between distances, metres.
    pub step: f64,
    /// Number of evenly spaced rotations per distance.
    pub turns: usize,
    /// Feasibility for each distance from zero on, and for each rotation; empty if it depends on
    /// more. Files store it as a text of 0 and 1.
    #[serde(with = "bits")]
    pub free: Vec<bool>,
    /// Centre of the annulus in the world, metres: the vertical axis of the arm, or its base.
    #[serde(default = "Vector::zeros", skip_serializing_if = "is_origin")]
    pub centre: Vector,
}

fn is_origin(centre: &Vector) -> bool {
    *centre == Vector::zeros()
}

impl Places {
    /// Returns `true` if the poses were computed and are valid.
    pub fn known(&self) -> bool {
        let [near, far] = self.ring;
        let sound = near >= 0.0 && near < far && far <= FARTHEST;
        let counted = self.turns > 0 && self.free.len().is_multiple_of(self.turns);
        sound && (self.free.is_empty() || self.step >= FINEST && counted)
    }

    /// Returns the annulus that contains all feasible positions.
    pub fn annulus(&self) -> Annulus {
        Annulus { centre: self.centre, radii: self.ring }
    }

    /// Returns `true` if a tool may be held at a position with the end effector rotated by `yaw`
    /// radians. The result is `false` only if no sampled pose around it is feasible.
    pub fn allow(&self, position: Vector, yaw: f64) -> bool {
        let position = position - self.centre;
        if self.free.is_empty() {
            let [near, far] = self.ring;
            let slack = self.step;
            return self.centre == Vector::zeros()
                || (near - slack..=far + slack).contains(&position.norm());
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

/// Serialization of booleans as a text of 1 and 0.
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
        let places = Places { ring: [0.2, 0.3], step: 0.1, turns: 8, free, ..Places::default() };
        let text = serde_json::to_string(&places).expect("JSON");
        assert!(places.known() && text.contains("00010000"), "{text}");
        assert_eq!(serde_json::from_str::<Places>(&text).expect("places"), places);
        assert!(serde_json::from_str::<Places>(&text.replace("0001", "0002")).is_err());
        let at = |x: f64, yaw: f64| places.allow(Vector::new(x, 0.0), yaw);
        assert!(at(0.2, 0.0) && at(0.15, 0.1) && at(0.25, -0.1));
        assert!(!at(0.05, 0.0) && !at(0.35, 0.0) && !at(0.2, 1.6) && !at(9.0, 0.0));
        // Only the rotation relative to the radial direction counts.
        assert!(places.allow(Vector::new(0.0, 0.2), TAU / 4.0));
        assert!(Places::default().allow(Vector::new(9.0, 0.0), 0.0));
        // The annulus of an arm that stands elsewhere.
        let centre = Vector::new(0.0, -0.5);
        let moved = Places { centre, ..places };
        assert!(
            moved.allow(Vector::new(0.2, -0.5), 0.0) && !moved.allow(Vector::new(0.2, 0.0), 0.0)
        );
        let [near, far] = moved.annulus().distances();
        assert!((near - 0.2).abs() < 1e-12 && (far - 0.8).abs() < 1e-12);
    }
}
