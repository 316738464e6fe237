//! Free space of a lifted tool at the travel height.

use crate::geometry::{
    Footprint, Pose, Vector, clearance, distance_to_origin, swept_clearance, wrap_angle,
};
use crate::scene::{Fixed, Mover, Region, Robot, Scene, State, Tool};
use crate::task::Task;

/// Distance below which bodies touch, metres: rounding.
const SLACK: f64 = 1e-6;

/// Largest motion of any point of the carried bodies between two checks of a rotation, metres.
const STEP: f64 = 0.005;

/// The carried bodies, and the bodies that they must avoid.
pub(super) struct Space<'a> {
    pub robot: &'a Robot,
    /// Bodies higher than the travel height, and the keep-out regions.
    tall: Vec<Tall<'a>>,
    /// Carried bodies in the frame of the end effector.
    carried: Vec<(Mover, Footprint, Pose)>,
    /// Rotation of the end effector, radians.
    yaw: f64,
}

/// A body that the tool and the hand avoid.
struct Tall<'a> {
    fixed: Fixed<'a>,
    tool: bool,
    hand: bool,
}

impl Tall<'_> {
    fn binds(&self, mover: Mover) -> bool {
        match mover {
            Mover::Tool => self.tool,
            Mover::Hand => self.hand,
        }
    }
}

/// Returns `true` if no body of a scene is higher than the travel height, except the column of the
/// robot, and there are no keep-out regions for tools and hands.
pub(super) fn is_open(task: &Task, scene: &Scene) -> bool {
    let above = [task.robot.travel, f64::INFINITY];
    let low = |name: &str, meets: bool| !meets || name.starts_with(Robot::BASE);
    scene.obstacles.iter().all(|one| low(&one.name, one.meets(above)))
        && scene.objects.iter().all(|object| object.top() <= task.robot.travel)
        && !scene.keep_out.iter().any(|region| region.tool || region.hand)
}

impl<'a> Space<'a> {
    /// Creates the space of a lifted tool held at `yaw` (radians), with the objects of a state, if
    /// any.
    pub fn new(
        task: &'a Task,
        (scene, state): (&'a Scene, Option<&State>),
        tool: &Tool,
        yaw: f64,
    ) -> Self {
        let travel = task.robot.travel;
        let obstacles = scene.obstacles.iter().filter(|one| one.meets([travel, f64::INFINITY]));
        let obstacles = obstacles.map(|one| Tall { fixed: one.into(), tool: true, hand: true });
        let regions = scene.keep_out.iter().filter(|region| region.tool || region.hand);
        let region = |one: &'a Region| Tall { fixed: one.into(), tool: one.tool, hand: one.hand };
        let objects = state.into_iter().flat_map(|state| {
            let placed = scene.objects.iter().zip(&state.poses).enumerate();
            let tall = placed.filter(move |(k, (object, _))| {
                object.top() > travel && !scene.has_left(*k, state)
            });
            tall.map(|(_, (object, pose))| {
                let footprint = object.shape.footprint();
                let fixed = Fixed { name: &object.name, footprint, pose: *pose };
                Tall { fixed, tool: true, hand: true }
            })
        });
        let tall = obstacles.chain(regions.map(region)).chain(objects).collect();
        let seen = tool.grip.inverse();
        let blade = tool.blade().map(|blade| {
            let half = Vector::new(0.5 * blade.length, 0.5 * blade.width);
            let ahead = Pose::new(half.x, 0.0, 0.0);
            (Mover::Tool, Footprint::Rectangle { half }, ahead)
        });
        let parts =
            tool.parts().iter().map(|part| (Mover::Tool, part.footprint(), seen * part.pose));
        let palm = task
            .robot
            .hand
            .map(|hand| (Mover::Hand, Footprint::Disc { radius: hand.radius }, Pose::default()));
        let handle = tool.handle().filter(|_| palm.is_some());
        let handle = handle.map(|(shape, pose, _)| (Mover::Hand, shape, seen * pose));
        let carried = parts.chain(blade).chain(palm).chain(handle).collect();
        Self { robot: &task.robot, tall, carried, yaw }
    }

    /// Returns the same space for the hand alone.
    pub fn of_hand(self) -> Self {
        let hand = self.carried.into_iter().filter(|(mover, shape, _)| {
            *mover == Mover::Hand && matches!(shape, Footprint::Disc { .. })
        });
        Self { carried: hand.collect(), ..self }
    }

    /// Returns the carried bodies with the end effector at a position, rotated by `yaw`.
    fn carried(&self, at: Vector, yaw: f64) -> impl Iterator<Item = (Mover, &Footprint, Pose)> {
        let frame = Pose { position: at, heading: yaw };
        self.carried.iter().map(move |(mover, shape, pose)| (*mover, shape, frame * *pose))
    }

    /// Returns the name of the first body that obstructs a straight path. The robot's column stands
    /// for positions inside its smallest reach.
    pub fn met(&self, [from, to]: [Vector; 2]) -> Option<&'a str> {
        let meets = |tall: &&Tall| {
            self.carried(from, self.yaw).any(|(mover, shape, start)| {
                let end = Pose { position: start.position + (to - from), ..start };
                let still = (&tall.fixed.footprint, &tall.fixed.pose);
                tall.binds(mover) && swept_clearance(shape, &start, &end, still, SLACK) <= 0.0
            })
        };
        let met = self.tall.iter().find(meets).map(|tall| tall.fixed.name);
        met.or_else(|| self.is_folded([from, to]).then_some(Robot::BASE))
    }

    /// Returns `true` if a straight path of the end effector leads through its smallest reach, by
    /// more than either end does.
    fn is_folded(&self, ends: [Vector; 2]) -> bool {
        let least = ends.iter().map(|end| end.norm()).fold(self.robot.reach_min, f64::min);
        distance_to_origin(ends[0], ends[1]) < least - SLACK
    }

    /// Returns `true` if no body is nearer than `room` metres, and the position is within reach.
    pub fn is_free(&self, place: Vector, room: f64) -> bool {
        self.robot.reaches(place) && self.clears((place, self.yaw), room)
    }

    fn clears(&self, (place, yaw): (Vector, f64), room: f64) -> bool {
        self.carried(place, yaw).all(|(mover, shape, here)| {
            self.tall.iter().all(|tall| {
                let still = (&tall.fixed.footprint, &tall.fixed.pose);
                !tall.binds(mover) || clearance((shape, &here), still, 2.0 * room + SLACK) > room
            })
        })
    }

    /// Returns `true` if the end effector can rotate from `other` (radians) to its own yaw at a
    /// position.
    pub fn turns(&self, place: Vector, other: f64) -> bool {
        let angle = wrap_angle(self.yaw - other);
        let far = |(_, shape, pose): &(Mover, Footprint, Pose)| {
            pose.position.norm() + shape.bounding_radius()
        };
        let radius = self.carried.iter().map(far).fold(0.0, f64::max);
        let steps = (angle.abs() * radius / STEP).ceil().max(1.0);
        (0..=steps as usize).all(|k| {
            let yaw = self.yaw - angle * k as f64 / steps;
            self.clears((place, yaw), SLACK)
        })
    }
}
