//! Playback of consecutive spatial motions in one world: rotation, hold and retreat of lever-ups,
//! and pushes, each until everything rests.

use std::sync::Arc;

use crate::geometry::{Pose, Pose3, Vector};
use crate::progress::Progress;
use crate::{
    outcome::{
        Ending, Frame, LEVER_FRAMES, LeverTrajectory, LeverWarning, Lift, ObjectRules, Trajectory,
        Warning, has_slipped,
    },
    scene::{Blade, GRAVITY, LeverScene, Plate, REST_SPEED, State},
    task::{LeverJob, LeverUp, Motion, Stroke, ToolMotion, lever_frame},
};

use super::super::spatial::TOPPLED;
use super::super::violations::Violations;
use super::scenery::Scenery;
use super::world::LeverWorld;

/// Force on the blade, beyond twice the plates' weight, from which on it is jammed, newtons.
/// Lifting takes less than the weight; a blade driven into a body soon takes hundreds.
const JAM: f64 = 30.0;

/// Number of consecutive steps after which a force counts as lasting; touches end after one or two.
const LASTING: usize = 3;

/// Maximum time of waiting for rest, seconds. None of thousands of plates took that long.
const PATIENCE: f64 = 4.0;

/// Time of slow motion that counts as rest, seconds; a plate on edge is slow for a moment.
const STILL: f64 = 0.1;

/// Recorded frames, each with the force on blade or tool during the last step, newtons.
pub(super) struct Film {
    pub frames: Vec<(Frame, f64)>,
    /// Time between two frames, seconds.
    pub interval: f64,
}

/// Plays the lever-up of a job of a data set in steps of at most `longest` seconds.
pub(super) fn play(
    job: &LeverJob,
    planned: &LeverScene,
    longest: f64,
    film: Option<Film>,
) -> (LeverTrajectory, Vec<(Frame, f64)>) {
    let planned_plates = planned.plates.clone();
    let scenery = Arc::new(Scenery { planned: planned_plates, ..Scenery::of_job(job) });
    let (plate, blades) = (job.lever.plate, [job.scene.blade, planned.blade]);
    let mut game = Game::new(&scenery, Some((&job.lever, blades)), longest, film);
    let (lift, held) = game.lever(&job.lever);
    let rest = game.last[plate];
    let mut warnings = Vec::new();
    if has_slipped(&scenery.starts[plate], &lift, &held) {
        warnings.push(LeverWarning::Slipped);
    }
    warnings.extend(game.trouble.as_ref().and_then(|trouble| match trouble {
        Warning::NotAtRest { .. } => Some(LeverWarning::Moving),
        Warning::Strained => Some(LeverWarning::Jammed),
        _ => None,
    }));
    let found = LeverTrajectory { lift, held, rest, ending: Ending::of(&rest), warnings };
    (found, game.film.map(|film| film.frames).unwrap_or_default())
}

/// Plays consecutive motions, each lever-up at its planned place; without a film only the end is
/// kept.
pub(super) fn play_all(
    scenery: &Arc<Scenery>,
    motions: &[Motion],
    longest: f64,
    film: Option<Film>,
    (mut trajectory, progress): (Trajectory, &dyn Progress),
) -> Trajectory {
    let first = motions.first().and_then(|motion| match motion {
        Motion::Lever(motion) => {
            Some((&motion.lever, [motion.tool().blade().unwrap_or_default(); 2]))
        }
        Motion::Slide(_) => None,
    });
    let mut game = Game::new(scenery, first, longest, film);
    for (k, motion) in motions.iter().enumerate() {
        if game.trouble.is_some() {
            break;
        }
        if progress.cancelled() {
            game.trouble = Some(Warning::Stopped);
            break;
        }
        match motion {
            Motion::Slide(motion) => game.push(motion),
            Motion::Lever(motion) => {
                let before = game.last.clone();
                if k > 0 {
                    let own = motion.tool().blade().unwrap_or_default();
                    game.take_up(&own, &motion.lever, motion.expected);
                }
                let (lift, held) = game.lever(&motion.lever);
                let plate = &scenery.plates[motion.lever.plate];
                let lift = lifted(plate, &motion.lever, &before, (&lift, &held));
                trajectory.lifts.push(lift.0);
                trajectory.warnings.extend(lift.1);
                game.world.lay_aside();
            }
        }
    }
    trajectory.warnings.extend(game.trouble.take());
    game.judge_end(motions, &mut trajectory);
    trajectory.force = Some(game.violations.force());
    let state = game.state();
    let frames = game.film.map(|film| film.frames).unwrap_or_default();
    trajectory.frames = frames.into_iter().map(|(frame, _)| frame).collect();
    if trajectory.frames.is_empty() {
        let end = Frame { time: 0.0, stroke: 0, tool: Pose::default(), state, blade: None };
        trajectory.frames.push(end);
    }
    trajectory
}

/// Returns the lift of a lever-up, with a warning if the plate slipped.
fn lifted(
    plate: &Plate,
    lever: &LeverUp,
    before: &[Pose3],
    (lift, held): (&[Pose3], &[bool]),
) -> (Lift, Option<Warning>) {
    let start = &before[lever.plate];
    let at = lever_frame(plate.corners(), lever.place).position;
    let end = lift.last().copied().unwrap_or(*start);
    let slipped = has_slipped(start, lift, held);
    let found = Lift {
        object: lever.plate,
        raised: Lift::height(start, &end, at),
        held: held.last().copied().unwrap_or(false),
        tilt: end.tilt(),
    };
    (found, slipped.then(|| Warning::Slipped { object: plate.name.clone() }))
}

/// A lever-up in progress.
struct Levering {
    lever: LeverUp,
    /// Plate as planned, and blade.
    planned: (Plate, Blade),
    /// Start time, seconds.
    began: f64,
}

impl Levering {
    /// Returns the pose of the blade's centre at a time.
    fn blade(&self, time: f64) -> Pose3 {
        let (plate, blade) = &self.planned;
        self.lever.blade_on(plate, blade, time - self.began)
    }
}

/// Motions in progress.
struct Game {
    scenery: Arc<Scenery>,
    world: LeverWorld,
    longest: f64,
    time: f64,
    /// Present or last lever-up.
    levering: Option<Levering>,
    /// Present push: start time and stroke.
    pushing: Option<(f64, Stroke)>,
    /// Last pose of a pushing tool.
    tool: Pose,
    /// Index of the stroke or lever-up in progress.
    stroke: usize,
    /// Warning that ended the playback.
    trouble: Option<Warning>,
    /// Number of consecutive steps with the force of a jam.
    strained: usize,
    most: f64,
    violations: Violations,
    /// Last finite poses.
    last: Vec<Pose3>,
    film: Option<Film>,
}

impl Game {
    /// Creates the start, with the real blade of a first lever-up at its planned pose.
    fn new(
        scenery: &Arc<Scenery>,
        first: Option<(&LeverUp, [Blade; 2])>,
        longest: f64,
        film: Option<Film>,
    ) -> Self {
        let plates = &scenery.plates;
        let mass: f64 = plates.iter().map(|plate| plate.mass).sum();
        let origin = match first {
            Some((lever, _)) => plates[lever.plate].pose.position,
            None => plates.first().map_or(Vector::zeros(), |plate| plate.pose.position),
        };
        let blade = first.map(|(lever, [real, own])| {
            (real, lever.blade_on(&scenery.planned[lever.plate], &own, 0.0))
        });
        let levering = first.map(|(lever, [_, own])| {
            let planned = (scenery.planned[lever.plate].clone(), own);
            Levering { lever: *lever, planned, began: 0.0 }
        });
        let there = blade.as_ref().map(|(blade, at)| (blade, at));
        let mut game = Self {
            world: LeverWorld::new(scenery, origin, there, longest),
            longest,
            time: 0.0,
            levering,
            pushing: None,
            tool: Pose::default(),
            stroke: 0,
            trouble: None,
            strained: 0,
            most: JAM + 2.0 * mass * GRAVITY,
            violations: Violations::new(&scenery.scene, false),
            last: scenery.starts.clone(),
            scenery: Arc::clone(scenery),
            film,
        };
        game.show();
        game
    }

    /// Takes up a blade for a lever-up after other motions.
    fn take_up(&mut self, blade: &Blade, lever: &LeverUp, expected: Option<Pose>) {
        let mut planned = self.scenery.planned[lever.plate].clone();
        if let Some(expected) = expected {
            planned.pose = expected;
        }
        self.world.take_up(blade, &lever.blade_on(&planned, blade, 0.0));
        self.levering =
            Some(Levering { lever: *lever, planned: (planned, *blade), began: self.time });
    }

    /// Returns the state of the whole scene.
    fn state(&self) -> State {
        self.scenery.scene.resting_in_space(self.last.clone())
    }

    /// Adds warnings for fallen objects, too much force, and objects that hang over the table's
    /// edge.
    fn judge_end(&self, motions: &[Motion], trajectory: &mut Trajectory) {
        let (scene, state) = (&self.scenery.scene, self.state());
        let levered = |k: usize| {
            motions.iter().any(|one| matches!(one, Motion::Lever(one) if one.lever.plate == k))
        };
        let starts = &self.scenery.starts;
        let leans = |k: &usize| {
            let (before, now) = (starts[*k].tilt(), self.last[*k].tilt());
            !levered(*k) && before <= TOPPLED && now > TOPPLED
        };
        let toppled: Vec<usize> = scene.things().map(|(k, _)| k).filter(leans).collect();
        let name = |k: usize| scene.objects[k].name.clone();
        let fell = toppled.iter().filter(|k| !scene.objects[**k].may_fall);
        let warnings = &mut trajectory.warnings;
        warnings.extend(fell.map(|k| Warning::Toppled { object: name(*k) }));
        warnings.extend(scene.fallen(&state, &toppled));
        warnings.extend(self.violations.too_hard(scene));
        let hangs = |k: &usize| scene.has_left(*k, &state) && !self.world.has_fallen(*k);
        let hanging = scene.things().map(|(k, _)| k).filter(hangs);
        warnings.extend(hanging.map(|k| Warning::Hangs { object: name(k) }));
    }

    /// Plays a lever-up; returns the pose of its plate at the end of each frame of the rotation,
    /// and whether the plate lies on the blade.
    fn lever(&mut self, lever: &LeverUp) -> (Vec<Pose3>, Vec<bool>) {
        let began = self.time;
        let mut lift = Vec::with_capacity(LEVER_FRAMES);
        let mut held = Vec::with_capacity(LEVER_FRAMES);
        for k in 1..=LEVER_FRAMES {
            self.go_on_until(began + lever.turn_time() * k as f64 / LEVER_FRAMES as f64);
            lift.push(self.last[lever.plate]);
            held.push(self.world.is_held(lever.plate));
        }
        self.go_on_until(began + lever.duration());
        self.rest();
        self.stroke += 1;
        (lift, held)
    }

    /// Plays until this time, in equal steps.
    fn go_on_until(&mut self, end: f64) {
        self.go_on_for(end - self.time);
    }

    /// Plays for `span` seconds, in equal steps.
    fn go_on_for(&mut self, span: f64) {
        let from = self.time;
        // The small offset gives 0.1 / (1 / 240) twenty-four steps under any rounding.
        let steps = (span / self.longest - 1e-9).ceil().max(1.0);
        let step = span / steps;
        if !(step > 0.0 && step.is_finite()) {
            return;
        }
        self.world.set_step(step);
        for k in 1..=steps as usize {
            self.step(from + step * k as f64);
            if self.trouble.is_some() {
                return;
            }
        }
    }

    /// Plays until everything rests.
    fn rest(&mut self) {
        self.world.set_step(self.longest);
        let (start, mut moved) = (self.time, self.time);
        while self.trouble.is_none() && self.time - moved < STILL {
            self.step(self.time + self.longest);
            if self.world.speed() > REST_SPEED {
                moved = self.time;
            }
            if self.time - start > PATIENCE {
                self.trouble =
                    self.trouble.take().or(Some(Warning::NotAtRest { waited: PATIENCE }));
            }
        }
        self.show();
    }

    /// Plays pushes from rest to rest. The tool is set down for each push that does not start at
    /// the end of the previous one, and lifted before the next.
    fn push(&mut self, motion: &ToolMotion) {
        self.world.lay_aside();
        let mut down = false;
        for stroke in &motion.strokes {
            if self.trouble.is_some() {
                return;
            }
            if !down && let Some(met) = self.world.set_down(motion, &stroke.from) {
                let object = self.scenery.plates[met].name.clone();
                self.trouble = Some(Warning::SetDownOn { object, stroke: self.stroke });
                return;
            }
            self.pushing = Some((self.time, *stroke));
            self.tool = stroke.from;
            self.world.drive(stroke);
            self.go_on_for(stroke.duration);
            self.pushing = None;
            self.tool = stroke.to;
            down = !stroke.settle;
            if stroke.settle {
                self.world.lift();
                self.rest();
            }
            self.stroke += 1;
        }
    }

    fn step(&mut self, to: f64) {
        let blade = self.levering.as_ref().map(|levering| levering.blade(to));
        self.world.step(blade.as_ref());
        self.time = to;
        let found = self.world.plates();
        let force = self.world.force_on_tool(&|_| true);
        self.strained = if force > self.most { self.strained + 1 } else { 0 };
        let is_finite = force.is_finite() && found.iter().all(Pose3::is_finite);
        if is_finite {
            self.last = found;
            self.violations.press(|of| self.world.force_on_tool(of));
        }
        if !is_finite || self.strained >= LASTING {
            self.trouble = Some(Warning::Strained);
        }
        let rules = ObjectRules::of(&self.scenery.scene);
        if self.trouble.is_none() && !rules.is_empty() {
            self.trouble = rules.broken(&self.state());
        }
        let due = self.film.as_ref().is_some_and(|film| {
            let last = film.frames.last().map(|(last, _)| last.time);
            last.is_none_or(|last| to - last > film.interval - 1e-9)
        });
        if due {
            self.show();
        }
    }

    /// Records a frame of the present state.
    fn show(&mut self) {
        let time = self.time;
        let is_new = |film: &&mut Film| film.frames.last().is_none_or(|(last, _)| last.time < time);
        let Some(film) = self.film.as_mut().filter(is_new) else { return };
        let levering = self.levering.as_ref().filter(|_| self.world.has_blade());
        let blade = levering.map(|levering| levering.blade(time));
        let tool = match (self.pushing, &blade) {
            (Some((began, stroke)), _) => {
                let share = ((time - began) / stroke.duration).clamp(0.0, 1.0);
                stroke.from.towards(&stroke.to, share)
            }
            (None, Some(blade)) => blade.from_above(),
            (None, None) => self.tool,
        };
        let state = self.scenery.scene.resting_in_space(self.last.clone());
        let force = self.world.force_on_tool(&|_| true);
        film.frames.push((Frame { time, stroke: self.stroke, tool, state, blade }, force));
    }
}
