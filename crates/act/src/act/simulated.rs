//! Simulated world with observation noise and a hidden ground truth.

use std::sync::Arc;

use crate::belief::{Belief, BeliefSettings, generator, normal};
use pushplan::asset::{Faults, ToolLibrary};
use pushplan::geometry::{Pose, Vector};
use pushplan::sim::{Arm, Simulator};
use pushplan::{
    outcome::{Record, Trajectory, Warning},
    scene::{ObservedPose, Physics, Rate, Scene, State},
    task::{COAST_FRAME, Job, Stroke, Task, ToolMotion, Truth},
};

use super::trace::{Step, Trace};
use super::world::{Look, Stop, World, WorldError, WorldState};

/// Coordinates of a tool that is lifted, metres: out of the way of everything.
const ASIDE: f64 = 100.0;

/// World simulated in one of the engines.
#[derive(Clone, Debug)]
pub struct SimulatedWorld {
    truth: Truth,
    /// True scene without rules, because nothing in the world enforces them.
    scene: Scene,
    simulator: Simulator,
    state: State,
    looks: u64,
    arm: Arm,
    stop: Option<Stop>,
}

impl SimulatedWorld {
    /// Creates the world in its initial state.
    pub fn new(truth: Truth) -> Self {
        let simulator = Simulator::new(truth.engine, Rate::DEFAULT).retreating();
        let (state, arm) = (truth.scene.start(), Arm::default());
        let scene = without_rules(&truth.scene);
        Self { state, simulator, looks: 0, scene, truth, arm, stop: None }
    }

    /// Limits the force of the robot's arm to `max_force` newtons; `None` removes the limit.
    pub fn pushed_with(self, max_force: Option<f64>) -> Self {
        Self { arm: Arm { max_force }, ..self }
    }

    /// Returns the true state.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Lets springs move their objects once the tool is lifted; returns the time that this takes,
    /// seconds, or `None` without springs.
    fn release(&mut self, motion: &ToolMotion) -> Option<f64> {
        self.scene.mounts.iter().find(|mount| mount.spring > 0.0)?;
        let from = Pose { position: Vector::repeat(ASIDE), heading: 0.0 };
        let waiting = Stroke { from, to: from, duration: 2.0 * COAST_FRAME, settle: true };
        let motion = ToolMotion { strokes: vec![waiting], ..motion.clone() };
        let physics = Physics::stated(&self.scene).into();
        let job = Job { start: self.state.clone(), motion: motion.into(), physics };
        let run = self.simulator.run(&self.scene, &job, Record::Outcome);
        self.state = State::at_rest(run.outcome().poses.clone());
        run.frames.last().map(|frame| frame.time)
    }

    /// Returns a noisy observation of a state.
    fn see(&mut self, time: f64, state: &State) -> Look {
        let mut rng = generator(self.truth.seed, self.looks);
        self.looks += 1;
        let noise = self.truth.noise;
        let things = self.truth.scene.things().count();
        let seen = state.poses.iter().take(things).map(|pose| {
            let off = Vector::new(normal(&mut rng), normal(&mut rng)) * noise.position;
            let heading = pose.heading + noise.heading * normal(&mut rng);
            let position = pose.position + off;
            Some(ObservedPose { position, heading: self.truth.headings.then_some(heading) })
        });
        Look { time, seen: seen.collect() }
    }
}

impl World for SimulatedWorld {
    fn look(&mut self) -> Result<Look, WorldError> {
        let state = self.state.clone();
        Ok(self.see(0.0, &state))
    }

    fn act(&mut self, motion: &ToolMotion) -> Result<Vec<Look>, WorldError> {
        let physics = Physics::stated(&self.scene).into();
        let job = Job { start: self.state.clone(), motion: motion.clone().into(), physics };
        let run = self.simulator.run_by(&self.arm, &self.scene, &job, Record::Frames);
        if let Some(warning) = run.warnings.iter().find(|warning| ends(warning)) {
            return Err(WorldError(format!("the simulated world cannot continue: {warning}")));
        }
        let (stop, kept) = stop(motion, &run);
        let frames = &run.frames[..kept];
        let mut looks: Vec<Look> =
            frames.iter().skip(1).map(|frame| self.see(frame.time, &frame.state)).collect();
        let last = &frames[kept - 1];
        self.state = State::at_rest(last.state.poses.clone());
        if stop.is_some() {
            // The objects have come to rest by the next observation.
            let state = self.state.clone();
            looks.push(self.see(last.time + COAST_FRAME, &state));
        }
        self.stop = stop;
        if let Some(waited) = self.release(motion) {
            let state = self.state.clone();
            looks.push(self.see(last.time + COAST_FRAME + waited, &state));
        }
        Ok(looks)
    }

    fn stopped(&self) -> Option<Stop> {
        self.stop.clone()
    }

    fn save(&self) -> Option<WorldState> {
        Some(WorldState { state: self.state.clone(), looks: self.looks })
    }

    fn restore(&mut self, saved: &WorldState) {
        self.state = saved.state.clone();
        self.looks = saved.looks;
    }
}

/// Returns where the arm gave up a motion and the number of valid frames before that.
///
/// The frame in which the arm gave up is excluded because rigid bodies do not penetrate and an
/// unavailable force moves nothing.
fn stop(motion: &ToolMotion, run: &Trajectory) -> (Option<Stop>, usize) {
    let all = run.frames.len();
    let stops = |warning: &&Warning| {
        matches!(
            warning,
            Warning::Jammed { .. } | Warning::TooMuchForce { .. } | Warning::SetDownOn { .. }
        )
    };
    let Some(warning) = run.warnings.iter().find(stops) else { return (None, all) };
    let why = warning.to_string();
    let kept = match warning {
        Warning::SetDownOn { stroke, .. } => {
            return (Some(Stop { stroke: *stroke, share: 0.0, why }), all);
        }
        _ => all.saturating_sub(1).max(1),
    };
    let last = &run.frames[kept - 1];
    let stroke = last.stroke.min(motion.strokes.len().saturating_sub(1));
    let whole = motion.strokes.get(stroke).map_or(0.0, Stroke::travel);
    let done = motion
        .strokes
        .get(stroke)
        .map_or(0.0, |stroke| Stroke { to: last.tool, ..*stroke }.travel());
    // The initial frame belongs to no stroke.
    let share = if kept > 1 && whole > 0.0 { done / whole } else { 0.0 };
    (Some(Stop { stroke, share, why }), kept)
}

/// Returns the true trajectory of every step of a run, frame by frame.
///
/// The engine is deterministic, so a replay from the recorded start is bit-identical. Returns an
/// empty vector if the world was not simulated.
pub fn really(trace: &Trace) -> Vec<Trajectory> {
    let (Some(truth), Some(before)) = (&trace.truth, &trace.before) else { return Vec::new() };
    let scene = without_rules(&truth.scene);
    let physics = Arc::new(Physics::stated(&scene));
    let simulator = Simulator::new(truth.engine, Rate::DEFAULT).retreating();
    let begins = trace.steps.iter().filter_map(|step| step.world.as_ref());
    let begins = std::iter::once(before).chain(begins);
    let replay = |(begin, step): (&WorldState, &Step)| {
        let (start, physics) = (begin.state.clone(), Arc::clone(&physics));
        simulator.run(&scene, &Job { start, motion: step.motion().into(), physics }, Record::Frames)
    };
    begins.zip(&trace.steps).map(replay).collect()
}

/// Returns the scene without `keep` and `keep_out`. The runner checks them on its observations.
fn without_rules(scene: &Scene) -> Scene {
    let mut scene = Scene { keep_out: Vec::new(), ..scene.clone() };
    scene.objects.iter_mut().for_each(|object| object.keep = None);
    scene
}

/// Returns `true` if the run cannot continue after a replay with this warning.
fn ends(warning: &Warning) -> bool {
    matches!(
        warning,
        Warning::NotFinite | Warning::Stopped | Warning::OffTable { .. } | Warning::Toppled { .. }
    )
}

/// Draws the ground truth of a task from `seed`.
///
/// Unknowns are drawn from the task's prior distributions; all other values are as stated. The
/// engine is the 2-D one and the noise is [`Truth::NOISE`].
///
/// # Errors
/// If the task names tools that `library` does not have.
pub fn hidden(task: &Task, library: &ToolLibrary, seed: u64) -> Result<Truth, Faults> {
    let mut truth = Truth::stated(&task.scene, seed);
    // The tool is irrelevant before the first motion.
    if let Some(tool) = task.tools(library)?.into_iter().next() {
        let settings = BeliefSettings::new(Default::default());
        let belief = Belief::about(&task.scene, task.unknown, (tool, 0.0), settings, seed);
        truth.scene = belief.sample_scene(&mut generator(seed, u64::MAX));
    }
    Ok(truth)
}
