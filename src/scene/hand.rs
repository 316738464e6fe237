//! The body of the robot: the hand that holds the tool, and the column on which the arm stands.

use serde::{Deserialize, Serialize};

use crate::geometry::{Footprint, Pose, Vector};

use super::{Obstacle, Part, Robot, Scene, Tool};

/// Nothing of a hand is lower than this unless a task says so, metres: fingers reach down to a tool.
const LOWEST: f64 = 0.12;

/// A grip outside of all parts holds the nearest one by a handle of this half width, metres.
const HANDLE: f64 = 0.01;

/// Room between hand and column, metres.
const ROOM: f64 = 0.01;

/// Height of the column, metres: nothing that is pushed is above it.
const COLUMN: f64 = 1.0;

/// A hand: an upright cylinder about the end effector.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hand {
    /// Its radius, metres.
    pub radius: f64,
    /// Height above the table at which it begins, metres; `None` where the tool at the grip ends, but
    /// 0.12 m at least.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<f64>,
}

impl Hand {
    /// Height above the table at which it begins where what it holds ends at `top`, metres.
    pub fn begins(&self, top: f64) -> f64 {
        self.from.unwrap_or(top.max(LOWEST))
    }
}

/// A gripper with two fingers.
impl Default for Hand {
    fn default() -> Self {
        Self { radius: 0.05, from: None }
    }
}

/// A body that the end effector carries besides the parts of the tool, and that touches nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Carried {
    /// What it covers, seen from above.
    pub footprint: Footprint,
    /// Where it is in the tool frame.
    pub pose: Pose,
    /// Heights above the table between which it is, metres; above a hand there is the arm.
    pub span: [f64; 2],
}

/// Height of a hand as it is shown, metres.
pub const SHOWN_HAND: f64 = 0.1;

impl Robot {
    /// What the task calls the column on which the arm stands; no other body can be called so.
    pub const BASE: &str = "robot base";

    /// Half the side of the usual column of an arm that reaches from `min` metres on: 0.08 m, or as much
    /// less as the hand comes nearer.
    pub fn usual_base(min: f64) -> f64 {
        (min - Hand::default().radius - ROOM).clamp(0.0, 0.08)
    }

    /// The column as a body of the scene, unless there is none.
    pub fn column(&self) -> Option<Obstacle> {
        (self.base > 0.0).then(|| Obstacle {
            name: Self::BASE.to_owned(),
            size: [2.0 * self.base, 2.0 * self.base, COLUMN],
            pose: Pose::default(),
            z: 0.0,
            friction: Scene::FRICTION,
        })
    }

    /// The hand and, where the grip is outside of all parts, the handle, when `tool` is held `lift`
    /// metres above the table.
    pub fn carried(&self, tool: &Tool, lift: f64) -> [Option<Carried>; 2] {
        let Some(hand) = self.hand else { return [None, None] };
        let Some((_, held)) = tool.held() else { return [None, None] };
        let top = lift + held.shape.height();
        let palm = Carried {
            footprint: Footprint::Disc { radius: hand.radius },
            pose: tool.grip,
            span: [hand.begins(top), f64::INFINITY],
        };
        let handle = tool.handle().map(|(footprint, pose, height)| Carried {
            footprint,
            pose,
            span: [lift, lift + height],
        });
        [Some(palm), handle]
    }
}

impl Tool {
    /// The part nearest to the grip, and how far that is from it, metres.
    fn held(&self) -> Option<(f64, &Part)> {
        let parts = self.parts().iter().map(|part| {
            let local = part.pose.local_point(self.grip.position);
            (distance(&part.footprint(), local), part)
        });
        parts.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// What it is held by where the grip is outside of all parts: a handle to the nearest one, in the
    /// tool frame, and as high as that, metres.
    pub fn handle(&self) -> Option<(Footprint, Pose, f64)> {
        let (_, held) = self.held().filter(|(gap, _)| *gap > HANDLE)?;
        let way: Vector = held.pose.position - self.grip.position;
        let footprint = Footprint::Rectangle { half: Vector::new(0.5 * way.norm(), HANDLE) };
        let pose = Pose { position: self.grip.position + 0.5 * way, heading: way.y.atan2(way.x) };
        Some((footprint, pose, held.shape.height()))
    }
}

/// Distance of a point from a shape about its own origin, metres; zero inside.
fn distance(footprint: &Footprint, point: Vector) -> f64 {
    match footprint {
        Footprint::Disc { radius } => (point.norm() - radius).max(0.0),
        Footprint::Rectangle { half } => {
            Vector::new((point.x.abs() - half.x).max(0.0), (point.y.abs() - half.y).max(0.0)).norm()
        }
        Footprint::Polygon(_) => (point.norm() - footprint.bounding_radius()).max(0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn held(at: f64, robot: &Robot) -> [Option<Carried>; 2] {
        let bar = Part::cuboid("bar", [0.1, 0.04, 0.05], Pose::new(at, 0.0, 0.0));
        robot.carried(&Tool::new("bar", [bar]).expect("one piece"), 0.002)
    }

    #[test]
    fn a_hand_begins_above_the_tool_and_its_fingers_and_holds_what_is_away_by_a_handle() {
        let robot = Robot::reaching(0.3, 0.9);
        let [palm, handle] = held(0.0, &robot);
        assert_eq!((palm.map(|palm| palm.span[0]), handle), (Some(LOWEST), None));
        let [_, handle] = held(0.15, &robot);
        let handle = handle.expect("the grip is 10 cm from the bar");
        assert!(handle.span[0] < 0.01 && (handle.pose.position.x - 0.075).abs() < 1e-12);
        let low = Robot { hand: Some(Hand { from: Some(0.03), ..Hand::default() }), ..robot };
        assert_eq!(held(0.0, &low)[0].map(|palm| palm.span[0]), Some(0.03));
        assert_eq!(held(0.15, &Robot { hand: None, ..robot }), [None, None]);
        assert!(robot.column().is_some() && Robot::reaching(0.0, 0.9).column().is_none());
    }
}
