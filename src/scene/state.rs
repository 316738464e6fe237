//! Poses and velocities of all objects at one instant.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Pose3, Vector};

use super::serde_planar::planar_only;

/// Speed below which a body counts as resting, m/s, of the centre and of the rim. A body this slow
/// slides v^2/(2 mu g) < 1 um further on any allowed table.
pub const REST_SPEED: f64 = 1e-3;

/// A planar velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Velocity {
    /// Velocity of the centre, m/s.
    pub linear: Vector,
    /// Angular velocity about the vertical, rad/s.
    pub angular: f64,
}

impl Velocity {
    /// Returns the velocity at the point `arm` metres from the centre, m/s.
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
    /// 3-D poses, after an object has left the plane; `poses` are then their projections from
    /// above.
    #[serde(with = "planar_only", default, skip_serializing_if = "Option::is_none")]
    pub space: Option<Vec<Pose3>>,
}

impl Clone for State {
    fn clone(&self) -> Self {
        let Self { poses, velocities, space } = self;
        Self { poses: poses.clone(), velocities: velocities.clone(), space: space.clone() }
    }

    /// Reuses the present memory, because rollouts copy states in every frame.
    fn clone_from(&mut self, other: &Self) {
        self.poses.clone_from(&other.poses);
        self.velocities.clone_from(&other.velocities);
        self.space.clone_from(&other.space);
    }
}

impl State {
    /// Creates a state with the given poses and no motion.
    pub fn at_rest(poses: Vec<Pose>) -> Self {
        let velocities = vec![Velocity::default(); poses.len()];
        Self { poses, velocities, space: None }
    }

    /// Creates a state with the given 3-D poses and no motion.
    pub fn in_space(poses: Vec<Pose3>) -> Self {
        let seen = poses.iter().map(Pose3::from_above).collect();
        Self { space: Some(poses), ..Self::at_rest(seen) }
    }

    /// Returns `true` if every number is finite.
    pub fn is_finite(&self) -> bool {
        self.poses.iter().all(Pose::is_finite)
            && self.space.iter().flatten().all(Pose3::is_finite)
            && self
                .velocities
                .iter()
                .all(|v| v.linear.iter().all(|x| x.is_finite()) && v.angular.is_finite())
    }
}
