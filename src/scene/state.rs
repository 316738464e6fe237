//! Where every object is and how it moves at one instant.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Vector};

/// A planar velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Velocity {
    /// Of the centre, m/s.
    pub linear: Vector,
    /// About the vertical, rad/s.
    pub angular: f64,
}

impl Velocity {
    /// Velocity at the point `arm` metres from the centre, m/s.
    pub fn at(&self, arm: Vector) -> Vector {
        self.linear + self.angular * Vector::new(-arm.y, arm.x)
    }
}

/// Poses and velocities of all objects, in the order of [`super::Scene::objects`].
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Poses in the world frame.
    pub poses: Vec<Pose>,
    /// Velocities in the world frame.
    pub velocities: Vec<Velocity>,
}

impl Clone for State {
    fn clone(&self) -> Self {
        Self { poses: self.poses.clone(), velocities: self.velocities.clone() }
    }

    /// On the memory that is there: rollouts do so in every frame.
    fn clone_from(&mut self, other: &Self) {
        self.poses.clone_from(&other.poses);
        self.velocities.clone_from(&other.velocities);
    }
}

impl State {
    /// The given poses, nothing moving.
    pub fn at_rest(poses: Vec<Pose>) -> Self {
        let velocities = vec![Velocity::default(); poses.len()];
        Self { poses, velocities }
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.poses.iter().all(Pose::is_finite)
            && self
                .velocities
                .iter()
                .all(|v| v.linear.iter().all(|x| x.is_finite()) && v.angular.is_finite())
    }
}
