//! Controlled set-ups in which only masses vary between trajectories and every cylinder is pushed
//! by another one, as in section 8.3 of Tekden (2020).
//!
//! The source shows its set-ups in a picture without sizes; these follow its description. A
//! cylinder pushed against another one continues to push it if it is the heavier one, otherwise it
//! slips off to either side.

use pushplan::internals::geometry::Vector;
use pushplan::internals::scene::{Object, Scene, Span};
use serde::{Deserialize, Serialize};

use super::constraints::TEST_SPEED;

/// Arrangement of nine cylinders in groups of three, as in Tekden (2020); each group gets one
/// stroke.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Controlled {
    /// Row with every second cylinder shifted sideways.
    Rows,
    /// Single cylinder before the gap between two.
    Wedges,
}

/// Radius and height of all cylinders, metres.
const SOLID: [f64; 2] = [0.05, 0.10];

/// Friction value of all bodies except the table: the planner's default. The table has the usual
/// value of a scene.
pub(super) const FRICTION: Span = Span::new(0.4, 0.4);

/// Distance between adjacent groups, metres; groups never touch.
const APART: f64 = 1.0;

/// Positions within a group, metres, with the stroke along the first axis; gaps are a millimetre.
const ROW: [[f64; 2]; 3] = [[0.0, 0.0], [0.099, 0.02], [0.198, 0.0]];
const WEDGE: [[f64; 2]; 3] = [[0.0, 0.0], [0.087, 0.051], [0.087, -0.051]];

/// Start of the hand and its travel, metres.
///
/// The row is met off-centre, so that the result is insensitive to the exact position; the wedge is
/// met in the middle.
const FROM: [[f64; 2]; 2] = [[-0.12, -0.004], [-0.12, 0.0]];
const TRAVEL: f64 = 0.5;

impl Controlled {
    /// Returns the scene before its masses are drawn.
    pub(super) fn scene(self) -> Scene {
        let places = match self {
            Self::Rows => ROW,
            Self::Wedges => WEDGE,
        };
        let mut objects = Vec::new();
        for three in 0..3 {
            for [x, y] in places {
                let name = format!("object-{}", objects.len() + 1);
                let can = Object::cylinder(&name, SOLID[0], SOLID[1]);
                objects.push(Object { friction: FRICTION.low, ..can.at(x, y + aside(three), 0.0) });
            }
        }
        Scene::new(objects)
    }

    /// Returns start, displacement and speed (m/s) of the hand for the stroke of every group.
    pub(super) fn strokes(self) -> [([Vector; 2], f64); 3] {
        let [x, y] = FROM[self as usize];
        [0, 1, 2].map(|three| {
            let from = Vector::new(x, y + aside(three));
            ([from, Vector::new(TRAVEL, 0.0)], TEST_SPEED)
        })
    }
}

fn aside(three: usize) -> f64 {
    APART * three as f64
}
