//! How often the best plan works is asked until it is clear.

use crate::watch::Instant;

use super::grade::{Class, Grade};
use super::solving::Solving;

impl Solving<'_> {
    /// Replays the best plan, if it is of this class or a better one, with further disturbances until it
    /// is clear how often it works, as `verify` does. Where it works less often than it seemed, another
    /// may be the best.
    pub(super) fn settle(&mut self, least: Class) {
        let began = Instant::now();
        let asked = self.planner.settings().disturbed > 0;
        while let Some((grade, k)) = self.best
            && asked
            && grade.class >= least
            && !self.tried[k].settled
            && !self.watch.cancelled()
        {
            let tried = &mut self.tried[k];
            tried.settled = true;
            let Some(verdict) = tried.verdict.take() else { break };
            let (tools, plan) = (&tried.tools, &tried.plan);
            let verifier = self.verifier.clone().until_clear();
            tried.verdict = Some(verifier.disturb(self.task, self.situation, tools, plan, verdict));
            self.best = self.best_of_all();
        }
        self.statistics.timing.verification += began.elapsed().as_secs_f64();
    }

    /// The best of the plans that were replayed with disturbances; the first of equal ones.
    fn best_of_all(&self) -> Option<(Grade, usize)> {
        let graded = self.tried.iter().enumerate().filter_map(|(k, tried)| {
            let verdict = tried.verdict.as_ref().filter(|verdict| verdict.robustness.is_some())?;
            Some((Grade::of(self.task, verdict), k))
        });
        graded.reduce(|best, next| if next.0.compare(&best.0).is_gt() { next } else { best })
    }
}
