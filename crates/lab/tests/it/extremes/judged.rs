//! Judgement of a cell: the model against the 2-D engine, and the engine against itself.
//!
//! A push is *wrong* when its error exceeds three bounds: [`TIMES_P95`] times the 95th percentile
//! of ordinary pushes of its kind, [`SHARE`] of the true motion, and [`TIMES_OWN`] times the
//! uncertainty of the ground truth. This uncertainty is the change of its motion with half the time
//! step or the start shifted by 0.1 mm. An error within that uncertainty is *undecided*. A cell is
//! wrong (or undecided) when more than [`PUSHES`] of its pushes are, because single pushes beyond
//! the rule also occur among ordinary ones.

use std::num::NonZeroU16;

use pushplan::{
    effect::{EffectModel, shifted_start},
    geometry::Pose,
    outcome::{Record, Trajectory, Warning},
    scene::{Body, Engine, Physics, Rate, Scene, State},
    seeded::generator,
    sim::Simulator,
    task::{COAST_FRAME, Job, MAX_COAST_FRAMES, ToolMotion},
};
use pushplan_act::judge::{Comparison, Summary, Trial, object_errors};
use pushplan_lab::bench::{Case, PERTURBATION};
use rayon::prelude::*;
use serde_json::Value as Json;

use super::cell::{Cell, Kind};

/// Factor on the 95th percentile of ordinary errors of the kind.
const TIMES_P95: f64 = 3.0;

/// Share of the true motion.
const SHARE: f64 = 0.05;

/// Twice the step rate of the ground truth.
const TWICE: Rate = Rate(Rate::DEFAULT.0.saturating_mul(NonZeroU16::MIN.saturating_add(1)));

/// Factor on the uncertainty of the ground truth.
const TIMES_OWN: f64 = 3.0;

/// Share of a cell's pushes.
const PUSHES: f64 = 0.10;

/// Factor on the travel of the tool, including coasting at its speed, beyond which an object has
/// been thrown. The factor is above one because joints make levers.
const THROWN: f64 = 5.0;

/// Verdict on a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Right, and no warning.
    Right,
    /// Right, but the model warned, because its accuracy was unknown.
    RightFlagged,
    /// Wrong, and the model warned.
    WrongFlagged,
    /// The 2-D engine itself cannot be trusted, and the model warned.
    Undecided,
    /// Wrong or undecided without a warning, not finite or not bounded.
    Defect,
}

/// Errors of the ordinary pushes of a kind, the reference for the extremes.
#[derive(Clone, Debug, PartialEq)]
pub struct Yardstick {
    pub kind: Kind,
    /// Largest error of a push, metres.
    pub error: Summary,
    /// Largest motion of a push, metres.
    pub motion: Summary,
    /// Share of pushes judged wrong.
    pub wrong: f64,
}

/// Result of a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    pub pushes: usize,
    /// Number of pushes with a finite answer in every frame.
    pub finite: usize,
    /// Number of pushes in which all motion was within the tool's means.
    pub bounded: usize,
    /// Largest true motion of a push, metres.
    pub motion: Option<Summary>,
    /// Largest error of a push, metres.
    pub error: Option<Summary>,
    /// Differences of the 2-D engine from itself, metres.
    pub own: Option<Summary>,
    /// Number of pushes judged wrong.
    pub wrong: usize,
    /// Number of pushes for which the uncertainty of the ground truth exceeds the rule's bound.
    pub undecided: usize,
    /// Number of pushes with a warning.
    pub flagged: usize,
    /// Distinct warnings.
    pub warnings: Vec<String>,
    pub verdict: Verdict,
}

/// Result of a push.
struct Measured {
    finite: bool,
    bounded: bool,
    motion: f64,
    error: f64,
    own: f64,
    /// Whether an object truly touches the tool and an obstacle.
    crushed: bool,
    warnings: Vec<Warning>,
}

impl Yardstick {
    /// Measures the ordinary pushes of a kind.
    pub fn of(model: &dyn EffectModel, kind: Kind, cases: &[Case]) -> Self {
        let measured = measure_all(model, cases);
        let error = summary(&measured, |one| one.error).expect("finite answers");
        let motion = summary(&measured, |one| one.motion).expect("finite truths");
        let wrong = measured.iter().filter(|one| one.is_wrong(error.p95)).count();
        let wrong = wrong as f64 / measured.len() as f64;
        Self { kind, motion, error, wrong }
    }
}

impl Judged {
    /// Measures and judges a cell by the yardsticks of all kinds.
    pub fn of(model: &dyn EffectModel, cell: &Cell, yardsticks: &[Yardstick]) -> Self {
        let kind = yardsticks.iter().find(|stick| stick.kind == cell.kind);
        let p95 = kind.expect("a yardstick of every kind").error.p95;
        let measured = measure_all(model, &cell.cases);
        let count = |is: &dyn Fn(&Measured) -> bool| measured.iter().filter(|one| is(one)).count();
        let pushes = measured.len();
        let (finite, bounded) = (count(&|one| one.finite), count(&|one| one.bounded));
        let wrong = count(&|one| one.is_wrong(p95));
        let undecided = count(&|one| one.is_undecided(p95));
        let flagged = count(&Measured::is_flagged);
        let silent = count(&|one| one.is_wrong(p95) && !one.is_flagged());
        let many = |count: usize| count as f64 > PUSHES * pushes as f64;
        let verdict = if finite < pushes || bounded < pushes || many(silent) {
            Verdict::Defect
        } else if let Some(doubt) = cell.doubt {
            let needs = |one: &Measured| one.crushed || !doubt.crushed;
            let unsaid = count(&|one| needs(one) && !one.is_flagged());
            if unsaid > 0 { Verdict::Defect } else { Verdict::Undecided }
        } else if many(wrong) {
            Verdict::WrongFlagged
        } else if many(undecided) {
            Verdict::Undecided
        } else if flagged > 0 {
            Verdict::RightFlagged
        } else {
            Verdict::Right
        };
        let mut warnings: Vec<String> =
            measured.iter().flat_map(|one| &one.warnings).map(brief).collect();
        warnings.sort();
        warnings.dedup();
        Self {
            pushes,
            finite,
            bounded,
            motion: summary(&measured, |one| one.motion),
            error: summary(&measured, |one| one.error),
            own: summary(&measured, |one| one.own),
            wrong,
            undecided,
            flagged,
            warnings,
            verdict,
        }
    }
}

impl Measured {
    fn is_flagged(&self) -> bool {
        !self.warnings.is_empty()
    }

    fn is_off(&self, p95: f64) -> bool {
        self.error.is_nan() || self.error > (TIMES_P95 * p95).max(SHARE * self.motion)
    }

    fn is_wrong(&self, p95: f64) -> bool {
        self.is_off(p95) && (self.error.is_nan() || self.error > TIMES_OWN * self.own)
    }

    fn is_undecided(&self, p95: f64) -> bool {
        self.is_off(p95) && !self.is_wrong(p95)
    }
}

/// Summarises the finite values.
fn summary(measured: &[Measured], value: impl Fn(&Measured) -> f64) -> Option<Summary> {
    let values = measured.iter().map(value).filter(|value| value.is_finite());
    Summary::of(&values.collect::<Vec<f64>>())
}

fn measure_all(model: &dyn EffectModel, cases: &[Case]) -> Vec<Measured> {
    cases.par_iter().enumerate().map(|(index, case)| measure(model, case, index)).collect()
}

fn measure(model: &dyn EffectModel, Case { scene, motion }: &Case, index: usize) -> Measured {
    let job = Job::stated(scene, motion.clone());
    let start = &job.start;
    // Contacts are recorded only with frames.
    let run = |simulator: Simulator, job: &Job| simulator.run(scene, job, Record::Frames);
    let truth = run(Simulator::planar(), &job);
    let poses = &truth.outcome().poses;
    let finer = run(Simulator::new(Engine::Planar, TWICE), &job);
    // Every object is shifted alone, so that joints are strained as well.
    let loose = Physics { joints: Vec::new(), ..Physics::clone(&job.physics) };
    let mut rng = generator(0xD157, index as u64);
    let shifted = shifted_start(start, &loose, PERTURBATION, &mut rng);
    let beside = run(Simulator::planar(), &Job { start: shifted, ..job.clone() });

    let trial = Trial::to_rest(scene.clone(), motion.clone(), poses.clone());
    let rolled = model.rollout(scene, std::slice::from_ref(&job), Record::Frames).pop();
    let compared = Comparison::new(&trial, rolled.expect("a trajectory for a job"));
    let predicted = compared.predicted();
    let mut warnings = model.trust(scene, &job).warnings();
    warnings.extend(predicted.warnings.iter().cloned());
    let own = [&finer, &beside].map(|run| apart(scene, start, &run.outcome().poses, poses));
    let unsettled = |run: &Trajectory| {
        let lost = |w: &Warning| matches!(w, Warning::NotFinite | Warning::NotAtRest { .. });
        run.warnings.iter().any(lost)
    };

    let finite = compared.is_finite() && predicted.frames.iter().all(|f| f.state.is_finite());
    let limit = THROWN * covered(motion);
    let near = |state: &State| {
        let pairs = start.poses.iter().zip(&state.poses);
        largest(pairs.map(|(a, b)| (a.position - b.position).norm())) <= limit
    };
    Measured {
        finite,
        bounded: finite && predicted.frames.iter().all(|frame| near(&frame.state)),
        motion: apart(scene, start, &start.poses, poses),
        error: predicted
            .frames
            .last()
            .map_or(f64::NAN, |frame| apart(scene, start, &frame.state.poses, poses)),
        own: if unsettled(&truth) { f64::INFINITY } else { own[0].max(own[1]) },
        crushed: crushed(scene, &truth),
        warnings,
    }
}

/// Returns the largest error of an object, metres. The error is the distance of its centre and, for
/// a cuboid, the rotation times the mean radius, added as squares.
fn apart(scene: &Scene, start: &State, predicted: &[Pose], truth: &[Pose]) -> f64 {
    let errors = object_errors(scene, &start.poses, Some(predicted), truth);
    largest(errors.iter().zip(&scene.objects).map(|(error, object)| {
        let rim = object.shape.footprint().mean_radius() * error.heading.unwrap_or(0.0);
        error.position.hypot(rim)
    }))
}

/// Returns the largest value, or NaN if any is NaN.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most, value| if value.is_nan() || value > most { value } else { most })
}

/// Returns `true` if an object touches the tool and an obstacle.
fn crushed(scene: &Scene, truth: &Trajectory) -> bool {
    let touches = |object: usize, obstacle: bool| {
        truth.contacts.iter().any(|contact| {
            contact.object == object
                && match contact.with {
                    Body::Part(_) => !obstacle,
                    Body::Obstacle(_) => obstacle,
                    Body::Object(_) => false,
                }
        })
    };
    (0..scene.objects.len()).any(|k| touches(k, false) && touches(k, true))
}

/// Returns the path length of the tool's farthest point, plus the maximum coasting distance of an
/// object at its greatest speed, metres.
fn covered(motion: &ToolMotion) -> f64 {
    let parts = motion.tool.parts().iter();
    let reach = parts
        .map(|part| part.pose.position.norm() + part.footprint().bounding_radius())
        .fold(0.0, f64::max);
    let ways = || {
        motion.strokes.iter().map(|stroke| {
            let turn = (stroke.to.heading - stroke.from.heading).abs();
            (stroke.travel() + turn * reach, stroke.duration)
        })
    };
    let way: f64 = ways().map(|(way, _)| way).sum();
    let speed = ways().map(|(way, time)| way / time).fold(0.0, f64::max);
    // A tool placed in an object pushes it out by at most its own size.
    way + speed * MAX_COAST_FRAMES as f64 * COAST_FRAME + reach
}

/// Returns a warning without its numbers and names.
fn brief(warning: &Warning) -> String {
    if let Warning::OutsideRange { quantity, .. } = warning {
        return format!("outside: {quantity}");
    }
    // Name of the kind, as in files.
    match serde_json::to_value(warning) {
        Ok(Json::String(kind)) => kind.replace('_', " "),
        Ok(Json::Object(map)) => map.keys().map(|kind| kind.replace('_', " ")).collect(),
        _ => warning.to_string(),
    }
}
