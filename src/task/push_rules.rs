//! Rules for the pushes of a plan.

use serde::{Deserialize, Serialize};

/// The way in which pushes start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PushForm {
    /// Each push starts at its best place: the tool comes down from above, pushes and lifts.
    Placed,
    /// The first push starts from `home`, and each further push starts at the end of the previous
    /// one, without lifting or waiting.
    Chained,
}

/// The push directions that are tried, world frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Directions {
    /// +x, -x, +y, -y.
    Principal,
    /// Number of equally spaced directions, the first one +x.
    Count(usize),
    /// Headings, radians.
    List(Vec<f64>),
}

impl Directions {
    /// Returns the headings, radians.
    pub fn headings(&self) -> Vec<f64> {
        use std::f64::consts::{FRAC_PI_2, PI, TAU};
        match self {
            Directions::Principal => vec![0.0, PI, FRAC_PI_2, -FRAC_PI_2],
            Directions::Count(n) => (0..*n).map(|k| TAU * k as f64 / *n as f64).collect(),
            Directions::List(list) => list.clone(),
        }
    }
}

/// The coarse lateral offsets that the search tries.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Offsets {
    /// Number given by the effort, over the contacting face.
    Effort,
    /// Offsets, metres.
    List(Vec<f64>),
}

/// The pushes that a plan may contain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PushRules {
    /// Start of the pushes.
    pub form: PushForm,
    /// Directions of the pushes.
    pub directions: Directions,
    /// Coarse lateral offsets (placed pushes only).
    pub offsets: Offsets,
    /// Rotations of the end effector about z against world +x, radians.
    pub grip_yaws: Vec<f64>,
    /// Travel of a push, metres; refinement may shorten or lengthen a placed push by half.
    pub length: f64,
    /// Speed, m/s.
    pub speed: f64,
    /// Maximum number of consecutive pushes; 0 allows none.
    pub max_count: usize,
    /// Maximum number of changes to another tool in a plan; `None` for no limit.
    pub tool_changes: Option<usize>,
    /// Height of the tool's underside above the table, metres.
    pub lift: f64,
}

impl PushRules {
    /// Default travel of a push, metres, as in the reference benchmark.
    pub const LENGTH: f64 = 0.20;
    /// Default speed of a push, m/s, as in the reference benchmark.
    pub const SPEED: f64 = 0.10;
    /// Default maximum number of consecutive pushes: enough to go around a corner. Fewer are tried
    /// first.
    pub const MAX_COUNT: usize = 3;
    /// Default height of the tool above the table, metres: free of the table, yet below every
    /// object.
    pub const LIFT: f64 = 0.002;

    /// Returns rules that allow no push.
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
