//! Plans of many pushes after legs on which things would be carried.

use std::sync::Arc;

use crate::asset::ToolLibrary;
use crate::plan::{
    FollowSettings, Followed, Groups, Leg, RefineSettings, Search, SearchResult, Transport,
    evaluate, follow,
};
use crate::watch::{Instant, Until, Watch};
use crate::{
    scene::{Situation, Tool},
    task::{Plan, Task},
};

use super::check::check;
use super::grade::Class;
use super::solving::{SCREENED_RADIUS, Solving};
use super::{Planner, SolveError};

/// Legs are looked for once the usual search has come to plans of this many pushes.
const FIRST: usize = 3;

/// Grips with which that is done, those that need the fewest pushes first, and plans of legs for each.
const GRIPS: usize = 3;
const PLANS: usize = 2;

/// Candidates for one leg that are refined.
const CANDIDATES: usize = 4;

/// The longest push of a leg, in lengths of the task: a little less than what refinement may make it.
const LONGEST: f64 = 1.4;

/// Most legs where only the first are to be followed.
const FAR: usize = 24;

/// Legs that are followed then.
const AHEAD: usize = 2;

/// The first pushes of a way to the goals.
pub struct Approach {
    /// The pushes.
    pub plan: Plan,
    /// What makes them.
    pub tool: Arc<Tool>,
    /// Pushes that the whole way would take.
    pub pushes: usize,
}

impl Planner {
    /// The first pushes of a way from a situation to the goals, if that takes at least `least` pushes,
    /// however many these are: what to do where plans end before that. Nothing is verified.
    ///
    /// # Errors
    /// [`SolveError`] for bad input only.
    pub fn approach(
        &self,
        situation: &Situation,
        task: &Task,
        library: &ToolLibrary,
        least: usize,
        watch: &dyn Watch,
    ) -> Result<Option<Approach>, SolveError> {
        if task.in_space() {
            return Ok(None);
        }
        let tools = task.tools(library)?;
        check(task, situation, &tools)?;
        let until = Until::new(watch, self.time_limit);
        Ok(Solving::new(self, task, situation, &tools, &until).approach(least))
    }
}

impl Solving<'_> {
    /// Makes, refines and verifies plans after legs, once the `usual` search has come far enough.
    pub(super) fn carry(&mut self, usual: &Search) {
        let most = self.task.pushes.max_count;
        let last = usual.depth() == FIRST || (usual.depth() < FIRST && !usual.can_deepen());
        if !last || most < 2 || !self.goes_on(FIRST) {
            return;
        }
        let began = Instant::now();
        let ways = self.legs(usual, most, PLANS);
        self.statistics.timing.search += began.elapsed().as_secs_f64();
        for (pair, legs) in ways {
            if !self.goes_on(legs.len()) || self.watch.cancelled() {
                return;
            }
            let began = Instant::now();
            let followed = self.follow(usual, pair, &legs);
            self.statistics.timing.search += began.elapsed().as_secs_f64();
            if followed.legs == legs.len() {
                let score = self.task.score(&followed.state);
                let found = SearchResult { candidate: followed.candidate, score };
                self.try_out(&[found], legs.len());
                self.settle(Class::Edge);
            }
        }
    }

    /// The first pushes of a way to the goals of at least `least` pushes, and of more than plans may
    /// have; `None` if there is no such way.
    pub(super) fn approach(mut self, least: usize) -> Option<Approach> {
        let usual = self.prepared();
        let mut ways = self.legs(&usual, FAR, 1);
        ways.sort_by_key(|(_, legs)| legs.len());
        if ways.first().is_none_or(|(_, legs)| legs.len() < least) {
            return None;
        }
        for (pair, legs) in ways {
            let followed = self.follow(&usual, pair, &legs[..AHEAD.min(legs.len())]);
            let made = [followed.candidate];
            let mut made = evaluate(&self.workspace, &mut self.rollouts, &made).into_iter();
            if followed.legs > 0
                && let Some(Ok(made)) = made.next()
                && self.is_for_arm(&made)
            {
                let tool = Arc::clone(&self.workspace.tools[pair.0]);
                return Some(Approach {
                    plan: made.plan(&self.workspace),
                    tool,
                    pushes: legs.len(),
                });
            }
        }
        None
    }

    /// Legs with the grips that need the fewest pushes, up to `count` ways of at most `most` pushes each.
    fn legs(&self, usual: &Search, most: usize, count: usize) -> Vec<((usize, f64), Vec<Leg>)> {
        if !self.workspace.is_placed() {
            return Vec::new();
        }
        let Some(things) = Groups::of(&self.workspace, self.situation) else { return Vec::new() };
        self.watch.stage("search, what is carried where");
        let longest = LONGEST * self.task.pushes.length;
        let (workspace, situation) = (self.workspace, self.situation);
        let carrying = |pair: &(usize, f64)| {
            Some((*pair, Transport::new(workspace, situation, &things, *pair, longest)?))
        };
        let mut all: Vec<_> = usual.grips().iter().filter_map(carrying).collect();
        // Stable: of those that need as much the first comes first.
        all.sort_by(|a, b| a.1.least().total_cmp(&b.1.least()));
        let best = all.iter().take(GRIPS);
        let ways = best
            .flat_map(|(pair, one)| one.legs(most, count).into_iter().map(|legs| (*pair, legs)));
        // Where the grid is too coarse to tell a goal from the start there is nothing to carry.
        ways.filter(|(_, legs)| !legs.is_empty()).collect()
    }

    fn follow(&mut self, usual: &Search, pair: (usize, f64), legs: &[Leg]) -> Followed {
        let settings = self.planner.settings();
        let refine = self.refine_settings(1);
        let settings = FollowSettings {
            search: usual.settings(),
            candidates: CANDIDATES,
            refine,
            decide: RefineSettings {
                rounds: settings.decided_rounds,
                radius: SCREENED_RADIUS,
                short_list: CANDIDATES,
                ..refine
            },
        };
        let models = [self.planner.screen(), self.planner.model()];
        let mut used = [0; 2];
        let (workspace, situation) = (self.workspace, self.situation);
        let followed =
            follow(&workspace, situation, pair, legs, (models, settings), &mut used, self.watch);
        self.rollouts.count(used[0]);
        match &mut self.deciding {
            Some(deciding) => deciding.count(used[1]),
            None => self.rollouts.count(used[1]),
        }
        followed
    }
}
