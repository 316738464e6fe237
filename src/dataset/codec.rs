//! Episodes as bytes: little-endian, no padding, `f64` kept whole so that a file holds the very
//! bits that were computed.
//!
//! ```text
//! episode  = index u64, scene, motion, n u32, n x frame
//! scene    = table friction f64,
//!            n u32, n x (name, shape, mass f64, friction f64, pose),
//!            n u32, n x (a u32, b u32, kind u8, x f64, y f64,
//!            limited u8, low f64, high f64)                          joints
//!            n u32, n x (name, size 3 x f64, pose, friction f64)     obstacles
//! shape    = 0 u8, radius f64, height f64  |  1 u8, size 3 x f64
//! motion   = name, description, grip pose, friction f64,
//!            n u32, n x (name, shape, pose),                         parts
//!            n u32, n x (a u32, b u32),                              joints
//!            lift f64, n u32, n x (from pose, to pose, duration f64, settle u8)
//! frame    = time f64, stroke u32, tool pose, objects x (pose, velocity)
//! pose, velocity = x f64, y f64, heading or angular f64
//! name     = n u32, n bytes of UTF-8
//! ```

use std::sync::Arc;

use crate::{
    geometry::{Pose, Shape, Vector},
    scene::{
        Frame, Joint, JointKind, Object, Obstacle, Part, Scene, Span, State, Stroke, Tool,
        ToolMotion, Velocity,
    },
};

use super::episode::Episode;

/// Appends an episode.
pub(super) fn write_episode(out: &mut Vec<u8>, episode: &Episode) {
    put_u64(out, episode.index);
    write_scene(out, &episode.scene);
    write_motion(out, &episode.motion);
    put_count(out, episode.frames.len());
    for frame in &episode.frames {
        put(out, &[frame.time]);
        put_count(out, frame.stroke);
        put_pose(out, &frame.tool);
        for (pose, velocity) in frame.state.poses.iter().zip(&frame.state.velocities) {
            put_pose(out, pose);
            put(out, &[velocity.linear.x, velocity.linear.y, velocity.angular]);
        }
    }
}

/// Reads what [`write_episode`] wrote; nothing if the bytes do not make one.
pub(super) fn read_episode(bytes: &mut Bytes) -> Option<Episode> {
    let index = bytes.u64()?;
    let scene = read_scene(bytes)?;
    let motion = read_motion(bytes)?;
    let objects = scene.objects.len();
    let frames = bytes.list(|bytes| {
        let time = bytes.f64()?;
        let stroke = bytes.count()?;
        let tool = bytes.pose()?;
        let mut state = State::default();
        for _ in 0..objects {
            state.poses.push(bytes.pose()?);
            let [x, y, angular] = bytes.triple()?;
            state.velocities.push(Velocity { linear: Vector::new(x, y), angular });
        }
        Some(Frame { time, stroke, tool, state })
    })?;
    Some(Episode { index, scene, motion, frames })
}

fn write_scene(out: &mut Vec<u8>, scene: &Scene) {
    put(out, &[scene.table_friction]);
    put_count(out, scene.objects.len());
    for object in &scene.objects {
        put_name(out, &object.name);
        write_shape(out, &object.shape);
        put(out, &[object.mass, object.friction]);
        put_pose(out, &object.pose);
    }
    put_count(out, scene.joints.len());
    for joint in &scene.joints {
        joint.between.iter().for_each(|&end| put_count(out, end));
        let (kind, vector, limits) = match joint.kind {
            JointKind::Fixed => (0, Vector::zeros(), None),
            JointKind::Revolute { at, limits } => (1, at, limits),
            JointKind::Prismatic { axis, limits } => (2, axis, limits),
        };
        out.push(kind);
        put(out, &[vector.x, vector.y]);
        let Span { low, high } = limits.unwrap_or(Span::new(0.0, 0.0));
        out.push(u8::from(limits.is_some()));
        put(out, &[low, high]);
    }
    put_count(out, scene.obstacles.len());
    for obstacle in &scene.obstacles {
        put_name(out, &obstacle.name);
        put(out, &obstacle.size);
        put_pose(out, &obstacle.pose);
        put(out, &[obstacle.friction]);
    }
}

fn read_scene(bytes: &mut Bytes) -> Option<Scene> {
    let table_friction = bytes.f64()?;
    let objects = bytes.list(|bytes| {
        let name = bytes.name()?;
        let shape = read_shape(bytes)?;
        let (mass, friction) = (bytes.f64()?, bytes.f64()?);
        Some(Object { name, shape, mass, friction, pose: bytes.pose()? })
    })?;
    let joints = bytes.list(|bytes| {
        let between = [bytes.count()?, bytes.count()?];
        let kind = bytes.u8()?;
        let vector = Vector::new(bytes.f64()?, bytes.f64()?);
        let (limited, low, high) = (bytes.u8()?, bytes.f64()?, bytes.f64()?);
        let limits = (limited == 1).then_some(Span::new(low, high));
        let kind = match kind {
            0 => JointKind::Fixed,
            1 => JointKind::Revolute { at: vector, limits },
            2 => JointKind::Prismatic { axis: vector, limits },
            _ => return None,
        };
        Some(Joint { between, kind, guessed: false })
    })?;
    let obstacles = bytes.list(|bytes| {
        let (name, size, pose) = (bytes.name()?, bytes.triple()?, bytes.pose()?);
        Some(Obstacle { name, size, pose, friction: bytes.f64()? })
    })?;
    Some(Scene { table_friction, objects, joints, obstacles })
}

fn write_shape(out: &mut Vec<u8>, shape: &Shape) {
    match *shape {
        Shape::Cylinder { radius, height } => {
            out.push(0);
            put(out, &[radius, height]);
        }
        Shape::Cuboid { size } => {
            out.push(1);
            put(out, &size);
        }
    }
}

fn read_shape(bytes: &mut Bytes) -> Option<Shape> {
    match bytes.u8()? {
        0 => Some(Shape::Cylinder { radius: bytes.f64()?, height: bytes.f64()? }),
        1 => Some(Shape::Cuboid { size: bytes.triple()? }),
        _ => None,
    }
}

fn write_motion(out: &mut Vec<u8>, motion: &ToolMotion) {
    let tool = &motion.tool;
    put_name(out, &tool.name);
    put_name(out, &tool.description);
    put_pose(out, &tool.grip);
    put(out, &[tool.friction]);
    put_count(out, tool.parts.len());
    for part in &tool.parts {
        put_name(out, &part.name);
        write_shape(out, &part.shape);
        put_pose(out, &part.pose);
    }
    put_count(out, tool.joints.len());
    tool.joints.iter().flatten().for_each(|&end| put_count(out, end));
    put(out, &[motion.lift]);
    put_count(out, motion.strokes.len());
    for stroke in &motion.strokes {
        put_pose(out, &stroke.from);
        put_pose(out, &stroke.to);
        put(out, &[stroke.duration]);
        out.push(u8::from(stroke.settle));
    }
}

fn read_motion(bytes: &mut Bytes) -> Option<ToolMotion> {
    let (name, description) = (bytes.name()?, bytes.name()?);
    let (grip, friction) = (bytes.pose()?, bytes.f64()?);
    let parts = bytes.list(|bytes| {
        Some(Part { name: bytes.name()?, shape: read_shape(bytes)?, pose: bytes.pose()? })
    })?;
    let joints = bytes.list(|bytes| Some([bytes.count()?, bytes.count()?]))?;
    let tool = Arc::new(Tool { name, description, grip, friction, parts, joints });
    let lift = bytes.f64()?;
    let strokes = bytes.list(|bytes| {
        let (from, to) = (bytes.pose()?, bytes.pose()?);
        Some(Stroke { from, to, duration: bytes.f64()?, settle: bytes.u8()? != 0 })
    })?;
    Some(ToolMotion { tool, lift, strokes })
}

/// Appends a whole number of eight bytes.
pub(super) fn put_u64(out: &mut Vec<u8>, value: u64) {
    out.extend_from_slice(&value.to_le_bytes());
}

fn put(out: &mut Vec<u8>, values: &[f64]) {
    values.iter().for_each(|value| out.extend_from_slice(&value.to_le_bytes()));
}

fn put_pose(out: &mut Vec<u8>, pose: &Pose) {
    put(out, &[pose.position.x, pose.position.y, pose.heading]);
}

/// Counts here are of things in one episode, far below the limit of four bytes.
fn put_count(out: &mut Vec<u8>, count: usize) {
    out.extend_from_slice(&u32::try_from(count).unwrap_or(u32::MAX).to_le_bytes());
}

fn put_name(out: &mut Vec<u8>, name: &str) {
    put_count(out, name.len());
    out.extend_from_slice(name.as_bytes());
}

/// Bytes being read from the front.
pub(super) struct Bytes<'a>(pub(super) &'a [u8]);

impl<'a> Bytes<'a> {
    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    fn u8(&mut self) -> Option<u8> {
        self.take(1).map(|b| b[0])
    }

    pub(super) fn u64(&mut self) -> Option<u64> {
        Some(u64::from_le_bytes(self.take(8)?.try_into().ok()?))
    }

    fn count(&mut self) -> Option<usize> {
        usize::try_from(u32::from_le_bytes(self.take(4)?.try_into().ok()?)).ok()
    }

    fn f64(&mut self) -> Option<f64> {
        Some(f64::from_le_bytes(self.take(8)?.try_into().ok()?))
    }

    fn triple(&mut self) -> Option<[f64; 3]> {
        Some([self.f64()?, self.f64()?, self.f64()?])
    }

    fn pose(&mut self) -> Option<Pose> {
        let [x, y, heading] = self.triple()?;
        Some(Pose::new(x, y, heading))
    }

    fn name(&mut self) -> Option<String> {
        let count = self.count()?;
        String::from_utf8(self.take(count)?.to_vec()).ok()
    }

    /// A counted list. Grows as it is read, so that a wrong count cannot ask for more memory
    /// than the bytes that are there.
    fn list<T>(&mut self, mut read: impl FnMut(&mut Self) -> Option<T>) -> Option<Vec<T>> {
        let count = self.count()?;
        let mut items = Vec::with_capacity(count.min(self.0.len()));
        for _ in 0..count {
            items.push(read(self)?);
        }
        Some(items)
    }
}
