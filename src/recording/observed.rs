//! The types of a recording.

use std::sync::Arc;

use crate::geometry::{Pose, wrap_angle};
use crate::{
    outcome::Frame,
    scene::{Scene, State, Tool, Velocity},
    task::{COAST_FRAME, ToolMotion},
};

/// What happened on a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Its name.
    pub name: String,
    /// One line for people.
    pub description: String,
    /// What stood on the table, in the poses of the first frame.
    pub scene: Scene,
    /// The pusher.
    pub tool: Arc<Tool>,
    /// Height of its underside above the table, metres.
    pub lift: f64,
    /// Whether the heading of each object was recorded.
    pub headings: Vec<bool>,
    /// How each object moves in the first frame. The pusher's motion is that of its frames.
    pub velocities: Vec<Velocity>,
    /// At least two, in order of time, the first at 0 s.
    pub frames: Vec<RecordedFrame>,
}

/// One recorded instant.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedFrame {
    /// Since the first frame, seconds.
    pub time: f64,
    /// Pose of the tool frame.
    pub tool: Pose,
    /// Whether the pusher was lifted before this frame and set down here.
    pub lifted: bool,
    /// Whether the objects were seen, not only the pusher; where not, their poses are those of the
    /// frame before.
    pub seen: bool,
    /// Poses of the objects; headings that were not recorded are those of the start.
    pub poses: Vec<Pose>,
}

impl Recording {
    /// What `frames` show of `motion` on `scene`, headings included: a simulation as if it had
    /// been recorded. The first frame must be the scene's start.
    pub fn of_frames(name: &str, scene: &Scene, motion: &ToolMotion, frames: &[Frame]) -> Self {
        let mut recorded: Vec<RecordedFrame> = Vec::new();
        let mut late = 0.0;
        for (k, frame) in frames.iter().enumerate() {
            let before = k.checked_sub(1).map(|before| &frames[before]);
            if let Some(before) = before.filter(|before| before.stroke != frame.stroke)
                && motion.strokes.get(before.stroke).is_some_and(|stroke| stroke.settle)
                && let Some(stroke) = motion.strokes.get(frame.stroke)
            {
                // Setting the tool down takes no time in a simulation; here it must take some.
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

    /// Where everything is in the first frame, and how it moves there.
    pub fn start(&self) -> State {
        State { velocities: self.velocities.clone(), ..self.scene.start() }
    }
}

impl RecordedFrame {
    /// Makes headings, which a tracker gives up to whole turns, count their turns from those of
    /// the frame before.
    pub fn unwrap_after(&mut self, before: &RecordedFrame) {
        let poses = before.poses.iter().zip(&mut self.poses);
        for (before, now) in poses.chain([(&before.tool, &mut self.tool)]) {
            now.heading = before.heading + wrap_angle(now.heading - before.heading);
        }
    }
}
