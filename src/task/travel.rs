//! Paths of a lifted tool from one push to the next: straight, or around taller bodies.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::geometry::{Footprint, Grid, Pose, Vector, clearance, swept_clearance};

use super::{PushForm, PushStep, Task, ToolMotion};
use crate::scene::{Fixed, Robot, Scene, Tool};

/// Spacing of the grid on which detours are searched, metres: smaller than any gap through which a
/// hand fits.
const SPACING: f64 = 0.02;

/// Maximum number of cells along a side of the grid.
const CELLS: usize = 160;

/// Distance below which bodies touch, metres: rounding.
const SLACK: f64 = 1e-6;

/// The path of the end effector between two positions, with the tool lifted.
#[derive(Clone, Debug, PartialEq)]
pub enum TravelPath {
    /// Straight.
    Straight,
    /// Around a body, by way of these positions, metres.
    Around {
        /// Name of the body on the straight path.
        what: String,
        /// Corners of the path.
        by: Vec<Vector>,
    },
    /// No path: the named body obstructs it.
    Blocked(String),
}

impl Task {
    /// Returns the maximum number of changes to another tool in a plan: 0 with an arm, because the
    /// task does not state where an arm fetches tools.
    pub fn tool_changes(&self) -> usize {
        let stated = self.pushes.tool_changes.unwrap_or(usize::MAX);
        if self.arm.is_some() { 0 } else { stated }
    }

    /// Returns the path of `tool` from the end of a push to the start of the next; `None` if it is
    /// not lifted between them.
    pub fn path_between(
        &self,
        scene: &Scene,
        tool: &Tool,
        [before, next]: [&PushStep; 2],
    ) -> Option<TravelPath> {
        if next.form != PushForm::Placed {
            return None;
        }
        let (lift, yaw) = (before.lift, before.grip_yaw);
        let made = ToolMotion::pushes(Arc::new(tool.clone()), lift, yaw, &[before.push], true);
        let back = made.retreat(scene, 0);
        let from = back.map_or(before.push.end(), |back| (back.to * tool.grip).position);
        Some(self.travel_path(scene, (tool, next.grip_yaw), [from, next.push.start]))
    }

    /// Returns the path of `tool`, held at `yaw` (radians), between two positions of the end
    /// effector at [`Robot::travel`]. It avoids everything higher: obstacles, and objects that must
    /// be kept in place.
    fn travel_path(
        &self,
        scene: &Scene,
        (tool, yaw): (&Tool, f64),
        ends: [Vector; 2],
    ) -> TravelPath {
        let kept = scene.objects.iter().filter(|object| object.keep.is_some());
        let tall = kept.filter(|object| object.top() > self.robot.travel);
        let tall = tall.map(|object| Fixed {
            name: &object.name,
            footprint: object.shape.footprint(),
            pose: object.pose,
        });
        let above = [self.robot.travel, f64::INFINITY];
        let obstacles = scene.obstacles.iter().filter(|obstacle| obstacle.meets(above));
        let mut room = Room {
            robot: &self.robot,
            tall: obstacles.map(Fixed::from).chain(tall).collect(),
            carried: Vec::new(),
        };
        let frame = tool.pose(Pose { position: Vector::zeros(), heading: yaw });
        let parts = tool.parts().iter().map(|part| (part.footprint(), frame * part.pose));
        let hand = self.robot.carried(tool, 0.0).into_iter().flatten();
        let hand = hand.map(|carried| (carried.footprint, frame * carried.pose));
        room.carried = parts.chain(hand).collect();
        let Some(what) = room.met(ends) else { return TravelPath::Straight };
        let what = what.to_owned();
        match room.around(ends) {
            Some(by) => TravelPath::Around { what, by },
            None => TravelPath::Blocked(what),
        }
    }
}

/// The carried bodies, and the bodies that they must avoid.
struct Room<'a> {
    robot: &'a Robot,
    tall: Vec<Fixed<'a>>,
    /// Carried bodies relative to the end effector, with the world's axes.
    carried: Vec<(Footprint, Pose)>,
}

impl Room<'_> {
    /// Returns the name of the first body that obstructs a straight path.
    fn met(&self, [from, to]: [Vector; 2]) -> Option<&str> {
        let at = |pose: &Pose, end: Vector| Pose { position: pose.position + end, ..*pose };
        let meets = |fixed: &&Fixed| {
            self.carried.iter().any(|(shape, pose)| {
                let still = (&fixed.footprint, &fixed.pose);
                swept_clearance(shape, &at(pose, from), &at(pose, to), still, SLACK) <= 0.0
            })
        };
        self.tall.iter().find(meets).map(|fixed| fixed.name)
    }

    /// Returns `true` if no body is nearer than `room` metres, and the position is within reach.
    fn is_free(&self, place: Vector, room: f64) -> bool {
        let clear = |(shape, pose): &(Footprint, Pose), fixed: &Fixed| {
            let here = Pose { position: pose.position + place, ..*pose };
            clearance((shape, &here), (&fixed.footprint, &fixed.pose), 2.0 * room) > room
        };
        self.robot.reaches(place)
            && self.carried.iter().all(|one| self.tall.iter().all(|fixed| clear(one, fixed)))
    }

    /// Returns the corners of a path, if there is one: the shortest in steps on the grid, without
    /// unnecessary corners.
    fn around(&self, ends: [Vector; 2]) -> Option<Vec<Vector>> {
        let reach = self.robot.reach_max;
        let spacing = SPACING.max(2.0 * reach / (CELLS - 1) as f64);
        let count = (2.0 * reach / spacing).ceil() as usize + 1;
        let grid = Grid::new(Vector::repeat(-reach), spacing, [count, count]);
        let place = |cell: usize| grid.position(cell);
        // Neighbours on a grid are at most 1.5 spacings apart, so a clearance of half of that at
        // two free cells keeps the path between them free.
        let free: Vec<bool> =
            (0..grid.count()).map(|cell| self.is_free(place(cell), 0.75 * spacing)).collect();
        let sees = |end: Vector, cell: usize| {
            (place(cell) - end).norm() < 4.0 * spacing && self.met([end, place(cell)]).is_none()
        };
        let mut before = vec![None; grid.count()];
        let mut queue = VecDeque::new();
        for cell in (0..grid.count()).filter(|&cell| free[cell] && sees(ends[0], cell)) {
            before[cell] = Some(cell);
            queue.push_back(cell);
        }
        let last = loop {
            let cell = queue.pop_front()?;
            if sees(ends[1], cell) {
                break cell;
            }
            for next in NEIGHBOURS.into_iter().filter_map(|step| grid.next(cell, step)) {
                if free[next] && before[next].is_none() {
                    before[next] = Some(cell);
                    queue.push_back(next);
                }
            }
        };
        let mut path = vec![ends[1], place(last)];
        let mut cell = last;
        while let Some(earlier) = before[cell].filter(|earlier| *earlier != cell) {
            cell = earlier;
            path.push(place(cell));
        }
        path.push(ends[0]);
        path.reverse();
        Some(self.straightened(&path))
    }

    /// Removes unnecessary corners of a path.
    fn straightened(&self, path: &[Vector]) -> Vec<Vector> {
        let (mut turns, mut here) = (Vec::new(), 0);
        while here + 1 < path.len() {
            let sees = |next: &usize| {
                let within = (1..8)
                    .all(|k| self.robot.reaches(path[here].lerp(&path[*next], f64::from(k) / 8.0)));
                within && self.met([path[here], path[*next]]).is_none()
            };
            here = (here + 2..path.len()).rev().find(sees).unwrap_or(here + 1);
            turns.extend(path.get(here).filter(|_| here + 1 < path.len()));
        }
        turns
    }
}

const NEIGHBOURS: [[i32; 2]; 8] =
    [[1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [1, -1], [-1, 1], [-1, -1]];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        scene::{Object, Obstacle, Part},
        task::Goal,
    };

    #[test]
    fn a_lifted_tool_goes_over_what_is_low_around_what_is_tall_and_not_out_of_a_ring() {
        let can = Object::cylinder("can", 0.03, 0.1).at(0.7, 0.0, 0.0);
        let bar = Part::cuboid("bar", [0.04, 0.04, 0.05], Pose::default());
        let tool = Tool::new("bar", [bar]).expect("one piece");
        let wall = |height: f64, y: f64, width: f64| {
            Obstacle::new("wall", [0.02, width, height], Pose::new(0.6, y, 0.0))
        };
        let path = |walls: &[Obstacle]| {
            let mut scene = Scene::new([can.clone()]);
            scene.obstacles = walls.to_vec();
            let goal = Goal::new(0, [0.7, 0.1], 0.02);
            let task = Task::new("t", scene, Robot::reaching(0.2, 1.0), goal);
            task.travel_path(&task.scene, (&tool, 0.0), [0.45, 0.8].map(|x| Vector::new(x, 0.0)))
        };
        assert_eq!(path(&[wall(0.2, 0.0, 0.4)]), TravelPath::Straight);
        let TravelPath::Around { what, by } = path(&[wall(0.5, 0.0, 0.4)]) else {
            panic!("no path")
        };
        assert!(what == "wall" && by.len() <= 3, "{by:?}");
        // The path leads around an end of the wall, at the distance of the hand's radius.
        assert!(by.iter().any(|at| at.y.abs() > 0.25), "{by:?}");
        // The wall extends over the whole reach of the arm, and the robot itself is behind it.
        assert_eq!(path(&[wall(0.5, 0.0, 2.4)]), TravelPath::Blocked("wall".into()));
        assert_eq!(path(&[wall(0.5, 0.0, 0.4).raised(0.5)]), path(&[wall(1.0, 0.0, 0.4)]));
    }
}
