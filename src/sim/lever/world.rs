//! A lever scene in rapier.

use rapier3d_f64::parry::query::contact;
use rapier3d_f64::prelude::{
    Collider, ColliderHandle, ContactPair, FrictionModel, MassProperties, PhysicsWorld,
    Pose3 as RapierPose, RigidBodyBuilder, RigidBodyHandle, Rotation, SpringCoefficients,
    Vector as RapierVector,
};

use crate::geometry::{Pose, Pose3, Vector, Vector3};
use crate::{
    scene::{Blade, GRAVITY, LeverScene, TOUCHING},
    task::{Stroke, ToolMotion},
};

use super::super::parameters::ALLOWED_ERROR;
use super::super::solids::solid;
use super::super::solved::solved;
use super::super::strain::force;
use super::fresh::fresh_contacts;
use super::solids;

/// A plate this near to the blade lies on it, metres; contacts flicker by less.
const NEAR: f64 = 5e-4;

/// Contact spring: natural frequency (Hz) and damping ratio.
///
/// With rapier's own (30 Hz, 5) a plate on three feet sags by 0.6 to 0.9 mm, which takes tenths of a
/// second and other ones at every rate, so runs at 1/240 and 1/1920 s are twice as far apart. Stiffer
/// springs throw boards that stand on edge in a drive.
const CONTACT: (f64, f64) = (100.0, 5.0);

/// Plates, blocks, table and blade.
pub(super) struct LeverWorld {
    world: PhysicsWorld,
    /// Where rapier's origin lies on the table: a scene far from the world's loses no digits.
    origin: Vector,
    /// What levers, with its solid: laid aside it stays where it is and meets nothing.
    blade: Option<(RigidBodyHandle, ColliderHandle)>,
    /// What pushes, while it is down.
    tool: Option<RigidBodyHandle>,
    plates: Vec<RigidBodyHandle>,
    /// Largest distance of a plate's points from its centre of mass, metres.
    reaches: Vec<f64>,
}

impl LeverWorld {
    /// Everything at the start about `origin`, plates where `starts` has them, and the centre of the
    /// scene's blade at `blade`, if it is there from the beginning; steps last `step` seconds.
    pub fn new(
        scene: &LeverScene,
        (origin, starts): (Vector, &[Pose3]),
        blade: Option<&Pose3>,
        step: f64,
    ) -> Self {
        let mut world = PhysicsWorld {
            gravity: RapierVector::Z * -GRAVITY,
            narrow_phase: fresh_contacts(),
            ..PhysicsWorld::default()
        };
        let settings = &mut world.integration_parameters;
        settings.dt = step;
        // The simplified model makes other plates flip.
        settings.friction_model = FrictionModel::Coulomb;
        settings.normalized_allowed_linear_error = ALLOWED_ERROR;
        let (frequency, damping) = CONTACT;
        settings.contact_softness = SpringCoefficients::new(frequency, damping);
        world.insert_collider(solids::table(scene.table_friction), None);
        let mut this = Self {
            world,
            origin,
            blade: None,
            tool: None,
            plates: Vec::new(),
            reaches: Vec::new(),
        };
        if let Some(at) = blade {
            this.take_up(&scene.blade, at);
        }
        this.add_plates(scene, starts);
        this.add_blocks(scene);
        this
    }

    /// Lets steps last so long from now on, seconds.
    pub fn set_step(&mut self, step: f64) {
        self.world.integration_parameters.dt = step;
    }

    /// One step, in which the blade moves to this pose, if there is one.
    pub fn step(&mut self, blade: Option<&Pose3>) {
        if let (Some((handle, _)), Some(pose)) = (self.blade, blade) {
            let body = &mut self.world.bodies[handle];
            let mut target = to_rapier(pose, self.origin);
            target.rotation = in_one_hemisphere(*body.rotation(), target.rotation);
            body.set_next_kinematic_position(target);
        }
        self.world.step();
    }

    /// Takes up a blade with its centre at `at`, in place of the one before.
    pub fn take_up(&mut self, blade: &Blade, at: &Pose3) {
        let at = to_rapier(at, self.origin);
        let body = RigidBodyBuilder::kinematic_position_based().pose(at).can_sleep(false);
        let body = self.world.insert_body(body);
        let solid = self.world.insert_collider(solids::blade(blade), Some(body));
        self.blade = Some((body, solid));
    }

    /// Lays the blade aside, where it meets nothing any more.
    pub fn lay_aside(&mut self) {
        if let Some((_, solid)) = self.blade {
            self.world.colliders[solid].set_enabled(false);
        }
    }

    /// Whether a blade is there and not laid aside.
    pub fn has_blade(&self) -> bool {
        self.blade.is_some_and(|(_, solid)| self.world.colliders[solid].is_enabled())
    }

    /// Sets a tool down with its frame at `at`; the index of a plate that it comes down on.
    pub fn set_down(&mut self, motion: &ToolMotion, at: &Pose) -> Option<usize> {
        let pose = to_rapier(&Pose3::upright(*at, motion.lift), self.origin);
        let body = RigidBodyBuilder::kinematic_velocity_based().pose(pose).can_sleep(false);
        // rapier's velocity is that of the centre of mass, so all of it lies in the tool frame.
        let mass = MassProperties::new(RapierVector::ZERO, 1.0, RapierVector::ONE);
        let tool = self.world.insert_body(body.additional_mass_properties(mass));
        self.tool = Some(tool);
        for part in motion.tool.outline() {
            let middle = Pose3::upright(part.pose, part.shape.height() / 2.0);
            let placed = to_rapier(&middle, Vector::zeros());
            let part = solid(&part.shape, placed, motion.tool.friction).density(0.0);
            self.world.insert_collider(part, Some(tool));
        }
        let down = |handle: &ColliderHandle| {
            let part = &self.world.colliders[*handle];
            let part = (pose * *part.position_wrt_parent().unwrap_or(&RapierPose::IDENTITY), part);
            self.plates.iter().position(|plate| self.overlaps(*plate, &part))
        };
        self.world.bodies[tool].colliders().iter().find_map(down)
    }

    /// Whether a part of a tool is deeper inside a plate than touching is.
    fn overlaps(&self, plate: RigidBodyHandle, (at, part): &(RapierPose, &Collider)) -> bool {
        self.world.bodies[plate].colliders().iter().any(|handle| {
            let own = &self.world.colliders[*handle];
            let found = contact(at, part.shape(), own.position(), own.shape(), 0.0);
            found.is_ok_and(|found| found.is_some_and(|found| found.dist < -TOUCHING))
        })
    }

    /// Lets the tool that is down begin a stroke.
    pub fn drive(&mut self, stroke: &Stroke) {
        let Some(tool) = self.tool else { return };
        let velocity = (stroke.to.position - stroke.from.position) / stroke.duration;
        let turning = (stroke.to.heading - stroke.from.heading) / stroke.duration;
        let body = &mut self.world.bodies[tool];
        body.set_linvel(RapierVector::new(velocity.x, velocity.y, 0.0), true);
        body.set_angvel(RapierVector::Z * turning, true);
    }

    /// Lifts the tool that is down.
    pub fn lift(&mut self) {
        if let Some(tool) = self.tool.take() {
            self.world.remove_body(tool);
        }
    }

    /// The frame of a plate.
    pub fn plate(&self, index: usize) -> Pose3 {
        from_rapier(self.world.bodies[self.plates[index]].position(), self.origin)
    }

    /// The frames of all plates.
    pub fn plates(&self) -> Vec<Pose3> {
        (0..self.plates.len()).map(|index| self.plate(index)).collect()
    }

    /// Speed of the fastest point of any plate, m/s.
    pub fn speed(&self) -> f64 {
        let speed = |(handle, reach): (&RigidBodyHandle, &f64)| {
            let body = &self.world.bodies[*handle];
            body.linvel().length() + body.angvel().length() * reach
        };
        self.plates.iter().zip(&self.reaches).map(speed).fold(0.0, f64::max)
    }

    /// Whether a plate touches the blade.
    pub fn is_held(&self, index: usize) -> bool {
        let plate = self.plates[index];
        let touches = |pair: &ContactPair| {
            let mut points = pair.manifolds.iter().flat_map(solved);
            points.any(|(_, point)| point.data.impulse > 0.0 || point.dist <= NEAR)
        };
        self.on_blade().any(|(other, _, pair)| other == plate && touches(pair))
    }

    /// Force of the plates on the blade during the last step, newtons.
    pub fn force_on_blade(&self) -> f64 {
        self.force(self.on_blade())
    }

    /// Force of the plates on the tool that is down during the last step, newtons.
    pub fn force_on_tool(&self) -> f64 {
        let Some(tool) = self.tool else { return 0.0 };
        let parts = self.world.bodies[tool].colliders();
        self.force(parts.iter().flat_map(|part| self.on(*part)))
    }

    /// Sum of the contact forces of the last step, newtons.
    fn force<'a>(
        &self,
        contacts: impl Iterator<Item = (RigidBodyHandle, f64, &'a ContactPair)>,
    ) -> f64 {
        let mut impulse = RapierVector::ZERO;
        for (_, sign, pair) in contacts {
            for (manifold, point) in pair.manifolds.iter().flat_map(solved) {
                impulse += manifold.data.normal * (sign * point.data.impulse);
            }
        }
        let settings = &self.world.integration_parameters;
        force(impulse.length(), settings.dt, settings.num_solver_iterations)
    }

    /// Contacts of the blade, see [`LeverWorld::on`].
    fn on_blade(&self) -> impl Iterator<Item = (RigidBodyHandle, f64, &ContactPair)> {
        self.blade.into_iter().flat_map(|(_, solid)| self.on(solid))
    }

    /// Contacts of a solid: with which body, and whether their normals point into it (1) or out.
    fn on(
        &self,
        solid: ColliderHandle,
    ) -> impl Iterator<Item = (RigidBodyHandle, f64, &ContactPair)> {
        self.world.narrow_phase.contact_pairs_with(solid).filter_map(move |pair| {
            let (other, sign) = if pair.collider1 == solid {
                (pair.collider2, -1.0)
            } else {
                (pair.collider1, 1.0)
            };
            Some((self.world.colliders[other].parent()?, sign, pair))
        })
    }

    fn add_plates(&mut self, scene: &LeverScene, starts: &[Pose3]) {
        for (plate, start) in scene.plates.iter().zip(starts) {
            let body = RigidBodyBuilder::dynamic()
                .pose(to_rapier(start, self.origin))
                .additional_mass_properties(solids::weight(plate))
                .can_sleep(false);
            let handle = self.world.insert_body(body);
            for part in solids::parts(plate) {
                self.world.insert_collider(part, Some(handle));
            }
            self.plates.push(handle);
            let far = plate.slabs.iter().flat_map(|slab| &slab.corners).map(|corner| corner.norm());
            self.reaches.push(far.fold(0.0, f64::max));
        }
    }

    fn add_blocks(&mut self, scene: &LeverScene) {
        for block in &scene.blocks {
            let middle = Pose3::upright(block.pose, block.z + 0.5 * block.size[2]);
            let collider = solids::cuboid(block.size, block.friction);
            self.world.insert_collider(collider.position(to_rapier(&middle, self.origin)), None);
        }
    }
}

/// The same turn, written with the sign that lies nearer to `last`: between opposite signs rapier
/// sees a full turn within a step, which throws the plate off at tens of metres a second.
fn in_one_hemisphere(last: Rotation, next: Rotation) -> Rotation {
    if last.dot(next) < 0.0 { -next } else { next }
}

fn to_rapier(pose: &Pose3, origin: Vector) -> RapierPose {
    let ([x, y, z], [i, j, k, w]) = (pose.position.into(), pose.quaternion());
    let position = RapierVector::new(x - origin.x, y - origin.y, z);
    RapierPose::from_parts(position, Rotation::from_xyzw(i, j, k, w))
}

fn from_rapier(pose: &RapierPose, origin: Vector) -> Pose3 {
    let (p, q) = (pose.translation, pose.rotation);
    let position = Vector3::new(p.x + origin.x, p.y + origin.y, p.z);
    Pose3::from_quaternion(position, q.to_array())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_keep_their_sign() {
        let turn = Rotation::from_rotation_y(0.3);
        let next = Rotation::from_rotation_y(0.31);
        assert_eq!(in_one_hemisphere(turn, -next), next);
        assert_eq!(in_one_hemisphere(turn, next), next);
        assert_eq!(in_one_hemisphere(-turn, next), -next);
    }
}
