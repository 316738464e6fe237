//! Search for lever-ups: every candidate with room is predicted and ranked with its neighbours.

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

/// Number of jobs predicted together, in parallel. Between batches the search can be stopped.
const BATCH: usize = 256;

/// Distances between lever points along the outline, metres. A smaller one is used if fewer than
/// [`ENOUGH`] lever-ups are feasible, as in a notch slightly wider than the blade.
const APART: [f64; 3] = [0.010, 0.005, 0.0025];

/// Number of feasible lever-ups that suffices for a search.
const ENOUGH: usize = 300;

/// Tilts at the end of the rotation between which plates fall to either side, degrees. In thousands
/// of measurements, two in a hundred turn over below 75, and all but two above 85.
const UNDECIDED_DEG: [f64; 2] = [70.0, 90.0];

/// Penalty for a final tilt in the middle of [`UNDECIDED_DEG`], in units of the score.
const UNDECIDED: f64 = 1.0;

/// Penalty for a slip, in units of the score.
const SLIPPED: f64 = 0.5;

/// Penalty for a candidate without a neighbour that reaches the goal, in units of the score.
const ALONE: f64 = 1.0;

/// Penalty for a plate that leans against something, in units of the score, because a small push
/// would change its pose.
const LEANING: f64 = 0.3;

/// Candidate with its prediction.
#[derive(Clone, Debug, PartialEq)]
pub struct ScoredLever {
    /// The candidate.
    pub candidate: LeverCandidate,
    /// Predicted outcome.
    pub outcome: Outcome,
    /// Ranking cost, lower is better.
    pub merit: f64,
    /// Share of the neighbours on the grid that reach the goal.
    pub company: f64,
}

/// Statistics of a search.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LeverSearchStatistics {
    /// Number of candidates on the grid.
    pub considered: usize,
    /// Number of infeasible candidates, by reason.
    pub refused: BTreeMap<String, usize>,
    /// Number of predicted candidates.
    pub rollouts: usize,
    /// Number of candidates predicted to reach the goal.
    pub promising: usize,
}

/// Search for lever-ups of one task.
pub struct LeverSearch<'a> {
    /// The task.
    pub task: &'a Task,
    /// Believed situation of the task's scene.
    pub situation: &'a Situation,
    /// Tools with blades.
    pub tools: &'a [Arc<Tool>],
}

impl LeverSearch<'_> {
    /// Returns the feasible candidates for lever points at the distance `apart`, metres.
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

    /// Returns the job of a candidate.
    pub fn job(&self, candidate: &LeverCandidate) -> Job {
        let tool = Arc::clone(&self.tools[candidate.tool]);
        let motion = Motion::Lever(LeverMotion::new(tool, candidate.lever, None));
        Job::new(self.situation, motion)
    }

    /// Returns all feasible candidates, best first. `predict` rolls out jobs. If `cancelled`
    /// returns `true`, the candidates predicted so far are returned.
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
        // The sort is stable, so that ties keep the order of the grid.
        scored.sort_by(|a, b| a.merit.total_cmp(&b.merit));
        (scored, statistics)
    }
}

/// Returns the ranking cost of a lever-up without regard to its neighbours: the score, with
/// penalties if the plate slips, leans, jams or ends between two sides.
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
    // Well within the goal, the penalties decide.
    score.clamp(0.5, 1e6) + undecided + slipped + leaning + wrong
}

/// Returns for each candidate the share of its neighbours predicted to reach the goal. Neighbours
/// are one step away along the outline, in depth or in angle; infeasible ones and ones beyond the
/// ranges count as half.
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
