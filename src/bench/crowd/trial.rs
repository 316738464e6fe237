//! One trajectory to predict, with the truth, and how the two are brought side by side.

use crate::{
    asset::Recording,
    dataset::Episode,
    geometry::Pose,
    scene::{Scene, State, ToolMotion, Trajectory},
};

/// A scene, a tool motion, and what really happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// What stands on the table at the start.
    pub scene: Scene,
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
    /// Pose of the tool frame.
    pub tool: Pose,
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
    /// What a data set holds, every frame of it.
    pub fn of_episode(episode: &Episode) -> Self {
        let mut truth = Vec::new();
        let (mut stroke, mut count) = (0, 0);
        // The first frame is the start.
        for frame in episode.frames.iter().skip(1) {
            count = if frame.stroke == stroke { count + 1 } else { 1 };
            stroke = frame.stroke;
            truth.push(Moment {
                stroke,
                when: When::Frame(count),
                tool: frame.tool,
                poses: frame.state.poses.clone(),
            });
        }
        Self {
            scene: episode.scene.clone(),
            motion: episode.motion.clone(),
            truth,
            headings: vec![true; episode.scene.objects.len()],
        }
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
                    tool: frame.tool,
                    poses: frame.poses.clone(),
                }
            })
            .collect();
        let headings = recording.headings.clone();
        Self { scene: recording.scene.clone(), motion: replay.motion, truth, headings }
    }

    /// The predicted state at every moment of the truth. Models and truth come to rest after
    /// different numbers of frames; from then on the state stays what it is.
    pub fn aligned<'a>(&'a self, predicted: &'a Trajectory) -> Vec<&'a State> {
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
