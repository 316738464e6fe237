//! What no real table does between two frames: then a tracker lost something, frames are missing,
//! or a size is wrong.

use crate::geometry::{Pose, clearance};

use super::observed::{RecordedFrame, Recording};

/// A body that moves farther than this between two frames was lost by the tracker, metres.
const JUMP: f64 = 0.10;

/// The same for turns: a right angle, as when a tracker mixes up the sides of a square.
const TURN: f64 = 0.45 * std::f64::consts::PI;

/// Frames are missing where a time step is this many times the usual one and something moved
/// farther than [`MOVED`] metres meanwhile.
const GAP: f64 = 2.5;
const MOVED: f64 = 0.002;

/// A body of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// What pushes.
    Pusher,
    /// The object with this index.
    Object(usize),
}

/// What a body does that cannot be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Strange {
    /// Moves so far, metres.
    Moves(f64),
    /// Turns so far, radians.
    Turns(f64),
}

/// A body that was lost between two frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// Which body.
    pub body: Body,
    /// What it does.
    pub what: Strange,
}

/// A step of time in which frames are missing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Index of the frame behind it.
    pub frame: usize,
    /// Its length, seconds.
    pub step: f64,
    /// The usual length, seconds.
    pub usual: f64,
}

/// Bodies that were lost between one frame and the next, the pusher first. Headings count their
/// turns, see [`RecordedFrame::unwrap_after`].
pub fn jumps(before: &RecordedFrame, now: &RecordedFrame) -> Vec<Jump> {
    let pusher = (!now.lifted).then_some((Body::Pusher, &before.tool, &now.tool));
    let poses = before.poses.iter().zip(&now.poses).enumerate();
    let objects = poses.map(|(index, (before, now))| (Body::Object(index), before, now));
    let bodies = pusher.into_iter().chain(objects);
    bodies
        .filter_map(|(body, before, now)| Some(Jump { body, what: strange(before, now)? }))
        .collect()
}

fn strange(before: &Pose, now: &Pose) -> Option<Strange> {
    let travel = (now.position - before.position).norm();
    let turn = (now.heading - before.heading).abs();
    if travel > JUMP {
        Some(Strange::Moves(travel))
    } else if turn > TURN {
        Some(Strange::Turns(turn))
    } else {
        None
    }
}

/// Time steps that are much longer than the others although something moves.
pub fn gaps(frames: &[RecordedFrame]) -> Vec<Gap> {
    let step = |pair: &[RecordedFrame]| pair[1].time - pair[0].time;
    let mut steps: Vec<f64> = frames.windows(2).map(step).collect();
    steps.sort_by(f64::total_cmp);
    let Some(usual) = steps.get(steps.len() / 2).copied() else { return Vec::new() };
    let moved = |pair: &[RecordedFrame]| {
        let bodies = pair[0].poses.iter().zip(&pair[1].poses);
        bodies
            .chain([(&pair[0].tool, &pair[1].tool)])
            .any(|(before, now)| (now.position - before.position).norm() > MOVED)
    };
    let pairs = frames.windows(2).enumerate();
    pairs
        .filter(|(_, pair)| !pair[1].lifted && step(pair) > GAP * usual && moved(pair))
        .map(|(k, pair)| Gap { frame: k + 1, step: step(pair), usual })
        .collect()
}

impl Recording {
    /// Measured bodies may be this deep in each other in a frame, metres: what trackers and the
    /// rounding of radii leave.
    pub const NOISE: f64 = 0.005;

    /// Where the pusher is set down inside an object: index of the frame and of the object.
    pub fn set_down_inside(&self) -> Vec<(usize, usize)> {
        let set_down = self.frames.iter().enumerate().filter(|(k, frame)| *k == 0 || frame.lifted);
        let mut found = Vec::new();
        for (k, frame) in set_down {
            for (index, (object, pose)) in self.scene.objects.iter().zip(&frame.poses).enumerate() {
                let solid = object.shape.footprint().shrunk(Self::NOISE);
                let mut parts = self.tool.parts.iter().enumerate();
                let on = self.lift < object.shape.height()
                    && parts.any(|(part, solids)| {
                        let at = self.tool.part_pose(part, &frame.tool);
                        clearance((&solids.footprint(), &at), (&solid, pose), Self::NOISE) <= 0.0
                    });
                if on {
                    found.push((k, index));
                }
            }
        }
        found
    }
}
