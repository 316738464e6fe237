//! Two set-ups in which nothing but masses changes from one trajectory to the next and the hand's strokes
//! have every cylinder pushed by another one, as in section 8.3 of the thesis. It shows its own in a
//! picture without sizes; these follow its words: a cylinder that is pushed against another one goes on
//! pushing it if it is the heavier of the two, and else slips off to either side.

use pushplan::internals::geometry::Vector;
use pushplan::internals::scene::{Object, Scene, Span};
use serde::{Deserialize, Serialize};

use super::constraints::TEST_SPEED;

/// How cylinders stand, three by three: nine in all, as in the thesis, and a stroke for every three.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Controlled {
    /// One behind the other, every second one somewhat aside.
    Rows,
    /// One before the gap between two.
    Wedges,
}

/// Radius and height of all cylinders, metres.
const SOLID: [f64; 2] = [0.05, 0.10];

/// Friction value of everything but the table, whose value is a scene's usual one: what the planner takes
/// where a task says nothing.
pub(super) const FRICTION: Span = Span::new(0.4, 0.4);

/// Distance between one three and the next, metres: they never meet.
const APART: f64 = 1.0;

/// Where the three stand, metres, the stroke along the first axis; gaps are a millimetre.
const ROW: [[f64; 2]; 3] = [[0.0, 0.0], [0.099, 0.02], [0.198, 0.0]];
const WEDGE: [[f64; 2]; 3] = [[0.0, 0.0], [0.087, 0.051], [0.087, -0.051]];

/// Where the hand begins, metres, and how far it goes: the row is met a little aside, so that it does
/// not matter how exactly; the wedge in the middle.
const FROM: [[f64; 2]; 2] = [[-0.12, -0.004], [-0.12, 0.0]];
const TRAVEL: f64 = 0.5;

impl Controlled {
    /// The scene; its masses are still to be drawn.
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

    /// From where to where the hand goes, a stroke for every three, and how fast, m/s.
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
