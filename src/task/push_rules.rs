//! The pushes that a plan may contain.

use serde::{Deserialize, Serialize};

/// How pushes start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PushForm {
    /// Each push starts where it is best: the tool comes down from above, pushes and lifts.
    Placed,
    /// All start from `home`, each goes on where the last ended, without lifting or waiting.
    Chained,
}

/// Which push directions are tried, world frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Directions {
    /// +x, -x, +y, -y.
    Principal,
    /// This many equal directions, from +x on.
    Count(usize),
    /// These headings, radians.
    List(Vec<f64>),
}

impl Directions {
    /// The headings, radians.
    pub fn headings(&self) -> Vec<f64> {
        use std::f64::consts::{FRAC_PI_2, PI, TAU};
        match self {
            Directions::Principal => vec![0.0, PI, FRAC_PI_2, -FRAC_PI_2],
            Directions::Count(n) => (0..*n).map(|k| TAU * k as f64 / *n as f64).collect(),
            Directions::List(list) => list.clone(),
        }
    }
}

/// Coarse lateral offsets that the search tries.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Offsets {
    /// As many as the effort asks for, over the contacting face.
    Effort,
    /// These, metres.
    List(Vec<f64>),
}

/// The pushes that a plan may contain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PushRules {
    /// How pushes start.
    pub form: PushForm,
    /// Which way they go.
    pub directions: Directions,
    /// Coarse lateral offsets (placed pushes only).
    pub offsets: Offsets,
    /// Turns of the end effector about z against world +x, radians.
    pub grip_yaws: Vec<f64>,
    /// Travel of a push, metres; refinement may shorten or lengthen a placed push by half.
    pub length: f64,
    /// Speed, m/s.
    pub speed: f64,
    /// Largest number of pushes in a row; none are allowed where it is 0.
    pub max_count: usize,
    /// Largest number of changes to another tool in a plan; any where it is `None`.
    pub tool_changes: Option<usize>,
    /// Height of the tool's underside above the table, metres.
    pub lift: f64,
}

impl PushRules {
    /// Default travel of a push, metres: that of the reference benchmark.
    pub const LENGTH: f64 = 0.20;
    /// Default speed of a push, m/s: that of the reference benchmark.
    pub const SPEED: f64 = 0.10;
    /// Default of the most pushes in a row: around a corner. Fewer are tried first.
    pub const MAX_COUNT: usize = 3;
    /// Default height of the tool above the table, metres: clear of it, yet below every object.
    pub const LIFT: f64 = 0.002;

    /// No push at all.
    pub fn none() -> Self {
        Self { max_count: 0, ..Self::default() }
    }
}

/// Placed pushes in principal directions, with the grip yaws of the reference benchmark.
impl Default for PushRules {
    fn default() -> Self {
        Self {
            form: PushForm::Placed,
            directions: Directions::Principal,
            offsets: Offsets::Effort,
            grip_yaws: [0.0, 90.0, -90.0].map(f64::to_radians).to_vec(),
            length: Self::LENGTH,
            speed: Self::SPEED,
            max_count: Self::MAX_COUNT,
            tool_changes: None,
            lift: Self::LIFT,
        }
    }
}
