//! How a lifted tool travels from one push to the next: straight, or around what is taller.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::geometry::{Footprint, Grid, Pose, Vector, clearance, swept_clearance};

use super::{PushForm, PushStep, Task, ToolMotion};
use crate::scene::{Fixed, Robot, Scene, Tool};

/// Spacing of the grid on which ways around are looked for, metres: no gap that a hand fits through is
/// missed.
const SPACING: f64 = 0.02;

/// Most cells along a side of the grid.
const CELLS: usize = 160;

/// Nearer is touching, metres: rounding.
const SLACK: f64 = 1e-6;

/// The way of the end effector between two places, with the tool lifted.
#[derive(Clone, Debug, PartialEq)]
pub enum Way {
    /// Straight.
    Straight,
    /// Around something, by these places, metres.
    Around {
        /// What would be met on the straight way.
        what: String,
        /// Where it turns.
        by: Vec<Vector>,
    },
    /// There is none: this is in it.
    Blocked(String),
}

impl Task {
    /// Largest number of changes to another tool in a plan: none with an arm, of which nobody says where it
    /// would fetch one.
    pub fn tool_changes(&self) -> usize {
        let stated = self.pushes.tool_changes.unwrap_or(usize::MAX);
        if self.arm.is_some() { 0 } else { stated }
    }

    /// The way from where `tool` is lifted after a push to where it is set down for the next; `None` where
    /// it is not lifted between them.
    pub fn way_between(
        &self,
        scene: &Scene,
        tool: &Tool,
        [before, next]: [&PushStep; 2],
    ) -> Option<Way> {
        if next.form != PushForm::Placed {
            return None;
        }
        let (lift, yaw) = (before.lift, before.grip_yaw);
        let made = ToolMotion::pushes(Arc::new(tool.clone()), lift, yaw, &[before.push], true);
        let back = made.retreat(scene, 0);
        let from = back.map_or(before.push.end(), |back| (back.to * tool.grip).position);
        Some(self.way(scene, (tool, next.grip_yaw), [from, next.push.start]))
    }

    /// How `tool`, held at `yaw` (radians), gets from one place of the end effector to another at
    /// [`Robot::travel`]. Everything that ends higher is gone around: obstacles, and objects that are
    /// kept where they are.
    fn way(&self, scene: &Scene, (tool, yaw): (&Tool, f64), ends: [Vector; 2]) -> Way {
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
        let Some(what) = room.met(ends) else { return Way::Straight };
        let what = what.to_owned();
        match room.around(ends) {
            Some(by) => Way::Around { what, by },
            None => Way::Blocked(what),
        }
    }
}

/// What moves, and what it has to go around.
struct Room<'a> {
    robot: &'a Robot,
    tall: Vec<Fixed<'a>>,
    /// Seen from the end effector, with the world's axes.
    carried: Vec<(Footprint, Pose)>,
}

impl Room<'_> {
    /// What is met on a straight way.
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

    /// Whether nothing is nearer than `room` metres, and the arm gets there.
    fn is_free(&self, place: Vector, room: f64) -> bool {
        let clear = |(shape, pose): &(Footprint, Pose), fixed: &Fixed| {
            let here = Pose { position: pose.position + place, ..*pose };
            clearance((shape, &here), (&fixed.footprint, &fixed.pose), 2.0 * room) > room
        };
        self.robot.reaches(place)
            && self.carried.iter().all(|one| self.tall.iter().all(|fixed| clear(one, fixed)))
    }

    /// Where a way around turns, if there is one: the shortest in steps on the grid, without the turns
    /// that it does not need.
    fn around(&self, ends: [Vector; 2]) -> Option<Vec<Vector>> {
        let reach = self.robot.reach_max;
        let spacing = SPACING.max(2.0 * reach / (CELLS - 1) as f64);
        let count = (2.0 * reach / spacing).ceil() as usize + 1;
        let grid = Grid::new(Vector::repeat(-reach), spacing, [count, count]);
        let place = |cell: usize| grid.position(cell);
        // Neighbours on a grid are at most 1.5 spacings apart: what keeps half of that clear between
        // two free cells meets nothing.
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
        let mut way = vec![ends[1], place(last)];
        let mut cell = last;
        while let Some(earlier) = before[cell].filter(|earlier| *earlier != cell) {
            cell = earlier;
            way.push(place(cell));
        }
        way.push(ends[0]);
        way.reverse();
        Some(self.straightened(&way))
    }

    /// The turns that a way needs.
    fn straightened(&self, way: &[Vector]) -> Vec<Vector> {
        let (mut turns, mut here) = (Vec::new(), 0);
        while here + 1 < way.len() {
            let sees = |next: &usize| {
                let within = (1..8)
                    .all(|k| self.robot.reaches(way[here].lerp(&way[*next], f64::from(k) / 8.0)));
                within && self.met([way[here], way[*next]]).is_none()
            };
            here = (here + 2..way.len()).rev().find(sees).unwrap_or(here + 1);
            turns.extend(way.get(here).filter(|_| here + 1 < way.len()));
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
        let way = |walls: &[Obstacle]| {
            let mut scene = Scene::new([can.clone()]);
            scene.obstacles = walls.to_vec();
            let goal = Goal::new(0, [0.7, 0.1], 0.02);
            let task = Task::new("t", scene, Robot::reaching(0.2, 1.0), goal);
            task.way(&task.scene, (&tool, 0.0), [0.45, 0.8].map(|x| Vector::new(x, 0.0)))
        };
        assert_eq!(way(&[wall(0.2, 0.0, 0.4)]), Way::Straight);
        let Way::Around { what, by } = way(&[wall(0.5, 0.0, 0.4)]) else { panic!("no way") };
        assert!(what == "wall" && by.len() <= 3, "{by:?}");
        // Around an end of the wall, by the hand's radius.
        assert!(by.iter().any(|at| at.y.abs() > 0.25), "{by:?}");
        // Across all that the arm reaches, and behind it the robot itself.
        assert_eq!(way(&[wall(0.5, 0.0, 2.4)]), Way::Blocked("wall".into()));
        assert_eq!(way(&[wall(0.5, 0.0, 0.4).raised(0.5)]), way(&[wall(1.0, 0.0, 0.4)]));
    }
}
