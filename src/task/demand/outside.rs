//! Demand: the centre of an object lies outside of an obstacle, seen from above.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Shape};
use crate::scene::Scene;

use super::check::name;
use super::{Area, Check, Demand, End, Kind, Mark, Quantity};

/// Depth inside of the obstacle that adds 1 to the score, metres.
const STEP: f64 = 0.01;

/// An obstacle that an object must leave, such as a drive or a tray.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outside {
    /// Name of the obstacle.
    pub name: String,
    /// Full extents, metres.
    pub size: [f64; 3],
    /// Pose of the obstacle.
    pub pose: Pose,
}

impl Outside {
    /// Creates the demand to leave an obstacle, an index into [`Scene::obstacles`]; `None` if the
    /// obstacle does not exist.
    pub fn of(scene: &Scene, obstacle: usize) -> Option<Self> {
        let obstacle = scene.obstacles.get(obstacle)?;
        Some(Self { name: obstacle.name.clone(), size: obstacle.size, pose: obstacle.pose })
    }

    /// Returns its outline on the table.
    pub fn area(&self) -> Area {
        Area { shape: Shape::Cuboid { size: self.size }, pose: self.pose }
    }
}

impl Kind for Outside {
    fn demand(&self) -> Demand {
        Demand::Outside(self.clone())
    }

    fn is_met(&self, end: &End) -> bool {
        self.score(end) <= 1.0
    }

    fn words(&self, _: usize, _: &Scene) -> String {
        format!("outside of {}", self.name)
    }

    fn score(&self, end: &End) -> f64 {
        let local = self.pose.inverse().point(end.pose().position);
        let [x, y, _] = self.size;
        let beyond = (local.x.abs() - 0.5 * x).max(local.y.abs() - 0.5 * y);
        1.0 - beyond / STEP
    }

    fn fault(&self, _: usize, scene: &Scene) -> Option<String> {
        let known = scene.obstacles.iter().any(|obstacle| obstacle.name == self.name);
        (!known).then(|| "the goal names an obstacle that does not exist".to_owned())
    }

    fn check(&self, object: usize, scene: &Scene) -> Check {
        let (object, corners) = (name(object, scene), self.area().corners());
        Check::from(Quantity::Beyond { object, frame: None, corners }, 0.0)
    }

    fn marks(&self, _: usize, _: &Scene) -> Vec<Mark> {
        vec![Mark::Outside(self.area())]
    }
}
