//! Small errors of the world against the task as written: what a camera and a data sheet miss by.

use std::fmt;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::geometry::Vector;
use crate::scene::{Hypothesis, Scene, State, Tool};

/// Largest shift of an object at the start along each axis, metres.
const SHIFT: f64 = 1e-3;

/// Largest turn of an object at the start, radians (one degree).
const TURN: f64 = std::f64::consts::PI / 180.0;

/// Largest relative change of every friction value.
const FRICTION: f64 = 0.1;

/// One draw of disturbances, uniform within their ranges; the same for the same seed and draw.
pub(super) struct Disturbance {
    draw: usize,
    /// Where the objects start instead.
    pub start: State,
    /// The parameters instead.
    pub hypothesis: Hypothesis,
}

impl Disturbance {
    pub fn draw(scene: &Scene, tool: &Tool, seed: u64, draw: usize) -> Self {
        let mut random = Pcg64::new(u128::from(seed), draw as u128);
        // A fresh stream's first numbers resemble those of its neighbours.
        let mut random = Pcg64::seed_from_u64(random.random());
        let mut start = scene.start();
        for (k, pose) in start.poses.iter_mut().enumerate() {
            let mut within = |range: f64| random.random_range(-range..=range);
            let (x, y, turn) = (within(SHIFT), within(SHIFT), within(TURN));
            // Moving one side of a joint alone would break it.
            if !scene.joints.iter().any(|joint| joint.between.contains(&k)) {
                pose.position += Vector::new(x, y);
                pose.heading += turn;
            }
        }
        let mut hypothesis = Hypothesis::nominal(scene, tool);
        let values = hypothesis
            .frictions
            .iter_mut()
            .chain([&mut hypothesis.table_friction, &mut hypothesis.tool_friction]);
        for friction in values {
            *friction *= 1.0 + random.random_range(-FRICTION..=FRICTION);
        }
        Self { draw, start, hypothesis }
    }
}

impl fmt::Display for Disturbance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "start +-{:.0} mm +-{:.0} deg, friction +-{:.0} %, draw {}",
            SHIFT * 1e3,
            TURN.to_degrees(),
            FRICTION * 1e2,
            self.draw + 1
        )
    }
}
