//! How often plans work: in the plane first, then in 3-D where that can matter, and the best until it is clear.

use crate::verify::Verifier;
use crate::watch::Instant;

use super::attempts::Perturbed;
use super::grade::{Class, Grade};
use super::solving::Solving;

impl Solving<'_> {
    /// Replays a plan with disturbances, and says what it is worth. One that is not safe in the plane is
    /// replayed there alone: it is worth no more than that, see [`Self::best_of_all`].
    pub(super) fn disturb(&mut self, k: usize) -> Class {
        let class = self.replay(k, &self.verifier.clone().in_plane(), Perturbed::InPlane);
        if class == Class::Safe { self.complete(k) } else { class }
    }

    /// Replays a plan in 3-D, too.
    fn complete(&mut self, k: usize) -> Class {
        self.replay(k, &self.verifier.clone(), Perturbed::InBoth)
    }

    fn replay(&mut self, k: usize, verifier: &Verifier, disturbed: Perturbed) -> Class {
        let tried = &mut self.tried[k];
        tried.disturbed = disturbed;
        let Some(verdict) = tried.verdict.take() else { return Class::Fails };
        let (tools, plan) = (&tried.tools, &tried.plan);
        let verdict = verifier.disturb(self.task, self.situation, tools, plan, verdict);
        let class = Grade::of(self.task, &verdict).class;
        tried.verdict = Some(verdict);
        class
    }

    /// Replays the best plan, if it is of this class or a better one, with further disturbances until it
    /// is clear how often it works, as `verify` does. Where it works less often than it seemed, another
    /// may be the best. As long as fragile plans are not wanted, one that fails on a support is left early.
    pub(super) fn settle(&mut self, least: Class) {
        let began = Instant::now();
        let asked = self.planner.settings().disturbed > 0;
        while let Some((grade, k)) = self.best
            && asked
            && grade.class >= least
            && self.tried[k].disturbed != Perturbed::Settled
            && !self.watch.cancelled()
        {
            let verifier = self.verifier.clone().until_clear();
            let seeking = least > Class::Fragile;
            let verifier = if seeking { verifier.giving_up() } else { verifier };
            if self.replay(k, &verifier, Perturbed::Settled) < least {
                self.tried[k].disturbed = Perturbed::InBoth;
            }
            self.best = self.best_of_all();
        }
        self.statistics.timing.verification += began.elapsed().as_secs_f64();
    }

    /// The best of the plans that were replayed with disturbances; the first of equal ones. It has been
    /// replayed in 3-D, which the others that seem no better need not be.
    pub(super) fn best_of_all(&mut self) -> Option<(Grade, usize)> {
        loop {
            let graded = self.tried.iter().enumerate().filter_map(|(k, tried)| {
                let replayed = tried.verdict.as_ref().filter(|_| tried.disturbed != Perturbed::No);
                Some((Grade::of(self.task, replayed?), k))
            });
            let better = |best: (Grade, usize), next: (Grade, usize)| {
                if next.0.compare(&best.0).is_gt() { next } else { best }
            };
            match graded.reduce(better) {
                Some((_, k)) if self.tried[k].disturbed == Perturbed::InPlane => {
                    self.complete(k);
                }
                best => return best,
            }
        }
    }
}
