//! A lever-up in its own frame: x inward, z up from the table, the lever point above the origin,
//! and the centre of mass never to the right.

use crate::geometry::{Box3, Pose, Pose3, Vector, Vector3};
use crate::{
    scene::Obstacle,
    task::{LeverJob, LeverUp, lever_frame},
};

use super::body::{Body, Spread};

/// Maximum radius of a foot, metres, as in the engine.
const FOOT: f64 = 1e-3;

/// A point of the plate that may touch the table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tip {
    /// Position relative to the centre of mass, body axes, metres.
    pub at: Vector3,
    /// Radius of the ball about the point, metres.
    pub radius: f64,
}

/// The constant data of a lever-up.
#[derive(Clone, Debug)]
pub(super) struct Setup {
    /// Inverse mass and inertia.
    pub spread: Spread,
    /// Initial centre of mass, metres.
    pub centre: Vector3,
    /// Origin of the plate's frame relative to the centre of mass, body axes, metres.
    pub frame: Vector3,
    /// Corners of the underside relative to the centre of mass, counter-clockwise from the end of
    /// the levered edge, body axes, metres.
    pub outline: Vec<Vector>,
    /// Points that may touch the table.
    pub tips: Vec<Tip>,
    /// Maximum distance of a tip from the centre of mass, metres.
    pub reach: f64,
    /// Initial height of the underside, metres.
    pub height: f64,
    /// Thickness of the plate itself, metres.
    pub thickness: f64,
    /// Friction coefficients with table and blade.
    pub friction: [f64; 2],
    /// Half width and length of the blade, metres.
    pub blade: [f64; 2],
    pub blade_height: f64,
    /// Cuboid solids of the plate, about the centre of mass, body axes.
    pub parts: Vec<Box3>,
    /// Fixed blocks, with their friction coefficient against the plate.
    pub blocks: Vec<(Box3, f64)>,
    /// The lever-up itself.
    pub lever: LeverUp,
    mirrored: bool,
    world: Pose3,
    start: Pose3,
}

impl Setup {
    pub fn new(job: &LeverJob) -> Self {
        let LeverJob { scene, lever } = job;
        let plate = &scene.plates[lever.plate];
        let weight = plate.weight();
        let own = lever_frame(plate.corners(), lever.place).inverse();
        let seen = own.point(Vector::new(weight.centre.x, weight.centre.y));
        let mirrored = seen.y < 0.0;
        let side = if mirrored { -1.0 } else { 1.0 };
        let view = |at: Vector| {
            let at = own.point(at) - seen;
            Vector::new(at.x, side * at.y)
        };
        // In reverse order, a mirrored outline is counter-clockwise again.
        let ring = |corners: &[Vector], first: usize| -> Vec<Vector> {
            let count = corners.len();
            let nth = |k: usize| if mirrored { first + count - k } else { first + k };
            (0..count).map(|k| view(corners[nth(k) % count])).collect()
        };
        let first = lever.place.edge + usize::from(!mirrored);
        let outline = ring(plate.corners(), first);
        let above = weight.centre.z;
        let feet = if plate.has_feet() { plate.z } else { 0.0 };
        let radius = FOOT.min(0.5 * feet);
        let point = |at: &Vector, z: f64| Vector3::new(at.x, at.y, z - above);
        let mut tips: Vec<Tip> =
            outline.iter().map(|at| Tip { at: point(at, radius - feet), radius }).collect();
        for (k, slab) in plate.slabs.iter().enumerate() {
            let ring = ring(&slab.corners, if k == 0 { first } else { 0 });
            // The corners of the plate's own underside are replaced by its feet.
            let levels = [slab.bottom, slab.bottom + slab.height];
            for level in &levels[usize::from(k == 0)..] {
                tips.extend(ring.iter().map(|at| Tip { at: point(at, *level), radius: 0.0 }));
            }
        }
        let frame = view(Vector::zeros());
        let parts = plate.slabs.iter().filter_map(|slab| {
            let (middle, heading, [x, y]) = slab.rectangle()?;
            let at = view(middle);
            let seen = Pose::new(at.x, at.y, side * (own.heading + heading));
            Some(Box3 {
                pose: Pose3::upright(seen, slab.bottom + 0.5 * slab.height - above),
                half: 0.5 * Vector3::new(x, y, slab.height),
            })
        });
        let mean = |other: f64| 0.5 * (plate.friction + other);
        Self {
            spread: Spread::new(&weight, &own, side),
            centre: Vector3::new(seen.x, side * seen.y, plate.z + above),
            frame: Vector3::new(frame.x, frame.y, -above),
            outline,
            reach: tips.iter().map(|tip| tip.at.norm()).fold(0.0, f64::max),
            tips,
            height: plate.z,
            thickness: plate.slabs[0].height,
            friction: [mean(scene.table_friction), mean(scene.blade.friction)],
            blade: [0.5 * scene.blade.width, scene.blade.length],
            blade_height: scene.blade.thickness,
            parts: parts.collect(),
            blocks: Vec::new(),
            lever: *lever,
            mirrored,
            world: Pose3 { position: Vector3::zeros(), ..lever.frame(scene) },
            start: plate.start(),
        }
        .above(lever.frame(scene).position)
        .among(&scene.blocks, plate.friction)
    }

    /// Returns the plate's frame in the world.
    pub fn pose(&self, body: &Body) -> Pose3 {
        let mut at = body.centre + body.axes * self.frame;
        let [mut x, y, mut z, w] = body.turn.coords.into();
        if self.mirrored {
            (at.y, x, z) = (-at.y, -x, -z);
        }
        let moved = Pose3::from_quaternion(at, [x, y, z, w]);
        let turned = self.world.rotation * moved.rotation * self.world.rotation.inverse();
        Pose3 { position: self.world.point(at), rotation: turned * self.start.rotation }
    }

    /// Returns the plate's initial frame in the world.
    pub fn start(&self) -> Pose3 {
        self.start
    }

    /// Adds blocks around the plate.
    fn among(mut self, blocks: &[Obstacle], friction: f64) -> Self {
        let own = self.world.inverse();
        let seen = |block: &Obstacle| {
            let [x, y, z] = block.size;
            let mut pose = own * Pose3::upright(block.pose, block.z + 0.5 * z);
            if self.mirrored {
                let [i, j, k, w] = pose.quaternion();
                let at = pose.position;
                let at = Vector3::new(at.x, -at.y, at.z);
                pose = Pose3::from_quaternion(at, [-i, j, -k, w]);
            }
            (Box3 { pose, half: 0.5 * Vector3::new(x, y, z) }, 0.5 * (friction + block.friction))
        };
        self.blocks = blocks.iter().map(seen).collect();
        self
    }

    /// Moves the frame's origin to the table below the lever point.
    fn above(mut self, point: Vector3) -> Self {
        self.world.position = Vector3::new(point.x, point.y, 0.0);
        self
    }
}

/// Pose of the blade: the middle of its tip's upper edge, and its directions. It moves in the plane
/// y = 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct BladePose {
    /// Position of the tip, metres.
    pub tip: Vector3,
    /// Unit vector towards the tip.
    pub along: Vector3,
    /// Unit normal of the upper face, outwards.
    pub up: Vector3,
}

impl Setup {
    /// Returns the blade `time` seconds from the start of the rotation, like [`LeverUp::blade`].
    pub fn blade_at(&self, time: f64) -> BladePose {
        let lever = &self.lever;
        let turn = lever.turn_time();
        let angle = lever.angle * (time / turn).clamp(0.0, 1.0);
        let back = ((time - turn - lever.hold) * lever.speed).clamp(0.0, lever.retreat);
        let (sin, cos) = if lever.pivot < 0.0 { -angle } else { angle }.sin_cos();
        let along = Vector3::new(cos, 0.0, -sin);
        let up = Vector3::new(sin, 0.0, cos);
        let pivot = Vector3::new(lever.pivot, 0.0, self.height);
        BladePose { tip: pivot + along * (lever.depth - lever.pivot - back), along, up }
    }
}
