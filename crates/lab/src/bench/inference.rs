//! Cost of the network alone: fused network and candle graph on the same batches, against the
//! matrix-product rate of the machine in the same run.

use std::time::Duration;

use pushplan::internals::contact::{Bodies, FrameProblem, FrameSolver};
use pushplan::internals::graph::{Batch, Corrections};
use pushplan::internals::network::{Buffers, Forward, PredictorWeights, matrix_product};
use pushplan::internals::sim::Simulator;
use pushplan::internals::{outcome::Record, task::Job};
use pushplan_learn::network::{Inputs, Predictor};
use serde::{Deserialize, Serialize};

use super::cpu_clock::processor_time;
use super::suite::Case;

/// Number of rounds. The fastest counts, because other work on the machine can only lengthen a
/// round.
const ROUNDS: usize = 7;

/// Minimum processor time of a round; the kernel may count in ticks of 4 ms.
const ROUND: Duration = Duration::from_millis(100);

/// Sides of the square products, the faster of which is the machine's peak: large enough to hide
/// their packing, small enough for the second-level cache. A single size may hit memory that the
/// cache does not hold: 80 instead of 130 GFLOP/s in some processes at 512.
const PEAK_SIDES: [usize; 2] = [256, 384];

/// Processor time of the network on a batch of graphs, one thread.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct InferenceCost {
    /// Number of graphs in the batch: candidate-steps.
    pub graphs: usize,
    /// Number of movable nodes in the batch.
    pub nodes: usize,
    /// Number of relations in the batch.
    pub relations: usize,
    /// Time of the fused network, seconds per graph.
    pub fused: f64,
    /// Time of the candle graph, seconds per graph; `None` in a build without the feature `train`.
    pub candle: Option<f64>,
    /// Time of graph building (contacts, analytic model, features), seconds per graph.
    pub graph: f64,
    /// Share of the peak that the fused network's matrix products would reach if they took all of
    /// its time, 0 to 1.
    pub of_peak: f64,
    /// Matrix-product rate of one thread in the same run, floating-point operations per second.
    pub peak: f64,
}

/// Times batches of `sizes` graphs, taken from frames of the cases' first strokes in which the tool
/// is near an object.
pub fn inference_costs(
    weights: &PredictorWeights,
    cases: &[Case],
    sizes: &[usize],
) -> Vec<InferenceCost> {
    let forward = Forward::new(weights);
    let peak = peak();
    sizes
        .iter()
        .map(|&size| {
            let mut batch = Batch::default();
            let building = fill(&mut batch, cases, size);
            let mut buffers = Buffers::default();
            let mut corrections = Corrections::default();
            let fused = best(|| forward.run(&batch, &mut buffers, &mut corrections));
            let work = forward.operations(&batch);
            InferenceCost {
                graphs: size,
                nodes: batch.node_count(),
                relations: batch.relation_count(),
                fused: fused / size as f64,
                candle: candle(weights, &batch).map(|seconds| seconds / size as f64),
                graph: building / size as f64,
                of_peak: work as f64 / fused / peak,
                peak,
            }
        })
        .collect()
}

/// Returns the time of a forward pass of the candle graph over `batch`, seconds.
fn candle(weights: &PredictorWeights, batch: &Batch) -> Option<f64> {
    // candle refuses no graph with parameters that were read from a weights file.
    let network = Predictor::new(weights.card.config, &weights.parameters).ok()?;
    let inputs = Inputs::new(batch, &weights.card.normaliser).ok()?;
    network.forward(&inputs).ok()?;
    Some(best(|| {
        let _ = std::hint::black_box(network.forward(&inputs));
    }))
}

/// Fills `batch` with `size` graphs and returns the processor time of building them.
fn fill(batch: &mut Batch, cases: &[Case], size: usize) -> f64 {
    let simulator = Simulator::planar();
    let mut found = Vec::new();
    let mut solver = FrameSolver::default();
    for case in cases {
        let job = Job::stated(&case.scene, case.motion.clone());
        let bodies = Bodies::new(&case.scene, &case.motion.tool, case.motion.lift, &job.physics);
        let truth = simulator.run(&case.scene, &job, Record::Frames);
        let Some(stroke) = case.motion.strokes.first() else { continue };
        let axis = (stroke.to.position - stroke.from.position).normalize();
        for index in 0..stroke.frames().min(truth.frames.len()) {
            let (state, step) = (truth.frames[index].state.clone(), stroke.frame(index));
            let problem = FrameProblem { bodies: &bodies, state: &state, step: &step, axis };
            if !solver.solve(problem).motions.is_empty() {
                found.push((bodies.clone(), state, step, axis));
            }
        }
    }
    if found.is_empty() {
        return 0.0;
    }
    best(|| {
        batch.clear();
        for (k, (bodies, state, step, axis)) in found.iter().cycle().take(size).enumerate() {
            let problem = FrameProblem { bodies, state, step, axis: *axis };
            let (frame, forces) = solver.solve_with_forces(problem);
            batch.add(k as u32, &frame, &forces);
        }
    })
}

/// Returns the matrix-product rate of a thread, floating-point operations per second.
pub(super) fn peak() -> f64 {
    let rates = PEAK_SIDES.map(|n| {
        let (a, b) = (vec![0.5; n * n], vec![0.25; n * n]);
        let mut c = vec![0.0; n * n];
        let seconds = best(|| matrix_product(&a, &b, n, n, n, &mut c));
        2.0 * (n as f64).powi(3) / seconds
    });
    rates.into_iter().fold(0.0, f64::max)
}

/// Returns the shortest processor time of a call, seconds.
fn best(mut work: impl FnMut()) -> f64 {
    // Bounded in case the clock stands still.
    let mut calls = 1u32;
    let mut time = |calls: u32| processor_time(|| (0..calls).for_each(|_| work()));
    while time(calls) < ROUND && calls < 1 << 20 {
        calls *= 2;
    }
    let rounds = (0..ROUNDS).map(|_| time(calls).as_secs_f64() / f64::from(calls));
    rounds.fold(f64::INFINITY, f64::min).max(f64::MIN_POSITIVE)
}
