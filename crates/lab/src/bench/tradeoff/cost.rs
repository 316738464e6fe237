//! Cost of a push with every predictor; a round measures each once.

use pushplan::internals::asset::ToolLibrary;
use pushplan_bench::store::Seconds;
use pushplan_learn::dataset::JointRule;

use crate::bench::inference::peak;
use crate::bench::suite::{Case, jointed_crowd_cases};
use crate::bench::timing::push_seconds;
use crate::bench::{Suite, SuiteKind};

use super::levels::Level;

/// Numbers of objects on the table for which pushes are timed.
pub(super) const OBJECTS: [usize; 3] = [1, 3, 9];

/// Number of pushes predicted together, as in a search.
pub(super) const BATCH: usize = 64;

/// Minimum processor time per measurement, seconds.
const ENOUGH: f64 = 0.05;

/// Key of the time that 1e9 floating-point operations of matrix products take.
pub(super) const YARDSTICK: &str = "1e9 operations";

/// Timed pushes: with one object, with three that touch, and in crowds of nine without joints.
pub(super) struct Timed {
    cases: [Vec<Case>; OBJECTS.len()],
}

impl Timed {
    /// Draws `count` pushes with one object, and a quarter of that number with more.
    pub fn draw(library: &ToolLibrary, seed: u64, count: usize) -> Self {
        let few = count.div_ceil(4);
        // Touching cases have two objects in one pass over the tools, and three in the next.
        let touching = Suite::draw(SuiteKind::Touching, library, seed, 2 * library.len() + few);
        let three = touching.cases.into_iter().filter(|case| case.scene.objects.len() == 3);
        Self {
            cases: [
                Suite::draw(SuiteKind::Single, library, seed, count).cases,
                three.take(few).collect(),
                jointed_crowd_cases(9, JointRule::None, seed, few),
            ],
        }
    }

    /// Runs a round: measures every predictor once, on this thread.
    pub fn round(&self, levels: &[Level]) -> Seconds {
        let mut seconds = Seconds::new();
        seconds.insert(YARDSTICK.to_owned(), 1e9 / peak());
        for (cases, objects) in self.cases.iter().zip(OBJECTS) {
            for level in levels.iter().filter(|level| objects == 1 || level.is_plain()) {
                let model = level.model();
                let batch = if level.batches() { BATCH } else { 1 };
                let spent = push_seconds(&model, cases, batch, ENOUGH);
                seconds.insert(key(objects, level.name()), spent);
                if objects == 1 && level.batches() {
                    let alone = push_seconds(&model, cases, 1, ENOUGH);
                    seconds.insert(alone_key(level.name()), alone);
                }
            }
        }
        seconds
    }
}

/// Returns the key of the time per push of `model` in a round.
pub(super) fn key(objects: usize, model: &str) -> String {
    format!("{model}, {objects} on the table")
}

/// Returns the key of the time of a push that is predicted alone.
pub(super) fn alone_key(model: &str) -> String {
    format!("{model}, alone")
}
