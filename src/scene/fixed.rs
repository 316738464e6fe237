//! What does not move and must not be run into: obstacles, and regions to keep out of.

use crate::geometry::{Footprint, Pose};

use super::{Obstacle, Region};

/// What moves through a scene by the robot's will.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mover {
    /// The parts of a tool.
    Tool,
    /// The hand, and what it holds the tool by.
    Hand,
}

/// Something to keep clear of, seen from above.
#[derive(Clone, Copy, Debug)]
pub struct Fixed<'a> {
    /// What it is called.
    pub name: &'a str,
    /// What it covers.
    pub footprint: Footprint,
    /// Where it is.
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
