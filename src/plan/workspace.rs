//! Limits of a task for the tool: free travel, and margins to all rules.

use std::sync::Arc;

use crate::geometry::{
    Footprint, Pose, Vector, clearance, distance_to_origin, perpendicular, swept_clearance,
    travel_to_contact,
};
use crate::{
    scene::{Fixed, Mover, Part, State, Tool},
    task::{Push, PushForm, Task},
};

use super::{Infeasible, Placement, STAND_OFF};

/// Minimum distance between a descending tool and every object, metres. It is small compared with
/// the stand-off, because a glancing face is closer to a round object than its travel.
pub const SET_DOWN_CLEARANCE: f64 = 0.001;

/// Maximum room on all sides for the uncertain pose of an object, metres: the arms of a hook leave
/// no more.
const MOST_ASIDE: f64 = 0.01;

/// Minimum distance between a tool and obstacles, also during pushes, metres: the error of a robot
/// arm and its calibration.
pub const OBSTACLE_CLEARANCE: f64 = 0.005;

/// Minimum distance between a hand and all bodies at its height, metres, because no sensor observes
/// it.
pub const HAND_CLEARANCE: f64 = 0.01;

/// Length of the shortest useful push, metres: the stand-off and an equal distance in contact.
pub const MIN_LENGTH: f64 = 0.01;

/// Share of the object's half width by which tried offsets exceed the face's half width. Farther
/// out the face only grazes the object.
const OVERHANG: f64 = 0.6;

/// Share of the object's half width by which refined offsets may exceed the face's half width.
const LARGEST_OVERHANG: f64 = 0.9;

/// Step by which a push that the arm cannot complete is shortened, metres.
const SHORTER: f64 = 0.02;

/// Largest distance that margins distinguish, metres.
const FAR: f64 = 0.05;

/// Tolerance of the rules, metres: iterative closest points are not exact to the last digit.
const SLACK: f64 = 1e-6;

/// Margins of a push to each rule, metres; negative for a violated rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margins {
    /// Margin of the end effector at the start to the outer reach.
    pub start: f64,
    /// Margin of the end effector at the end to the outer reach.
    pub end: f64,
    /// Margin of the end effector's path to the inner reach.
    pub base: f64,
    /// Margin of the moving tool to the obstacles, beyond [`OBSTACLE_CLEARANCE`].
    pub obstacle: f64,
    /// Margin of the tool to the objects when set down, beyond [`SET_DOWN_CLEARANCE`] and the
    /// push's room.
    pub object: f64,
    /// Margin of the hand to all bodies at its height, beyond [`HAND_CLEARANCE`].
    pub hand: f64,
}

impl Margins {
    /// Number of rules.
    pub const COUNT: usize = 6;

    /// Returns all margins, in a fixed order.
    pub fn list(&self) -> [f64; Self::COUNT] {
        [self.start, self.end, self.base, self.obstacle, self.object, self.hand]
    }

    /// Returns the first violated rule.
    pub fn violation(&self) -> Option<Infeasible> {
        let reasons = [
            Infeasible::Reach,
            Infeasible::Reach,
            Infeasible::Reach,
            Infeasible::Obstacle,
            Infeasible::OnObject,
            Infeasible::Hand,
        ];
        let mut pairs = self.list().into_iter().zip(reasons);
        pairs.find(|(margin, _)| margin.is_nan() || *margin < -SLACK).map(|(_, reason)| reason)
    }
}

/// Task with the tools that may be used.
#[derive(Clone, Copy)]
pub struct Workspace<'a> {
    /// The task.
    pub task: &'a Task,
    /// Tools that candidates name by index.
    pub tools: &'a [Arc<Tool>],
}

impl Workspace<'_> {
    /// Returns the longest travel, at most `length` metres, that satisfies reach and obstacle
    /// clearance.
    ///
    /// # Errors
    /// Returns the reason if the travel is shorter than [`MIN_LENGTH`].
    pub fn free_travel(
        &self,
        (tool, grip_yaw): (usize, f64),
        start: Vector,
        direction: f64,
        length: f64,
    ) -> Result<f64, Infeasible> {
        let robot = &self.task.robot;
        if !self.task.is_reachable(start, grip_yaw) {
            return Err(Infeasible::Reach);
        }
        let (ahead, _) = axes(direction);
        let along = start.dot(&ahead);
        let square = along * along - start.norm_squared();
        let mut free = length.min(-along + (square + robot.reach_max.powi(2)).max(0.0).sqrt());
        let base = Footprint::Disc { radius: robot.reach_min };
        let hand = (&Footprint::Disc { radius: 0.0 }, &Pose { position: start, heading: 0.0 });
        if robot.reach_min > 0.0
            && let Some(t) = travel_to_contact(hand, ahead, (&base, &Pose::default()))
        {
            free = free.min(t);
        }
        // An arm cannot hold the tool with this yaw everywhere.
        while free >= MIN_LENGTH
            && !self.task.is_reachable(start + ahead * (free - SLACK), grip_yaw)
        {
            free -= SHORTER;
        }
        if free < MIN_LENGTH {
            return Err(Infeasible::Reach);
        }
        let (tool, scene) = (&*self.tools[tool], &self.task.scene);
        let frame = tool.pose(Pose { position: start, heading: grip_yaw });
        let room = |moving: (&Footprint, &Pose), fixed: &Fixed, apart: f64| {
            let grown = fixed.footprint.grown(apart);
            travel_to_contact(moving, ahead, (&grown, &fixed.pose))
        };
        for (k, part) in tool.parts().iter().enumerate() {
            let (shape, from) = (part.footprint(), tool.part_pose(k, &frame));
            let span = self.span_of(part);
            for fixed in scene.fixed(Mover::Tool, span) {
                match room((&shape, &from), &fixed, OBSTACLE_CLEARANCE) {
                    Some(t) if t <= 0.0 => return Err(Infeasible::Obstacle),
                    Some(t) => free = free.min(t),
                    None => {}
                }
            }
            let below = |fixed: Fixed| {
                let still = (&fixed.footprint, &fixed.pose);
                clearance((&shape, &from), still, FAR) < OBSTACLE_CLEARANCE
            };
            if self.is_placed() && scene.above(span[1]).any(below) {
                return Err(Infeasible::Obstacle);
            }
        }
        if free < MIN_LENGTH {
            return Err(Infeasible::NoRoom);
        }
        for carried in robot.carried(tool, self.task.pushes.lift).into_iter().flatten() {
            let moving = (&carried.footprint, &(frame * carried.pose));
            for fixed in scene.fixed(Mover::Hand, carried.span) {
                free = free.min(room(moving, &fixed, HAND_CLEARANCE).unwrap_or(f64::INFINITY));
            }
        }
        if free < MIN_LENGTH { Err(Infeasible::Hand) } else { Ok(free) }
    }

    /// Returns the margin of hand and handle to obstacles and to objects at their height. All such
    /// objects count while the tool is set down, and all but the pushed one during the push. The
    /// pushed one also counts where the tool meets it.
    fn hand(
        &self,
        tool: &Tool,
        (from, to): (&Pose, &Pose),
        (state, pushed): (&State, usize),
        set_down: Option<Placement>,
    ) -> f64 {
        let (task, mut least) = (self.task, FAR);
        // Position of the tool when it meets the pushed object.
        let approach = set_down.map_or(0.0, |placement| placement.approach());
        let travel = (to.position - from.position).norm();
        let meets = from.towards(to, (approach / travel).min(1.0));
        let most = FAR + HAND_CLEARANCE;
        for carried in task.robot.carried(tool, task.pushes.lift).into_iter().flatten() {
            let [from, to, meets] = [from, to, &meets].map(|frame| *frame * carried.pose);
            for other in task.scene.fixed(Mover::Hand, carried.span) {
                let still = (&other.footprint, &other.pose);
                least = least.min(swept_clearance(&carried.footprint, &from, &to, still, most));
            }
            for other in task.scene.above(carried.span[1]).filter(|_| set_down.is_some()) {
                let still = (&other.footprint, &other.pose);
                least = least.min(clearance((&carried.footprint, &from), still, most));
            }
            let objects = task.scene.objects.iter().zip(&state.poses).enumerate();
            for (k, (object, pose)) in objects {
                // During the descent, the hand passes all heights above its own.
                if carried.span[0] >= object.top() {
                    continue;
                }
                let still = (&object.shape.footprint(), pose);
                if set_down.is_some() {
                    least = least.min(clearance((&carried.footprint, &from), still, most));
                }
                if k == pushed && set_down.is_some() {
                    let gap = clearance((&carried.footprint, &meets), still, most);
                    least = least.min(gap + STAND_OFF);
                }
                if k != pushed && object.meets(carried.span) {
                    least = least.min(swept_clearance(&carried.footprint, &from, &to, still, most));
                }
            }
        }
        least - HAND_CLEARANCE
    }

    /// Returns the margins of a push of object `pushed` from `state` to every rule. A tool that is
    /// set down must clear the objects by the room in `set_down`; a chained push after the first
    /// begins in contact.
    pub fn margins(
        &self,
        (tool, grip_yaw): (usize, f64),
        (state, pushed): (&State, usize),
        push: &Push,
        set_down: Option<Placement>,
    ) -> Margins {
        let (task, tool) = (self.task, &*self.tools[tool]);
        let frame = |position| tool.pose(Pose { position, heading: grip_yaw });
        let (from, to) = (frame(push.start), frame(push.end()));
        let (mut obstacle, mut object) = (FAR, FAR);
        for (k, part) in tool.parts().iter().enumerate() {
            let (shape, from, to) =
                (part.footprint(), tool.part_pose(k, &from), tool.part_pose(k, &to));
            let (span, most) = (self.span_of(part), FAR + OBSTACLE_CLEARANCE);
            for other in task.scene.fixed(Mover::Tool, span) {
                let still = (&other.footprint, &other.pose);
                let gap = swept_clearance(&shape, &from, &to, still, most);
                obstacle = obstacle.min(gap - OBSTACLE_CLEARANCE);
            }
            for other in task.scene.above(span[1]).filter(|_| set_down.is_some()) {
                let gap = clearance((&shape, &from), (&other.footprint, &other.pose), most);
                obstacle = obstacle.min(gap - OBSTACLE_CLEARANCE);
            }
            if let Some(placement) = set_down {
                let clear = SET_DOWN_CLEARANCE + placement.room.min(MOST_ASIDE);
                for (other, pose) in task.scene.objects.iter().zip(&state.poses) {
                    if task.pushes.lift < other.top() {
                        let still = (&other.shape.footprint(), pose);
                        let gap = clearance((&shape, &from), still, FAR + clear);
                        object = object.min(gap - clear);
                    }
                }
            }
        }
        Margins {
            start: task.robot.reach_max - push.start.norm(),
            end: task.robot.reach_max - push.end().norm(),
            base: distance_to_origin(push.start, push.end()) - task.robot.reach_min,
            obstacle,
            object,
            hand: self.hand(tool, (&from, &to), (state, pushed), set_down),
        }
    }

    /// Returns the largest absolute offset tried in a search, metres, for an object in a state.
    pub fn offset_span(
        &self,
        pair: (usize, f64),
        object: (&State, usize),
        part: usize,
        along: f64,
    ) -> f64 {
        self.span(pair, object, part, along, OVERHANG)
    }

    /// Returns the largest absolute offset in refinement, metres.
    pub fn largest_offset(
        &self,
        pair: (usize, f64),
        object: (&State, usize),
        part: usize,
        along: f64,
    ) -> f64 {
        self.span(pair, object, part, along, LARGEST_OVERHANG)
    }

    /// Returns `true` if pushes are placed and not chained.
    pub fn is_placed(&self) -> bool {
        self.task.pushes.form == PushForm::Placed
    }

    fn span(
        &self,
        (tool, grip_yaw): (usize, f64),
        (state, object): (&State, usize),
        part: usize,
        direction: f64,
        overhang: f64,
    ) -> f64 {
        let tool = &*self.tools[tool];
        let (footprint, at) = self.object(object, state);
        let (_, left) = axes(direction);
        let frame = tool.pose(Pose { position: Vector::zeros(), heading: grip_yaw });
        let face = tool.part_pose(part, &frame).local_vector(left);
        // The wider side counts, because offsets beyond the narrower one are rejected later for
        // lack of contact.
        let wide = |shape: &Footprint, axis: Vector| shape.extent(axis).max(shape.extent(-axis));
        wide(&tool.parts()[part].footprint(), face)
            + overhang * wide(&footprint, at.local_vector(left))
    }

    pub(super) fn object(&self, index: usize, state: &State) -> (Footprint, Pose) {
        (self.task.scene.objects[index].shape.footprint(), state.poses[index])
    }

    /// Returns the lowest and highest height of a tool's part above the table, metres.
    pub(super) fn span_of(&self, part: &Part) -> [f64; 2] {
        let lift = self.task.pushes.lift;
        [lift, lift + part.shape.height()]
    }
}

/// Returns the unit vectors ahead and to the left.
pub(super) fn axes(direction: f64) -> (Vector, Vector) {
    let ahead = Vector::new(direction.cos(), direction.sin());
    (ahead, perpendicular(ahead))
}
