//! The lever-up: a blade goes under an edge and rotates about a horizontal axis.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Pose3, Vector, Vector3, perpendicular};

use crate::scene::{Blade, LeverScene, Plate};

/// A place on a plate's outline.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// Edge, by the index of its first corner.
    pub edge: usize,
    /// Position along the edge, 0 to 1.
    pub fraction: f64,
}

/// A lever-up (Tekden 2020, chapters 5 and 6), executed by a robot without observation.
///
/// The lever frame has its origin on the edge at the underside, x along the inward normal, z up.
/// The blade lies in it along x with its upper face touching the underside.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverUp {
    /// Index of the levered object.
    #[serde(rename = "object")]
    pub plate: usize,
    /// Place on the outline under which the blade goes.
    pub place: Place,
    /// Distance of the tip behind the edge, metres.
    pub depth: f64,
    /// Signed distance of the axis from the edge, inward, metres. In front of the blade (> 0) the
    /// blade lifts the edge on an arc; behind it (< 0) it pries over the axis.
    pub pivot: f64,
    /// Rotation of the blade about the axis, radians; the edge always goes up.
    pub angle: f64,
    /// Speed of the blade's tip, m/s.
    pub speed: f64,
    /// Time for which the blade then stands still, seconds.
    pub hold: f64,
    /// Distance by which the blade is then drawn back along its shaft, metres.
    pub retreat: f64,
}

impl LeverUp {
    /// Default hold time at the end of the rotation, seconds.
    pub const HOLD: f64 = 0.2;
    /// Default retreat, metres.
    pub const RETREAT: f64 = 0.1;
    /// Maximum duration that is planned or replayed, seconds.
    pub const LONGEST: f64 = 120.0;
    /// Default speed of the tip, m/s.
    pub const SPEED: f64 = 0.1;

    /// Returns the lever frame in the world for a plate at its start.
    pub fn frame(&self, scene: &LeverScene) -> Pose3 {
        self.frame_on(&scene.plates[self.plate])
    }

    /// Returns the lever frame in the world on a plate at its start.
    pub fn frame_on(&self, plate: &Plate) -> Pose3 {
        let local = lever_frame(plate.corners(), self.place);
        Pose3::upright(plate.pose * local, plate.z)
    }

    /// Returns the duration of the rotation, seconds.
    pub fn turn_time(&self) -> f64 {
        let radius = (self.pivot - self.depth).abs().max(1e-3);
        self.angle * radius / self.speed
    }

    /// Returns the duration of rotation, hold and retreat, seconds.
    pub fn duration(&self) -> f64 {
        self.turn_time() + self.hold + self.retreat / self.speed
    }

    /// Returns the pose of the blade's centre in the world at `time` seconds from the start of the
    /// rotation.
    pub fn blade(&self, scene: &LeverScene, time: f64) -> Pose3 {
        self.blade_on(&scene.plates[self.plate], &scene.blade, time)
    }

    /// Returns the pose of the centre of `blade` at `time` seconds from the start of the rotation,
    /// under a plate at its start.
    pub fn blade_on(&self, plate: &Plate, blade: &Blade, time: f64) -> Pose3 {
        let turn = self.turn_time();
        let angle = self.angle * (time / turn).clamp(0.0, 1.0);
        let back = ((time - turn - self.hold) * self.speed).clamp(0.0, self.retreat);
        let middle = Vector3::new(self.depth - 0.5 * blade.length, 0.0, -0.5 * blade.thickness);
        // A positive rotation about +y lifts points before the axis; behind it the sign is
        // reversed.
        let signed = if self.pivot < 0.0 { -angle } else { angle };
        let pivot = Vector3::new(self.pivot, 0.0, 0.0);
        let lying = Pose3 { position: middle, ..Pose3::default() };
        let mut turned = lying.turned_about(pivot, Vector3::y_axis(), signed);
        turned.position -= turned.rotation * Vector3::x() * back;
        self.frame_on(plate) * turned
    }
}

/// Returns the lever frame in the plate's frame: on the outline, x inward.
pub fn lever_frame(corners: &[Vector], place: Place) -> Pose {
    let from = corners[place.edge];
    let along = corners[(place.edge + 1) % corners.len()] - from;
    let inward = perpendicular(along);
    Pose { position: from + along * place.fraction, heading: inward.y.atan2(inward.x) }
}

/// A lever-up in a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct LeverJob {
    /// Scene.
    pub scene: Arc<LeverScene>,
    /// Lever-up.
    pub lever: LeverUp,
}
