//! Rolling many jobs of one scene out side by side, frame by frame.

use crate::{
    geometry::Vector,
    graph::{Batch, Bodies, Motion, add_graph},
    scene::{
        COAST_FRAME, Contact, Frame, FrameStep, Job, MAX_COAST_FRAMES, Record, Scene, State,
        Stroke, Trajectory, Warning,
    },
};

use super::integrate;

/// Corrects the quasi-static prior of every node of a batch: fills the vector with one entry
/// per node, in output units (see [`crate::graph::Node::encode`]).
pub type Corrector<'a> = dyn FnMut(&Batch, &mut Vec<[f64; 6]>) + 'a;

/// How finely a rollout goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RollSettings {
    /// Frames of a moving tool (see [`crate::scene::FRAME_TRAVEL`]) that are predicted as one,
    /// at least 1. The states between are interpolated, so that a trajectory has the same
    /// frames whatever the stride.
    pub stride: usize,
}

impl Default for RollSettings {
    fn default() -> Self {
        Self { stride: 1 }
    }
}

/// Rolls out every job until everything rests.
///
/// Jobs do not influence each other; they only share the network's batches.
pub fn roll(
    scene: &Scene,
    jobs: &[Job],
    record: Record,
    settings: RollSettings,
    correct: &mut Corrector<'_>,
) -> Vec<Trajectory> {
    let mut runs: Vec<Run> = jobs.iter().map(|job| Run::new(scene, job, record)).collect();
    let mut batch = Batch::default();
    let mut corrections = Vec::new();
    let mut motions: Vec<Vec<Motion>> = vec![Vec::new(); runs.len()];
    loop {
        batch.clear();
        let mut active = false;
        for (k, run) in runs.iter_mut().enumerate() {
            run.next_step(scene, settings.stride);
            let Some(step) = &run.step else { continue };
            active = true;
            add_graph(
                &run.bodies,
                &run.state,
                step,
                run.axis,
                k as u32,
                &mut batch,
                &mut motions[k],
            );
        }
        if !active {
            return runs.into_iter().map(Run::finish).collect();
        }
        correct(&batch, &mut corrections);
        apply(&batch, &corrections, &mut motions);
        if record == Record::Frames {
            for touch in &batch.touches {
                runs[touch.graph as usize].touch(touch.object, touch.with);
            }
        }
        for (run, motions) in runs.iter_mut().zip(&motions) {
            run.advance(motions, record);
        }
    }
}

/// Puts the corrected motion of every node in its graph's list.
pub fn apply(batch: &Batch, corrections: &[[f64; 6]], motions: &mut [Vec<Motion>]) {
    for (node, correction) in batch.nodes.iter().zip(corrections) {
        let mut output = node.prior;
        for (value, change) in output.iter_mut().zip(correction) {
            *value += change;
        }
        motions[node.graph as usize][node.object as usize] = node.decode(&output);
    }
}

/// One job on its way.
struct Run<'a> {
    job: &'a Job,
    bodies: Bodies,
    state: State,
    stroke: usize,
    /// Frames done of the stroke, coasting ones included.
    frame: usize,
    time: f64,
    axis: Vector,
    /// The frame to compute now; `None` when the job is done.
    step: Option<FrameStep>,
    /// How many of the stroke's frames it stands for.
    span: usize,
    trajectory: Trajectory,
}

impl<'a> Run<'a> {
    fn new(scene: &Scene, job: &'a Job, record: Record) -> Self {
        let motion = &job.motion;
        let bodies = Bodies::new(scene, &motion.tool, motion.lift, job.hypothesis.as_deref());
        let mut run = Self {
            job,
            bodies,
            state: job.start.clone(),
            stroke: 0,
            frame: 0,
            time: 0.0,
            axis: Vector::x(),
            step: None,
            span: 1,
            trajectory: Trajectory::default(),
        };
        if record == Record::Frames {
            let tool = motion.strokes.first().map(|stroke| stroke.from).unwrap_or_default();
            run.record(tool);
        }
        run
    }

    /// Decides what the tool does in the next frame.
    fn next_step(&mut self, scene: &Scene, stride: usize) {
        self.step = None;
        self.span = 1;
        while let Some(stroke) = self.job.motion.strokes.get(self.stroke) {
            let moving = stroke.frames();
            if self.frame < moving {
                self.axis = direction(stroke).unwrap_or(self.axis);
                self.span = stride.clamp(1, moving - self.frame);
                self.step = Some(stroke.frames_from(self.frame, self.span));
                return;
            }
            if stroke.settle && !scene.is_resting(&self.state) {
                if self.frame < moving + MAX_COAST_FRAMES {
                    let duration = COAST_FRAME;
                    self.step = Some(FrameStep { from: stroke.to, to: stroke.to, duration });
                    return;
                }
                let waited = MAX_COAST_FRAMES as f64 * COAST_FRAME;
                self.trajectory.warnings.push(Warning::NotAtRest { waited });
            }
            self.stroke += 1;
            self.frame = 0;
        }
    }

    /// Applies the frame's motions; a state that is not finite ends the job at the last good
    /// one, with a warning.
    fn advance(&mut self, motions: &[Motion], record: Record) {
        let Some(step) = self.step else { return };
        let before = self.state.clone();
        integrate(&self.bodies, &mut self.state, motions, &step);
        if !self.state.is_finite() {
            self.state = before;
            self.trajectory.warnings.push(Warning::NotFinite);
            self.stroke = self.job.motion.strokes.len();
            return;
        }
        self.frame += self.span;
        if record == Record::Frames && self.span > 1 {
            self.record_between(&before, &step);
        }
        self.time += step.duration;
        if record == Record::Frames {
            self.record(step.to);
        }
    }

    /// Records the frames that a longer step leaves out, with objects on straight ways.
    fn record_between(&mut self, before: &State, step: &FrameStep) {
        let (after, began) = (self.state.clone(), self.time);
        for k in 1..self.span {
            let share = k as f64 / self.span as f64;
            let pairs = before.poses.iter().zip(&after.poses);
            self.state.poses = pairs.map(|(from, to)| from.towards(to, share)).collect();
            self.time = began + share * step.duration;
            self.record(step.from.towards(&step.to, share));
        }
        (self.state, self.time) = (after, began);
    }

    fn record(&mut self, tool: crate::geometry::Pose) {
        self.trajectory.frames.push(Frame {
            time: self.time,
            stroke: self.stroke,
            tool,
            state: self.state.clone(),
        });
    }

    fn touch(&mut self, object: usize, with: crate::scene::Body) {
        let known = self.trajectory.contacts.iter().any(|c| c.object == object && c.with == with);
        if !known {
            let frame = self.trajectory.frames.len();
            self.trajectory.contacts.push(Contact { frame, object, with });
        }
    }

    fn finish(mut self) -> Trajectory {
        if self.trajectory.frames.is_empty() {
            self.stroke = self.job.motion.strokes.len().saturating_sub(1);
            let tool = self.job.motion.strokes.last().map(|stroke| stroke.to).unwrap_or_default();
            self.record(tool);
        }
        self.trajectory
    }
}

/// Unit vector of a stroke's travel, if it has any.
fn direction(stroke: &Stroke) -> Option<Vector> {
    let travel = stroke.to.position - stroke.from.position;
    let length = travel.norm();
    (length > 1e-9).then(|| travel / length)
}
