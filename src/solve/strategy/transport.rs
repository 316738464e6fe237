//! Plans of many pushes that follow legs of transport.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::plan::{
    FollowSettings, Followed, Groups, Leg, Search, SearchResult, Transport as Carrier, evaluate,
    follow,
};
use crate::progress::Instant;
use crate::scene::Tool;
use crate::solve::SolveError;
use crate::solve::arm_feasibility::arm_fault;
use crate::solve::blackboard::Blackboard;
use crate::solve::candidates::Candidates;
use crate::solve::solving::{Batch, Strategy};
use crate::task::Plan;

/// Number of pushes of the usual search at which the search for legs begins.
const FIRST: usize = 3;

/// Number of grips for which legs are searched, fewest pushes first.
const GRIPS: usize = 3;

/// Number of plans of legs for each grip.
const PLANS: usize = 2;

/// Number of refined candidates for one leg.
const CANDIDATES: usize = 4;

/// Maximum length of a push of a leg relative to the task's: slightly less than refinement allows.
const LONGEST: f64 = 1.4;

/// Maximum number of legs if only the first ones are followed.
const FAR: usize = 24;

/// Number of first legs followed in this case.
const AHEAD: usize = 2;

/// Legs for a tool and grip yaw.
type Legs = ((usize, f64), Vec<Leg>);

/// First pushes of a plan that leads to the goals.
pub struct Approach {
    /// The first pushes.
    pub plan: Plan,
    /// The pushing tool.
    pub tool: Arc<Tool>,
    /// Number of pushes of the entire plan.
    pub pushes: usize,
}

/// Strategy that follows legs once the usual search has reached a given number of pushes.
#[derive(Default)]
pub(super) struct Transport {
    depth: usize,
    open: VecDeque<Legs>,
}

impl<'a> Strategy<'a> for Transport {
    fn name(&self) -> &'static str {
        "transport"
    }

    fn next(&mut self, board: &mut Blackboard<'a>) -> Result<Option<Batch>, SolveError> {
        let Some(usual) = &board.search else { return Ok(None) };
        let depth = usual.depth();
        if depth > self.depth {
            self.depth = depth;
            let most = board.query.task.pushes.max_count;
            let last = depth == FIRST || (depth < FIRST && !usual.can_deepen());
            if last && most >= 2 && board.wants_longer(FIRST) {
                let began = Instant::now();
                self.open = legs(board, most, PLANS).into();
                board.timing.search += began.elapsed().as_secs_f64();
            }
        }
        while let Some((pair, legs)) = self.open.pop_front() {
            if !board.wants_longer(legs.len()) || board.query.progress.cancelled() {
                self.open.clear();
                break;
            }
            let began = Instant::now();
            let followed = followed(board, pair, &legs);
            board.timing.search += began.elapsed().as_secs_f64();
            if let Some(followed) = followed.filter(|followed| followed.legs == legs.len()) {
                let score = board.query.task.score(&followed.state);
                let found = vec![SearchResult { candidate: followed.candidate, score }];
                let candidates = Candidates { found, pushes: legs.len(), hardenable: false };
                return Ok(Some(Batch::Pushes(candidates)));
            }
        }
        Ok(None)
    }
}

/// Returns the first pushes of a plan of at least `least` pushes that leads to the goals, even with
/// more pushes than plans may have. Returns `None` if there is no such plan.
pub(in crate::solve) fn approach(board: &mut Blackboard, least: usize) -> Option<Approach> {
    let mut ways = legs(board, FAR, 1);
    ways.sort_by_key(|(_, legs)| legs.len());
    if ways.first().is_none_or(|(_, legs)| legs.len() < least) {
        return None;
    }
    let workspace = board.query.workspace();
    for (pair, legs) in ways {
        let followed = followed(board, pair, &legs[..AHEAD.min(legs.len())])?;
        let made = [followed.candidate];
        let mut made = evaluate(&workspace, &mut board.refiner.rollouts, &made).into_iter();
        if followed.legs > 0
            && let Some(Ok(made)) = made.next()
            && arm_fault(&board.query, &made).is_none()
        {
            let tool = Arc::clone(&workspace.tools[pair.0]);
            return Some(Approach { plan: made.plan(&workspace), tool, pushes: legs.len() });
        }
    }
    None
}

/// Returns legs for the grips that need the fewest pushes, up to `count` plans of at most `most`
/// legs each.
fn legs(board: &Blackboard, most: usize, count: usize) -> Vec<Legs> {
    let (workspace, situation) = (board.query.workspace(), board.query.situation);
    let Some(usual) = board.search.as_ref().filter(|_| workspace.is_placed()) else {
        return Vec::new();
    };
    let Some(groups) = Groups::of(&workspace, situation) else { return Vec::new() };
    board.reporter.stage("search for legs");
    let longest = LONGEST * board.query.task.pushes.length;
    let carrier = |pair: &(usize, f64)| {
        Some((*pair, Carrier::new(workspace, situation, &groups, *pair, longest)?))
    };
    let mut all: Vec<_> = usual.grips().iter().filter_map(carrier).collect();
    // The sort is stable, so that ties keep their order.
    all.sort_by(|a, b| a.1.least().total_cmp(&b.1.least()));
    let best = all.iter().take(GRIPS);
    let ways =
        best.flat_map(|(pair, one)| one.legs(most, count).into_iter().map(|legs| (*pair, legs)));
    // If the grid is too coarse to distinguish a goal from the start, no leg is needed.
    ways.filter(|(_, legs)| !legs.is_empty()).collect()
}

/// Finds pushes along legs and counts their rollouts.
fn followed(board: &mut Blackboard, pair: (usize, f64), legs: &[Leg]) -> Option<Followed> {
    let query = board.query;
    let settings = FollowSettings {
        search: board.search.as_ref().map(Search::settings)?,
        candidates: CANDIDATES,
        refine: query.refine_settings(1),
    };
    let mut used = 0;
    let (workspace, situation) = (query.workspace(), query.situation);
    let model = (query.planner.model(), settings);
    let followed = follow(&workspace, situation, pair, legs, model, &mut used, query.progress);
    board.refiner.rollouts.count(used);
    Some(followed)
}
