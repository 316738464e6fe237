//! Where the best plan works, but not nearly always: others are made that depend less on what objects rest on.

use crate::plan::{HardenSettings, SearchResult, harden};
use crate::watch::Instant;

use super::grade::{Class, Grade};
use super::solving::{REFINE_WORK, Solving};

/// Sets the changes apart from the samples of refinements.
const HARDENING: u64 = 1 << 14;

impl Solving<'_> {
    /// Hardens what was found of this many pushes, if the best plan so far works, but not nearly always; then
    /// refines and verifies that, too.
    pub(super) fn harden(&mut self, found: &[SearchResult], pushes: usize) {
        let shaky = |(grade, _): &(Grade, usize)| grade.class > Class::Fails && !grade.is_steady();
        if self.watch.cancelled() || !self.best.as_ref().is_some_and(shaky) {
            return;
        }
        self.tell("harden", pushes);
        let began = Instant::now();
        let settings = HardenSettings {
            kinds: 2 * self.planner.settings().refined,
            rollouts: REFINE_WORK / self.situation.scene.objects.len().max(1),
            seed: self.refine_settings(pushes).seed ^ HARDENING,
        };
        let hardened = harden(&self.workspace, &mut self.rollouts, found, settings, self.watch);
        self.statistics.timing.search += began.elapsed().as_secs_f64();
        self.try_out(&hardened, pushes);
        self.settle(Class::Edge);
    }
}
