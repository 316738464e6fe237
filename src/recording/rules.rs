//! Motions between two frames that are impossible on a real table. They indicate a tracking loss,
//! missing frames or a wrong size.

use crate::geometry::{Footprint, Pose, clearance};
use crate::scene::{DisjointSets, Velocity, near_pairs};

use super::observed::{RecordedFrame, Recording};

/// Travel between two frames beyond which the tracker lost the body, metres.
const JUMP: f64 = 0.10;

/// Rotation between two frames beyond which the tracker lost the body, radians: nearly a right
/// angle, as when a tracker confuses the sides of a square.
const TURN: f64 = 0.45 * std::f64::consts::PI;

/// Time step, relative to the usual one, beyond which frames are missing if a body moved farther
/// than [`MOVED`] metres meanwhile.
const GAP: f64 = 2.5;
const MOVED: f64 = 0.002;

/// Time within which an object that slides at the start must show it, seconds; later motions of
/// untouched objects are tracking errors.
const SOON: f64 = 0.3;

/// Rotation at the start below which it is a tracking error, radians.
const TURNED: f64 = 0.05;

/// A body of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// The pusher.
    Pusher,
    /// The object with this index.
    Object(usize),
}

/// An impossible motion of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Strange {
    /// Travel in one step, metres.
    Moves(f64),
    /// Rotation in one step, radians.
    Turns(f64),
}

/// A body that the tracker lost between two frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// The body.
    pub body: Body,
    /// Its motion.
    pub what: Strange,
}

/// A time step in which frames are missing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Index of the frame after the step.
    pub frame: usize,
    /// Length of the step, seconds.
    pub step: f64,
    /// Usual length of a step, seconds.
    pub usual: f64,
}

/// Returns the bodies that the tracker lost between two frames, the pusher first. Headings must be
/// unwrapped, see [`RecordedFrame::unwrap_after`].
pub fn jumps(before: &RecordedFrame, now: &RecordedFrame) -> Vec<Jump> {
    let pusher = (!now.lifted).then_some((Body::Pusher, &before.tool, &now.tool));
    // After frames without objects, their last sight may be long ago.
    let seen = if before.seen { &before.poses[..] } else { &[] };
    let poses = seen.iter().zip(&now.poses).enumerate();
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

/// Returns the time steps that are much longer than usual although a body moves.
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

/// An untouched object that moves at the start farther than its stated velocity explains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moving {
    /// Index of the object.
    pub object: usize,
    /// Index of the frame in which the motion is visible.
    pub frame: usize,
    /// Travel up to that frame, metres.
    pub travel: f64,
    /// Rotation up to that frame, radians.
    pub turn: f64,
}

impl Recording {
    /// Returns the objects with an unstated motion in the first frame: they move farther than their
    /// velocity explains, although the pusher and all bodies that it may push stay away from them.
    pub fn moving_at_the_start(&self) -> Vec<Moving> {
        let Some(first) = self.frames.first() else { return Vec::new() };
        // A frame that is itself faulty may lack objects.
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

    /// Returns for every object whether it may be pushed up to frame `index`.
    ///
    /// An object may be pushed if the pusher, or a body that moves from the start, is observed near
    /// its group. A group contains objects that are near each other or joined.
    fn pushed_until(&self, index: usize) -> Vec<bool> {
        let seen = &self.frames[..=index];
        let footprint = |object: usize| self.scene.objects[object].shape.footprint();
        let near = |a: (&Footprint, &Pose), b: (&Footprint, &Pose)| {
            clearance(a, b, 2.0 * Self::NOISE) < Self::NOISE
        };
        let objects = 0..self.scene.objects.len();
        // Objects that are near each other, or joined, move together. Possible joints that the
        // recording does not state connect objects that are near enough at the start.
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

    /// Maximum penetration of measured bodies in a frame, metres: tracking errors and the rounding
    /// of radii.
    pub const NOISE: f64 = 0.005;

    /// Returns the frame and object indices at which the pusher is set down inside an object.
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
