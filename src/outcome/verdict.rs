//! Verdicts on plans: evidence and reasons for rejection.

use serde::{Deserialize, Serialize};

use super::{Force, Outcome, Trajectory, Warning};
use crate::scene::{Engine, Physics, Support};

/// Number of failed replays on one support model, without a success, that rules out chance: with a
/// success rate of three in four, it happens to one plan in 250.
const NEVER: usize = 4;

/// Difference of a replay from the task as written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Perturbation {
    /// No perturbation.
    Nominal,
    /// Small random perturbation of the start poses and of every friction coefficient.
    Perturbed {
        /// Number of the draw, from 1. A draw of a given seed is identical in both engines.
        draw: usize,
    },
}

/// Replay of a plan in an engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evidence {
    /// Engine of the replay.
    pub engine: Engine,
    /// Perturbation of the replay.
    pub perturbation: Perturbation,
    /// Final state and goal errors.
    pub outcome: Outcome,
    /// Warnings raised during the replay.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Warning>,
    /// Force of the tool on objects.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force: Option<Force>,
    /// Trajectory of a nominal replay. It is not written to files, because a replay of the plan
    /// reproduces it.
    #[serde(skip)]
    pub trajectory: Option<Trajectory>,
}

impl Evidence {
    /// Returns the first warning that invalidates the outcome.
    pub fn fault(&self) -> Option<&Warning> {
        self.warnings.iter().find(|warning| warning.forbids_success())
    }
}

/// Reason for the rejection of a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// The plan violates a rule of its task.
    Forbidden(Warning),
    /// A fault occurs in the replay of the plan as written.
    GoesWrong {
        /// Engine of the replay.
        engine: Engine,
        /// The fault.
        fault: Warning,
    },
    /// The object misses the goal in the replay of the plan as written.
    Misses {
        /// Engine of the replay.
        engine: Engine,
        /// Position error, metres.
        error: f64,
        /// Heading error, radians, if the goal has a heading.
        heading_error: Option<f64>,
    },
    /// The plan works as written, but fails too often when start poses and frictions are perturbed.
    Fragile {
        /// Engine with the larger share of failures.
        engine: Engine,
        /// Number of perturbed replays in this engine that reach the goal.
        reached: usize,
        /// Number of perturbed replays in this engine.
        replays: usize,
        /// Required share of successful replays.
        wanted: f64,
    },
    /// The plan works as written, but never with another plausible support model.
    NeverOn {
        /// Engine of the replay.
        engine: Engine,
        /// Support model with which the plan fails.
        support: Support,
        /// Number of replays with this support model.
        replays: usize,
    },
}

/// Verdict on a plan, with the evidence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Whether the plan passes. A passing plan violates no rule, and its nominal replays reach the
    /// goal at rest in both engines. In each engine, so does the required share of perturbed
    /// replays.
    pub passed: bool,
    /// Reason for the rejection.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<Reason>,
    /// Violations of the task's rules, regardless of their effect.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub forbidden: Vec<Warning>,
    /// Replays, the nominal ones first.
    pub evidence: Vec<Evidence>,
    /// Share of the perturbed replays that reach the goal, 0 to 1, in the engine with fewer
    /// successes. `None` if no perturbed replay was made.
    pub robustness: Option<f64>,
}

impl Verdict {
    /// Judges a plan by its rule violations and its replays. `wanted` is the share of the perturbed
    /// replays that must reach the goal.
    pub fn judge(forbidden: Vec<Warning>, evidence: Vec<Evidence>, wanted: f64) -> Self {
        let mut verdict =
            Self { passed: false, reason: None, forbidden, evidence, robustness: None };
        let shares = Engine::ALL.map(|engine| verdict.share(engine));
        verdict.robustness = shares.iter().flatten().map(|share| share.2).reduce(f64::min);
        verdict.reason = verdict.find_reason(wanted);
        verdict.passed = verdict.reason.is_none();
        verdict
    }

    /// Returns `true` if the plan works as written, even if too seldom when perturbed.
    pub fn nominal_ok(&self) -> bool {
        matches!(self.reason, None | Some(Reason::Fragile { .. } | Reason::NeverOn { .. }))
    }

    /// Returns `true` if a replay was stopped early, so that the verdict is inconclusive.
    pub fn was_stopped(&self) -> bool {
        self.evidence.iter().any(|evidence| evidence.warnings.contains(&Warning::Stopped))
    }

    /// Returns the nominal replay in an engine.
    pub fn nominal(&self, engine: Engine) -> Option<&Evidence> {
        self.of(engine).find(|evidence| evidence.perturbation == Perturbation::Nominal)
    }

    /// Returns the perturbed replays in an engine, in the order of their draws.
    pub fn perturbed(&self, engine: Engine) -> impl Iterator<Item = &Evidence> + Clone {
        self.of(engine).filter(|evidence| evidence.perturbation != Perturbation::Nominal)
    }

    fn of(&self, engine: Engine) -> impl Iterator<Item = &Evidence> + Clone {
        self.evidence.iter().filter(move |evidence| evidence.engine == engine)
    }

    /// Returns the number of perturbed replays in an engine that reach the goal, their total number
    /// and the share.
    fn share(&self, engine: Engine) -> Option<(usize, usize, f64)> {
        let replays = self.perturbed(engine).count();
        let reached = self.perturbed(engine).filter(|evidence| evidence.outcome.reached).count();
        (replays > 0).then(|| (reached, replays, reached as f64 / replays as f64))
    }

    fn find_reason(&self, wanted: f64) -> Option<Reason> {
        if let Some(forbidden) = self.forbidden.first() {
            return Some(Reason::Forbidden(forbidden.clone()));
        }
        // The 3-D engine comes first, because it covers effects that the 2-D engine cannot.
        for engine in [Engine::Spatial, Engine::Planar] {
            let Some(nominal) = self.nominal(engine) else { continue };
            if nominal.outcome.reached {
                continue;
            }
            let error = nominal.outcome.error();
            let heading_error = nominal.outcome.heading_error();
            return Some(match nominal.fault() {
                Some(fault) => Reason::GoesWrong { engine, fault: fault.clone() },
                None => Reason::Misses { engine, error, heading_error },
            });
        }
        let shares = [Engine::Spatial, Engine::Planar].map(|engine| (engine, self.share(engine)));
        let shares = shares.into_iter().filter_map(|(engine, share)| Some((engine, share?)));
        let least = shares.min_by(|a, b| a.1.2.total_cmp(&b.1.2));
        let least = least.filter(|(_, (_, _, share))| *share < wanted);
        let fragile = least.map(|(engine, (reached, replays, _))| Reason::Fragile {
            engine,
            reached,
            replays,
            wanted,
        });
        self.never_on().filter(|_| wanted > 0.0).or(fragile)
    }

    /// Returns the support model with which no replay reaches the goal. Lever-ups have none,
    /// because the 2-D engine does not replay them and their supports are not perturbed.
    fn never_on(&self) -> Option<Reason> {
        self.nominal(Engine::Planar)?;
        [Engine::Spatial, Engine::Planar].into_iter().find_map(|engine| {
            let (support, replays) = never_on(self.perturbed(engine))?;
            Some(Reason::NeverOn { engine, support: support.clone(), replays })
        })
    }
}

/// Returns the support model with which none of these perturbed replays in one engine reaches the
/// goal, and their number. The number must be large enough to rule out chance.
pub fn never_on<'a>(
    replays: impl Iterator<Item = &'a Evidence> + Clone,
) -> Option<(&'static Support, usize)> {
    let on = |support| {
        replays.clone().filter(move |evidence| match evidence.perturbation {
            Perturbation::Perturbed { draw } => Physics::doubted(draw - 1) == Some(support),
            Perturbation::Nominal => false,
        })
    };
    let supports = Physics::PLAUSIBLE_SUPPORTS.iter();
    let mut counted = supports.map(|support| (support, on(support).count()));
    counted.find(|(support, count)| *count >= NEVER && !on(support).any(|one| one.outcome.reached))
}
