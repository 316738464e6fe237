//! How a lever-up is seen: in its lever frame, and mirrored so that the centre of mass lies to the
//! left.

use crate::geometry::{Pose3, Turn3, Vector, Vector3};
use crate::task::{LeverJob, lever_frame};

/// Poses of a plate as seen from where it is levered: what is learned of one lever-up holds for all
/// that look alike.
///
/// A pose is nine numbers: the way of the centre of mass since the start, metres, and the images of
/// the x- and z-axes under the turn since then (Zhou et al., CVPR 2019), all in the lever frame.
#[derive(Clone, Copy, Debug)]
pub struct LeverView {
    frame: Pose3,
    start: Pose3,
    centre: Vector3,
    /// 1, or -1 where y is mirrored.
    side: f64,
}

impl LeverView {
    /// Numbers of a pose.
    pub const NUMBERS: usize = 9;

    /// That of a job.
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

    /// The same from the other side: a mirror image, as real as the other.
    #[must_use]
    pub fn mirrored(self) -> Self {
        Self { side: -self.side, ..self }
    }

    /// A point of the plate's plane as seen, metres.
    pub fn point(&self, job: &LeverJob, point: Vector) -> Vector {
        let plate = &job.scene.plates[job.lever.plate];
        let at = lever_frame(plate.corners(), job.lever.place).local_point(point);
        Vector::new(at.x, self.side * at.y)
    }

    /// Whether y is mirrored.
    pub fn is_mirrored(&self) -> bool {
        self.side < 0.0
    }

    /// The numbers of a pose of the plate's frame in the world.
    pub fn see(&self, pose: &Pose3) -> [f64; Self::NUMBERS] {
        let way = pose.point(self.centre) - self.start.point(self.centre);
        let turn = pose.rotation * self.start.rotation.inverse();
        let seen = |v: Vector3| self.mirror(self.frame.rotation.inverse() * v);
        let image = |axis: Vector3| seen(turn * (self.frame.rotation * self.mirror(axis)));
        let (way, x, z) = (seen(way), image(Vector3::x()), image(Vector3::z()));
        [way.x, way.y, way.z, x.x, x.y, x.z, z.x, z.y, z.z]
    }

    /// The middle of the blade's tip when it has made `share` of its turn, as seen from the plate if
    /// that is in `pose`: x how far behind the levered edge, y aside, z above the underside, metres.
    pub fn tip(&self, job: &LeverJob, share: f64, pose: &Pose3) -> [f64; 3] {
        let lever = &job.lever;
        let angle = lever.angle * share;
        let (sin, cos) = if lever.pivot < 0.0 { -angle } else { angle }.sin_cos();
        let along = Vector3::new(cos, 0.0, -sin);
        let tip = Vector3::new(lever.pivot, 0.0, 0.0) + along * (lever.depth - lever.pivot);
        // Back to where the plate was, with the plate.
        let on_plate = self.start.point(pose.inverse().point(self.frame.point(tip)));
        self.mirror(self.frame.inverse().point(on_plate)).into()
    }

    /// The pose in the world that is seen so; of numbers that are no turn the nearest one that
    /// keeps the z-axis.
    pub fn pose(&self, seen: &[f64; Self::NUMBERS]) -> Pose3 {
        let [a, b, c, d, e, f, g, h, i] = *seen;
        let turn: Turn3 = {
            let (x, z) = (Vector3::new(d, e, f), Vector3::new(g, h, i));
            // A mirrored turn is the turn between mirrored vectors; y is mirrored twice.
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
