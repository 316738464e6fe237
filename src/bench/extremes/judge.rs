//! Judging a cell: the model against the planar engine, and the engine against itself.
//!
//! A push is *wrong* when its error exceeds [`TIMES_P95`] times the 95th percentile of ordinary
//! pushes of its kind and [`SHARE`] of the true motion, and also [`TIMES_OWN`] times the truth's
//! own uncertainty: what it changes by when the time step is halved or the start shifted by 0.1
//! mm. An error within that uncertainty is *undecided*. A cell is wrong (or undecided) when more
//! than [`PUSHES`] of its pushes are; single pushes beyond the rule occur among ordinary ones,
//! too.

use rayon::prelude::*;
use serde_json::Value as Json;

use crate::{
    bench::suite::Case,
    bench::{heldout::DISTURBANCE, statistics::Summary},
    dataset::generator,
    effect::EffectModel,
    geometry::{Vector, wrap_angle},
    scene::{
        Body, COAST_FRAME, Job, MAX_COAST_FRAMES, Record, Scene, State, ToolMotion, Trajectory,
        Warning,
    },
    sim::Simulator,
};

use super::{
    cell::Cell,
    report::{ExtremeCell, ExtremeKind, ExtremeYardstick, Verdict},
};

/// Times the 95th percentile of ordinary errors of the kind.
pub(super) const TIMES_P95: f64 = 3.0;

/// Share of the true motion.
pub(super) const SHARE: f64 = 0.05;

/// Times the truth's own uncertainty.
pub(super) const TIMES_OWN: f64 = 3.0;

/// Share of a cell's pushes.
pub(super) const PUSHES: f64 = 0.10;

/// An object that ends farther from its start than this many times what the tool covers, while
/// it moves and while the object may coast at its speed, has been thrown. Joints make levers.
const THROWN: f64 = 5.0;

/// One push, measured.
pub(super) struct Measured {
    finite: bool,
    bounded: bool,
    motion: f64,
    error: f64,
    own: f64,
    /// Whether an object truly touches the tool and an obstacle.
    crushed: bool,
    warnings: Vec<Warning>,
}

/// Measures the ordinary pushes of a kind; nothing if none has a finite answer.
pub(super) fn yardstick(
    model: &dyn EffectModel,
    kind: ExtremeKind,
    cases: &[Case],
) -> Option<ExtremeYardstick> {
    let measured = measure_all(model, cases);
    let error = Summary::of(&finite(&measured, |one| one.error))?;
    let motion = Summary::of(&finite(&measured, |one| one.motion))?;
    let wrong = measured.iter().filter(|one| one.is_wrong(error.p95)).count();
    let wrong = wrong as f64 / measured.len().max(1) as f64;
    Some(ExtremeYardstick { kind, error, motion, wrong })
}

/// Measures and judges a cell.
pub(super) fn judge(model: &dyn EffectModel, cell: &Cell, p95: f64) -> ExtremeCell {
    let measured = measure_all(model, &cell.cases);
    let count = |what: &dyn Fn(&Measured) -> bool| measured.iter().filter(|one| what(one)).count();
    let pushes = measured.len();
    let (finite_ones, bounded) = (count(&|one| one.finite), count(&|one| one.bounded));
    let wrong = count(&|one| one.is_wrong(p95));
    let undecided = count(&|one| one.is_undecided(p95));
    let flagged = count(&Measured::is_flagged);
    let silent = count(&|one| one.is_wrong(p95) && !one.is_flagged());
    let many = |count: usize| count as f64 > PUSHES * pushes as f64;
    let verdict = if finite_ones < pushes || bounded < pushes || many(silent) {
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
    ExtremeCell {
        factor: cell.factor.into(),
        value: cell.value.clone(),
        kind: cell.kind,
        pushes,
        finite: finite_ones,
        bounded,
        motion: Summary::of(&finite(&measured, |one| one.motion)),
        error: Summary::of(&finite(&measured, |one| one.error)),
        own: Summary::of(&finite(&measured, |one| one.own)),
        wrong,
        undecided,
        flagged,
        silent,
        warnings,
        doubt: cell.doubt.map(|doubt| doubt.why.to_owned()),
        verdict,
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

fn finite(measured: &[Measured], value: impl Fn(&Measured) -> f64) -> Vec<f64> {
    measured.iter().map(value).filter(|value| value.is_finite()).collect()
}

fn measure_all(model: &dyn EffectModel, cases: &[Case]) -> Vec<Measured> {
    cases.par_iter().enumerate().map(|(index, case)| measure(model, case, index)).collect()
}

fn measure(model: &dyn EffectModel, case: &Case, index: usize) -> Measured {
    let Case { scene, motion } = case;
    let start = scene.start();
    let job = Job::stated(scene, motion.clone());
    let mut warnings = model.warnings(scene, motion);
    let predicted =
        model.rollout(scene, std::slice::from_ref(&job), Record::Frames).pop().unwrap_or_default();
    warnings.extend(predicted.warnings.iter().cloned());

    let run = |simulator: Simulator, start: &State| {
        let job = Job { start: start.clone(), ..job.clone() };
        simulator.run(scene, &job, Record::Outcome)
    };
    let truth = run(Simulator::planar(), &start);
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
    let crushed = (0..scene.objects.len()).any(|k| touches(k, false) && touches(k, true));
    let finer = run(Simulator::planar_with_step(0.5 * Simulator::planar().step()), &start);
    let beside = run(Simulator::planar(), &disturbed(&start, index));
    let own = apart(scene, truth.outcome(), finer.outcome());
    let own = own.max(apart(scene, truth.outcome(), beside.outcome()));
    let unsettled = |run: &Trajectory| {
        let lost = |w: &Warning| matches!(w, Warning::NotFinite | Warning::NotAtRest { .. });
        run.warnings.iter().any(lost)
    };
    let own = if unsettled(&truth) { f64::INFINITY } else { own };

    let finite = !predicted.frames.is_empty()
        && predicted.frames.iter().all(|frame| frame.state.is_finite())
        && !predicted.warnings.contains(&Warning::NotFinite);
    let limit = THROWN * covered(motion);
    let near = |state: &State| farthest(&start, state) <= limit;
    let bounded = finite && predicted.frames.iter().all(|frame| near(&frame.state));
    let error = predicted
        .frames
        .last()
        .map_or(f64::NAN, |frame| apart(scene, &frame.state, truth.outcome()));
    Measured {
        finite,
        bounded,
        motion: apart(scene, &start, truth.outcome()),
        error,
        own,
        crushed,
        warnings,
    }
}

/// Every object's start shifted by [`DISTURBANCE`] in a random direction.
fn disturbed(start: &State, index: usize) -> State {
    let mut rng = generator(0xD157, index as u64);
    let mut state = start.clone();
    for pose in &mut state.poses {
        let angle = rand::Rng::random_range(&mut rng, 0.0..std::f64::consts::TAU);
        pose.position += DISTURBANCE * Vector::new(angle.cos(), angle.sin());
    }
    state
}

/// How far the object that is farthest off is off, metres: its centre's distance and, for a
/// cuboid, the turn times the mean radius, added as squares.
fn apart(scene: &Scene, one: &State, other: &State) -> f64 {
    let pairs = one.poses.iter().zip(&other.poses);
    let off = scene.objects.iter().zip(pairs).map(|(object, (a, b))| {
        let turn = wrap_angle(a.heading - b.heading);
        let rim = object.shape.footprint().mean_radius() * turn;
        let rim = if object.shape.is_cylinder() { 0.0 } else { rim };
        (a.position - b.position).norm().hypot(rim)
    });
    largest(off)
}

fn farthest(start: &State, state: &State) -> f64 {
    let pairs = start.poses.iter().zip(&state.poses);
    largest(pairs.map(|(a, b)| (a.position - b.position).norm()))
}

/// The largest, undefined if any is.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most, value| if value.is_nan() || value > most { value } else { most })
}

/// Length of the way of the tool's farthest point, and of what slides on at its greatest speed
/// until waiting is given up, metres.
fn covered(motion: &ToolMotion) -> f64 {
    let parts = motion.tool.parts.iter();
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
    // A tool set down into an object pushes it out by at most its own size.
    way + speed * MAX_COAST_FRAMES as f64 * COAST_FRAME + reach
}

/// A warning without its numbers and names.
fn brief(warning: &Warning) -> String {
    if let Warning::OutsideTraining { quantity, .. } = warning {
        return format!("outside: {quantity}");
    }
    // The name of the kind, as files have it.
    match serde_json::to_value(warning) {
        Ok(Json::String(kind)) => kind.replace('_', " "),
        Ok(Json::Object(map)) => map.keys().map(|kind| kind.replace('_', " ")).collect(),
        _ => warning.to_string(),
    }
}
