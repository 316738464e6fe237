//! Playback of a tool motion in a world of either engine, frame by frame, with recording.
//!
//! Every frame is divided into equal steps no longer than the engine's, so that the tool travels
//! exactly as in the motion. At the start of each frame the tool is set exactly to the pose of the
//! motion, so that rounding errors do not accumulate.

use crate::geometry::Pose;
use crate::{
    outcome::{Contact, Frame, ObjectRules, Record, Trajectory, Warning},
    scene::{Body, ModelSpec, Scene, State},
    task::{COAST_FRAME, FrameStep, Job, MAX_COAST_FRAMES, ToolMotion},
};

use crate::progress::Progress;

use super::Simulator;
use super::violations::{Overlap, Violations};
use super::world::World;

/// Factor by which the steps of an accelerated frame are finer.
const FINER: f64 = 4.0;

/// Maximum factor by which a frame is accelerated.
const MOST_HURRIED: f64 = 100.0;

/// Speed relative to the tool above which an object is not carried by it.
const CARRIED: f64 = 3.0;

/// A pushing arm: it stops where it cannot continue, and motions impossible for rigid bodies are
/// never excused.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Arm {
    /// Maximum lasting force, newtons; `None` for no limit.
    pub max_force: Option<f64>,
}

impl Arm {
    /// Returns a warning if the force exceeds the arm's limit.
    fn gives_up(&self, violations: &Violations) -> Option<Warning> {
        let (needed, limit) = (violations.force().lasting, self.max_force?);
        (needed > limit).then_some(Warning::TooMuchForce { object: None, needed, limit })
    }
}

/// Plays `job` in a world `W` with the simulator's steps; with an `arm`, until it cannot continue.
pub(super) fn playback<W: World>(
    scene: &Scene,
    job: &Job,
    simulator: &Simulator,
    record: Record,
    (arm, progress): (Option<&Arm>, &dyn Progress),
) -> Trajectory {
    let Job { start, motion, physics } = job;
    let motion = motion.slide();
    let step = simulator.step();
    let tool = motion.strokes.first().map_or(Pose::default(), |stroke| stroke.from);
    let mut recorder = Recorder::new(simulator.spec(), record, start, tool);
    recorder.violations = Violations::new(scene, arm.is_some());
    if !start.is_finite() {
        recorder.trajectory.warnings.push(Warning::NotFinite);
        return recorder.finish(scene, motion);
    }
    let rules = ObjectRules::of(scene).starting(start);
    let mut world = W::build(scene, start, physics, motion, &tool);
    let mut time = 0.0;
    for (index, stroke) in motion.strokes.iter().enumerate() {
        let lifted = index > 0 && motion.strokes[index - 1].settle;
        if lifted && world.toppled().is_empty() {
            // A fresh world, so that a continuation from a recorded rest equals an uninterrupted
            // computation. A planar state cannot describe an object on its side, so such objects
            // stay in the old world, and the tool jumps there.
            world = W::build(scene, &world.state(), physics, motion, &stroke.from);
            recorder.violations.begin();
        }
        if index == 0 || lifted {
            let below = motion.set_down_on(scene, &recorder.last().state, index);
            let name = |object: usize| scene.thing_name(object).to_owned();
            let warnings: Vec<Warning> = below
                .map(|object| Warning::SetDownOn { object: name(object), stroke: index })
                .collect();
            let stands = arm.is_some() && !warnings.is_empty();
            recorder.trajectory.warnings.extend(warnings);
            if stands {
                return recorder.finish(scene, motion);
            }
        }
        let mut go = |frame: &FrameStep, world: &mut W, recorder: &mut Recorder| {
            let played = play(world, frame, step, recorder);
            time += played.share * frame.duration;
            let tool = frame.from.towards(&frame.to, played.share);
            let recorded = recorder.record(world, time, index, tool);
            let broken = rules.broken(&recorder.last().state);
            let jam = played.jam.map(|jam| jammed(scene, motion, jam));
            let weak = arm.and_then(|arm| {
                arm.gives_up(&recorder.violations)
                    .or_else(|| recorder.violations.too_hard(scene).next())
            });
            let stopped = || progress.cancelled().then_some(Warning::Stopped);
            let ends = jam.or(broken).or(weak).or_else(stopped);
            let goes_on = recorded && ends.is_none();
            recorder.trajectory.warnings.extend(ends);
            goes_on
        };
        let back = motion.retreat(scene, index).filter(|_| simulator.retreats());
        for part in std::iter::once(*stroke).chain(back) {
            for k in 0..part.frames() {
                if !go(&part.frame(k), &mut world, &mut recorder) {
                    return recorder.finish(scene, motion);
                }
            }
            let still = FrameStep { from: part.to, to: part.to, duration: COAST_FRAME };
            let mut waited = 0;
            while part.settle && !scene.is_resting(&recorder.last().state) {
                if waited == MAX_COAST_FRAMES {
                    let waited = waited as f64 * COAST_FRAME;
                    recorder.trajectory.warnings.push(Warning::NotAtRest { waited });
                    break;
                }
                waited += 1;
                if !go(&still, &mut world, &mut recorder) {
                    return recorder.finish(scene, motion);
                }
            }
        }
    }
    recorder.note_hanging(scene, &world);
    recorder.finish(scene, motion)
}

/// The result of a frame.
struct Played {
    /// Share of the frame that was played; 1 without a jam.
    share: f64,
    /// The jam that ended the frame, if any.
    jam: Option<Overlap>,
}

/// Plays one frame in equal steps, until an object jams.
fn play<W: World>(
    world: &mut W,
    frame: &FrameStep,
    longest: f64,
    recorder: &mut Recorder,
) -> Played {
    let hurry = hurry(world, frame);
    let longest = if hurry > 1.0 { longest / FINER } else { longest };
    let frame = &FrameStep { duration: frame.duration / hurry, ..*frame };
    // The small offset gives 0.1 / (1 / 240) twenty-four steps under any rounding.
    let steps = (frame.duration / longest - 1e-9).ceil().max(1.0);
    let step = frame.duration / steps;
    // A jump has no duration, so nothing happens in it; the next frame starts at its end.
    if !(step > 0.0 && step.is_finite()) {
        return Played { share: 1.0, jam: None };
    }
    world.hurry(hurry);
    world.begin_frame(frame, step);
    let mut played = Played { share: 1.0, jam: None };
    for k in 1..=steps as usize {
        world.step();
        if recorder.record == Record::Frames {
            recorder.note_contacts(world);
        }
        if let Some(jam) = recorder.violations.look(world) {
            played = Played { share: k as f64 / steps, jam: Some(jam) };
            break;
        }
    }
    world.hurry(1.0 / hurry);
    played
}

/// Returns the factor by which a frame may be accelerated, see [`World::SLOWEST`]: 1 while an
/// object still moves by itself.
fn hurry<W: World>(world: &W, frame: &FrameStep) -> f64 {
    let travel = (frame.to.position - frame.from.position).norm();
    let speed = travel / frame.duration;
    if !(speed > 0.0 && speed < W::SLOWEST) {
        return 1.0;
    }
    let state = world.state();
    let fastest =
        state.velocities.iter().map(|velocity| velocity.linear.norm()).fold(0.0, f64::max);
    if fastest > CARRIED * speed { 1.0 } else { (W::SLOWEST / speed).min(MOST_HURRIED) }
}

/// Returns the warning about a jammed object.
fn jammed(scene: &Scene, motion: &ToolMotion, jam: Overlap) -> Warning {
    let against = match jam.with {
        Body::Object(index) => scene.thing_name(index).to_owned(),
        Body::Obstacle(index) => scene.obstacles[index].name.clone(),
        Body::Part(index) => format!("{}/{}", motion.tool.name, motion.tool.outline()[index].name),
    };
    let object = scene.thing_name(jam.object).to_owned();
    Warning::Jammed { object, against, depth: jam.depth }
}

/// A recorder of the growing trajectory.
struct Recorder {
    record: Record,
    trajectory: Trajectory,
    /// Number of recorded frames, kept or not.
    seen: usize,
    /// Objects that have toppled, in order.
    toppled: Vec<usize>,
    violations: Violations,
}

impl Recorder {
    fn new(by: ModelSpec, record: Record, start: &State, tool: Pose) -> Self {
        let trajectory = Trajectory::standing(by, tool, start.clone());
        Self { record, trajectory, seen: 1, toppled: Vec::new(), violations: Violations::default() }
    }

    fn finish(mut self, scene: &Scene, motion: &ToolMotion) -> Trajectory {
        let toppled = self
            .toppled
            .iter()
            .map(|&index| &scene.objects[index])
            .filter(|object| !object.may_fall && !object.is_part())
            .map(|object| Warning::Toppled { object: object.name.clone() });
        self.trajectory.warnings.extend(toppled);
        let fallen = scene.fallen(self.trajectory.outcome(), &self.toppled);
        self.trajectory.warnings.extend(fallen);
        // Warnings that stopped an arm are already in the list.
        let harmed: Vec<Warning> = self.violations.too_hard(scene).collect();
        let warnings = &mut self.trajectory.warnings;
        warnings
            .extend(harmed.into_iter().filter(|one| !warnings.contains(one)).collect::<Vec<_>>());
        self.trajectory.force = Some(self.violations.force());
        self.trajectory.resolve_parts(scene, &motion.tool);
        self.trajectory
    }

    fn last(&self) -> &Frame {
        &self.trajectory.frames[self.trajectory.frames.len() - 1]
    }

    /// Records the world's state as the end of a frame; returns `false` if it is not finite.
    fn record<W: World>(&mut self, world: &W, time: f64, stroke: usize, tool: Pose) -> bool {
        let state = world.state();
        if !state.is_finite() {
            self.trajectory.warnings.push(Warning::NotFinite);
            return false;
        }
        for object in world.toppled() {
            if !self.toppled.contains(&object) {
                self.toppled.push(object);
            }
        }
        let frame = Frame { time, stroke, tool, state, blade: None };
        match self.record {
            Record::Frames => self.trajectory.frames.push(frame),
            Record::Outcome => self.trajectory.frames[0] = frame,
        }
        self.seen += 1;
        true
    }

    /// Adds warnings for objects that have left the table but have not fallen.
    fn note_hanging<W: World>(&mut self, scene: &Scene, world: &W) {
        let state = &self.last().state;
        let hangs = |k: usize| scene.has_left(k, state) && world.has_fallen(k) == Some(false);
        let found = scene.things().filter(|(k, _)| hangs(*k));
        let found = found.map(|(_, object)| Warning::Hangs { object: object.name.clone() });
        let found: Vec<Warning> = found.collect();
        self.trajectory.warnings.extend(found);
    }

    fn note_contacts<W: World>(&mut self, world: &W) {
        let frame = self.seen;
        let contacts = &mut self.trajectory.contacts;
        world.touches(&mut |object, with| {
            if !contacts.iter().any(|known| known.object == object && known.with == with) {
                contacts.push(Contact { frame, object, with });
            }
        });
    }
}
