//! Convergence of simulated lever-ups with the time step, and their sensitivity to the start of the
//! plate.

use std::f64::consts::TAU;

use super::super::cpu_clock::timed;
use pushplan::internals::seeded::generator;
use pushplan::internals::sim::LeverSimulator;
use pushplan::internals::{
    outcome::{Ending, LeverTrajectory, LeverWarning},
    scene::LeverScene,
    task::LeverJob,
};
use pushplan_act::judge::Summary;
use pushplan_learn::dataset::{LEVERS_PER_SHAPE, LeverConfig, LeverPreset, lever_job};
use rand::Rng;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Displacement of plates at the start, which gives the attainable accuracy of a ground truth,
/// metres.
const ASIDE: f64 = 1e-4;

/// Rates that are compared with the ground truth, steps per second.
const RATES: [u16; 4] = [60, 120, 240, 960];

/// A setting of the simulator and its reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Setting {
    /// A number of steps per second against [`LeverSimulator::TRUTH`].
    Steps(u16),
    /// The start displaced by 0.1 mm against the original start, both by [`LeverSimulator::FINE`].
    Aside,
}

/// Differences over all lever-ups of a family.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ConvergenceRow {
    /// Setting of the comparison.
    pub setting: Setting,
    /// Root mean square distance of the plate's frame over the frames of the rotation, metres.
    pub lift: Option<Summary>,
    /// Distance of the plate's frame at the end of the rotation, metres.
    pub last: Option<Summary>,
    /// Distance of the plate's frame at rest, metres.
    pub rest: Option<Summary>,
    /// Number of lever-ups of which only one of both slips.
    pub slips: usize,
    /// Number of lever-ups with different endings.
    pub endings: usize,
    /// Processor time of a lever-up, seconds.
    pub time: Option<Summary>,
}

/// Convergence over a family of lever-ups.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ConvergenceReport {
    /// Family of the lever-ups.
    pub preset: LeverPreset,
    /// Seed of the lever-ups.
    pub seed: u64,
    /// Number of lever-ups.
    pub cases: usize,
    /// Mean displacement of the plate's frame at the end of the rotation, metres.
    pub motion: f64,
    /// Number of lever-ups that slip, in the ground truth like all counts below.
    pub slipped: usize,
    /// Number of plates that end upside down.
    pub flipped: usize,
    /// Number of plates that end leaning.
    pub leaning: usize,
    /// Number of lever-ups with a jam.
    pub jammed: usize,
    /// Rows in the order of settings.
    pub rows: Vec<ConvergenceRow>,
}

/// A lever-up in every setting.
struct Case {
    start: LeverJob,
    truth: LeverTrajectory,
    runs: Vec<(LeverTrajectory, LeverTrajectory, f64)>,
}

/// Compares `cases` lever-ups of a family, each of another shape, in parallel on the current rayon
/// pool. Apart from times, the result has the same bits for any number of threads.
pub fn convergence(preset: LeverPreset, seed: u64, cases: usize) -> ConvergenceReport {
    let config = LeverConfig { seed, episodes: cases as u64, preset };
    // Disc and board have a single shape, so their cases are neighbouring places.
    let one_shape = matches!(preset, LeverPreset::Disc | LeverPreset::Board);
    let apart = if one_shape { 1 } else { LEVERS_PER_SHAPE };
    let measure = |index: u64| measure(lever_job(&config, index * apart), seed, index);
    let done: Vec<Case> = (0..cases as u64).into_par_iter().map(measure).collect();
    let count =
        |is: &dyn Fn(&LeverTrajectory) -> bool| done.iter().filter(|case| is(&case.truth)).count();
    let moved = |case: &Case| {
        let plate = case.start.lever.plate;
        let start = case.start.scene.plates[plate].start().position;
        case.truth.lift.last().map_or(0.0, |last| (last.position - start).norm())
    };
    let settings = RATES.map(Setting::Steps).into_iter().chain([Setting::Aside]);
    let row = |(k, setting)| row(setting, done.iter().map(|case| &case.runs[k]));
    ConvergenceReport {
        preset,
        seed,
        cases,
        motion: done.iter().map(moved).sum::<f64>() / cases.max(1) as f64,
        slipped: count(&LeverTrajectory::slipped),
        flipped: count(&|truth| truth.ending == Ending::Flipped),
        leaning: count(&|truth| truth.ending == Ending::Leaning),
        jammed: count(&|truth| truth.warnings.contains(&LeverWarning::Jammed)),
        rows: settings.enumerate().map(row).collect(),
    }
}

fn measure(job: LeverJob, seed: u64, index: u64) -> Case {
    let truth = LeverSimulator::TRUTH.run(&job);
    let mut runs = Vec::with_capacity(RATES.len() + 1);
    for rate in RATES {
        let (run, time) = timed(|| LeverSimulator::per_second(rate).run(&job));
        runs.push((run, truth.clone(), time.as_secs_f64()));
    }
    let fine = LeverSimulator::FINE;
    let beside = beside(&job, generator(seed, index).random::<f64>() * TAU);
    let (run, time) = timed(|| fine.run_as_planned(&beside, &job.scene));
    runs.push((run, fine.run(&job), time.as_secs_f64()));
    Case { start: job, truth, runs }
}

/// Returns the job with the plate displaced by [`ASIDE`] in this direction, radians.
fn beside(job: &LeverJob, direction: f64) -> LeverJob {
    let mut scene = LeverScene::clone(&job.scene);
    let at = &mut scene.plates[job.lever.plate].pose.position;
    at.x += ASIDE * direction.cos();
    at.y += ASIDE * direction.sin();
    LeverJob { scene: scene.into(), lever: job.lever }
}

fn row<'a>(
    setting: Setting,
    runs: impl Iterator<Item = &'a (LeverTrajectory, LeverTrajectory, f64)>,
) -> ConvergenceRow {
    let runs: Vec<_> = runs.collect();
    let over = |error: &dyn Fn(&LeverTrajectory, &LeverTrajectory) -> f64| {
        Summary::of(&runs.iter().map(|(run, other, _)| error(run, other)).collect::<Vec<f64>>())
    };
    let differ = |differ: &dyn Fn(&LeverTrajectory, &LeverTrajectory) -> bool| {
        runs.iter().filter(|(run, other, _)| differ(run, other)).count()
    };
    let squares = |a: &LeverTrajectory, b: &LeverTrajectory| {
        let pairs = a.lift.iter().zip(&b.lift);
        pairs.map(|(a, b)| (a.position - b.position).norm_squared()).collect::<Vec<f64>>()
    };
    let lift = |a: &LeverTrajectory, b: &LeverTrajectory| {
        let squares = squares(a, b);
        (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
    };
    ConvergenceRow {
        setting,
        lift: over(&lift),
        last: over(&|a, b| squares(a, b).last().copied().unwrap_or(0.0).sqrt()),
        rest: over(&|a, b| (a.rest.position - b.rest.position).norm()),
        slips: differ(&|a, b| a.slipped() != b.slipped()),
        endings: differ(&|a, b| a.ending != b.ending),
        time: Summary::of(&runs.iter().map(|(_, _, time)| *time).collect::<Vec<f64>>()),
    }
}
