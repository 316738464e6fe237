//! The body of the robot: the hand that holds the tool, and the column on which the arm stands.

use serde::{Deserialize, Serialize};

use crate::geometry::{Footprint, Pose, Vector};

use super::{Obstacle, Part, Robot, Scene, Tool};

/// Lowest height of a hand if the task states none, metres; fingers reach down to a tool.
const LOWEST: f64 = 0.12;

/// Half width of the handle by which a grip outside of all parts holds the nearest part, metres.
const HANDLE: f64 = 0.01;

/// Clearance between hand and column, metres.
const ROOM: f64 = 0.01;

/// Height of the column, metres; pushed objects are below it.
const COLUMN: f64 = 1.0;

/// Half the side of a usual column and of the thinnest, metres.
const BASE: f64 = 0.08;
const THIN: f64 = 0.04;

/// A hand: an upright cylinder about the end effector.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hand {
    /// Radius, metres.
    pub radius: f64,
    /// Height of the lower end above the table, metres; `None` for the top of the tool at the grip,
    /// but at least 0.12 m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<f64>,
}

impl Hand {
    /// Returns the height of the lower end above the table for a held part whose top is at `top`,
    /// metres.
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

/// A body that the end effector carries in addition to the parts of the tool, and that touches
/// nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Carried {
    /// Outline, seen from above.
    pub footprint: Footprint,
    /// Pose in the tool frame.
    pub pose: Pose,
    /// Lower and upper end above the table, metres; a hand has no upper end, because the arm is
    /// above it.
    pub span: [f64; 2],
}

/// Height of a hand in drawings, metres.
pub const SHOWN_HAND: f64 = 0.1;

impl Robot {
    /// Name of the column on which the arm stands; no other body can have it.
    pub const BASE: &str = Obstacle::ROBOT;

    /// Returns half the side of the default column of an arm, metres: 0.08 m, or less if the hand
    /// would touch it where the reach begins, `min` metres from the origin, but at least 0.04 m.
    pub fn usual_base(min: Option<f64>) -> f64 {
        min.map_or(BASE, |min| (min - Hand::default().radius - ROOM).clamp(THIN, BASE))
    }

    /// Returns the default start of the reach, metres: what column and hand need.
    pub fn usual_reach_min(base: f64, hand: Option<Hand>) -> f64 {
        if base > 0.0 { base + hand.map_or(0.0, |hand| hand.radius) + ROOM } else { 0.0 }
    }

    /// Returns the column as an obstacle, or `None` for a robot without one.
    pub fn column(&self) -> Option<Obstacle> {
        (self.base > 0.0).then(|| Obstacle {
            name: Self::BASE.to_owned(),
            size: [2.0 * self.base, 2.0 * self.base, COLUMN],
            pose: Pose::default(),
            z: 0.0,
            friction: Scene::FRICTION,
        })
    }

    /// Returns the hand and, if the grip is outside of all parts, the handle, when `tool` is held
    /// `lift` metres above the table.
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
    /// Returns the part nearest to the grip, and its distance from the grip, metres.
    fn held(&self) -> Option<(f64, &Part)> {
        let parts = self.parts().iter().map(|part| {
            let local = part.pose.local_point(self.grip.position);
            (distance(&part.footprint(), local), part)
        });
        parts.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Returns the handle between a grip outside of all parts and the nearest part: outline, pose
    /// in the tool frame, and height, metres. The handle is as high as that part.
    pub fn handle(&self) -> Option<(Footprint, Pose, f64)> {
        let (_, held) = self.held().filter(|(gap, _)| *gap > HANDLE)?;
        let way: Vector = held.pose.position - self.grip.position;
        let footprint = Footprint::Rectangle { half: Vector::new(0.5 * way.norm(), HANDLE) };
        let pose = Pose { position: self.grip.position + 0.5 * way, heading: way.y.atan2(way.x) };
        Some((footprint, pose, held.shape.height()))
    }
}

/// Returns the distance of a point from a shape about its own origin, metres; zero inside.
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
        assert!(robot.column().is_some() && robot.without_body().column().is_none());
    }
}
