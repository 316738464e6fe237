//! Whether a plan works, with the evidence, and why not.

use serde::{Deserialize, Serialize};

use super::{Force, Outcome, Trajectory, Warning};
use crate::scene::{Engine, Physics, Support};

/// This many failed replays on one support, with none that reaches the goal, are no accident: if three
/// in four reached it, one plan in 250 would show that.
const NEVER: usize = 4;

/// What a replay changes against the task as written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Disturbance {
    /// Nothing.
    Nominal,
    /// Where objects start and every friction value, slightly and at random.
    Disturbed {
        /// Number of the draw, from 1; the same for the same seed in both engines.
        draw: usize,
    },
}

/// One replay of a plan in an engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evidence {
    /// Which engine.
    pub engine: Engine,
    /// What was changed against the task as written.
    pub disturbance: Disturbance,
    /// Where it ended.
    pub outcome: Outcome,
    /// What happened on the way that a reader should know.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Warning>,
    /// How hard the tool pressed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force: Option<Force>,
    /// What happened frame by frame, of a nominal replay. Not written to files, as replaying the
    /// plan gives it again.
    #[serde(skip)]
    pub trajectory: Option<Trajectory>,
}

impl Evidence {
    /// What went wrong on the way, so that the end does not count.
    pub fn fault(&self) -> Option<&Warning> {
        self.warnings.iter().find(|warning| warning.forbids_success())
    }
}

/// Why a plan does not pass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// The plan does what its task does not allow.
    Forbidden(Warning),
    /// Something goes wrong on the way when it is replayed as written.
    GoesWrong {
        /// In which engine.
        engine: Engine,
        /// What.
        fault: Warning,
    },
    /// The object misses the goal when the plan is replayed as written.
    Misses {
        /// In which engine.
        engine: Engine,
        /// By how much, metres.
        error: f64,
        /// By how much it is turned, radians, where a heading is asked for.
        heading_error: Option<f64>,
    },
    /// It works as written, but too seldom when starts and frictions are a little different.
    Fragile {
        /// In which engine more of the replays fail.
        engine: Engine,
        /// Disturbed replays that reach the goal there, of how many.
        reached: usize,
        /// How many were made there.
        replays: usize,
        /// Share that was asked for.
        wanted: f64,
    },
    /// It works as written, but never where objects rest on the table in a way that is as plausible.
    NeverOn {
        /// In which engine.
        engine: Engine,
        /// What they rest on then.
        support: Support,
        /// How many replays were made so.
        replays: usize,
    },
}

/// Whether a plan works, with the evidence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Passed: the plan breaks no rule of its task, its replays as written reach the goal at rest
    /// in both engines, and in each engine so does the wanted share of the disturbed ones.
    pub passed: bool,
    /// Why not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<Reason>,
    /// What the plan does that its task does not allow, whatever it leads to.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub forbidden: Vec<Warning>,
    /// All replays, nominal ones first.
    pub evidence: Vec<Evidence>,
    /// Share of the disturbed replays that reach the goal, 0 to 1, in the engine in which fewer
    /// do; `None` if none was made.
    pub robustness: Option<f64>,
}

impl Verdict {
    /// The verdict on a plan that does what is `forbidden`, by its replays, `wanted` being the
    /// share of the disturbed ones that must reach the goal.
    pub fn judge(forbidden: Vec<Warning>, evidence: Vec<Evidence>, wanted: f64) -> Self {
        let mut verdict =
            Self { passed: false, reason: None, forbidden, evidence, robustness: None };
        let shares = Engine::ALL.map(|engine| verdict.share(engine));
        verdict.robustness = shares.iter().flatten().map(|share| share.2).reduce(f64::min);
        verdict.reason = verdict.find_reason(wanted);
        verdict.passed = verdict.reason.is_none();
        verdict
    }

    /// Whether the plan works as written, though perhaps too seldom under disturbances.
    pub fn works(&self) -> bool {
        matches!(self.reason, None | Some(Reason::Fragile { .. } | Reason::NeverOn { .. }))
    }

    /// Whether a replay was stopped before it was over, so that the verdict says nothing.
    pub fn was_stopped(&self) -> bool {
        self.evidence.iter().any(|evidence| evidence.warnings.contains(&Warning::Stopped))
    }

    /// The replay as written in an engine.
    pub fn nominal(&self, engine: Engine) -> Option<&Evidence> {
        self.of(engine).find(|evidence| evidence.disturbance == Disturbance::Nominal)
    }

    /// The disturbed replays in an engine, in the order of their draws.
    pub fn disturbed(&self, engine: Engine) -> impl Iterator<Item = &Evidence> + Clone {
        self.of(engine).filter(|evidence| evidence.disturbance != Disturbance::Nominal)
    }

    fn of(&self, engine: Engine) -> impl Iterator<Item = &Evidence> + Clone {
        self.evidence.iter().filter(move |evidence| evidence.engine == engine)
    }

    /// Disturbed replays in an engine that reach the goal, all of them, and the share.
    fn share(&self, engine: Engine) -> Option<(usize, usize, f64)> {
        let replays = self.disturbed(engine).count();
        let reached = self.disturbed(engine).filter(|evidence| evidence.outcome.reached).count();
        (replays > 0).then(|| (reached, replays, reached as f64 / replays as f64))
    }

    fn find_reason(&self, wanted: f64) -> Option<Reason> {
        if let Some(forbidden) = self.forbidden.first() {
            return Some(Reason::Forbidden(forbidden.clone()));
        }
        // The 3-D engine first: it sees what the planar one cannot.
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

    /// A support on which no replay reaches the goal. Lever-ups have none: the planar engine does not replay
    /// them, and their supports are not disturbed.
    fn never_on(&self) -> Option<Reason> {
        self.nominal(Engine::Planar)?;
        [Engine::Spatial, Engine::Planar].into_iter().find_map(|engine| {
            let (support, replays) = never_on(self.disturbed(engine))?;
            Some(Reason::NeverOn { engine, support: support.clone(), replays })
        })
    }
}

/// A support on which none of these disturbed replays in one engine reaches the goal, and how many they
/// are, where there are enough of them to rule out chance.
pub fn never_on<'a>(
    replays: impl Iterator<Item = &'a Evidence> + Clone,
) -> Option<(&'static Support, usize)> {
    let on = |support| {
        replays.clone().filter(move |evidence| match evidence.disturbance {
            Disturbance::Disturbed { draw } => Physics::doubted(draw - 1) == Some(support),
            Disturbance::Nominal => false,
        })
    };
    let supports = Physics::PLAUSIBLE_SUPPORTS.iter();
    let mut counted = supports.map(|support| (support, on(support).count()));
    counted.find(|(support, count)| *count >= NEVER && !on(support).any(|one| one.outcome.reached))
}
