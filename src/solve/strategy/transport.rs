//! Plans of many pushes that follow legs of transport.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::plan::{
    Follow, FollowSettings, Followed, Groups, Leg, Search, SearchResult, Transport as Carrier,
    evaluate, find_legs,
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

/// Number of objects from which the search for legs begins after a single push. It is then cheaper
/// than the usual search for two and more pushes, and follows legs that need more than [`FIRST`].
const CROWD: usize = 4;

/// Number of tools for which legs are searched, fewest pushes first.
const TOOLS: usize = 3;

/// Number of plans of legs for each tool.
const PLANS: usize = 2;

/// Number of refined candidates for one leg.
const CANDIDATES: usize = 4;

/// Maximum length of a push of a leg relative to the task's: slightly less than refinement allows.
const LONGEST: f64 = 1.4;

/// Maximum number of legs if only the first ones are followed.
const FAR: usize = 24;

/// Number of first legs followed in this case.
const AHEAD: usize = 2;

/// Index of a tool and its grip yaws, radians.
type Grips<'a> = (usize, &'a [f64]);

/// Legs for a tool.
type Legs<'a> = (Grips<'a>, Vec<Leg>);

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
pub(super) struct Transport<'a> {
    depth: usize,
    /// Whether legs have been searched.
    searched: bool,
    /// Whether legs of few pushes are followed.
    begun: bool,
    open: VecDeque<Legs<'a>>,
}

impl<'a> Strategy<'a> for Transport<'a> {
    fn name(&self) -> &'static str {
        "transport"
    }

    fn next(&mut self, board: &mut Blackboard<'a>) -> Result<Option<Batch>, SolveError> {
        let Some(usual) = &board.search else { return Ok(None) };
        let (depth, most) = (usual.depth(), board.query.task.pushes.max_count);
        if depth > self.depth {
            self.depth = depth;
            let last = depth == FIRST || (depth < FIRST && !usual.can_deepen());
            let crowded = depth == 1 && board.query.task.scene.things().count() >= CROWD;
            let now = (last || crowded) && !self.searched;
            self.searched |= now;
            if now && most >= 2 && board.wants_longer(FIRST) {
                let began = Instant::now();
                self.open = legs(board, most, PLANS).into();
                board.timing.search += began.elapsed().as_secs_f64();
            }
            self.begun |= last;
        }
        // The usual search may still find shorter plans.
        if !self.begun && self.open.iter().any(|(_, legs)| legs.len() <= FIRST) {
            return Ok(None);
        }
        while let Some((tool, legs)) = self.open.pop_front() {
            if !board.wants_longer(legs.len()) || board.query.progress.cancelled() {
                self.open.clear();
                break;
            }
            let began = Instant::now();
            let followed = followed(board, tool, &legs, (most, usize::MAX));
            board.timing.search += began.elapsed().as_secs_f64();
            if let Some(followed) = followed.filter(|followed| followed.complete) {
                let score = board.query.task.score(&followed.state);
                let pushes = followed.candidate.pushes.len();
                let found = vec![SearchResult { candidate: followed.candidate, score }];
                let candidates = Candidates { found, pushes, hardenable: false };
                return Ok(Some(Batch::Pushes(candidates)));
            }
        }
        Ok(None)
    }
}

/// Returns the first pushes of a plan of at least `least` pushes that leads to the goals, even with
/// more pushes than plans may have. Returns `None` if there is no such plan.
pub(in crate::solve) fn approach(board: &mut Blackboard, least: usize) -> Option<Approach> {
    // A tool that stays down would have to begin at home again.
    if !board.query.workspace().is_placed() {
        return None;
    }
    let mut ways = legs(board, FAR, 1);
    ways.sort_by_key(|(_, legs)| legs.len());
    if ways.first().is_none_or(|(_, legs)| legs.len() < least) {
        return None;
    }
    let workspace = board.query.workspace();
    for (tool, legs) in ways {
        let followed = followed(board, tool, &legs, (FAR, AHEAD))?;
        let made = [followed.candidate];
        let mut made = evaluate(&workspace, &mut board.refiner.rollouts, &made).into_iter();
        if followed.legs > 0
            && let Some(Ok(made)) = made.next()
            && arm_fault(&board.query, &made).is_none()
        {
            let tool = Arc::clone(&workspace.tools[tool.0]);
            return Some(Approach { plan: made.plan(&workspace), tool, pushes: legs.len() });
        }
    }
    None
}

/// Returns legs for the tools that need the fewest pushes, up to `count` plans of at most `most`
/// legs each.
fn legs<'a>(board: &Blackboard<'a>, most: usize, count: usize) -> Vec<Legs<'a>> {
    let (workspace, situation) = (board.query.workspace(), board.query.situation);
    if board.search.is_none() {
        return Vec::new();
    }
    let Some(groups) = Groups::of(&workspace, situation) else { return Vec::new() };
    board.reporter.stage("search for legs");
    let task = board.query.task;
    let start = (task.robot.home, longest(board));
    let carrier = |grips: Grips<'a>| {
        Some((grips, Carrier::new(workspace, situation, &groups, grips, start)?))
    };
    // A tool that stays down keeps its yaw.
    let yaws = &task.pushes.grip_yaws;
    let at_once = if workspace.is_placed() { yaws.len().max(1) } else { 1 };
    let tools = 0..workspace.tools.len();
    let grips = tools.flat_map(|tool| yaws.chunks(at_once).map(move |yaws| (tool, yaws)));
    let mut all: Vec<_> = grips.filter_map(carrier).collect();
    // The sort is stable, so that ties keep their order.
    all.sort_by(|a, b| a.1.least().total_cmp(&b.1.least()));
    let best = all.iter().take(TOOLS);
    let progress = board.query.progress;
    let ways = best.flat_map(|(tool, one)| {
        find_legs(one, most, count, progress).into_iter().map(|legs| (*tool, legs))
    });
    // If the grid is too coarse to distinguish a goal from the start, no leg is needed.
    ways.filter(|(_, legs)| !legs.is_empty()).collect()
}

/// Returns the maximum length of a push of a leg, metres.
fn longest(board: &Blackboard) -> f64 {
    LONGEST * board.query.task.pushes.length
}

/// Finds at most `most` pushes along at most `ahead` legs and counts their rollouts.
fn followed(
    board: &mut Blackboard,
    grips: Grips,
    legs: &[Leg],
    (most, ahead): (usize, usize),
) -> Option<Followed> {
    let query = board.query;
    let settings = FollowSettings {
        search: board.search.as_ref().map(Search::settings)?,
        candidates: CANDIDATES,
        refine: query.refine_settings(1),
    };
    let mut used = 0;
    let follow = Follow {
        workspace: query.workspace(),
        situation: query.situation,
        tool: grips,
        longest: longest(board),
        most,
        model: query.planner.model(),
        settings,
    };
    let followed = follow.run(legs, ahead, &mut used, query.progress);
    board.refiner.rollouts.count(used);
    Some(followed)
}
