//! Plays motions in space one after another in one world: a lever-up's turn, wait and way back, and
//! pushes, each until everything rests.

use crate::geometry::{Pose, Pose3, Vector};
use crate::watch::Watch;
use crate::{
    outcome::{
        Ending, Force, Frame, LEVER_FRAMES, LeverFrame, LeverRecord, LeverTrajectory, LeverWarning,
        Lift, Trajectory, Warning, has_slipped,
    },
    scene::{Blade, GRAVITY, LeverScene, REST_SPEED, State},
    task::{LeverJob, LeverUp, Motion, Stroke, ToolMotion, lever_frame},
};

use super::world::LeverWorld;

/// More force on the blade than this, beyond twice the plates' weight, is a jam, newtons. Lifting
/// takes less than the weight; a blade that is driven into something soon takes hundreds.
const JAM: f64 = 30.0;

/// A force lasts when it is there for so many steps in a row: touches are over in one or two.
const LASTING: usize = 3;

/// Waits no longer for rest, seconds. No plate of thousands took that long.
const PATIENCE: f64 = 4.0;

/// Everything rests when it was slow for so long, seconds: a plate on edge is slow for a moment.
const STILL: f64 = 0.1;

/// Who looks on.
pub(super) enum Watcher<'a> {
    Nobody,
    Recorder { record: &'a mut LeverRecord, interval: f64 },
    Filmer { frames: &'a mut Vec<Frame>, interval: f64 },
}

/// What is played: the scene as it really is and as the motions were planned in it, and where the
/// objects really are.
pub(super) struct Scenery<'a> {
    pub really: &'a LeverScene,
    pub planned: &'a LeverScene,
    pub starts: Vec<Pose3>,
}

impl<'a> Scenery<'a> {
    /// With the objects where the scene has them.
    pub fn stated(really: &'a LeverScene, planned: &'a LeverScene) -> Self {
        Self { really, planned, starts: really.plates.iter().map(|plate| plate.start()).collect() }
    }
}

/// Plays `job` in steps of at most `longest` seconds, the blade going where it would in the scene
/// as `planned`.
pub(super) fn play(
    job: &LeverJob,
    planned: &LeverScene,
    longest: f64,
    watcher: &mut Watcher,
) -> LeverTrajectory {
    let scenery = Scenery::stated(&job.scene, planned);
    let mut game = Game::new(&scenery, Some(&job.lever), longest, watcher);
    let (lift, held) = game.lever(&job.lever);
    let rest = game.last[job.lever.plate];
    let mut warnings = Vec::new();
    if has_slipped(&scenery.starts[job.lever.plate], &lift, &held) {
        warnings.push(LeverWarning::Slipped);
    }
    warnings.extend(game.trouble.as_ref().and_then(|trouble| match trouble {
        Warning::NotAtRest { .. } => Some(LeverWarning::Moving),
        Warning::Strained => Some(LeverWarning::Jammed),
        _ => None,
    }));
    LeverTrajectory { lift, held, rest, ending: Ending::of(&rest), warnings }
}

/// Plays motions one after another, each lever-up where it was planned; what `trajectory` gets is
/// everything but its frames, which are the watcher's, and how all ends.
pub(super) fn play_all(
    scenery: &Scenery,
    motions: &[Motion],
    longest: f64,
    watcher: &mut Watcher,
    (trajectory, watch): (&mut Trajectory, &dyn Watch),
) -> State {
    let first = motions.first().and_then(|motion| match motion {
        Motion::Lever(motion) => Some(&motion.lever),
        Motion::Slide(_) => None,
    });
    let mut game = Game::new(scenery, first, longest, watcher);
    for (k, motion) in motions.iter().enumerate() {
        if game.trouble.is_some() {
            break;
        }
        if watch.cancelled() {
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
                let lift = lifted(scenery.really, &motion.lever, &before, (&lift, &held));
                trajectory.lifts.push(lift.0);
                trajectory.warnings.extend(lift.1);
                game.world.lay_aside();
            }
        }
    }
    trajectory.warnings.extend(game.trouble.take());
    trajectory.force = Some(game.force);
    State::in_space(game.last.clone())
}

/// What a lever-up came to.
fn lifted(
    scene: &LeverScene,
    lever: &LeverUp,
    before: &[Pose3],
    (lift, held): (&[Pose3], &[bool]),
) -> (Lift, Option<Warning>) {
    let (plate, start) = (&scene.plates[lever.plate], &before[lever.plate]);
    let at = lever_frame(plate.corners(), lever.place).position;
    let end = lift.last().copied().unwrap_or(*start);
    let slipped = has_slipped(start, lift, held);
    let found = Lift {
        object: lever.plate,
        raised: end.point([at.x, at.y, 0.0].into()).z - start.position.z,
        held: held.last().copied().unwrap_or(false),
        tilt: end.tilt(),
    };
    (found, slipped.then(|| Warning::Slipped { object: plate.name.clone() }))
}

/// A blade on its way.
struct Levering {
    lever: LeverUp,
    /// The scene in which it is planned.
    planned: LeverScene,
    /// When it began, seconds.
    began: f64,
}

/// Motions on their way.
struct Game<'a, 'b> {
    scenery: &'a Scenery<'a>,
    world: LeverWorld,
    longest: f64,
    time: f64,
    /// What levers, or levered last.
    levering: Option<Levering>,
    /// What pushes now: when it began, and the stroke.
    pushing: Option<(f64, Stroke)>,
    /// Where a tool that pushes was last.
    tool: Pose,
    /// Index of the stroke or lever-up that is under way.
    stroke: usize,
    /// What ended it all, after which nothing goes on.
    trouble: Option<Warning>,
    /// For how many steps the force has been that of a jam.
    strained: usize,
    most: f64,
    /// Forces of the last steps, and the largest so far.
    recent: [f64; LASTING],
    force: Force,
    /// The last poses that were finite.
    last: Vec<Pose3>,
    watcher: &'a mut Watcher<'b>,
}

impl<'a, 'b> Game<'a, 'b> {
    fn new(
        scenery: &'a Scenery<'a>,
        first: Option<&LeverUp>,
        longest: f64,
        watcher: &'a mut Watcher<'b>,
    ) -> Self {
        let Scenery { really, planned, starts } = scenery;
        let mass: f64 = really.plates.iter().map(|plate| plate.mass).sum();
        let origin = match first {
            Some(lever) => really.plates[lever.plate].pose.position,
            None => really.plates.first().map_or(Vector::zeros(), |plate| plate.pose.position),
        };
        let levering =
            first.map(|lever| Levering { lever: *lever, planned: (*planned).clone(), began: 0.0 });
        let blade = first.map(|lever| lever.blade(planned, 0.0));
        let mut game = Self {
            scenery,
            world: LeverWorld::new(really, (origin, starts), blade.as_ref(), longest),
            longest,
            time: 0.0,
            levering,
            pushing: None,
            tool: Pose::default(),
            stroke: 0,
            trouble: None,
            strained: 0,
            most: JAM + 2.0 * mass * GRAVITY,
            recent: [0.0; LASTING],
            force: Force::default(),
            last: starts.clone(),
            watcher,
        };
        game.show();
        game
    }

    /// Takes up a blade for a lever-up that comes after other motions.
    fn take_up(&mut self, blade: &Blade, lever: &LeverUp, expected: Option<Pose>) {
        let Scenery { really, planned, .. } = self.scenery;
        let mut planned = (*planned).clone();
        // Disturbed frictions are those of one world.
        let factor = really.blade.friction / planned.blade.friction;
        let factor = if factor.is_finite() { factor } else { 1.0 };
        planned.blade = *blade;
        if let Some(expected) = expected {
            planned.plates[lever.plate].pose = expected;
        }
        let real = Blade { friction: blade.friction * factor, ..*blade };
        self.world.take_up(&real, &lever.blade(&planned, 0.0));
        self.levering = Some(Levering { lever: *lever, planned, began: self.time });
    }

    /// Plays a lever-up: where its plate is at the end of each frame of the turn, and whether it lies
    /// on the blade.
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

    /// Plays on to this time, in equal steps.
    fn go_on_until(&mut self, end: f64) {
        self.go_on_for(end - self.time);
    }

    /// Plays on for so long, in equal steps.
    fn go_on_for(&mut self, span: f64) {
        let from = self.time;
        // The small part keeps 0.1 / (1 / 240) at twenty-four steps however it is rounded.
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

    /// Plays on until everything rests.
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

    /// Plays pushes from rest to rest; the tool is set down for each that does not go on where the
    /// last one ended, and lifted before the next.
    fn push(&mut self, motion: &ToolMotion) {
        self.world.lay_aside();
        let mut down = false;
        for stroke in &motion.strokes {
            if self.trouble.is_some() {
                return;
            }
            if !down && let Some(met) = self.world.set_down(motion, &stroke.from) {
                let object = self.scenery.really.plates[met].name.clone();
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

    /// The blade's centre at a time, if there is a blade.
    fn blade(&self, time: f64) -> Option<Pose3> {
        let Levering { lever, planned, began } = self.levering.as_ref()?;
        Some(lever.blade(planned, time - began))
    }

    fn step(&mut self, to: f64) {
        let blade = self.blade(to);
        self.world.step(blade.as_ref());
        self.time = to;
        let found = self.world.plates();
        let force = self.world.force_on_blade().max(self.world.force_on_tool());
        self.strained = if force > self.most { self.strained + 1 } else { 0 };
        let is_finite = force.is_finite() && found.iter().all(Pose3::is_finite);
        if is_finite {
            self.last = found;
            self.recent.rotate_left(1);
            self.recent[LASTING - 1] = force;
            let lasting = self.recent.iter().copied().fold(f64::INFINITY, f64::min);
            self.force.peak = self.force.peak.max(force);
            self.force.lasting = self.force.lasting.max(lasting);
        }
        if !is_finite || self.strained >= LASTING {
            self.trouble = Some(Warning::Strained);
        }
        let late =
            |last: Option<f64>, interval: f64| last.is_none_or(|last| to - last > interval - 1e-9);
        let due = match self.watcher {
            Watcher::Recorder { record, interval } => {
                late(record.frames.last().map(|last| last.time), *interval)
            }
            Watcher::Filmer { frames, interval } => {
                late(frames.last().map(|last| last.time), *interval)
            }
            Watcher::Nobody => false,
        };
        if due {
            self.show();
        }
    }

    /// Lets the watcher see how things stand.
    fn show(&mut self) {
        let (time, blade) = (self.time, self.blade(self.time));
        match self.watcher {
            Watcher::Recorder { record, .. } => {
                if record.frames.last().is_none_or(|last| last.time < time) {
                    let force = self.world.force_on_blade();
                    let (blade, plates) = (blade.unwrap_or_default(), self.last.clone());
                    record.frames.push(LeverFrame { time, blade, plates, force });
                }
            }
            Watcher::Filmer { frames, .. } => {
                if frames.last().is_none_or(|last| last.time < time) {
                    let blade = blade.filter(|_| self.world.has_blade());
                    let tool = match (self.pushing, &blade) {
                        (Some((began, stroke)), _) => {
                            let share = ((time - began) / stroke.duration).clamp(0.0, 1.0);
                            stroke.from.towards(&stroke.to, share)
                        }
                        (None, Some(blade)) => blade.from_above(),
                        (None, None) => self.tool,
                    };
                    let state = State::in_space(self.last.clone());
                    frames.push(Frame { time, stroke: self.stroke, tool, state, blade });
                }
            }
            Watcher::Nobody => {}
        }
    }
}
