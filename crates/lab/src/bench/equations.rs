//! Cost of a push in the analytic model: number of equations, number of solutions, and minimum
//! number of operations.

use std::num::NonZeroU16;

use pushplan::internals::asset::ToolLibrary;
use pushplan::internals::contact::SolverStats;
use pushplan::internals::effect::{EffectModel, Prior, Simulated};
use pushplan::internals::rollout::{RollSettings, Roller};
use pushplan::internals::sim::Simulator;
use pushplan::internals::{
    outcome::Record,
    scene::{Engine, Rate},
    task::Job,
};
use pushplan_learn::dataset::JointRule;
use serde::{Deserialize, Serialize};

use super::inference::peak;
use super::suite::{Case, Suite, SuiteKind, jointed_crowd_cases};
use super::timing::push_seconds;

/// Numbers of objects on the table.
const COUNTS: [usize; 6] = [1, 2, 3, 6, 9, 12];

/// Maximum number of free objects that touch each other at the start; larger sets are scattered or
/// dense in turn.
const TOUCHING: usize = 3;

/// Number of rounds. The fastest counts, because other work on the machine can only lengthen a
/// round.
const ROUNDS: usize = 3;

/// Minimum processor time of a round, seconds.
const ROUND: f64 = 0.1;

/// Rate of the engine that the analytic model is compared with, steps per second.
const RIVAL: Rate = Rate(NonZeroU16::MIN.saturating_add(119));

/// Cost of pushes among a number of objects in the analytic model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EquationCost {
    /// Number of objects on the table.
    pub objects: usize,
    /// Whether some are joined.
    pub jointed: bool,
    /// Number of pushes.
    pub pushes: usize,
    /// Processor time of a push, seconds.
    pub seconds: f64,
    /// Processor time of a push in the 2-D engine at 1/120 s, seconds.
    pub rival: f64,
    /// Counts of the work on all pushes.
    pub tally: SolverStats,
    /// Matrix-product rate of this machine, operations per second.
    pub peak: f64,
}

/// Counts and times `count` pushes of every kind on this thread.
pub fn equation_costs(library: &ToolLibrary, seed: u64, count: usize) -> Vec<EquationCost> {
    let peak = peak();
    let rival = Simulated::new(Simulator::new(Engine::Planar, RIVAL));
    let prior = Prior::default();
    let mut costs = Vec::new();
    for jointed in [false, true] {
        for objects in COUNTS.into_iter().filter(|&objects| objects > usize::from(jointed)) {
            let cases = cases(library, (objects, jointed), seed, count);
            let timed = |model: &dyn EffectModel| {
                let rounds = (0..ROUNDS).map(|_| push_seconds(model, &cases, 1, ROUND));
                rounds.fold(f64::INFINITY, f64::min)
            };
            let mut roller = Roller::new(prior.spec().clone(), RollSettings::default());
            for case in &cases {
                let job = Job::stated(&case.scene, case.motion.clone());
                roller.roll(&case.scene, &[job], Record::Outcome, None);
            }
            costs.push(EquationCost {
                objects,
                jointed,
                pushes: cases.len(),
                seconds: timed(&prior),
                rival: timed(&rival),
                tally: roller.tally(),
                peak,
            });
        }
    }
    costs
}

fn cases(
    library: &ToolLibrary,
    (objects, jointed): (usize, bool),
    seed: u64,
    count: usize,
) -> Vec<Case> {
    match (objects, jointed) {
        (1, _) => Suite::draw(SuiteKind::Single, library, seed, count).cases,
        (2..=TOUCHING, false) => {
            // Touching cases have two objects in one pass over the tools, and three in the next.
            let enough = 2 * (library.len() + count);
            let all = Suite::draw(SuiteKind::Touching, library, seed, enough).cases.into_iter();
            all.filter(|case| case.scene.objects.len() == objects).take(count).collect()
        }
        (_, false) => jointed_crowd_cases(objects, JointRule::None, seed, count),
        (_, true) => jointed_crowd_cases(objects, JointRule::Mixed, seed, count),
    }
}
