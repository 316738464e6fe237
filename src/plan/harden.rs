//! Hardening of plans against the unknown support of their objects.
//!
//! A search ranks plans by their final pose on the believed support, and refinement brings the
//! centre of their final poses to the goal. Neither reduces the spread over support models. If no
//! plan works nearly always, a random search starts from the candidates with the smallest spread.
//! The random search varies offsets, directions and lengths, and keeps changes that reduce the
//! error for the worst support model. Half of the candidates are dropped after every few rounds
//! (successive halving, Jamieson and Talwalkar 2016, arXiv:1502.07943).

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::progress::Progress;

use super::parameters::Parameters;
use super::supports::{Ends, Supports};
use super::{Candidate, Evaluation, REFINABLE, Rollouts, SearchResult, Workspace, evaluate, kinds};

/// Share of the rollouts used to evaluate the search results.
const LOOKING: f64 = 0.25;

/// Number of changes of each candidate in a round.
const CHILDREN: usize = 12;

/// Number of rounds before half of the candidates are dropped.
const ROUNDS: usize = 4;

/// Number of candidates left when the search ends.
const LEFT: usize = 6;

/// Smallest and largest size of changes in steps of the parameters, drawn log-uniformly.
const CHANGES: (f64, f64) = (0.2, 8.0);

/// Budgets of hardening.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HardenSettings {
    /// Number of candidates to vary, each of a different kind.
    pub kinds: usize,
    /// Number of rollouts after which no further round begins.
    pub rollouts: usize,
    /// Seed of the changes.
    pub seed: u64,
}

/// Candidate under variation, with its score for the worst support model.
struct Work {
    best: Candidate,
    parameters: Parameters,
    worst: f64,
    random: Pcg64,
}

/// Returns the search results re-optimised for the worst support model, best first. Scores are for
/// the worst support model.
pub fn harden(
    workspace: &Workspace,
    rollouts: &mut Rollouts,
    found: &[SearchResult],
    settings: HardenSettings,
    progress: &dyn Progress,
) -> Vec<SearchResult> {
    let (before, start) = (rollouts.used(), rollouts.situation().start.clone());
    let supports = Supports::around(rollouts.situation());
    let steady = steadiest(workspace, rollouts, &supports, found, settings.rollouts);
    let mut work: Vec<Work> = kinds(&steady, settings.kinds)
        .into_iter()
        .map(|k| {
            let random = Pcg64::seed_from_u64(settings.seed.wrapping_add(k as u64));
            let parameters = Parameters::new(workspace, &start, &steady[k].candidate);
            // The initial score is infinite, so that any valid change replaces the search result.
            Work { best: steady[k].candidate.clone(), parameters, worst: f64::INFINITY, random }
        })
        .collect();
    while work.len() > LEFT {
        for _ in 0..ROUNDS {
            if progress.cancelled() || rollouts.used() - before >= settings.rollouts {
                break;
            }
            round(workspace, rollouts, &supports, &mut work);
        }
        work.sort_by(|a, b| a.worst.total_cmp(&b.worst));
        work.truncate((work.len() / 2).max(LEFT));
    }
    work.into_iter().map(|one| SearchResult { candidate: one.best, score: one.worst }).collect()
}

/// Returns the search results near the goal, ordered by their spread over all support models, which
/// becomes their score.
fn steadiest(
    workspace: &Workspace,
    rollouts: &mut Rollouts,
    supports: &Supports,
    found: &[SearchResult],
    most: usize,
) -> Vec<SearchResult> {
    let each = found.first().map_or(1, |one| one.candidate.pushes.len()) * supports.count();
    let most = (LOOKING * most as f64) as usize / each.max(1);
    let near = found.iter().filter(|one| one.score <= REFINABLE).take(most);
    let candidates: Vec<Candidate> = near.map(|one| one.candidate.clone()).collect();
    let evaluated = evaluate(workspace, rollouts, &candidates);
    let feasible: Vec<Evaluation> =
        evaluated.into_iter().flatten().filter(Evaluation::is_feasible).collect();
    let ends = supports.ends(workspace, rollouts, &feasible.iter().collect::<Vec<_>>());
    let with = |(one, ends): (Evaluation, Ends)| SearchResult {
        candidate: one.candidate,
        score: ends.radius,
    };
    let mut steady: Vec<SearchResult> = feasible.into_iter().zip(ends).map(with).collect();
    steady.sort_by(|a, b| a.score.total_cmp(&b.score));
    steady
}

/// Varies every candidate in several ways and keeps changes that improve its worst support model.
fn round(workspace: &Workspace, rollouts: &mut Rollouts, supports: &Supports, work: &mut [Work]) {
    let mut owners = Vec::new();
    let mut candidates = Vec::new();
    for (k, one) in work.iter_mut().enumerate() {
        for _ in 0..CHILDREN {
            let (low, high) = (CHANGES.0.ln(), CHANGES.1.ln());
            let size = one.random.random_range(low..high).exp();
            let count = one.parameters.count();
            let step = |_| size * one.random.random_range(-1.0..=1.0);
            let steps: Vec<f64> = (0..count).map(step).collect();
            owners.push(k);
            candidates.push(one.parameters.moved(&one.best, &steps).0);
        }
    }
    let results = evaluate(workspace, rollouts, &candidates);
    let better: Vec<(usize, Evaluation)> = owners
        .into_iter()
        .zip(results)
        .filter_map(|(k, result)| Some((k, result.ok()?)))
        .filter(|(k, one)| one.is_feasible() && one.score < work[*k].worst)
        .collect();
    let ends =
        supports.ends(workspace, rollouts, &better.iter().map(|(_, one)| one).collect::<Vec<_>>());
    for ((k, one), ends) in better.into_iter().zip(ends) {
        if ends.worst < work[k].worst {
            (work[k].best, work[k].worst) = (one.candidate, ends.worst);
        }
    }
}
