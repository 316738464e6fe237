//! The search: every candidate with room is predicted, and ranked with its neighbours.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::{
    outcome::{Ending, LeverFault, Outcome, Trajectory, Warning},
    scene::{Situation, Tool},
    task::{Goal, Job, LeverMotion, Motion, Task},
};

use super::{LeverCandidate, LeverGrid, LeverRoom};

/// Jobs that are predicted together, in parallel; between batches the search can be stopped.
const BATCH: usize = 256;

/// How far apart lever points are along the outline, metres: less where that leaves fewer than so
/// many lever-ups that can be made, as in a notch that is little wider than the blade.
const APART: [f64; 3] = [0.010, 0.005, 0.0025];
const ENOUGH: usize = 300;

/// Tilts at the end of the turn between which plates fall either way, degrees. Measured on
/// thousands of plates: below 75 two of a hundred turn over, above 85 all but two.
const UNDECIDED_DEG: [f64; 2] = [70.0, 90.0];

/// What it costs a candidate to end in the middle of them, to slip, and to have no neighbour that
/// reaches the goal, in units of the score.
const UNDECIDED: f64 = 1.0;
const SLIPPED: f64 = 0.5;
const ALONE: f64 = 1.0;

/// What it costs to end against something, where the goal leaves that open: a little push would
/// change it.
const LEANING: f64 = 0.3;

/// A candidate with what is predicted of it.
#[derive(Clone, Debug, PartialEq)]
pub struct ScoredLever {
    /// The candidate.
    pub candidate: LeverCandidate,
    /// What comes of it.
    pub outcome: Outcome,
    /// By what it is ranked, the smaller the better.
    pub merit: f64,
    /// Share of its neighbours on the grid that reach the goal.
    pub company: f64,
}

/// What a search looked at.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LeverSearchStatistics {
    /// Candidates on the grid.
    pub considered: usize,
    /// How many of them cannot be made, by why.
    pub refused: BTreeMap<String, usize>,
    /// Candidates that were predicted.
    pub rollouts: usize,
    /// How many of those reach the goal by prediction.
    pub promising: usize,
}

/// A search for lever-ups of one task.
pub struct LeverSearch<'a> {
    /// The task.
    pub task: &'a Task,
    /// Its scene as it is believed.
    pub situation: &'a Situation,
    /// The tools with blades.
    pub tools: &'a [Arc<Tool>],
}

impl LeverSearch<'_> {
    /// The candidates that can be made, with lever points so far `apart`, metres.
    fn feasible(&self, apart: f64) -> (LeverSearchStatistics, Vec<LeverCandidate>) {
        let mut statistics = LeverSearchStatistics::default();
        let mut candidates = Vec::new();
        for (tool, own) in self.tools.iter().enumerate() {
            let all = LeverGrid { task: self.task, tool, apart }.candidates();
            statistics.considered += all.len();
            let room = LeverRoom::new(self.task, own);
            let faults: Vec<Option<LeverFault>> =
                all.par_iter().map(|candidate| room.fault(&candidate.lever)).collect();
            for (candidate, fault) in all.into_iter().zip(faults) {
                match fault {
                    Some(fault) => *statistics.refused.entry(fault.to_string()).or_default() += 1,
                    None => candidates.push(candidate),
                }
            }
        }
        (statistics, candidates)
    }

    /// What a candidate does.
    pub fn job(&self, candidate: &LeverCandidate) -> Job {
        let tool = Arc::clone(&self.tools[candidate.tool]);
        let motion = Motion::Lever(LeverMotion::new(tool, candidate.lever, None));
        Job::new(self.situation, motion)
    }

    /// All candidates that can be made, the best first; `predict` tells what comes of jobs, and
    /// `cancelled` whether to make do with those that were predicted by now.
    pub fn run(
        &self,
        predict: &dyn Fn(&[Job]) -> Vec<Trajectory>,
        cancelled: &dyn Fn() -> bool,
    ) -> (Vec<ScoredLever>, LeverSearchStatistics) {
        let mut statistics = LeverSearchStatistics::default();
        let mut candidates: Vec<LeverCandidate> = Vec::new();
        for apart in APART {
            (statistics, candidates) = self.feasible(apart);
            if candidates.len() >= ENOUGH {
                break;
            }
        }
        let mut outcomes: Vec<(Outcome, f64)> = Vec::with_capacity(candidates.len());
        for batch in candidates.chunks(BATCH) {
            if cancelled() {
                break;
            }
            let jobs: Vec<Job> = batch.iter().map(|candidate| self.job(candidate)).collect();
            let (scene, goal) = (&self.task.scene, self.task.levered());
            outcomes.extend(predict(&jobs).into_iter().map(|trajectory| {
                let outcome = Outcome::judge(scene, self.task, &trajectory);
                let merit = merit(goal, &outcome, &trajectory);
                (outcome, merit)
            }));
        }
        candidates.truncate(outcomes.len());
        statistics.rollouts = candidates.len();
        statistics.promising = outcomes.iter().filter(|(outcome, _)| outcome.reached).count();
        let company = company(&candidates, &outcomes);
        let scored = candidates.into_iter().zip(outcomes).zip(company);
        let mut scored: Vec<ScoredLever> = scored
            .map(|((candidate, (outcome, merit)), company)| {
                let merit = merit + ALONE * (1.0 - company);
                ScoredLever { candidate, outcome, merit, company }
            })
            .collect();
        // Stable, so that the order of the grid decides between equals.
        scored.sort_by(|a, b| a.merit.total_cmp(&b.merit));
        (scored, statistics)
    }
}

/// By what a lever-up is ranked, its neighbours aside: the score, more where the plate slips, leans,
/// jams or is left undecided.
pub fn merit(goal: &Goal, outcome: &Outcome, trajectory: &Trajectory) -> f64 {
    let tilt = trajectory.lifts.last().map_or(0.0, |lift| lift.tilt.to_degrees());
    let (score, ending) = (outcome.score(), outcome.side(goal.object));
    let [low, high] = UNDECIDED_DEG;
    let middle = 1.0 - (2.0 * tilt - low - high).abs() / (high - low);
    let matters = goal.demands.iter().any(|demand| demand.kind().is_at_rest());
    let undecided = if matters { UNDECIDED * middle.max(0.0) } else { 0.0 };
    let slips = |warning: &Warning| matches!(warning, Warning::Slipped { .. });
    let slipped = if trajectory.warnings.iter().any(slips) { SLIPPED } else { 0.0 };
    let leaning = if ending == Ending::Leaning { LEANING } else { 0.0 };
    let wrong = if outcome.reached || score > 1.0 { 0.0 } else { 2.0 };
    // Among those that are well within the goal the others decide.
    score.clamp(0.5, 1e6) + undecided + slipped + leaning + wrong
}

/// Of each candidate the share of its neighbours (one step along the outline, in depth or in turn)
/// that reach the goal by prediction; those that cannot be made or are beyond the ranges count as
/// half.
fn company(candidates: &[LeverCandidate], outcomes: &[(Outcome, f64)]) -> Vec<f64> {
    let cells: HashMap<(usize, [usize; 4]), usize> =
        candidates.iter().enumerate().map(|(k, c)| ((c.tool, c.cell), k)).collect();
    let of = |candidate: &LeverCandidate| {
        let mut sum = 0.0;
        for axis in [0, 1, 3] {
            for step in [usize::MAX, 1] {
                let mut cell = candidate.cell;
                cell[axis] = cell[axis].wrapping_add(step);
                let neighbour = cells.get(&(candidate.tool, cell));
                sum += neighbour.map_or(0.5, |&k| f64::from(u8::from(outcomes[k].0.reached)));
            }
        }
        sum / 6.0
    };
    candidates.iter().map(of).collect()
}
