//! Grades of verified plans, and their order.

use std::cmp::Ordering;

use crate::plan::NEAR;
use crate::{
    outcome::{Evidence, Verdict, Warning},
    scene::Engine,
};

use super::PlanStatus;

/// A plan that ends within this share of the tolerance in 3-D is well inside it. Played in another
/// engine (MuJoCo), plans of 241 random tasks that end so, and reach the goal in all disturbed
/// replays and in the plane, work in 97.5 %; among those that end in the outer half 55 % do.
pub const WELL_INSIDE: f64 = 0.5;

/// A plan that reaches the goal in this share of the disturbed replays does so nearly always. Played in
/// MuJoCo, of 47 plans of random and everyday tasks that do so less often, and pass, 13 fail; of 934 that do so
/// more often, 26.
const STEADY: f64 = 0.9;

/// Classes of verdicts, worst first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Does not work as written.
    Fails,
    /// Works as written, too seldom under disturbances.
    Fragile,
    /// Passes, near the edge of the tolerance, or pressing harder than an ordinary arm does: one push more may
    /// do better.
    Edge,
    /// Passes inside of it.
    Passes,
    /// Passes well inside the tolerance and in every disturbed replay: nothing better is looked
    /// for.
    Safe,
}

impl Class {
    /// The status when such a plan is the best one.
    pub fn status(self) -> PlanStatus {
        match self {
            Class::Fails => PlanStatus::FailedVerification,
            Class::Fragile => PlanStatus::Fragile,
            Class::Edge | Class::Passes | Class::Safe => PlanStatus::Solved,
        }
    }
}

/// A verified plan's worth.
#[derive(Clone, Copy, Debug)]
pub struct Grade {
    /// Class of the verdict.
    pub class: Class,
    /// Share of the disturbed replays that reach the goal.
    robustness: f64,
    /// Error in 3-D in units of the tolerance, or the demand that is met worst.
    score: f64,
}

impl Grade {
    /// Grades a plan with this verdict.
    pub fn of(verdict: &Verdict) -> Self {
        let spatial = verdict.nominal(Engine::Spatial);
        let score = spatial.map_or(f64::INFINITY, |e| e.outcome.score());
        let robustness = verdict.robustness.unwrap_or(1.0);
        let presses = |evidence: &Evidence| {
            evidence.warnings.iter().any(|warning| matches!(warning, Warning::HardPush { .. }))
        };
        let presses = Engine::ALL.into_iter().filter_map(|one| verdict.nominal(one)).any(presses);
        let class = match (verdict.passed, verdict.works()) {
            (true, _) if presses => Class::Edge,
            (true, _) if robustness == 1.0 && score <= WELL_INSIDE => Class::Safe,
            (true, _) if score <= WELL_INSIDE => Class::Passes,
            (true, _) => Class::Edge,
            (false, true) => Class::Fragile,
            (false, false) => Class::Fails,
        };
        Self { class, robustness, score }
    }

    /// Whether this plan comes before, equal with or after another, of two that were not disturbed yet and
    /// whose costs compare so: among those that may be safe the cheaper one comes first, then the better.
    pub fn before(&self, other: &Self, costs: Ordering) -> Ordering {
        let safe = self.class == Class::Safe && other.class == Class::Safe;
        let costs = if safe { costs } else { Ordering::Equal };
        costs.then(other.compare(self))
    }

    /// Whether it works nearly always, if it works at all.
    pub fn is_steady(&self) -> bool {
        self.robustness >= STEADY
    }

    /// Whether none has more margin that matters.
    pub fn is_best(&self) -> bool {
        self.class == Class::Safe && self.score <= NEAR
    }

    /// Whether it has more margin than another: it works more often, or misses by clearly less.
    pub fn has_more_margin(&self, other: &Self) -> bool {
        match self.class.cmp(&other.class).then(self.robustness.total_cmp(&other.robustness)) {
            Ordering::Equal => self.score < other.score - NEAR,
            order => order.is_gt(),
        }
    }

    /// Compares two, the better one being greater.
    pub fn compare(&self, other: &Self) -> Ordering {
        let robust = self.robustness.total_cmp(&other.robustness);
        self.class.cmp(&other.class).then(robust).then(other.score.total_cmp(&self.score))
    }
}
