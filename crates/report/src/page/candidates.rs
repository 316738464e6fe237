//! Pushes considered by the search, as grids of direction by offset.

use std::collections::BTreeMap;

use pushplan::decimals::fixed;
use pushplan::plan::{Infeasible, ScoredPush, Start, bare, is_behind};
use pushplan::solve::Solution;

use super::data::{Candidates, Grid};

/// Maximum number of cells on a page, because more would make it slow to load. Cells of longer
/// sequences are dropped first.
const MOST_CELLS: usize = 6000;

/// Largest score shown, in units of the tolerance; higher scores are clamped.
const WORST: f64 = 999.0;

/// Returns the grids of a search; `None` if no push was considered.
pub fn candidates(solution: &Solution) -> Option<Candidates> {
    let all = &solution.candidates;
    let mut reasons: Vec<Infeasible> = all.iter().filter_map(|push| push.refused).collect();
    reasons.sort_unstable();
    reasons.dedup();
    let of_grid = |a: &ScoredPush, b: &ScoredPush| {
        (a.pushes, a.tool, a.grip_yaw) == (b.pushes, b.tool, b.grip_yaw)
    };
    let (mut grids, mut shown) = (Vec::new(), 0);
    for pushes in all.chunk_by(of_grid) {
        if shown + pushes.len() <= MOST_CELLS {
            shown += pushes.len();
            grids.push(grid(solution, pushes, &reasons));
        }
    }
    let reasons = reasons.iter().map(ToString::to_string).collect();
    (shown > 0).then_some(Candidates { reasons, grids, considered: all.len(), shown })
}

/// Returns the most frequent reason why pushes are infeasible.
pub fn frequent(pushes: &[&ScoredPush]) -> Option<Infeasible> {
    let mut counts: BTreeMap<Infeasible, usize> = BTreeMap::new();
    for reason in pushes.iter().filter_map(|push| push.refused) {
        *counts.entry(reason).or_default() += 1;
    }
    counts.into_iter().max_by_key(|(_, count)| *count).map(|(reason, _)| reason)
}

/// Builds a grid of `pushes`, which share tool, grip yaw and sequence length and are ordered by
/// direction, part and offset.
fn grid(solution: &Solution, pushes: &[ScoredPush], reasons: &[Infeasible]) -> Grid {
    let first = pushes[0];
    let mut directions: Vec<f64> = Vec::new();
    for push in pushes {
        if directions.last() != Some(&push.direction) {
            directions.push(push.direction);
        }
    }
    let mut faces: Vec<(Option<usize>, usize)> = Vec::new();
    let row = pushes.iter().take_while(|push| push.direction == first.direction);
    for push in row {
        let part = match push.start {
            Start::Placed { part, .. } => Some(part),
            Start::Chained => None,
        };
        match faces.last_mut() {
            Some((last, cells)) if *last == part => *cells += 1,
            _ => faces.push((part, 1)),
        }
    }
    let tool = &solution.tools[first.tool];
    let name = |(part, cells): (Option<usize>, usize)| {
        let part = part.and_then(|part| tool.parts().get(part));
        (part.map_or(String::new(), |part| part.name.clone()), cells)
    };
    let offset = |push: &ScoredPush| match push.start {
        Start::Placed { offset, .. } => (1e3 * offset).round() as i64,
        Start::Chained => 0,
    };
    Grid {
        tool: tool.name.clone(),
        pushes: first.pushes,
        yaw: fixed(first.grip_yaw.to_degrees(), 0),
        faces: faces.into_iter().map(name).collect(),
        directions: directions.iter().map(|way| (way.to_degrees() * 10.0).round() / 10.0).collect(),
        offsets: pushes.iter().map(offset).collect(),
        cells: pushes.iter().map(|push| cell(push, reasons)).collect(),
    }
}

fn cell(push: &ScoredPush, reasons: &[Infeasible]) -> i64 {
    match (push.score, push.refused) {
        (Some(score), _) if is_behind(score) => Grid::BLOCKED,
        (Some(score), _) => (100.0 * bare(score).min(WORST)).round() as i64,
        (None, Some(reason)) => {
            let index = reasons.iter().position(|known| *known == reason);
            index.map_or(Grid::NOT_TRIED, |index| Grid::REFUSED - index as i64)
        }
        (None, None) => Grid::NOT_TRIED,
    }
}
