//! Grades of verified plans, and their order.

use std::cmp::Ordering;

use crate::plan::NEAR;
use crate::{
    outcome::{Evidence, Verdict, Warning},
    scene::Engine,
};

use super::PlanStatus;

/// Share of the tolerance within which a plan ends well inside in 3-D. Of the plans for 241 random
/// tasks that end this near to the goal, and reach it in 2-D and in all perturbed replays, 97.5 %
/// work in MuJoCo. Of the plans that end in the outer half, 55 % work.
pub const WELL_INSIDE: f64 = 0.5;

/// Share of successful perturbed replays of a plan that works nearly always. In MuJoCo, of the
/// passing plans of random and everyday tasks, 13 of 47 with a lower share fail, and 26 of 934 with
/// a higher one.
const STEADY: f64 = 0.9;

/// Difference of two errors that no engine resolves, in units of the tolerance.
const RESOLUTION: f64 = 0.05;

/// Class of a verdict, worst first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// The plan does not work as written.
    Fails,
    /// The plan works as written, but too seldom when perturbed.
    Fragile,
    /// The plan passes, but presses harder than an ordinary arm or far harder than friction
    /// requires. One more push may improve it.
    Forced,
    /// The plan passes near the edge of the tolerance. One more push may improve it.
    Edge,
    /// The plan passes well inside the tolerance.
    Passes,
    /// The plan passes well inside the tolerance and in every perturbed replay, so that the search
    /// for a better plan ends.
    Safe,
}

impl Class {
    /// Returns the status if a plan of this class is the best one.
    pub fn status(self) -> PlanStatus {
        match self {
            Class::Fails => PlanStatus::FailedVerification,
            Class::Fragile => PlanStatus::Fragile,
            Class::Forced | Class::Edge | Class::Passes | Class::Safe => PlanStatus::Solved,
        }
    }
}

/// Grade of a verified plan.
#[derive(Clone, Copy, Debug)]
pub struct Grade {
    /// Class of the verdict.
    pub class: Class,
    /// Share of the perturbed replays that reach the goal.
    robustness: f64,
    /// Largest error of all demands in 3-D, in units of their tolerances.
    score: f64,
}

impl Grade {
    /// Returns the grade of a plan with this verdict.
    pub fn of(verdict: &Verdict) -> Self {
        let spatial = verdict.nominal(Engine::Spatial);
        let score = spatial.map_or(f64::INFINITY, |e| e.outcome.score());
        let robustness = verdict.robustness.unwrap_or(1.0);
        let presses = |evidence: &Evidence| evidence.warnings.iter().any(Warning::presses);
        let presses = Engine::ALL.into_iter().filter_map(|one| verdict.nominal(one)).any(presses);
        let class = match (verdict.passed, verdict.nominal_ok()) {
            (true, _) if presses => Class::Forced,
            (true, _) if robustness == 1.0 && score <= WELL_INSIDE => Class::Safe,
            (true, _) if score <= WELL_INSIDE => Class::Passes,
            (true, _) => Class::Edge,
            (false, true) => Class::Fragile,
            (false, false) => Class::Fails,
        };
        Self { class, robustness, score }
    }

    /// Compares the order of two plans that have not been perturbed, given the order of their
    /// `costs`. Among plans that may be safe, the cheaper one comes first, then the better one.
    pub fn before(&self, other: &Self, costs: Ordering) -> Ordering {
        let safe = self.class == Class::Safe && other.class == Class::Safe;
        let costs = if safe { costs } else { Ordering::Equal };
        costs.then(other.compare(self))
    }

    /// Returns `true` if the plan, should it work as written, also works nearly always when
    /// perturbed.
    pub fn is_steady(&self) -> bool {
        self.robustness >= STEADY
    }

    /// Returns `true` if no plan can have a relevantly larger margin.
    pub fn is_best(&self) -> bool {
        self.class == Class::Safe && self.score <= NEAR
    }

    /// Returns `true` if the plan has more margin than another: it works more often, or its error
    /// is clearly smaller.
    pub fn has_more_margin(&self, other: &Self) -> bool {
        match self.class.cmp(&other.class).then(self.robustness.total_cmp(&other.robustness)) {
            Ordering::Equal => self.score < other.score - NEAR,
            order => order.is_gt(),
        }
    }

    /// Returns `true` if two passing plans differ by less than the resolution of the tolerance, so
    /// that neither is worth another push.
    pub fn is_as_good_as(&self, other: &Self) -> bool {
        let passes = |one: &Self| one.class >= Class::Edge && one.score.is_finite();
        let close = (self.score - other.score).abs() <= RESOLUTION;
        passes(self) && passes(other) && self.robustness == other.robustness && close
    }

    /// Compares two grades; the better one is greater.
    pub fn compare(&self, other: &Self) -> Ordering {
        let robust = self.robustness.total_cmp(&other.robustness);
        self.class.cmp(&other.class).then(robust).then(other.score.total_cmp(&self.score))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outcome::{Miss, Outcome, Perturbation, Warning};
    use crate::scene::State;

    /// Returns the grade of a plan that ends at this score, with these warnings of both replays.
    fn grade(score: f64, warnings: &[Warning]) -> Grade {
        let miss = Miss { object: 0, error: 0.0, heading_error: None, score, raised: None };
        let evidence = Engine::ALL.map(|engine| Evidence {
            engine,
            perturbation: Perturbation::Nominal,
            outcome: Outcome { state: State::default(), goals: vec![miss], reached: true },
            warnings: warnings.to_vec(),
            force: None,
            trajectory: None,
        });
        Grade::of(&Verdict::judge(Vec::new(), evidence.to_vec(), 0.75))
    }

    #[test]
    fn a_squeeze_ranks_behind_an_end_near_the_edge_of_the_tolerance() {
        let squeezed = Warning::Squeezed { against: None, needed: 40.0, friction: 2.0 };
        let [edge, forced] = [grade(0.9, &[]), grade(0.1, &[squeezed])];
        assert_eq!((edge.class, forced.class), (Class::Edge, Class::Forced));
        assert!(edge.compare(&forced).is_gt() && forced.class > Class::Fragile);
        assert_eq!(forced.class.status(), PlanStatus::Solved);
    }
}
