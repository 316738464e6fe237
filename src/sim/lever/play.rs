//! Plays a lever-up: the turn in frames, the wait, the way back, and until everything rests; then
//! the pushes that follow.

use crate::geometry::Pose3;
use crate::scene::{
    Ending, GRAVITY, LEVER_FRAMES, LeverFrame, LeverJob, LeverMotion, LeverScene, LeverTrajectory,
    LeverWarning, REST_SPEED, Stroke, ToolMotion, has_slipped,
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
    Recorder { motion: &'a mut LeverMotion, interval: f64 },
}

/// Plays `job` in steps of at most `longest` seconds, the blade going where it would in the scene
/// as `planned`, and then the pushes that follow, if there are any.
pub(super) fn play(
    job: &LeverJob,
    planned: &LeverScene,
    longest: f64,
    (follow_up, watcher): (Option<&ToolMotion>, &mut Watcher),
) -> LeverTrajectory {
    let mut game = Game::new(job, planned, longest, watcher);
    let plate = job.lever.plate;
    let mut lift = Vec::with_capacity(LEVER_FRAMES);
    let mut held = Vec::with_capacity(LEVER_FRAMES);
    for k in 1..=LEVER_FRAMES {
        game.go_on_until(job.lever.turn_time() * k as f64 / LEVER_FRAMES as f64);
        lift.push(game.pose(plate));
        held.push(game.world.is_held(plate));
    }
    game.go_on_until(job.lever.duration());
    game.rest();
    if let Some(motion) = follow_up {
        game.push(motion);
    }
    let rest = game.pose(plate);
    let mut warnings = Vec::new();
    if has_slipped(&job.scene.plates[plate].start(), &lift, &held) {
        warnings.push(LeverWarning::Slipped);
    }
    warnings.extend(game.trouble);
    LeverTrajectory { lift, held, rest, ending: Ending::of(&rest), warnings }
}

/// A lever-up on its way.
struct Game<'a, 'b> {
    job: &'a LeverJob,
    planned: &'a LeverScene,
    world: LeverWorld,
    longest: f64,
    time: f64,
    /// Jam or unrest, after which nothing goes on.
    trouble: Option<LeverWarning>,
    /// For how many steps the force has been that of a jam.
    strained: usize,
    most: f64,
    /// The last poses that were finite.
    last: Vec<Pose3>,
    watcher: &'a mut Watcher<'b>,
}

impl<'a, 'b> Game<'a, 'b> {
    fn new(
        job: &'a LeverJob,
        planned: &'a LeverScene,
        longest: f64,
        watcher: &'a mut Watcher<'b>,
    ) -> Self {
        let mass: f64 = job.scene.plates.iter().map(|plate| plate.mass).sum();
        let mut game = Self {
            job,
            planned,
            world: LeverWorld::new(job, &job.lever.blade(planned, 0.0), longest),
            longest,
            time: 0.0,
            trouble: None,
            strained: 0,
            most: JAM + 2.0 * mass * GRAVITY,
            last: job.scene.plates.iter().map(|plate| plate.start()).collect(),
            watcher,
        };
        game.show();
        game
    }

    fn pose(&self, plate: usize) -> Pose3 {
        self.last[plate]
    }

    /// Plays on to this time, in equal steps.
    fn go_on_until(&mut self, end: f64) {
        let from = self.time;
        // The small part keeps 0.1 / (1 / 240) at twenty-four steps however it is rounded.
        let steps = ((end - from) / self.longest - 1e-9).ceil().max(1.0);
        let step = (end - from) / steps;
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
                self.trouble = self.trouble.or(Some(LeverWarning::Moving));
            }
        }
        self.show();
    }

    /// Plays pushes from rest to rest; the tool is set down for each and lifted after it.
    fn push(&mut self, motion: &ToolMotion) {
        self.world.lay_aside();
        for stroke in &motion.strokes {
            if self.trouble.is_some() {
                return;
            }
            if self.world.set_down(motion, &stroke.from) {
                self.trouble = Some(LeverWarning::SetDown);
                return;
            }
            self.stroke(stroke);
            self.world.lift();
            self.rest();
        }
    }

    /// Plays one stroke, in equal steps.
    fn stroke(&mut self, stroke: &Stroke) {
        let from = self.time;
        let steps = (stroke.duration / self.longest - 1e-9).ceil().max(1.0);
        let step = stroke.duration / steps;
        if !(step > 0.0 && step.is_finite()) {
            return;
        }
        self.world.set_step(step);
        self.world.drive(stroke);
        for k in 1..=steps as usize {
            self.step(from + step * k as f64);
            if self.trouble.is_some() {
                return;
            }
        }
    }

    fn step(&mut self, to: f64) {
        let blade = self.job.lever.blade(self.planned, to);
        self.world.step(&blade);
        self.time = to;
        let found = self.world.plates();
        let force = self.world.force_on_blade().max(self.world.force_on_tool());
        self.strained = if force > self.most { self.strained + 1 } else { 0 };
        let is_finite = force.is_finite() && found.iter().all(Pose3::is_finite);
        if is_finite {
            self.last = found;
        }
        if !is_finite || self.strained >= LASTING {
            self.trouble = Some(LeverWarning::Jammed);
        }
        let due = match self.watcher {
            Watcher::Recorder { motion, interval } => {
                motion.frames.last().is_none_or(|last| to - last.time > *interval - 1e-9)
            }
            Watcher::Nobody => false,
        };
        if due {
            self.show();
        }
    }

    /// Lets the watcher see how things stand.
    fn show(&mut self) {
        if let Watcher::Recorder { motion, .. } = self.watcher {
            let time = self.time;
            if motion.frames.last().is_some_and(|last| last.time >= time) {
                return;
            }
            let blade = self.job.lever.blade(self.planned, time);
            let force = self.world.force_on_blade();
            motion.frames.push(LeverFrame { time, blade, plates: self.last.clone(), force });
        }
    }
}
