//! Conversion of recorded pusher poses into strokes for effect models.

use std::sync::Arc;

use crate::geometry::Pose;
use crate::{
    scene::{FRAME_TRAVEL, ObservedPose},
    task::{COAST_FRAME, Observation, Stroke, ToolMotion},
};

use super::observed::Recording;

/// Motion between frames below which a pusher stands still, metres and radians: the jitter of
/// trackers.
const STANDING: f64 = 2e-4;
const STANDING_TURN: f64 = 4e-3;

/// Maximum deviation of the pusher from a uniform motion along one stroke, metres and radians: well
/// below the effects of pushing.
const STRAIGHT: f64 = 5e-4;
const STRAIGHT_TURN: f64 = 0.02;

/// A recording as a tool motion, with the instants at which prediction and recording are compared.
#[derive(Clone, Debug, PartialEq)]
pub struct Replay {
    /// Motion of the pusher: strokes of about a model's frame, with a wait for rest only before the
    /// pusher is lifted.
    pub motion: ToolMotion,
    /// Instants ordered by time; the last one is the last recorded frame.
    pub instants: Vec<Instant>,
}

/// A recorded frame and the stroke that ends with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Instant {
    /// Index into [`Recording::frames`].
    pub frame: usize,
    /// Index of the stroke.
    pub stroke: usize,
    /// Whether the instant is the rest after the stroke, not the stroke's end.
    pub settled: bool,
}

impl Recording {
    /// Returns the pusher's motion.
    ///
    /// Frames are joined while the pusher moves straight and uniformly, up to the travel of a
    /// model's frame. Longer steps are divided by the stroke itself. Steps in which the pusher
    /// rotates are divided by the travel of its contact surface.
    pub fn replay(&self) -> Replay {
        let frames = &self.frames;
        let motion =
            ToolMotion { tool: Arc::clone(&self.tool), lift: self.lift, strokes: Vec::new() };
        let mut replay = Replay { motion, instants: Vec::new() };
        let Some(first) = frames.first() else { return replay };
        let mut at = first.tool;
        let mut from = 0;
        while from + 1 < frames.len() {
            let to = self.reach(from, &at);
            if frames[to].lifted {
                replay.settle();
                at = frames[to].tool;
                let stroke = replay.motion.strokes.len();
                // There is nothing to wait for before the first stroke.
                if let Some(stroke) = stroke.checked_sub(1).filter(|_| frames[to].seen) {
                    replay.instants.push(Instant { frame: to, stroke, settled: true });
                }
            } else {
                let duration = frames[to].time - frames[from].time;
                replay.move_to(&mut at, frames[to].tool, duration);
                let stroke = replay.motion.strokes.len() - 1;
                if frames[to].seen {
                    replay.instants.push(Instant { frame: to, stroke, settled: false });
                }
            }
            from = to;
        }
        replay
    }

    /// Returns the last frame at which one stroke can end that starts in frame `from` with the
    /// pusher at `at`.
    fn reach(&self, from: usize, at: &Pose) -> usize {
        let frames = &self.frames;
        let mut to = from + 1;
        if frames[to].lifted {
            return to;
        }
        while to + 1 < frames.len() && !frames[to + 1].lifted && self.one_stroke(from, to + 1, at) {
            to += 1;
        }
        to
    }

    /// Returns `true` if the pusher moves uniformly from `at` in frame `from` to its pose in frame
    /// `to`.
    fn one_stroke(&self, from: usize, to: usize, at: &Pose) -> bool {
        let frames = &self.frames;
        let (start, end) = (frames[from].time, frames[to].time);
        if stands(at, &frames[to].tool) {
            let still = frames[from..=to].iter().all(|frame| stands(at, &frame.tool));
            return still && end - start <= COAST_FRAME * (1.0 + 1e-6);
        }
        self.tool.travel(at, &frames[to].tool) <= FRAME_TRAVEL * (1.0 + 1e-6)
            && frames[from + 1..to].iter().all(|frame| {
                let even = at.towards(&frames[to].tool, (frame.time - start) / (end - start));
                (frame.tool.position - even.position).norm() <= STRAIGHT
                    && (frame.tool.heading - even.heading).abs() <= STRAIGHT_TURN
            })
    }

    /// Returns the observations at the instants of [`Self::replay`], taken at rest if the pusher is
    /// lifted.
    pub fn observations(&self) -> Vec<Observation> {
        let replay = self.replay();
        let mut observations = Vec::new();
        let mut done = 0;
        for Instant { frame, stroke, .. } in observed(&replay) {
            let poses = self.frames[frame].poses.iter().zip(&self.headings);
            observations.push(Observation {
                strokes: replay.motion.strokes[done..=stroke].to_vec(),
                seen: poses
                    .map(|(pose, heading)| Some(ObservedPose::new(pose, *heading)))
                    .collect(),
            });
            done = stroke + 1;
        }
        observations
    }

    /// Returns the frame indices of [`Self::observations`].
    pub fn observed_frames(&self) -> Vec<usize> {
        observed(&self.replay()).map(|instant| instant.frame).collect()
    }
}

/// Returns the instants of a replay, without ends of strokes that a rest follows.
fn observed(replay: &Replay) -> impl Iterator<Item = Instant> {
    let rests = |k: usize| replay.instants.get(k + 1).is_some_and(|next| next.settled);
    let instants = replay.instants.iter().copied().enumerate();
    instants.filter(move |(k, instant)| instant.settled || !rests(*k)).map(|(_, instant)| instant)
}

impl Replay {
    fn settle(&mut self) {
        if let Some(last) = self.motion.strokes.last_mut() {
            last.settle = true;
        }
    }

    /// Adds the strokes that move the pusher from `at` to `to`.
    fn move_to(&mut self, at: &mut Pose, to: Pose, duration: f64) {
        let tool = Arc::clone(&self.motion.tool);
        let mut push = |from, to, duration| {
            self.motion.strokes.push(Stroke { from, to, duration, settle: false });
        };
        if stands(at, &to) {
            // Frames of at most the duration that models use while waiting for rest.
            let pieces = (duration / COAST_FRAME - 1e-6).ceil().max(1.0);
            for _ in 0..pieces as usize {
                push(*at, *at, duration / pieces);
            }
        } else {
            // A stroke is divided by the travel of the tool's frame, but points of a rotating tool
            // can travel much farther.
            let travel = tool.travel(at, &to);
            let turns = at.heading != to.heading;
            let pieces = if turns { (travel / FRAME_TRAVEL - 1e-6).ceil().max(1.0) } else { 1.0 };
            let place = |k: f64| if k < pieces { at.towards(&to, k / pieces) } else { to };
            for k in 0..pieces as usize {
                push(place(k as f64), place(k as f64 + 1.0), duration / pieces);
            }
            *at = to;
        }
    }
}

fn stands(at: &Pose, to: &Pose) -> bool {
    (to.position - at.position).norm() < STANDING && (to.heading - at.heading).abs() < STANDING_TURN
}
