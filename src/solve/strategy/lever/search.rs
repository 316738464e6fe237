//! Search for lever-ups of a task with the effect model, and coarse simulation of the best.

use std::sync::Arc;

use rayon::prelude::*;

use crate::outcome::{Outcome, Record, Trajectory};
use crate::plan::lever::{LeverCandidate, LeverSearch, LeverSearchStatistics, ScoredLever, merit};
use crate::progress::{Instant, NoProgress};
use crate::scene::{Scene, Situation, Tool};
use crate::sim::LeverSimulator;
use crate::solve::attempts::Attempt;
use crate::solve::blackboard::Blackboard;
use crate::solve::lever_batch::{Kind, LeverPlan, mixed};
use crate::solve::query::Query;
use crate::task::{Job, LeverMotion, LeverStep, Motion, Plan, Step, Task};

use super::doubt::doubted;
use super::prefix::Prefix;

/// Ranking cost of a candidate whose perturbed coarse simulations all miss the goal.
const DOUBTED: f64 = 2.0;

/// Candidate after coarse simulation.
struct Simulated {
    candidate: LeverCandidate,
    trajectory: Trajectory,
    outcome: Outcome,
    merit: f64,
}

/// Returns the best lever-ups of `task` after coarse simulation, best first, each after `prefix`.
pub(super) fn lever_ups(board: &mut Blackboard, task: &Task, prefix: &Prefix) -> Vec<LeverPlan> {
    let began = Instant::now();
    board.reporter.stage("search lever-ups");
    let (scored, statistics) = search(&board.query, task);
    let chosen = choose(scored, board.query.settings.levers.simulated);
    if let Some(levers) = &mut board.levers {
        levers.search = statistics;
        levers.simulated += chosen.len();
    }
    let plan = |Simulated { candidate, trajectory, outcome, .. }| {
        let (tool, lever) = (&board.query.tools[candidate.tool], candidate.lever);
        let expected = (!prefix.plan.is_empty()).then(|| task.scene.objects[lever.plate].pose);
        let step = Step::LeverUp(LeverStep { tool: tool.name.clone(), lever, expected });
        let plan = prefix.plan.clone().then(Plan { steps: vec![step] });
        let promising = outcome.reached;
        let tools = prefix.with(std::slice::from_ref(tool));
        let attempt = Attempt::simulated(plan, tools, (trajectory, outcome));
        LeverPlan { attempt, kind: kind(&candidate), promising }
    };
    let plans = simulate(&board.query, task, chosen).into_iter().map(plan).collect();
    board.timing.search += began.elapsed().as_secs_f64();
    plans
}

/// Returns the number of lever-ups of `task` that are predicted to reach its goal.
pub(super) fn promising(board: &Blackboard, task: &Task) -> usize {
    search(&board.query, task).1.promising
}

fn search(query: &Query, task: &Task) -> (Vec<ScoredLever>, LeverSearchStatistics) {
    let situation = Situation::stated(&task.scene);
    let search = LeverSearch { task, situation: &situation, tools: query.tools };
    let predict = |jobs: &[Job]| predict(query, &task.scene, jobs);
    search.run(&predict, &|| query.progress.cancelled())
}

/// Predicts jobs with the model, or by coarse simulation if the model does not support them.
fn predict(query: &Query, scene: &Scene, jobs: &[Job]) -> Vec<Trajectory> {
    let model = query.planner.model();
    if jobs.iter().all(|job| model.takes(scene, job)) {
        model.rollout(scene, jobs, Record::Outcome)
    } else {
        let really = Situation::stated(scene);
        jobs.par_iter().map(|job| simulated(&really, scene, job.motion.clone())).collect()
    }
}

/// Simulates a motion planned in `scene` coarsely in the true situation.
fn simulated(really: &Situation, scene: &Scene, motion: Motion) -> Trajectory {
    let watched = (Record::Outcome, &NoProgress as _);
    LeverSimulator::COARSE.run_all(really, scene, &[motion], watched)
}

/// Chooses the best `wanted` candidates of different kinds: at most an eighth of one kind while
/// there are others.
fn choose(scored: Vec<ScoredLever>, wanted: usize) -> Vec<ScoredLever> {
    let kinds: Vec<Kind> = scored.iter().map(|found| kind(&found.candidate)).collect();
    let all: Vec<usize> = (0..scored.len()).collect();
    let chosen = mixed(&all, &kinds, &[], wanted.div_ceil(8), wanted);
    let mut scored: Vec<Option<ScoredLever>> = scored.into_iter().map(Some).collect();
    chosen.into_iter().filter_map(|k| scored[k].take()).collect()
}

/// Simulates candidates coarsely, nominal and perturbed, and ranks them by the results.
fn simulate(query: &Query, task: &Task, chosen: Vec<ScoredLever>) -> Vec<Simulated> {
    let doubts = query.settings.levers.doubts;
    let stated = Situation::stated(&task.scene);
    let mut simulated: Vec<Simulated> = chosen
        .into_par_iter()
        .map(|scored| {
            let (lever, tool) = (scored.candidate.lever, &query.tools[scored.candidate.tool]);
            let run = |really: &Situation, friction: f64| {
                let tool = Arc::new(Tool::clone(tool).friction(friction));
                coarse(task, really, Motion::Lever(LeverMotion::new(tool, lever, None)))
            };
            let (trajectory, outcome) = run(&stated, tool.friction);
            let mut merit = merit(task.levered(), &outcome, &trajectory) + 1.0 - scored.company;
            if outcome.reached && doubts > 0 {
                let missed = (0..doubts).filter(|&draw| {
                    let own = (tool.friction, draw);
                    let (really, friction) = doubted(&stated, lever.plate, own);
                    !run(&really, friction).1.reached
                });
                merit += DOUBTED * missed.count() as f64 / doubts as f64;
            } else if !outcome.reached {
                merit += DOUBTED;
            }
            Simulated { candidate: scored.candidate, trajectory, outcome, merit }
        })
        .collect();
    // The sort is stable, so that ties keep the order of the search.
    simulated.sort_by(|a, b| a.merit.total_cmp(&b.merit));
    simulated
}

/// Simulates a motion coarsely in the true situation and judges its outcome by the task.
fn coarse(task: &Task, really: &Situation, motion: Motion) -> (Trajectory, Outcome) {
    let trajectory = simulated(really, &task.scene, motion);
    let scene = Scene { obstacles: really.scene.obstacles.clone(), ..task.scene.clone() };
    let outcome = Outcome::judge(&scene, task, &trajectory);
    (trajectory, outcome)
}

fn kind(candidate: &LeverCandidate) -> Kind {
    let [_, _, axis, turn] = candidate.cell;
    (candidate.tool, candidate.lever.place.edge, axis, turn)
}
