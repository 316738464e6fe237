//! Poses in rapier's frame. rapier's friction acts along the axes of its frame, so the frame
//! follows the push; a rotated scene then gives a rotated result.

use rapier3d_f64::prelude::{Pose3, Rotation, Vector as RapierVector};

use crate::geometry::{Pose, Vector};
use crate::{
    scene::{Scene, State},
    task::{Stroke, ToolMotion},
};

use super::super::parameters::centre;
use super::super::solids::{TABLE_DEPTH, Top};

/// The frame of poses that are given relative to a body.
pub const LOCAL: Pose = Pose { position: Vector::new(0.0, 0.0), heading: 0.0 };

/// Returns rapier's frame: its origin is among the objects, so that a scene far from the world's
/// origin loses no precision. Its x axis points along the stroke that begins with the tool at
/// `tool`.
pub fn frame_of(state: &State, motion: &ToolMotion, tool: &Pose) -> Pose {
    let begins = |stroke: &&Stroke| stroke.from == *tool;
    let stroke = motion.strokes.iter().find(begins).or(motion.strokes.first());
    let ahead = stroke.and_then(Stroke::direction);
    Pose {
        position: centre(state).unwrap_or(tool.position),
        heading: ahead.map_or(tool.heading, |ahead| ahead.y.atan2(ahead.x)),
    }
}

/// Returns a pose in `frame`, at a height.
pub fn to_rapier(pose: &Pose, frame: &Pose, height: f64) -> Pose3 {
    let Pose { position, heading } = frame.inverse() * *pose;
    let translation = RapierVector::new(position.x, position.y, height);
    Pose3::from_parts(translation, Rotation::from_rotation_z(heading))
}

/// Returns the extent of the table for objects that may fall off it.
pub fn brink(scene: &Scene, frame: &Pose) -> Option<Top> {
    let top = scene.brink()?;
    let middle = Pose { position: top.middle, heading: 0.0 };
    Some((to_rapier(&middle, frame, -0.5 * TABLE_DEPTH), top.size))
}

/// Returns the rotation about the vertical, radians.
pub fn yaw(rotation: &Rotation) -> f64 {
    let (x, y, z, w) = (rotation.x, rotation.y, rotation.z, rotation.w);
    (2.0 * (w * z + x * y)).atan2(1.0 - 2.0 * (y * y + z * z))
}
