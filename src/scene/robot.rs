//! The robot: the reach of its end effector, its hand and its base.

use serde::{Deserialize, Serialize};

use crate::geometry::Vector;

use super::Hand;

/// The workspace and the body of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Robot {
    /// End-effector position from which chained pushes start, metres. Reach is measured from the
    /// world's origin, the robot's base.
    pub home: Vector,
    /// Smallest distance of the end effector from the base, metres.
    pub reach_min: f64,
    /// Largest distance of the end effector from the base, metres.
    pub reach_max: f64,
    /// Maximum force of the arm for longer than an impact, newtons; `None` for no limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_force: Option<f64>,
    /// The hand that holds the tool; `None` for a robot without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hand: Option<Hand>,
    /// Half the side of the square column on which the arm stands, at the origin, metres; 0 for a
    /// robot without one.
    #[serde(default)]
    pub base: f64,
    /// Height of a lifted tool's underside above the table between pushes, metres.
    #[serde(default = "usual_travel", skip_serializing_if = "is_usual_travel")]
    pub travel: f64,
}

/// Annulus of positions within reach of an end effector, seen from above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Annulus {
    /// Centre in the world, metres.
    pub centre: Vector,
    /// Inner and outer radius, metres.
    pub radii: [f64; 2],
}

impl Annulus {
    /// Returns the smallest and the largest distance from the world's origin, metres.
    pub fn distances(&self) -> [f64; 2] {
        let ([near, far], away) = (self.radii, self.centre.norm());
        [(near - away).max(away - far).max(0.0), far + away]
    }
}

fn usual_travel() -> f64 {
    Robot::TRAVEL
}

fn is_usual_travel(travel: &f64) -> bool {
    *travel == Robot::TRAVEL
}

impl Robot {
    /// Default height of lifted tools, metres: above the pushed objects, and within reach of arms
    /// over a table.
    pub const TRAVEL: f64 = 0.3;

    /// Creates a robot whose end effector reaches from `min` to `max` metres from the world's
    /// origin. Its home is `min` metres in front of the origin, and it has a default hand and a
    /// [default column](Robot::usual_base).
    pub fn reaching(min: f64, max: f64) -> Self {
        Self {
            home: Vector::new(min, 0.0),
            reach_min: min,
            reach_max: max,
            max_force: None,
            hand: Some(Hand::default()),
            base: Self::usual_base(Some(min)),
            travel: Self::TRAVEL,
        }
    }

    /// Removes hand and column; the robot is then a point that holds a tool.
    pub fn without_body(self) -> Self {
        Self { hand: None, base: 0.0, ..self }
    }

    /// Returns `true` if the end effector can be at `position` (metres).
    pub fn reaches(&self, position: Vector) -> bool {
        (self.reach_min..=self.reach_max).contains(&position.norm())
    }
}
