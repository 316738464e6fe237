//! Trajectory to predict, with its ground truth, and the alignment of predictions with it.

use pushplan::recording::Recording;
use pushplan::{
    geometry::Pose,
    outcome::{Frame, Trajectory},
    scene::{Scene, State, Velocity},
    task::{Job, ToolMotion},
};

/// Scene, tool motion and true outcome.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// Scene at the start.
    pub scene: Scene,
    /// Initial velocity of each object.
    pub velocities: Vec<Velocity>,
    /// Motion of the tool.
    pub motion: ToolMotion,
    /// Ground truth in chronological order, without the start.
    pub truth: Vec<Moment>,
    /// Whether the true heading of each object is known.
    pub headings: Vec<bool>,
}

/// Instant with known ground truth.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// Index of the stroke.
    pub stroke: usize,
    /// Instant during or after the stroke.
    pub when: When,
    /// True poses of all objects.
    pub poses: Vec<Pose>,
}

/// Instant of a stroke.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// Instant after this many frames of the stroke, including its coasting frames.
    Frame(usize),
    /// Instant when all objects rest after the stroke.
    Rest,
}

impl Trial {
    /// Creates a trial whose ground truth is the final poses at rest.
    pub fn to_rest(scene: Scene, motion: ToolMotion, poses: Vec<Pose>) -> Self {
        let stroke = motion.strokes.len().saturating_sub(1);
        let headings = vec![true; scene.objects.len()];
        let velocities = scene.start().velocities;
        let truth = vec![Moment { stroke, when: When::Rest, poses }];
        Self { scene, velocities, motion, truth, headings }
    }

    /// Creates a trial with ground truth in every frame; the first frame is the start.
    pub fn of_frames(scene: Scene, motion: ToolMotion, frames: &[Frame]) -> Self {
        let mut truth = Vec::new();
        let (mut stroke, mut count) = (0, 0);
        for frame in frames.iter().skip(1) {
            count = if frame.stroke == stroke { count + 1 } else { 1 };
            stroke = frame.stroke;
            let poses = frame.state.poses.clone();
            truth.push(Moment { stroke, when: When::Frame(count), poses });
        }
        let headings = vec![true; scene.objects.len()];
        let first = frames.first().map(|first| first.state.velocities.clone());
        let velocities = first.unwrap_or_else(|| scene.start().velocities);
        Self { scene, velocities, motion, truth, headings }
    }

    /// Creates a trial from a recording, with ground truth at the ends of strokes.
    pub fn of_recording(recording: &Recording) -> Self {
        let replay = recording.replay();
        let truth = replay
            .instants
            .iter()
            .map(|instant| {
                let frame = &recording.frames[instant.frame];
                let frames = replay.motion.strokes[instant.stroke].frames();
                Moment {
                    stroke: instant.stroke,
                    when: if instant.settled { When::Rest } else { When::Frame(frames) },
                    poses: frame.poses.clone(),
                }
            })
            .collect();
        Self {
            scene: recording.scene.clone(),
            velocities: recording.velocities.clone(),
            motion: replay.motion,
            truth,
            headings: recording.headings.clone(),
        }
    }

    /// Returns the job for a model.
    pub fn job(&self) -> Job {
        let start = State { velocities: self.velocities.clone(), ..self.scene.start() };
        Job { start, ..Job::stated(&self.scene, self.motion.clone()) }
    }

    /// Returns the distances from the start to the last true positions, metres.
    pub fn motions(&self) -> Vec<f64> {
        let last = self.truth.last().map_or(&[][..], |moment| &moment.poses);
        let pairs = last.iter().zip(&self.scene.objects);
        pairs.map(|(pose, object)| (pose.position - object.pose.position).norm()).collect()
    }

    /// Returns `true` if the ground truth is known only at rest after the last stroke.
    pub(super) fn is_of_the_end(&self) -> bool {
        let last = self.motion.strokes.len().saturating_sub(1);
        let end = |moment: &Moment| moment.when == When::Rest && moment.stroke == last;
        self.truth.iter().all(end)
    }

    /// Returns the predicted state at every moment of the ground truth.
    ///
    /// Prediction and ground truth may come to rest after different numbers of frames; later states
    /// are constant. The prediction must have at least one frame.
    pub(super) fn aligned<'a>(&'a self, predicted: &'a Trajectory) -> Vec<&'a State> {
        let frames = &predicted.frames;
        let mut ends = Vec::new();
        let mut from = 1.min(frames.len());
        for stroke in 0..self.motion.strokes.len() {
            let count = frames[from..].iter().take_while(|frame| frame.stroke == stroke).count();
            ends.push((from, count));
            from += count;
        }
        self.truth
            .iter()
            .map(|moment| {
                let (from, count) = ends.get(moment.stroke).copied().unwrap_or((from, 0));
                let within = match moment.when {
                    When::Frame(index) => index.min(count),
                    When::Rest => count,
                };
                // A rollout that stopped early keeps its last state.
                let index = (from + within).saturating_sub(1).min(frames.len().saturating_sub(1));
                &frames[index].state
            })
            .collect()
    }
}

#[cfg(test)]
mod tests;
