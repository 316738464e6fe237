//! Plans that first move aside what stands in the way.

use crate::plan::{
    Evaluation, Rollouts, Search, SearchSettings, SweptRegion, Workspace, evaluate, is_behind,
    kinds,
};
use crate::{
    outcome::Record,
    scene::Situation,
    task::{Job, Task},
};

use super::solving::Solving;

/// Kinds of plans of one length that are looked at for what stands in their way.
const KINDS: usize = 16;

/// In how many corridors of one length room is made, those with the nearest ends first.
const TRIED: usize = 3;

/// A plan is looked at if it misses the goal by at most this many tolerances: refinement brings it
/// nearer.
const NEAR: f64 = 2.0;

/// How many pushes may be made beyond one for each object in the way: what stands in a corner takes
/// two.
const MORE: usize = 1;

/// Corridors in which the goals' objects would come to their goals if nothing else stood on the table.
pub(super) struct Clearings<'a> {
    workspace: Workspace<'a>,
    situation: &'a Situation,
    rollouts: Rollouts<'a>,
    search: Search<'a>,
    found: Vec<Clearing>,
}

/// One of them.
struct Clearing {
    corridor: SweptRegion,
    /// How the tool is held on it.
    grip: (usize, f64),
    /// Pushes of the goals' objects, and one for each object that stands there.
    pushes: usize,
}

impl<'a> Clearings<'a> {
    /// Those of a task `without` everything else; nothing is searched yet.
    pub fn new(
        solving: &Solving<'a>,
        without: &'a (Task, Situation),
        settings: SearchSettings,
    ) -> Self {
        let (task, situation) = without;
        let workspace = Workspace { task, ..solving.workspace };
        let rollouts = Rollouts::new(solving.planner.screen(), situation.clone());
        let search = Search::new(workspace, situation, settings);
        Self { workspace, situation, rollouts, search, found: Vec::new() }
    }

    /// Looks at plans of one push more, and notes what stands in their way in `solving`.
    fn deepen(&mut self, solving: &Solving) {
        let found = self.search.deepen(&mut self.rollouts, solving.watch);
        let near = |k: &usize| !is_behind(found[*k].score) && found[*k].score <= NEAR;
        let near = kinds(&found, KINDS).into_iter().filter(near);
        let candidates: Vec<_> = near.map(|k| found[k].candidate.clone()).collect();
        let made = evaluate(&self.workspace, &mut self.rollouts, &candidates);
        let made: Vec<Evaluation> = made.into_iter().flatten().collect();
        let motions: Vec<_> = made.iter().map(|one| one.motions(&self.workspace)).collect();
        let jobs: Vec<_> =
            motions.iter().map(|motions| Job::sequence(self.situation, motions)).collect();
        let trajectories = self.rollouts.in_turn(&jobs, Record::Frames);
        let objects = &solving.task.scene.objects;
        for ((one, motions), trajectory) in made.iter().zip(&motions).zip(&trajectories) {
            let corridor =
                SweptRegion::of(&solving.workspace, solving.situation, motions, trajectory);
            let blocking = corridor.blocking(&solving.situation.start);
            if !blocking.is_empty() && blocking.iter().all(|&k| objects[k].keep.is_none()) {
                let pushes = one.pushes.len() + blocking.len();
                let grip = one.candidate.grip().map(|grip| Clearing { corridor, grip, pushes });
                self.found.extend(grip);
            }
        }
    }
}

impl<'a> Solving<'a> {
    /// Searches, refines and verifies plans that make room first, of as many pushes as the `usual` search
    /// has come to and up to [`MORE`] beyond. `without` is the task without everything else.
    pub(super) fn clear_the_way<'b>(
        &mut self,
        clearings: &mut Option<Clearings<'b>>,
        without: &'b (Task, Situation),
        usual: &Search,
    ) where
        'a: 'b,
    {
        // To move something aside and to push takes two pushes at least.
        let pushes = usual.depth();
        if pushes < 2 || !self.goes_on(pushes - 1) {
            return;
        }
        let clearings =
            clearings.get_or_insert_with(|| Clearings::new(self, without, usual.settings()));
        if clearings.search.can_deepen() {
            self.watch.stage("search, what stands in the way");
            let before = clearings.rollouts.used();
            clearings.deepen(self);
            self.rollouts.count(clearings.rollouts.used() - before);
        }
        let (now, later): (Vec<Clearing>, Vec<Clearing>) =
            std::mem::take(&mut clearings.found).into_iter().partition(|one| one.pushes <= pushes);
        clearings.found = later;
        // In the order in which they were found: nearest ends first.
        for Clearing { corridor, grip, pushes } in now.into_iter().take(TRIED) {
            let mut search = usual.clearing(corridor, grip);
            while self.goes_on(search.depth())
                && search.can_deepen()
                && search.depth() < pushes + MORE
            {
                self.attempt(&mut search);
            }
        }
    }
}
