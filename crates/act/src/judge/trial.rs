//! One trajectory to predict, with the truth, and how the two are brought side by side.

use pushplan::recording::Recording;
use pushplan::{
    geometry::Pose,
    outcome::{Frame, Trajectory},
    scene::{Scene, State, Velocity},
    task::{Job, ToolMotion},
};

/// A scene, a tool motion, and what really happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// What stands on the table at the start.
    pub scene: Scene,
    /// How each of its objects moves there.
    pub velocities: Vec<Velocity>,
    /// What the tool does.
    pub motion: ToolMotion,
    /// In order of time, the start left out.
    pub truth: Vec<Moment>,
    /// Whether the true heading of each object is known.
    pub headings: Vec<bool>,
}

/// An instant at which the truth is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// Index of the stroke.
    pub stroke: usize,
    /// When during or after it.
    pub when: When,
    /// True poses of all objects.
    pub poses: Vec<Pose>,
}

/// An instant of a stroke.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// After this many of its frames, those of coming to rest included.
    Frame(usize),
    /// When everything rests after it.
    Rest,
}

impl Trial {
    /// A motion of which only the end is known: the poses at rest after all of it.
    pub fn to_rest(scene: Scene, motion: ToolMotion, poses: Vec<Pose>) -> Self {
        let stroke = motion.strokes.len().saturating_sub(1);
        let headings = vec![true; scene.objects.len()];
        let velocities = scene.start().velocities;
        let truth = vec![Moment { stroke, when: When::Rest, poses }];
        Self { scene, velocities, motion, truth, headings }
    }

    /// A motion that was followed frame by frame, the start first.
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

    /// What was recorded, at the ends of strokes.
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

    /// What a model is asked.
    pub fn job(&self) -> Job {
        let start = State { velocities: self.velocities.clone(), ..self.scene.start() };
        Job { start, ..Job::stated(&self.scene, self.motion.clone()) }
    }

    /// Distances of the last true positions from the start, metres.
    pub fn motions(&self) -> Vec<f64> {
        let last = self.truth.last().map_or(&[][..], |moment| &moment.poses);
        let pairs = last.iter().zip(&self.scene.objects);
        pairs.map(|(pose, object)| (pose.position - object.pose.position).norm()).collect()
    }

    /// Whether only the end is known, at rest.
    pub(super) fn is_of_the_end(&self) -> bool {
        let last = self.motion.strokes.len().saturating_sub(1);
        let end = |moment: &Moment| moment.when == When::Rest && moment.stroke == last;
        self.truth.iter().all(end)
    }

    /// The predicted state at every moment of the truth. Models and truth come to rest after
    /// different numbers of frames; from then on the state stays what it is. The prediction must
    /// have a frame.
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
                // A rollout that stopped early stays where it was.
                let index = (from + within).saturating_sub(1).min(frames.len().saturating_sub(1));
                &frames[index].state
            })
            .collect()
    }
}

#[cfg(test)]
mod tests;
