//! Refinement of candidates: offsets, directions and lengths of all pushes are improved by a
//! quadratic programme on a linear model of the object's final pose.
//!
//! Around the current parameters x0 (in steps, see `parameters`), the model y = y0 + J u is fitted
//! by least squares. Its samples are rollouts at plus and minus half the trust radius along every
//! parameter, and a few seeded random combinations. No gradient of the effect model is needed.
//!
//! The programme minimises the squared goal error of y in units of the tolerances. Its constraints
//! are the trust radius, the parameters' bounds and the linearised margins of reach and clearance.
//! The solutions for several radii are rolled out. The best rollout that satisfies all rules
//! becomes the new centre if it is better, so that a candidate never gets worse. All candidates
//! share their batches.
//!
//! The refined quantity is the centre of the object's final poses over plausible support models
//! (see `supports`). Its offset from the predicted final pose is taken as constant and recomputed
//! for the best rollout of every round.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::progress::Progress;
use crate::task::Task;

use super::goal_errors::{apart, asked, beside, farthest, goal_errors, largest};
use super::linear::slopes;
use super::parameters::Parameters;
use super::score::{bare, behind, is_behind};
use super::supports::{Ends, Supports};
use super::{
    Candidate, Evaluation, Margins, QpProblem, QpSolver, QpStatus, RefineStatistics, Refined,
    Rollouts, Workspace, evaluate,
};

/// Initial trust radius for search results, in steps. An early stop has an error of up to a frame,
/// and an offset of up to half the coarse spacing.
const FOUND_RADIUS: f64 = 2.0;

/// Largest error that refinement can correct, in units of the tolerance, because it moves final
/// poses by centimetres.
pub const REFINABLE: f64 = 5.0;

/// Smallest and largest trust radius, in steps. The effect of smaller steps is less than the noise
/// of contacts.
const RADII: (f64, f64) = (0.05, 8.0);

/// Radii of the programmes solved in each round, in units of the trust radius.
const TRIALS: [f64; 3] = [2.0, 1.0, 0.5];

/// Factor of the radius after a round without improvement.
const SHRINK: f64 = 0.25;

/// Score that needs no further improvement, in units of the tolerance: a tenth of the usual error
/// of effect models and robots.
const GOOD_ENOUGH: f64 = 0.01;

/// Factor of the last gain that estimates the gain of each remaining round optimistically. A
/// candidate is dropped if even these gains would not bring it within the tolerance. Gains grow at
/// first because the trust radius grows.
const HOPE: f64 = 4.0;

/// Weight of the step's length relative to the goal error, in units of the mean curvature. It only
/// decides between parameters without effect.
const DAMPING: f64 = 1e-3;

/// Budgets of refinement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RefineSettings {
    /// Number of rounds of fitting, solving and rolling out.
    pub rounds: usize,
    /// Number of random combinations per round in addition to the two samples of every parameter.
    pub extra: usize,
    /// Seed of the random combinations.
    pub seed: u64,
    /// Number of candidates without further gain at which refinement stops.
    pub enough: usize,
    /// Number of rollouts after which no further round begins.
    pub rollouts: usize,
}

struct Work {
    parameters: Parameters,
    refined: Refined,
    /// Final poses of the best evaluation for plausible support models.
    ends: Ends,
    radius: f64,
    random: Pcg64,
}

/// Refines the candidates that satisfy all rules and returns them in the given order; infeasible
/// candidates are left out. `progress` receives the numbers of completed and total rounds, and can
/// stop the refinement between rounds.
pub fn refine(
    workspace: &Workspace,
    rollouts: &mut Rollouts,
    candidates: &[Candidate],
    settings: RefineSettings,
    statistics: &mut RefineStatistics,
    progress: &dyn Progress,
) -> Vec<Refined> {
    let before = rollouts.used();
    let mut solver = QpSolver::default();
    let supports = Supports::around(rollouts.situation());
    let sound: Vec<(usize, Evaluation)> = evaluate(workspace, rollouts, candidates)
        .into_iter()
        .enumerate()
        .filter_map(|(index, result)| Some((index, result.ok().filter(Evaluation::is_feasible)?)))
        .collect();
    let ends =
        supports.ends(workspace, rollouts, &sound.iter().map(|(_, e)| e).collect::<Vec<_>>());
    let task = workspace.task;
    let mut work: Vec<Work> = sound
        .into_iter()
        .zip(ends)
        .map(|((index, best), ends)| Work {
            parameters: Parameters::new(workspace, &rollouts.situation().start, &best.candidate),
            refined: Refined {
                index,
                off: [off(task, &best, &ends); 2],
                worst: ends.worst,
                rounds: vec![score(task, &best, &ends)],
                best,
            },
            ends,
            radius: FOUND_RADIUS,
            random: Pcg64::seed_from_u64(settings.seed.wrapping_add(index as u64)),
        })
        .collect();
    for round in 0..settings.rounds {
        if progress.cancelled() {
            break;
        }
        progress.update(round as u64, settings.rounds as u64);
        let left = settings.rounds - round;
        let good = work.iter().filter(|w| w.is_good()).count();
        if good >= settings.enough || rollouts.used() - before >= settings.rollouts {
            break;
        }
        let mut active: Vec<&mut Work> = work.iter_mut().filter(|w| w.is_open(left)).collect();
        if active.is_empty() {
            break;
        }
        step((workspace, &supports), rollouts, &mut active, settings, &mut solver, statistics);
    }
    progress.update(settings.rounds as u64, settings.rounds as u64);
    statistics.rollouts += rollouts.used() - before;
    work.into_iter().map(|w| w.refined).collect()
}

impl Work {
    /// Returns the score of the centre of the best evaluation's final poses.
    fn score(&self) -> f64 {
        self.refined.rounds.last().copied().unwrap_or(f64::INFINITY)
    }

    fn is_good(&self) -> bool {
        self.score() <= GOOD_ENOUGH
    }

    /// Returns `true` if the `left` remaining rounds can be worth their rollouts.
    fn is_open(&self, left: usize) -> bool {
        let score = bare(self.score());
        if self.is_good() || !score.is_finite() || self.radius <= RADII.0 {
            return false;
        }
        let [.., before, _] = self.refined.rounds[..] else { return true };
        score - HOPE * (bare(before) - score) * left as f64 <= 1.0
    }
}

/// Returns the score of the centre of a candidate's final poses.
fn score(task: &Task, evaluation: &Evaluation, ends: &Ends) -> f64 {
    let score = largest(&beside(&goal_errors(task, &evaluation.outcome), &ends.middles));
    match evaluation.score {
        blocked if is_behind(blocked) => behind(score),
        counts if counts.is_finite() => score,
        other => other,
    }
}

/// Returns the distance of the centre of the final poses from the goal, metres: the largest over
/// all goals.
fn off(task: &Task, evaluation: &Evaluation, ends: &Ends) -> f64 {
    farthest(task, &beside(&goal_errors(task, &evaluation.outcome), &ends.middles))
}

/// Runs one round for all open candidates.
fn step(
    (workspace, supports): (&Workspace, &Supports),
    rollouts: &mut Rollouts,
    active: &mut [&mut Work],
    settings: RefineSettings,
    solver: &mut QpSolver,
    statistics: &mut RefineStatistics,
) {
    let task = workspace.task;
    let designs: Vec<Vec<Vec<f64>>> =
        active.iter_mut().map(|work| design(work, settings.extra)).collect();
    let sampled = evaluate_groups(workspace, rollouts, active, &designs);
    let mut trials: Vec<Vec<Vec<f64>>> = Vec::with_capacity(active.len());
    for (work, samples) in active.iter().zip(&sampled) {
        trials.push(proposals(workspace.task, work, samples, solver, statistics));
    }
    let tried = evaluate_groups(workspace, rollouts, active, &trials);
    // Best evaluation of every candidate, before its final poses are known, and the radius after
    // it.
    let mut leaders: Vec<(usize, f64, &Evaluation)> = Vec::new();
    for (k, work) in active.iter_mut().enumerate() {
        let tried = tried[k].iter().map(|(u, trial)| {
            let reach = u.iter().fold(0.0f64, |most, v| most.max(v.abs()));
            (reach.max(RADII.0 * 2.0).min(RADII.1), trial)
        });
        let all = sampled[k].iter().map(|(_, sample)| (work.radius, sample)).chain(tried);
        let leader = all
            .filter(|(_, one)| one.is_feasible())
            .map(|(radius, one)| (score(task, one, &work.ends), radius, one))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .filter(|(score, ..)| *score < work.score());
        work.radius = (work.radius * SHRINK).min(RADII.1);
        leaders.extend(leader.map(|(_, radius, one)| (k, radius, one)));
    }
    let evaluations: Vec<&Evaluation> = leaders.iter().map(|(.., one)| *one).collect();
    let ends = supports.ends(workspace, rollouts, &evaluations);
    let mut scores: Vec<f64> = active.iter().map(|work| work.score()).collect();
    for ((k, radius, one), ends) in leaders.into_iter().zip(ends) {
        let (work, score) = (&mut active[k], score(task, one, &ends));
        if score < scores[k] {
            scores[k] = score;
            let refined = &mut work.refined;
            refined.off[1] = off(task, one, &ends);
            (refined.worst, refined.best) = (ends.worst, one.clone());
            (work.ends, work.radius) = (ends, radius);
        }
    }
    active.iter_mut().zip(scores).for_each(|(work, score)| work.refined.rounds.push(score));
}

/// Returns the points to sample around the current parameters, in steps.
fn design(work: &mut Work, extra: usize) -> Vec<Vec<f64>> {
    let n = work.parameters.count();
    let reach = 0.5 * work.radius;
    let mut points = Vec::with_capacity(2 * n + extra);
    for i in 0..n {
        for side in [-reach, reach] {
            let mut point = vec![0.0; n];
            point[i] = side;
            points.push(point);
        }
    }
    for _ in 0..extra {
        points.push((0..n).map(|_| work.random.random_range(-reach..=reach)).collect());
    }
    points
}

/// Evaluates every group of points around its candidate in one batch. Points are first clamped to
/// the bounds; points that cannot be placed are left out.
fn evaluate_groups(
    workspace: &Workspace,
    rollouts: &mut Rollouts,
    active: &[&mut Work],
    groups: &[Vec<Vec<f64>>],
) -> Vec<Vec<(Vec<f64>, Evaluation)>> {
    let mut owners = Vec::new();
    let mut candidates = Vec::new();
    for (k, (work, points)) in active.iter().zip(groups).enumerate() {
        for point in points {
            let (candidate, point) = work.parameters.moved(&work.refined.best.candidate, point);
            owners.push((k, point));
            candidates.push(candidate);
        }
    }
    let mut evaluated: Vec<Vec<(Vec<f64>, Evaluation)>> = groups.iter().map(|_| vec![]).collect();
    let results = evaluate(workspace, rollouts, &candidates);
    for ((k, point), result) in owners.into_iter().zip(results) {
        if let Ok(evaluation) = result {
            evaluated[k].push((point, evaluation));
        }
    }
    evaluated
}

/// Returns the minimisers of the fitted programme for every trial radius, in steps.
fn proposals(
    task: &Task,
    work: &Work,
    samples: &[(Vec<f64>, Evaluation)],
    solver: &mut QpSolver,
    statistics: &mut RefineStatistics,
) -> Vec<Vec<f64>> {
    let mut found: Vec<Vec<f64>> = Vec::new();
    for share in TRIALS {
        let problem = programme(task, work, samples, share * work.radius);
        let solution = solver.solve(&problem);
        match solution.status {
            QpStatus::Solved | QpStatus::AlmostSolved => {
                statistics.solved += 1;
                // Inactive radii give equal solutions.
                let repeats = found.iter().any(|x| {
                    x.iter().zip(&solution.x).all(|(a, b)| (a - b).abs() < 1e-3 * RADII.0)
                });
                if !repeats {
                    found.push(solution.x);
                }
            }
            status => statistics.failures.push((status, problem)),
        }
    }
    found
}

/// Returns the quadratic programme of one candidate: see the module's documentation.
fn programme(
    task: &Task,
    work: &Work,
    samples: &[(Vec<f64>, Evaluation)],
    radius: f64,
) -> QpProblem {
    let (n, best) = (work.parameters.count(), &work.refined.best);
    let known = beside(&goal_errors(task, &best.outcome), &work.ends.middles);
    let centre = asked(task, &known);
    let (goals, rules) = (centre.len(), best.margins.len() * Margins::COUNT);
    let held: Vec<f64> = best.margins.iter().flat_map(Margins::list).collect();
    let changes: Vec<(Vec<f64>, Vec<f64>)> = samples
        .iter()
        .filter(|(_, sample)| sample.outcome.is_finite())
        .map(|(u, sample)| {
            let sampled = beside(&goal_errors(task, &sample.outcome), &work.ends.middles);
            let mut y = asked(task, &apart(task, &sampled, &known));
            let margins = sample.margins.iter().flat_map(Margins::list);
            y.extend(margins.zip(&held).map(|(a, b)| a - b));
            (u.clone(), y)
        })
        .collect();
    let fitted = slopes(&changes, n, goals + rules);
    let product = |i: usize, j: usize| -> f64 {
        fitted[..goals].iter().map(|slope| 2.0 * slope[i] * slope[j]).sum()
    };
    let mut p: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| product(i, j)).collect()).collect();
    let curvature = (0..n).map(|i| p[i][i]).sum::<f64>() / n.max(1) as f64;
    for (i, row) in p.iter_mut().enumerate() {
        row[i] += DAMPING * curvature + f64::EPSILON;
    }
    let q = (0..n)
        .map(|i| fitted[..goals].iter().zip(&centre).map(|(slope, e)| 2.0 * slope[i] * e).sum())
        .collect();
    let (mut a, mut b) = (Vec::new(), Vec::new());
    let room = work.parameters.room(&best.candidate);
    for (i, (low, high)) in room.into_iter().enumerate() {
        for (sign, limit) in [(1.0, high), (-1.0, -low)] {
            let mut row = vec![0.0; n];
            row[i] = sign;
            a.push(row);
            b.push(limit.min(radius).max(0.0));
        }
    }
    for (slope, margin) in fitted[goals..].iter().zip(&held) {
        // Rows are scaled to about the size of the bounds' rows.
        let scale = 1.0 / slope.iter().fold(1e-3f64, |most, v| most.max(v.abs()));
        // Bounds that no step can violate are moved near, because distant ones have prevented
        // convergence of the solver.
        let reach = 1.0 + radius * scale * slope.iter().map(|v| v.abs()).sum::<f64>();
        a.push(slope.iter().map(|v| -v * scale).collect());
        b.push((margin.max(0.0) * scale).min(reach));
    }
    QpProblem { p, q, a, b }
}
