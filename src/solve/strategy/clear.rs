//! Plans that first clear an obstruction.

use std::collections::VecDeque;

use crate::outcome::Record;
use crate::plan::{
    Evaluation, Rollouts, Search, SweptRegion, Workspace, evaluate, is_behind, kinds,
};
use crate::scene::Situation;
use crate::solve::SolveError;
use crate::solve::blackboard::Blackboard;
use crate::solve::solving::{Batch, Strategy};
use crate::task::{Job, Task};

/// Maximum number of kinds of plans whose obstructions are examined, per number of pushes.
const KINDS: usize = 16;

/// Maximum number of swept regions to clear, per number of pushes. Regions whose plans have smaller
/// final errors come first.
const REGIONS: usize = 3;

/// Maximum error of an examined plan in units of the tolerance; above 1 because refinement can
/// reduce it.
const NEAR: f64 = 2.0;

/// Number of pushes beyond one for each obstruction, because an object in a corner takes two.
const MORE: usize = 1;

/// Search for plans that first clear a swept region. Their number of pushes is limited to the
/// pushes of the goals' objects, one for each obstruction, and [`MORE`].
pub(super) struct Clear<'a> {
    /// Task without the possible obstructions.
    alone: Option<&'a (Task, Situation)>,
    /// Search in that task.
    unobstructed: Option<Unobstructed<'a>>,
    /// Number of pushes of the usual search at the last examination.
    depth: usize,
    waiting: Vec<Clearing>,
    open: VecDeque<Clearing>,
    /// Current search, and the maximum length of its plans.
    current: Option<(Search<'a>, usize)>,
}

/// Swept region of a plan that reaches the goals if the other objects are absent.
struct Clearing {
    region: SweptRegion,
    /// Tool and grip yaw of the plan.
    grip: (usize, f64),
    /// Number of pushes of the goals' objects plus one for each obstruction.
    pushes: usize,
}

struct Unobstructed<'a> {
    workspace: Workspace<'a>,
    situation: &'a Situation,
    rollouts: Rollouts<'a>,
    search: Search<'a>,
}

impl<'a> Clear<'a> {
    pub fn new(alone: Option<&'a (Task, Situation)>) -> Self {
        let (waiting, open) = (Vec::new(), VecDeque::new());
        Self { alone, unobstructed: None, depth: 0, waiting, open, current: None }
    }

    /// Finds the regions to clear for plans of `pushes` pushes.
    fn look(&mut self, board: &mut Blackboard<'a>, pushes: usize) {
        let (Some(alone), Some(usual)) = (self.alone, &board.search) else { return };
        // Clearing an obstruction and pushing an object take at least two pushes.
        if pushes < 2 || !board.wants_longer(pushes - 1) {
            return;
        }
        let one = self.unobstructed.get_or_insert_with(|| {
            let (task, situation) = alone;
            let workspace = Workspace { task, ..board.query.workspace() };
            let rollouts = Rollouts::new(board.query.planner.model(), situation.clone());
            let search = Search::new(workspace, situation, usual.settings());
            Unobstructed { workspace, situation, rollouts, search }
        });
        if one.search.can_deepen() {
            board.reporter.stage("search for obstructions");
            let before = one.rollouts.used();
            self.waiting.extend(one.deepen(board));
            board.refiner.rollouts.count(one.rollouts.used() - before);
        }
        let (now, later): (Vec<Clearing>, Vec<Clearing>) =
            std::mem::take(&mut self.waiting).into_iter().partition(|one| one.pushes <= pushes);
        self.waiting = later;
        // Regions keep their order, nearest ends first.
        self.open.extend(now.into_iter().take(REGIONS));
    }
}

impl Unobstructed<'_> {
    /// Searches for plans with one more push, and returns the swept regions of obstructed plans.
    fn deepen(&mut self, board: &Blackboard) -> Vec<Clearing> {
        let found = self.search.deepen(&mut self.rollouts, board.query.progress);
        let near = |k: &usize| !is_behind(found[*k].score) && found[*k].score <= NEAR;
        let near = kinds(&found, KINDS).into_iter().filter(near);
        let candidates: Vec<_> = near.map(|k| found[k].candidate.clone()).collect();
        let made = evaluate(&self.workspace, &mut self.rollouts, &candidates);
        let made: Vec<Evaluation> = made.into_iter().flatten().collect();
        let motions: Vec<_> = made.iter().map(|one| one.motions(&self.workspace)).collect();
        let jobs: Vec<_> =
            motions.iter().map(|motions| Job::sequence(self.situation, motions)).collect();
        let trajectories = self.rollouts.in_turn(&jobs, Record::Frames);
        let (workspace, situation) = (board.query.workspace(), board.query.situation);
        let objects = &board.query.task.scene.objects;
        let mut clearings = Vec::new();
        for ((one, motions), trajectory) in made.iter().zip(&motions).zip(&trajectories) {
            let region = SweptRegion::of(&workspace, situation, motions, trajectory);
            let blocking = region.blocking(&situation.start);
            if !blocking.is_empty() && blocking.iter().all(|&k| objects[k].keep.is_none()) {
                let pushes = one.pushes.len() + blocking.len();
                let grip = one.candidate.grip().map(|grip| Clearing { region, grip, pushes });
                clearings.extend(grip);
            }
        }
        clearings
    }
}

impl<'a> Strategy<'a> for Clear<'a> {
    fn name(&self) -> &'static str {
        "clear the way"
    }

    fn next(&mut self, board: &mut Blackboard<'a>) -> Result<Option<Batch>, SolveError> {
        let Some(pushes) = board.search.as_ref().map(Search::depth) else { return Ok(None) };
        if pushes > self.depth {
            self.depth = pushes;
            self.look(board, pushes);
        }
        loop {
            if let Some((search, longest)) = &mut self.current
                && board.wants_longer(search.depth())
                && search.can_deepen()
                && search.depth() < *longest
            {
                return Ok(Some(Batch::Pushes(board.deepen(search))));
            }
            self.current = None;
            let (Some(next), Some(usual)) = (self.open.pop_front(), &board.search) else {
                return Ok(None);
            };
            self.current = Some((usual.clearing(next.region, next.grip), next.pushes + MORE));
        }
    }
}
