//! Motions between two frames that are impossible on a real table: a tracker lost something, frames
//! are missing, or a size is wrong.

use crate::geometry::{Footprint, Pose, clearance};
use crate::scene::{DisjointSets, Velocity, near_pairs};

use super::observed::{RecordedFrame, Recording};

/// A body that moves farther than this between two frames was lost by the tracker, metres.
const JUMP: f64 = 0.10;

/// The same for turns: a right angle, as when a tracker mixes up the sides of a square.
const TURN: f64 = 0.45 * std::f64::consts::PI;

/// Frames are missing where a time step is this many times the usual one and something moved
/// farther than [`MOVED`] metres meanwhile.
const GAP: f64 = 2.5;
const MOVED: f64 = 0.002;

/// An object that slides at the start of a recording shows it within this time, seconds; later
/// motions of untouched objects are a tracker's errors.
const SOON: f64 = 0.3;

/// Turns of less than this at the start are a tracker's errors, radians.
const TURNED: f64 = 0.05;

/// A body of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// What pushes.
    Pusher,
    /// The object with this index.
    Object(usize),
}

/// Impossible motions of bodies.
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

/// An object that moves at the start although nothing touches it, and farther than its stated velocity
/// takes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moving {
    /// Index of the object.
    pub object: usize,
    /// Index of the frame that shows it.
    pub frame: usize,
    /// How far it has come by then, metres.
    pub travel: f64,
    /// How far it has turned by then, radians.
    pub turn: f64,
}

impl Recording {
    /// Objects that are in motion in the first frame without its being stated: they move farther than
    /// their velocity takes them although neither the pusher nor anything that it may push comes near them.
    pub fn moving_at_the_start(&self) -> Vec<Moving> {
        let Some(first) = self.frames.first() else { return Vec::new() };
        // A frame with faults of its own may lack objects.
        let count = self.scene.objects.len();
        if self.frames.iter().any(|frame| frame.poses.len() != count) {
            return Vec::new();
        }
        let mut found: Vec<Moving> = Vec::new();
        for (index, frame) in self.frames.iter().enumerate().skip(1) {
            if frame.lifted || (index > 1 && frame.time > SOON) {
                break;
            }
            let pushed = self.pushed_until(index);
            for (object, pushed) in pushed.into_iter().enumerate() {
                let (from, to) = (&first.poses[object], &frame.poses[object]);
                let travel = (to.position - from.position).norm();
                let turned = (to.heading - from.heading).abs();
                let turn = if self.headings[object] { turned } else { 0.0 };
                let new = found.iter().all(|moving| moving.object != object);
                let Velocity { linear, angular } = self.velocities[object];
                let far = travel - linear.norm() * frame.time > MOVED;
                if new && !pushed && (far || turn - angular.abs() * frame.time > TURNED) {
                    found.push(Moving { object, frame: index, travel, turn });
                }
            }
        }
        found
    }

    /// For every object whether, up to frame `index`, the pusher is seen near it or near anything
    /// that moves it along, or something that does so moves from the start on.
    fn pushed_until(&self, index: usize) -> Vec<bool> {
        let seen = &self.frames[..=index];
        let footprint = |object: usize| self.scene.objects[object].shape.footprint();
        let near = |a: (&Footprint, &Pose), b: (&Footprint, &Pose)| {
            clearance(a, b, 2.0 * Self::NOISE) < Self::NOISE
        };
        let objects = 0..self.scene.objects.len();
        // Whatever is near each other, or joined, moves together; what may be joined without the
        // recording saying so is near enough at the start.
        let joined = self.scene.joints.iter().map(|joint| joint.between);
        let joinable = near_pairs(&self.scene).into_iter().map(|(pair, _)| pair);
        let mut pairs: Vec<[usize; 2]> = joined.chain(joinable).collect();
        for a in objects.clone() {
            let (own, others) = (footprint(a), a + 1..objects.end);
            pairs.extend(others.map(|b| [a, b]).filter(|[_, b]| {
                let other = footprint(*b);
                seen.iter().any(|at| near((&own, &at.poses[a]), (&other, &at.poses[*b])))
            }));
        }
        let groups = DisjointSets::of(objects.end, pairs).names().to_vec();
        let met = |object: usize| {
            let own = footprint(object);
            seen.iter().any(|at| {
                self.tool.parts().iter().enumerate().any(|(part, solid)| {
                    let pose = self.tool.part_pose(part, &at.tool);
                    near((&solid.footprint(), &pose), (&own, &at.poses[object]))
                })
            })
        };
        let alone =
            |object: usize| groups.iter().filter(|own| **own == groups[object]).count() == 1;
        let moves =
            |object: usize| self.velocities[object] != Velocity::default() && !alone(object);
        let pushed = objects.clone().filter(|object| met(*object) || moves(*object));
        let pushed: Vec<usize> = pushed.map(|object| groups[object]).collect();
        objects.map(|object| pushed.contains(&groups[object])).collect()
    }

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
                let mut parts = self.tool.parts().iter().enumerate();
                let on = self.lift < object.top()
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
