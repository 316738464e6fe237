//! The robot: the reach of its end effector, its hand and its base.

use serde::{Deserialize, Serialize};

use crate::geometry::Vector;

use super::Hand;

/// Where the end effector can be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Robot {
    /// End-effector position from which chained pushes start, metres; reach is measured from
    /// the world's origin, the robot's base.
    pub home: Vector,
    /// Smallest distance of the end effector from the base, metres.
    pub reach_min: f64,
    /// Largest distance of the end effector from the base, metres.
    pub reach_max: f64,
    /// Largest force that the arm can press with for longer than an impact, newtons; any by
    /// default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_force: Option<f64>,
    /// The hand that holds the tool; `None` for one without a body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hand: Option<Hand>,
    /// Half the side of the square column on which the arm stands, at the origin, metres; 0 for one
    /// without a body.
    #[serde(default)]
    pub base: f64,
    /// Height above the table at which a lifted tool travels between pushes, that of its underside,
    /// metres.
    #[serde(default = "usual_travel", skip_serializing_if = "is_usual_travel")]
    pub travel: f64,
}

fn usual_travel() -> f64 {
    Robot::TRAVEL
}

fn is_usual_travel(travel: &f64) -> bool {
    *travel == Robot::TRAVEL
}

impl Robot {
    /// Usual height at which tools travel, metres: above what is pushed, and what arms over a table
    /// reach.
    pub const TRAVEL: f64 = 0.3;

    /// A robot whose end effector reaches from `min` to `max` metres from the world's origin, with
    /// its home `min` metres in front of it, a usual hand and a [usual column](Robot::usual_base).
    pub fn reaching(min: f64, max: f64) -> Self {
        Self {
            home: Vector::new(min, 0.0),
            reach_min: min,
            reach_max: max,
            max_force: None,
            hand: Some(Hand::default()),
            base: Self::usual_base(min),
            travel: Self::TRAVEL,
        }
    }

    /// The same as a point that holds a tool: neither hand nor column.
    pub fn without_body(self) -> Self {
        Self { hand: None, base: 0.0, ..self }
    }

    /// Whether the end effector can stand at `position` (metres).
    pub fn reaches(&self, position: Vector) -> bool {
        (self.reach_min..=self.reach_max).contains(&position.norm())
    }
}
