//! The cost of objects that no push can touch: none, if a model computes only the relevant
//! part of the scene.

use pushplan::internals::effect::EffectModel;
use pushplan::internals::{
    outcome::Record,
    scene::{Object, Scene},
};
use serde::{Deserialize, Serialize};

use super::suite::Suite;
use super::timing::{batches, push_seconds};

/// Numbers of far objects.
pub const FAR_COUNTS: [usize; 7] = [0, 1, 3, 10, 30, 60, 100];

/// Distance of the nearest far object from everything else, metres, beyond the reach of any push.
const FAR: f64 = 5.0;

/// Distance of far objects from each other, metres; they do not touch.
const APART: f64 = 0.15;

/// Number of columns of far objects.
const COLUMNS: usize = 10;

/// Number of rounds. The fastest counts, because other work on the machine can only lengthen a
/// round.
const ROUNDS: usize = 5;

/// Minimum processor time of a round, seconds; the kernel may count in ticks of 4 ms.
const ROUND: f64 = 0.06;

/// Cost of a push with a number of far objects on the table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FarCost {
    /// Name of the model.
    pub model: String,
    /// Number of objects that no push can touch.
    pub far: usize,
    /// Number of jobs per rollout call.
    pub batch: usize,
    /// Processor time of a push, seconds.
    pub seconds: f64,
    /// Largest distance between final positions of an object near the tool with and without the far
    /// objects, metres.
    pub difference: f64,
}

/// Times the pushes of `suite` by every model on one thread, with increasing numbers of far
/// objects. Each model is paired with its number of jobs per call.
///
/// # Errors
/// Returns an error if the thread cannot be started.
pub fn far_costs(
    models: &[(&dyn EffectModel, usize)],
    suite: &Suite,
    counts: &[usize],
) -> Result<Vec<FarCost>, rayon::ThreadPoolBuildError> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    Ok(pool.install(|| {
        let crowded: Vec<(usize, Suite)> =
            counts.iter().map(|&far| (far, with_far(suite, far))).collect();
        // Model by model, because a model that runs right after another finds its memory warm.
        let mut costs = Vec::new();
        for &(model, batch) in models {
            for (far, crowded) in &crowded {
                costs.push(FarCost {
                    model: model.spec().to_string(),
                    far: *far,
                    batch,
                    seconds: seconds(model, crowded, batch),
                    difference: difference(model, suite, crowded),
                });
            }
        }
        costs
    }))
}

/// Returns the suite with `far` additional objects in every scene.
fn with_far(suite: &Suite, far: usize) -> Suite {
    let mut suite = suite.clone();
    for case in &mut suite.cases {
        add_far(&mut case.scene, far);
    }
    suite
}

fn add_far(scene: &mut Scene, far: usize) {
    for k in 0..far {
        let (row, column) = (k / COLUMNS, k % COLUMNS);
        let (x, y) = (FAR + APART * row as f64, APART * column as f64);
        scene.objects.push(Object::cylinder(format!("far-{k}"), 0.05, 0.1).at(x, y, 0.0));
    }
}

/// Returns the processor time of a push, seconds.
fn seconds(model: &dyn EffectModel, suite: &Suite, batch: usize) -> f64 {
    let round = |_| push_seconds(model, &suite.cases, batch, ROUND);
    (0..ROUNDS).map(round).fold(f64::INFINITY, f64::min)
}

/// Returns the largest distance between final positions with and without the far objects, metres.
fn difference(model: &dyn EffectModel, alone: &Suite, crowded: &Suite) -> f64 {
    let ends = |suite: &Suite| {
        let ends = batches(&suite.cases, 1).into_iter().map(|(scene, jobs)| {
            model.rollout(scene, &jobs, Record::Outcome).remove(0).outcome().clone()
        });
        ends.collect::<Vec<_>>()
    };
    let apart = ends(alone).into_iter().zip(ends(crowded)).flat_map(|(a, b)| {
        let pairs: Vec<f64> =
            a.poses.iter().zip(&b.poses).map(|(p, q)| (p.position - q.position).norm()).collect();
        pairs
    });
    apart.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::SuiteKind;
    use pushplan::internals::asset::ToolLibrary;
    use pushplan::internals::effect::EffectModels;
    use pushplan::internals::scene::ModelKind;

    #[test]
    fn far_objects_change_no_bit() {
        let library = ToolLibrary::embedded().expect("the shipped tools");
        let suite = Suite::draw(SuiteKind::Touching, &library, 3, 4);
        let model = EffectModels::build(&ModelKind::NETWORK.into()).expect("the shipped weights");
        for far in [1, 100] {
            let crowded = with_far(&suite, far);
            let counts: Vec<usize> = crowded.cases.iter().map(|c| c.scene.objects.len()).collect();
            assert!(counts.iter().all(|count| *count > far));
            assert_eq!(difference(&model, &suite, &crowded), 0.0);
        }
    }
}
