//! The view of a lever-up: its lever frame, mirrored so that the centre of mass lies to the left.

use crate::geometry::{Pose3, Turn3, Vector, Vector3};
use crate::task::{LeverJob, lever_frame};

/// Poses of a plate relative to its lever point. Learning from one lever-up thereby covers all with
/// the same view.
///
/// A pose has nine numbers, all in the lever frame: the displacement of the centre of mass since
/// the start, metres, and the images of the x- and z-axes under the rotation since then (Zhou et
/// al., CVPR 2019).
#[derive(Clone, Copy, Debug)]
pub struct LeverView {
    frame: Pose3,
    start: Pose3,
    centre: Vector3,
    /// Sign of y: 1, or -1 for a mirrored view.
    side: f64,
}

impl LeverView {
    /// Count of numbers of a pose.
    pub const NUMBERS: usize = 9;

    /// Creates the view of a job.
    pub fn new(job: &LeverJob) -> Self {
        let LeverJob { scene, lever } = job;
        let plate = &scene.plates[lever.plate];
        let centre = plate.weight().centre;
        let own = lever_frame(plate.corners(), lever.place);
        let right = own.local_point(Vector::new(centre.x, centre.y)).y < 0.0;
        Self {
            frame: lever.frame(scene),
            start: plate.start(),
            centre,
            side: if right { -1.0 } else { 1.0 },
        }
    }

    /// Returns the mirrored view, which is equally valid.
    #[must_use]
    pub fn mirrored(self) -> Self {
        Self { side: -self.side, ..self }
    }

    /// Returns a point of the plate's plane in the view, metres.
    pub fn point(&self, job: &LeverJob, point: Vector) -> Vector {
        let plate = &job.scene.plates[job.lever.plate];
        let at = lever_frame(plate.corners(), job.lever.place).local_point(point);
        Vector::new(at.x, self.side * at.y)
    }

    /// Returns `true` if y is mirrored.
    pub fn is_mirrored(&self) -> bool {
        self.side < 0.0
    }

    /// Converts a pose of the plate's frame in the world into the numbers of the view.
    pub fn see(&self, pose: &Pose3) -> [f64; Self::NUMBERS] {
        let way = pose.point(self.centre) - self.start.point(self.centre);
        let turn = pose.rotation * self.start.rotation.inverse();
        let seen = |v: Vector3| self.mirror(self.frame.rotation.inverse() * v);
        let image = |axis: Vector3| seen(turn * (self.frame.rotation * self.mirror(axis)));
        let (way, x, z) = (seen(way), image(Vector3::x()), image(Vector3::z()));
        [way.x, way.y, way.z, x.x, x.y, x.z, z.x, z.y, z.z]
    }

    /// Returns the middle of the blade's tip relative to the plate in `pose`, after a `share` of
    /// its rotation. x is the depth behind the levered edge, y the lateral offset, z the height
    /// above the underside, metres.
    pub fn tip(&self, job: &LeverJob, share: f64, pose: &Pose3) -> [f64; 3] {
        let lever = &job.lever;
        let angle = lever.angle * share;
        let (sin, cos) = if lever.pivot < 0.0 { -angle } else { angle }.sin_cos();
        let along = Vector3::new(cos, 0.0, -sin);
        let tip = Vector3::new(lever.pivot, 0.0, 0.0) + along * (lever.depth - lever.pivot);
        // Moved back with the plate to its initial pose.
        let on_plate = self.start.point(pose.inverse().point(self.frame.point(tip)));
        self.mirror(self.frame.inverse().point(on_plate)).into()
    }

    /// Converts the numbers of the view into a pose in the world. If the numbers are not a
    /// rotation, the nearest rotation that keeps the z-axis is used.
    pub fn pose(&self, seen: &[f64; Self::NUMBERS]) -> Pose3 {
        let [a, b, c, d, e, f, g, h, i] = *seen;
        let turn: Turn3 = {
            let (x, z) = (Vector3::new(d, e, f), Vector3::new(g, h, i));
            // A mirrored rotation is the rotation between mirrored vectors; y is mirrored twice.
            Pose3::from_axes(Vector3::zeros(), self.mirror(x), self.mirror(z)).rotation
        };
        let way = self.frame.rotation * self.mirror(Vector3::new(a, b, c));
        let frame = self.frame.rotation;
        let rotation = frame * turn * frame.inverse() * self.start.rotation;
        let centre = self.start.point(self.centre) + way;
        Pose3 { position: centre - rotation * self.centre, rotation }
    }

    fn mirror(&self, v: Vector3) -> Vector3 {
        Vector3::new(v.x, self.side * v.y, v.z)
    }
}
