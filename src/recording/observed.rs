//! The types of a recording.

use std::sync::Arc;

use crate::geometry::{Pose, wrap_angle};
use crate::{
    outcome::Frame,
    scene::{Scene, State, Tool, Velocity},
    task::{COAST_FRAME, ToolMotion},
};

/// A recorded motion of a pusher and objects on a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Name of the recording.
    pub name: String,
    /// Description in one line.
    pub description: String,
    /// The scene, with the poses of the first frame.
    pub scene: Scene,
    /// The pusher.
    pub tool: Arc<Tool>,
    /// Height of the pusher's underside above the table, metres.
    pub lift: f64,
    /// Whether the heading of each object was recorded.
    pub headings: Vec<bool>,
    /// Velocity of each object in the first frame. The pusher's velocity follows from its frames.
    pub velocities: Vec<Velocity>,
    /// Recorded frames: at least two, ordered by time, the first at 0 s.
    pub frames: Vec<RecordedFrame>,
}

/// The state at one recorded instant.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedFrame {
    /// Time since the first frame, seconds.
    pub time: f64,
    /// Pose of the tool frame.
    pub tool: Pose,
    /// Whether the pusher was lifted before this frame and set down here.
    pub lifted: bool,
    /// Whether the objects were observed, not only the pusher; otherwise their poses are copied
    /// from the previous frame.
    pub seen: bool,
    /// Poses of the objects; headings that were not recorded are copied from the start.
    pub poses: Vec<Pose>,
}

impl Recording {
    /// Creates a recording of a simulation: the `frames` of `motion` on `scene`, headings included.
    /// The first frame must be the scene's start.
    pub fn of_frames(name: &str, scene: &Scene, motion: &ToolMotion, frames: &[Frame]) -> Self {
        let mut recorded: Vec<RecordedFrame> = Vec::new();
        let mut late = 0.0;
        for (k, frame) in frames.iter().enumerate() {
            let before = k.checked_sub(1).map(|before| &frames[before]);
            if let Some(before) = before.filter(|before| before.stroke != frame.stroke)
                && motion.strokes.get(before.stroke).is_some_and(|stroke| stroke.settle)
                && let Some(stroke) = motion.strokes.get(frame.stroke)
            {
                // Setting down takes no time in a simulation, but must take some in a recording.
                let time = before.time + late + COAST_FRAME;
                let poses = before.state.poses.clone();
                recorded.push(RecordedFrame {
                    time,
                    tool: stroke.from,
                    lifted: true,
                    seen: true,
                    poses,
                });
                late += COAST_FRAME;
            }
            recorded.push(RecordedFrame {
                time: frame.time + late,
                tool: frame.tool,
                lifted: false,
                seen: true,
                poses: frame.state.poses.clone(),
            });
        }
        let first = frames.first().map(|first| first.state.velocities.clone());
        Self {
            name: name.into(),
            description: String::new(),
            scene: scene.clone(),
            tool: Arc::clone(&motion.tool),
            lift: motion.lift,
            headings: vec![true; scene.objects.len()],
            velocities: first.unwrap_or_else(|| scene.start().velocities),
            frames: recorded,
        }
    }

    /// Returns the poses and velocities of the first frame.
    pub fn start(&self) -> State {
        State { velocities: self.velocities.clone(), ..self.scene.start() }
    }
}

impl RecordedFrame {
    /// Unwraps headings, which a tracker gives up to full rotations, relative to the previous
    /// frame.
    pub fn unwrap_after(&mut self, before: &RecordedFrame) {
        let poses = before.poses.iter().zip(&mut self.poses);
        for (before, now) in poses.chain([(&before.tool, &mut self.tool)]) {
            now.heading = before.heading + wrap_angle(now.heading - before.heading);
        }
    }
}
