//! Fixed bodies that must not be touched: obstacles and keep-out regions.

use crate::geometry::{Footprint, Pose};

use super::{Obstacle, Region};

/// A body that the robot moves through a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mover {
    /// The parts of a tool.
    Tool,
    /// The hand and the handle by which it holds the tool.
    Hand,
}

/// An area to keep clear of, seen from above.
#[derive(Clone, Copy, Debug)]
pub struct Fixed<'a> {
    /// Name of the obstacle or region.
    pub name: &'a str,
    /// Outline.
    pub footprint: Footprint,
    /// Pose of the outline.
    pub pose: Pose,
}

impl<'a> From<&'a Obstacle> for Fixed<'a> {
    fn from(obstacle: &'a Obstacle) -> Self {
        let Obstacle { name, pose, .. } = obstacle;
        Self { name, footprint: obstacle.shape().footprint(), pose: *pose }
    }
}

impl<'a> From<&'a Region> for Fixed<'a> {
    fn from(region: &'a Region) -> Self {
        Self { name: &region.name, footprint: region.footprint(), pose: region.pose }
    }
}
