//! What a plan needs free: the places that its tool and the goal's object pass.
//!
//! A plan that is made as if nothing else stood on the table says what has to be moved aside, as the
//! relaxed plans of task planning do (Bonet and Geffner 2001, "Planning as heuristic search"): what
//! stands in its corridor, and that is enough.

use std::sync::Arc;

use crate::geometry::{Footprint, Pose, contact_points};
use crate::{
    outcome::Trajectory,
    scene::{Object, Situation, State},
    task::{Goal, Task, ToolMotion},
};

use super::Workspace;

/// What stands nearer than this to the corridor stands in the way, metres: less than the play in
/// which things are pushed past each other.
const NEEDED: f64 = 0.005;

/// Things are moved so far from the corridor where they can be, metres: at least as far as an object
/// comes to lie from where it is predicted.
const ROOM: f64 = 0.03;

/// How densely the way of a tool or an object is sampled, metres: less than what anything that stands
/// on a table is wide.
const SAMPLE: f64 = 0.02;

/// Another turn than this is another place, radians.
const TURNED: f64 = 0.2;

/// Where things that are not to be in the way are put, metres from the robot: no push comes there.
const FAR_AWAY: f64 = 1e3;

/// What is not joined to an object that a goal speaks of, when `groups` says what is joined.
fn others(task: &Task, groups: &[usize]) -> Vec<usize> {
    let named: Vec<usize> = task.goals.iter().flat_map(Goal::objects).collect();
    let own = |k: usize| named.iter().any(|named| groups[*named] == groups[k]);
    (0..groups.len()).filter(|&k| !own(k)).collect()
}

/// All that a plan passes.
#[derive(Clone, Debug)]
pub struct SweptRegion {
    passed: Vec<Passed>,
    /// The objects that may stand in it.
    others: Vec<(usize, Object)>,
}

/// A place that something passes.
#[derive(Clone, Copy, Debug)]
struct Passed {
    footprint: Footprint,
    pose: Pose,
    /// Heights above the table between which it is, metres.
    span: [f64; 2],
}

/// A task as it would be without all that is not joined to a goal's object, with fewer pushes by one;
/// `None` if there is nothing else, or no push is left for it.
pub fn alone(task: &Task, situation: &Situation) -> Option<(Task, Situation)> {
    let groups = situation.physics.groups(|_| true);
    let (mut task, mut situation) = (task.clone(), situation.clone());
    let others = others(&task, &groups);
    let mut put = 0;
    for k in others {
        put += 1;
        situation.start.poses[k].position.x = -FAR_AWAY * put as f64;
        task.scene.objects[k].keep = None;
    }
    // They are beyond the end of any table.
    task.scene.table_top = None;
    task.pushes.max_count = task.pushes.max_count.saturating_sub(1);
    situation.scene = Arc::new(task.scene.clone());
    (put > 0 && task.pushes.max_count > 0).then_some((task, situation))
}

impl SweptRegion {
    /// Of `motions`, in which the goals' objects move as `trajectory` says.
    pub fn of(
        workspace: &Workspace,
        situation: &Situation,
        motions: &[ToolMotion],
        trajectory: &Trajectory,
    ) -> Self {
        let objects = &situation.scene.objects;
        let groups = situation.physics.groups(|_| true);
        let object = |k: usize, pose| {
            let (footprint, span) = (objects[k].shape.footprint(), objects[k].span());
            Passed { footprint, pose, span }
        };
        let mut passed = Vec::new();
        let strokes =
            motions.iter().flat_map(|motion| motion.strokes.iter().map(move |one| (motion, one)));
        for (motion, stroke) in strokes {
            let steps = (stroke.travel() / SAMPLE).ceil().max(1.0);
            for step in 0..=steps as usize {
                let tool = stroke.from.towards(&stroke.to, step as f64 / steps);
                let parts = motion.tool.parts().iter();
                passed.extend(parts.map(|part| {
                    let (footprint, pose) = (part.footprint(), tool * part.pose);
                    // It comes down from above.
                    let top = if step == 0 { f64::INFINITY } else { part.shape.height() };
                    Passed { footprint, pose, span: [motion.lift, motion.lift + top] }
                }));
            }
        }
        let others = others(workspace.task, &groups);
        for k in (0..objects.len()).filter(|k| !others.contains(k)) {
            let mut last: Option<Pose> = None;
            for pose in trajectory.frames.iter().map(|frame| frame.state.poses[k]) {
                let same = |last: &Pose| {
                    let turned = (pose.heading - last.heading).abs();
                    (pose.position - last.position).norm() < SAMPLE && turned < TURNED
                };
                if !last.as_ref().is_some_and(same) {
                    passed.push(object(k, pose));
                    last = Some(pose);
                }
            }
            passed.push(object(k, trajectory.outcome().poses[k]));
        }
        let low = |k: usize| objects[k].top() <= workspace.task.pushes.lift;
        let others = others.into_iter().filter(|&k| !low(k));
        Self { passed, others: others.map(|k| (k, objects[k].clone())).collect() }
    }

    /// What stands in it.
    pub fn blocking(&self, state: &State) -> Vec<usize> {
        let depths = self.depths(state);
        depths.filter(|(_, depth)| *depth > ROOM - NEEDED).map(|(k, _)| k).collect()
    }

    /// How far all that may stand in it would have to move to leave room, metres.
    pub(super) fn depths(&self, state: &State) -> impl Iterator<Item = (usize, f64)> {
        self.others.iter().map(|(k, object)| (*k, self.depth(object, &state.poses[*k])))
    }

    /// How far an object at `pose` would have to move, metres; 0 beside it, with room.
    fn depth(&self, object: &Object, pose: &Pose) -> f64 {
        let own = object.shape.footprint();
        let into = |passed: &Passed| {
            let (points, _) = contact_points((&own, pose), (&passed.footprint, &passed.pose), ROOM);
            points[0].map_or(0.0, |point| ROOM - point.gap)
        };
        let met = self.passed.iter().filter(|passed| object.meets(passed.span));
        met.map(into).fold(0.0, f64::max)
    }

    /// The same of object `k`, if that may stand in it.
    pub(super) fn depth_of(&self, k: usize, pose: &Pose) -> f64 {
        let own = self.others.iter().find(|(other, _)| *other == k);
        own.map_or(0.0, |(_, object)| self.depth(object, pose))
    }
}
