//! What a task allows the tool to do: where it can be set down, how far it can go, and by how
//! much it keeps its distances.

use std::sync::Arc;

use crate::geometry::{
    Footprint, Pose, Vector, clearance, perpendicular, swept_clearance, travel_to_contact,
};
use crate::{
    scene::{Fixed, Mover, Part, State, Tool},
    task::{Push, PushForm, Task},
};

use super::{CandidatePush, Infeasible, Start};

/// Travel of the contacting face before it meets the object, metres (by the definition of a
/// placed push).
pub const STAND_OFF: f64 = 0.005;

/// A tool that comes down keeps at least this distance from every object, metres. Small compared
/// with the stand-off, because a glancing face is closer to a round object than it travels.
pub const SET_DOWN_CLEARANCE: f64 = 0.001;

/// Room for where an object may be is kept on all sides up to this, metres: between the arms of a
/// hook there is no more.
const MOST_ASIDE: f64 = 0.01;

/// A tool keeps at least this distance from obstacles, also while pushing, metres: the error of a
/// robot arm and its calibration.
pub const OBSTACLE_CLEARANCE: f64 = 0.005;

/// A hand keeps at least this distance from all that is as high as it is, metres: nobody looks there.
pub const HAND_CLEARANCE: f64 = 0.01;

/// Shortest push worth making, metres: the stand-off and then as much again, to have an effect.
pub const MIN_LENGTH: f64 = 0.01;

/// Offsets are tried up to the face's half width plus this share of the object's half width.
/// Farther out the face only grazes the object.
const OVERHANG: f64 = 0.6;

/// Refinement may shift the offset up to this share of the object's half width past the face.
const LARGEST_OVERHANG: f64 = 0.9;

/// A push that an arm does not carry through is shortened by this, metres, until it does.
const SHORTER: f64 = 0.02;

/// Distances larger than this are all alike to the margins, metres.
const FAR: f64 = 0.05;

/// Slack for rounding in comparisons of closed forms, metres.
const ROUNDING: f64 = 1e-9;

/// Slack in the rules, metres: iterative closest points are not exact to the last digit.
const SLACK: f64 = 1e-6;

/// Margins of a push to each rule, metres; negative where it breaks one.
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
    /// Margin of the tool set down to the objects, beyond [`SET_DOWN_CLEARANCE`] and the push's room.
    pub object: f64,
    /// Margin of the hand to all that is as high, beyond its clearance.
    pub hand: f64,
}

impl Margins {
    /// Number of rules.
    pub const COUNT: usize = 6;

    /// Returns all margins, in a fixed order.
    pub fn list(&self) -> [f64; Self::COUNT] {
        [self.start, self.end, self.base, self.obstacle, self.object, self.hand]
    }

    /// The first rule that is broken.
    pub fn broken(&self) -> Option<Infeasible> {
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

/// A task together with the tools that may be used on it.
#[derive(Clone, Copy)]
pub struct Workspace<'a> {
    /// The task.
    pub task: &'a Task,
    /// The tools that candidates name by index.
    pub tools: &'a [Arc<Tool>],
}

impl Workspace<'_> {
    /// End-effector position at which the push of a candidate starts: for a placed push so that
    /// the part's leading face meets the object after exactly the stand-off and the push's room,
    /// with the wanted offset; for a chained one `previous`, or home.
    ///
    /// # Errors
    /// [`Infeasible::NoContact`] and [`Infeasible::OtherPartFirst`]. Reach and collisions are
    /// not checked here, see [`Workspace::margins`].
    pub fn place(
        &self,
        state: &State,
        push: &CandidatePush,
        previous: Option<Vector>,
    ) -> Result<Vector, Infeasible> {
        let Start::Placed { part, offset } = push.start else {
            return Ok(previous.unwrap_or(self.task.robot.home));
        };
        let (tool, grip_yaw) = (&*self.tools[push.tool], push.grip_yaw);
        let (footprint, at) = self.object(push.object, state);
        let (ahead, left) = axes(push.direction);
        let object = &self.task.scene.objects[push.object];
        let meets = |k: usize| object.meets(self.span_of(&tool.parts()[k]));
        if !meets(part) {
            return Err(Infeasible::NoContact);
        }
        // The end effector at the world's origin; everything below is shifted from there.
        let frame = tool.pose(Pose { position: Vector::zeros(), heading: grip_yaw });
        let parts: Vec<(Footprint, Pose)> = (0..tool.parts().len())
            .map(|k| (tool.parts()[k].footprint(), tool.part_pose(k, &frame)))
            .collect();
        let (face, pose) = parts[part];
        let stand_off = STAND_OFF + push.room;
        let behind = face.bounding_radius() + footprint.bounding_radius() + 2.0 * stand_off;
        let lateral = at.position.dot(&left) - offset;
        let far = left * lateral + ahead * (at.position.dot(&ahead) - behind);
        let from = Pose { position: far, heading: pose.heading };
        let travel = travel_to_contact((&face, &from), ahead, (&footprint, &at))
            .ok_or(Infeasible::NoContact)?;
        let start = far + ahead * (travel - stand_off) - pose.position;
        for (other, (face, pose)) in parts.iter().enumerate() {
            let there = Pose { position: pose.position + start, ..*pose };
            let first = travel_to_contact((face, &there), ahead, (&footprint, &at));
            if other != part && meets(other) && first.is_some_and(|t| t < stand_off - ROUNDING) {
                return Err(Infeasible::OtherPartFirst);
            }
        }
        Ok(start)
    }

    /// Longest travel, at most `length` metres, that keeps reach and obstacle clearance.
    ///
    /// # Errors
    /// Returns why there is none of at least [`MIN_LENGTH`].
    pub fn free_travel(
        &self,
        (tool, grip_yaw): (usize, f64),
        start: Vector,
        direction: f64,
        length: f64,
    ) -> Result<f64, Infeasible> {
        let robot = &self.task.robot;
        if !self.task.stands(start, grip_yaw) {
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
        // An arm does not turn the tool everywhere.
        while free >= MIN_LENGTH && !self.task.stands(start + ahead * (free - SLACK), grip_yaw) {
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

    /// By how much hand and handle keep clear of obstacles, and of objects that are as high: of all of
    /// them where the tool is set down, of those that are not to be moved during the push.
    fn hand(
        &self,
        tool: &Tool,
        (from, to): (&Pose, &Pose),
        (state, pushed): (&State, usize),
        set_down: bool,
    ) -> f64 {
        let (task, mut least) = (self.task, FAR);
        let most = FAR + HAND_CLEARANCE;
        for carried in task.robot.carried(tool, task.pushes.lift).into_iter().flatten() {
            let [from, to] = [from, to].map(|frame| *frame * carried.pose);
            for other in task.scene.fixed(Mover::Hand, carried.span) {
                let still = (&other.footprint, &other.pose);
                least = least.min(swept_clearance(&carried.footprint, &from, &to, still, most));
            }
            for other in task.scene.above(carried.span[1]).filter(|_| set_down) {
                let still = (&other.footprint, &other.pose);
                least = least.min(clearance((&carried.footprint, &from), still, most));
            }
            let objects = task.scene.objects.iter().zip(&state.poses).enumerate();
            for (k, (object, pose)) in objects {
                // What comes down from above passes all that is above where it goes.
                if carried.span[0] >= object.top() {
                    continue;
                }
                let still = (&object.shape.footprint(), pose);
                if set_down {
                    least = least.min(clearance((&carried.footprint, &from), still, most));
                }
                if k != pushed && object.meets(carried.span) {
                    least = least.min(swept_clearance(&carried.footprint, &from, &to, still, most));
                }
            }
        }
        least - HAND_CLEARANCE
    }

    /// By how much a push of object `pushed` keeps every rule, when it starts from `state`. A tool that
    /// is set down keeps clear of the objects, with the push's room as `set_down`; a chained push after
    /// the first begins in contact.
    pub fn margins(
        &self,
        (tool, grip_yaw): (usize, f64),
        (state, pushed): (&State, usize),
        push: &Push,
        set_down: Option<f64>,
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
            if let Some(room) = set_down {
                let clear = SET_DOWN_CLEARANCE + room.min(MOST_ASIDE);
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
            hand: self.hand(tool, (&from, &to), (state, pushed), set_down.is_some()),
        }
    }

    /// Offsets from an object in a state are tried within plus and minus this, metres.
    pub fn offset_span(
        &self,
        pair: (usize, f64),
        object: (&State, usize),
        part: usize,
        along: f64,
    ) -> f64 {
        self.span(pair, object, part, along, OVERHANG)
    }

    /// Offsets may be refined within plus and minus this, metres.
    pub fn largest_offset(
        &self,
        pair: (usize, f64),
        object: (&State, usize),
        part: usize,
        along: f64,
    ) -> f64 {
        self.span(pair, object, part, along, LARGEST_OVERHANG)
    }

    /// Whether pushes are placed rather than chained.
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
        // The wider side: offsets beyond the narrower one are seen to touch nothing.
        let wide = |shape: &Footprint, axis: Vector| shape.extent(axis).max(shape.extent(-axis));
        wide(&tool.parts()[part].footprint(), face)
            + overhang * wide(&footprint, at.local_vector(left))
    }

    fn object(&self, index: usize, state: &State) -> (Footprint, Pose) {
        (self.task.scene.objects[index].shape.footprint(), state.poses[index])
    }

    /// Heights above the table between which a part of a tool is, metres.
    fn span_of(&self, part: &Part) -> [f64; 2] {
        let lift = self.task.pushes.lift;
        [lift, lift + part.shape.height()]
    }
}

/// Unit vectors ahead and to the left.
fn axes(direction: f64) -> (Vector, Vector) {
    let ahead = Vector::new(direction.cos(), direction.sin());
    (ahead, perpendicular(ahead))
}

/// Distance of the straight way between two points from the origin, metres.
pub fn distance_to_origin(from: Vector, to: Vector) -> f64 {
    let way = to - from;
    let square = way.norm_squared();
    let t = if square > 0.0 { (-from.dot(&way) / square).clamp(0.0, 1.0) } else { 0.0 };
    (from + way * t).norm()
}
