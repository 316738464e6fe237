//! Plans of many pushes after legs on which things would be carried.

use crate::plan::{Carrying, FollowSettings, Found, RefineSettings, Search, follow};
use crate::watch::Instant;

use super::grade::Class;
use super::solving::{SCREENED_RADIUS, Solving};

/// The usual search is through with plans of so many pushes before legs are looked for.
const FIRST: usize = 3;

/// Grips with which that is done, those that need the fewest pushes first, and plans of legs for each.
const GRIPS: usize = 3;
const PLANS: usize = 2;

/// Candidates for one leg that are refined.
const CANDIDATES: usize = 4;

/// A push may be so much longer than the task says: less than what refinement may lengthen it by.
const LONGEST: f64 = 1.2;

impl<'a> Solving<'a> {
    /// Makes, refines and verifies plans after legs, once the `usual` search has come far enough.
    pub(super) fn carry(&mut self, usual: &Search) {
        let rules = &self.task.pushes;
        let last = usual.depth() == FIRST || (usual.depth() < FIRST && !usual.can_deepen());
        if !last || rules.max_count < 2 || !self.workspace.is_placed() || !self.goes_on(FIRST) {
            return;
        }
        self.watch.stage("search, what is carried where");
        let began = Instant::now();
        let longest = LONGEST * rules.length;
        let mut carrying: Vec<((usize, f64), Carrying)> = Vec::new();
        for pair in usual.grips() {
            let Some(one) = Carrying::new(&self.workspace, self.situation, *pair, longest) else {
                continue;
            };
            carrying.push((*pair, one));
        }
        // Stable: of those that need as much the first comes first.
        carrying.sort_by(|a, b| a.1.least().total_cmp(&b.1.least()));
        self.statistics.timing.search += began.elapsed().as_secs_f64();
        if std::env::var("CARRY").is_ok() {
            eprintln!("carrying {} in {:?}", carrying.len(), began.elapsed());
        }
        for (pair, one) in carrying.into_iter().take(GRIPS) {
            for legs in one.legs(rules.max_count, PLANS) {
                if !self.goes_on(legs.len()) || self.watch.cancelled() {
                    return;
                }
                let began = Instant::now();
                let models = [self.planner.screen(), self.planner.model()];
                let settings = self.follow_settings(usual);
                let mut used = [0; 2];
                let followed = follow(
                    &self.workspace,
                    self.situation,
                    pair,
                    &legs,
                    (models, settings),
                    &mut used,
                    self.watch,
                );
                if std::env::var("CARRY").is_ok() {
                    eprintln!("grip {pair:?} followed {} of {}", followed.legs, legs.len());
                    for leg in &legs {
                        eprintln!("  {leg:?}");
                    }
                }
                self.rollouts.count(used[0]);
                if let Some(deciding) = &mut self.deciding {
                    deciding.count(used[1]);
                }
                self.statistics.timing.search += began.elapsed().as_secs_f64();
                if followed.legs == legs.len() {
                    let score = self.task.score(&followed.state);
                    let found = Found { candidate: followed.candidate, score };
                    self.try_out(&[found], legs.len());
                    self.settle(Class::Edge);
                }
            }
        }
    }

    fn follow_settings(&self, usual: &Search) -> FollowSettings {
        let settings = self.planner.settings();
        let refine = self.refine_settings(1);
        FollowSettings {
            search: usual.settings(),
            candidates: CANDIDATES,
            refine,
            decide: RefineSettings {
                rounds: settings.decided_rounds,
                radius: SCREENED_RADIUS,
                short_list: CANDIDATES,
                ..refine
            },
        }
    }
}
