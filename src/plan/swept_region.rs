//! Swept region of a plan, which must be free of obstructions: the places that its tool and the
//! goal's object pass.
//!
//! A plan made without the other objects shows which of them must be cleared. Clearing the objects
//! in its swept region suffices. Task planning uses relaxed plans in the same role (Bonet and
//! Geffner 2001, "Planning as heuristic search").

use std::sync::Arc;

use crate::geometry::{Footprint, Pose, contact_points};
use crate::{
    outcome::Trajectory,
    scene::{Object, Situation, State},
    task::{Goal, Task, ToolMotion},
};

use super::Workspace;

/// Distance to the swept region below which an object obstructs it, metres: less than the play in
/// which objects are pushed past each other.
const NEEDED: f64 = 0.005;

/// Wanted distance of cleared objects from the swept region, metres: at least the error of an
/// object's predicted final position.
const ROOM: f64 = 0.03;

/// Sampling distance along the path of a tool or an object, metres: less than the width of any
/// object on a table.
const SAMPLE: f64 = 0.02;

/// Rotation beyond which a pose is sampled again, radians.
const TURNED: f64 = 0.2;

/// Distance from the robot at which ignored objects are placed, metres: no push reaches them.
const FAR_AWAY: f64 = 1e3;

/// Returns the objects without a joint to any object named by a goal, where `groups` lists the
/// jointed groups.
fn others(task: &Task, groups: &[usize]) -> Vec<usize> {
    let named: Vec<usize> = task.goals.iter().flat_map(Goal::objects).collect();
    let own = |k: usize| named.iter().any(|named| groups[*named] == groups[k]);
    (0..groups.len()).filter(|&k| !own(k)).collect()
}

/// Region swept by a plan.
#[derive(Clone, Debug)]
pub struct SweptRegion {
    passed: Vec<Passed>,
    /// Objects that may obstruct the region.
    others: Vec<(usize, Object)>,
}

/// Place swept by a part or an object.
#[derive(Clone, Copy, Debug)]
struct Passed {
    footprint: Footprint,
    pose: Pose,
    /// Lowest and highest height above the table, metres.
    span: [f64; 2],
}

/// Returns the task without the objects that have no joint to a goal's object, and with one fewer
/// push. Returns `None` if there are no such objects or no push is left.
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
    // The removed objects lie beyond the end of any table.
    task.scene.table_top = None;
    task.pushes.max_count = task.pushes.max_count.saturating_sub(1);
    situation.scene = Arc::new(task.scene.clone());
    (put > 0 && task.pushes.max_count > 0).then_some((task, situation))
}

impl SweptRegion {
    /// Returns the region swept by `motions`, in which the goals' objects move along `trajectory`.
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
                    // The tool comes down from above.
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

    /// Returns the objects that obstruct the region.
    pub fn blocking(&self, state: &State) -> Vec<usize> {
        let depths = self.depths(state);
        depths.filter(|(_, depth)| *depth > ROOM - NEEDED).map(|(k, _)| k).collect()
    }

    /// Returns, for every object that may obstruct the region, the distance that it would have to
    /// move, metres.
    pub(super) fn depths(&self, state: &State) -> impl Iterator<Item = (usize, f64)> {
        self.others.iter().map(|(k, object)| (*k, self.depth(object, &state.poses[*k])))
    }

    /// Returns the distance that an object at `pose` would have to move to leave the region with
    /// room, metres; 0 outside the region.
    fn depth(&self, object: &Object, pose: &Pose) -> f64 {
        let own = object.shape.footprint();
        let into = |passed: &Passed| {
            let (points, _) = contact_points((&own, pose), (&passed.footprint, &passed.pose), ROOM);
            points[0].map_or(0.0, |point| ROOM - point.gap)
        };
        let met = self.passed.iter().filter(|passed| object.meets(passed.span));
        met.map(into).fold(0.0, f64::max)
    }

    /// Returns the depth of object `k` at `pose`, or 0 if that object cannot obstruct the region.
    pub(super) fn depth_of(&self, k: usize, pose: &Pose) -> f64 {
        let own = self.others.iter().find(|(other, _)| *other == k);
        own.map_or(0.0, |(_, object)| self.depth(object, pose))
    }
}
