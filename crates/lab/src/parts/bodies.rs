//! The cuboids of a lever-up in the lever frame.

use std::sync::Arc;

use pushplan::internals::geometry::{Box3, Matrix3, Pose3, Turn3, Vector3};
use pushplan::internals::{
    scene::LeverScene,
    task::{LeverJob, LeverUp},
};

/// Half the width and half the thickness of the table, metres.
const TABLE: [f64; 2] = [2.0, 0.25];

/// A fixed cuboid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fixed {
    pub solid: Box3,
    pub bounds: [Vector3; 2],
    /// Friction coefficient against the body.
    pub rub: f64,
}

impl Fixed {
    fn new((solid, rub): (Box3, f64)) -> Self {
        let axes = solid.pose.rotation.to_rotation_matrix().into_inner();
        Self { solid, bounds: bounds(&solid, &axes), rub }
    }
}

/// Returns the smallest and largest coordinates of a cuboid, metres; `axes` is its rotation.
pub(super) fn bounds(solid: &Box3, axes: &Matrix3) -> [Vector3; 2] {
    let extents = axes.abs() * solid.half;
    [solid.pose.position - extents, solid.pose.position + extents]
}

/// A levered body of cuboids and the bodies around it.
#[derive(Clone, Debug)]
pub(super) struct LeverBodies {
    /// Motion of the blade.
    pub lever: LeverUp,
    /// Cuboids of the body about its centre of mass, on its own axes.
    pub(super) parts: Vec<Box3>,
    /// Largest distance of their points from the centre of mass, metres.
    pub(super) reach: f64,
    /// Fixed bodies, the table first.
    pub(super) fixed: Vec<Fixed>,
    /// Friction coefficient with the blade.
    pub(super) rub: f64,
    scene: Arc<LeverScene>,
    frame: Pose3,
    /// Centre of mass in the body's frame, metres.
    centre: Vector3,
}

impl LeverBodies {
    /// Returns the bodies of a job; `None` if there are other plates, or a part of the plate is no
    /// cuboid.
    pub fn new(job: &LeverJob) -> Option<Self> {
        let LeverJob { scene, lever } = job;
        let [plate] = &scene.plates[..] else { return None };
        let centre = plate.weight().centre;
        let cuboids = plate.slabs.iter().map(|slab| {
            let (middle, heading, [x, y]) = slab.rectangle()?;
            let position =
                Vector3::new(middle.x, middle.y, slab.bottom + 0.5 * slab.height) - centre;
            let rotation = Turn3::from_axis_angle(&Vector3::z_axis(), heading);
            let half = 0.5 * Vector3::new(x, y, slab.height);
            Some(Box3 { pose: Pose3 { position, rotation }, half })
        });
        let parts: Vec<Box3> = cuboids.collect::<Option<_>>()?;
        let frame = lever.frame(scene);
        let own = frame.inverse();
        let mean = |other: f64| 0.5 * (plate.friction + other);
        let [wide, deep] = TABLE;
        let table = Box3 {
            pose: Pose3 { position: Vector3::z() * (-plate.z - deep), ..Pose3::default() },
            half: Vector3::new(wide, wide, deep),
        };
        let blocks = scene.blocks.iter().map(|block| {
            let [x, y, z] = block.size;
            let pose = own * Pose3::upright(block.pose, block.z + 0.5 * z);
            (Box3 { pose, half: 0.5 * Vector3::new(x, y, z) }, mean(block.friction))
        });
        let far = |part: &Box3| part.pose.position.norm() + part.half.norm();
        Some(Self {
            lever: *lever,
            reach: parts.iter().map(far).fold(0.0, f64::max),
            parts,
            fixed: std::iter::once((table, mean(scene.table_friction)))
                .chain(blocks)
                .map(Fixed::new)
                .collect(),
            rub: mean(scene.blade.friction),
            scene: scene.clone(),
            frame,
            centre,
        })
    }

    /// Returns a world pose of the body's frame as centre of mass and rotation in the lever frame.
    pub fn see(&self, pose: &Pose3) -> (Vector3, Turn3) {
        let centre = self.frame.local_point(pose.point(self.centre));
        (centre, self.frame.rotation.inverse() * pose.rotation)
    }

    /// Returns the world pose of a centre of mass and rotation in the lever frame.
    pub fn pose(&self, (centre, turn): (Vector3, Turn3)) -> Pose3 {
        let rotation = self.frame.rotation * turn;
        Pose3 { position: self.frame.point(centre) - rotation * self.centre, rotation }
    }

    /// Returns the initial pose of the body.
    pub fn start(&self) -> (Vector3, Turn3) {
        self.see(&self.scene.plates[self.lever.plate].start())
    }

    /// Returns the blade at some time, seconds from the start of the rotation.
    pub(super) fn blade(&self, time: f64) -> Box3 {
        let blade = &self.scene.blade;
        let half = 0.5 * Vector3::new(blade.length, blade.width, blade.thickness);
        Box3 { pose: self.frame.inverse() * self.lever.blade(&self.scene, time), half }
    }
}
