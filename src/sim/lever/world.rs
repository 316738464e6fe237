//! A spatial scene in rapier.

use std::sync::Arc;

use rapier3d_f64::parry::query::contact;
use rapier3d_f64::prelude::{
    ActiveHooks, Collider, ColliderBuilder, ColliderHandle, ContactPair, MassProperties,
    PhysicsWorld, Pose3 as RapierPose, RigidBodyBuilder, RigidBodyHandle, Vector as RapierVector,
};

use crate::geometry::{Pose, Pose3, Vector};
use crate::{
    scene::{Blade, Body, TOUCHING},
    task::{Stroke, ToolMotion},
};

use super::super::parameters::{STIFF_CONTACT, is_articulated};
use super::super::seams::Seams;
use super::super::solids::solid;
use super::super::solved::solved;
use super::super::spatial::empty::empty_world;
use super::super::spatial::joints::{Anchored, add_joints};
use super::super::spatial::place::brink;
use super::super::violations::force;
use super::fresh::fresh_contacts;
use super::place::{from_rapier, in_one_hemisphere, to_rapier};
use super::scenery::Scenery;
use super::solids;

/// The `user_data` of the table, which no label names.
const TABLE: u128 = u128::MAX;

/// Distance below its start at which an object has left the table, metres.
const FALLEN: f64 = 0.1;

/// Distance below which a plate lies on the blade, metres; contacts flicker by less.
const NEAR: f64 = 5e-4;

/// Contact spring: natural frequency (Hz) and damping ratio.
///
/// A plate on three feet sags by 0.6 to 0.9 mm with rapier's default (30 Hz, 5). This takes tenths
/// of a second, and other times at every rate, so runs at 1/240 and 1/1920 s are twice as far
/// apart. Stiffer springs throw boards that stand on edge in a drive.
const CONTACT: (f64, f64) = (100.0, 5.0);

/// A world with objects, obstacles, table and blade.
pub(super) struct LeverWorld {
    world: PhysicsWorld,
    scenery: Arc<Scenery>,
    /// Bodies of colliders, by their `user_data`.
    labels: Vec<Body>,
    seams: Seams,
    /// Rapier's origin on the table, so that a scene far from the world's origin loses no
    /// precision.
    origin: Vector,
    /// Blade with its solid; laid aside, it keeps its pose and collides with nothing.
    blade: Option<(RigidBodyHandle, ColliderHandle)>,
    /// Pushing tool, while it is down.
    tool: Option<RigidBodyHandle>,
    plates: Vec<RigidBodyHandle>,
    /// Largest distance of a plate's points from its centre of mass, metres.
    reaches: Vec<f64>,
}

impl LeverWorld {
    /// Creates the world at the start about `origin`. `blade` is the blade that is present from the
    /// beginning, with the pose of its centre; steps last `step` seconds.
    pub fn new(
        scenery: &Arc<Scenery>,
        origin: Vector,
        blade: Option<(&Blade, &Pose3)>,
        step: f64,
    ) -> Self {
        let (scene, physics) = (&*scenery.scene, &*scenery.physics);
        let articulated = is_articulated(scene, physics);
        let softness = if articulated { STIFF_CONTACT } else { CONTACT };
        let mut world = empty_world(articulated, Some(softness));
        world.narrow_phase = fresh_contacts();
        world.integration_parameters.dt = step;
        let frame = Pose { position: origin, heading: 0.0 };
        let table = solids::table(physics.table_friction, brink(scene, &frame));
        world.insert_collider(table.user_data(TABLE), None);
        let mut this = Self {
            world,
            scenery: Arc::clone(scenery),
            labels: Vec::new(),
            seams: Seams::default(),
            origin,
            blade: None,
            tool: None,
            plates: Vec::new(),
            reaches: Vec::new(),
        };
        if let Some((blade, at)) = blade {
            this.take_up(blade, at);
        }
        this.add_plates();
        this.add_obstacles();
        this.join(&frame);
        this.rub();
        this
    }

    /// Applies the frictions stated for pairs.
    fn rub(&mut self) {
        let pairs = &self.scenery.physics.pairs;
        if pairs.is_empty() {
            return;
        }
        let mut asking = self.seams.rub(&self.labels, pairs);
        asking.extend(self.seams.rub_table(&self.labels, pairs, TABLE));
        for (_, collider) in self.world.colliders.iter_mut() {
            if asking.iter().any(|label| collider.user_data == *label as u128) {
                collider.set_active_hooks(ActiveHooks::MODIFY_SOLVER_CONTACTS);
            }
        }
    }

    fn insert(
        &mut self,
        collider: ColliderBuilder,
        label: Body,
        body: Option<RigidBodyHandle>,
    ) -> ColliderHandle {
        let collider = collider.user_data(self.labels.len() as u128);
        self.labels.push(label);
        self.world.insert_collider(collider, body)
    }

    /// Sets the duration of later steps, seconds.
    pub fn set_step(&mut self, step: f64) {
        self.world.integration_parameters.dt = step;
    }

    /// Advances by one step, in which the blade, if present, moves to this pose.
    pub fn step(&mut self, blade: Option<&Pose3>) {
        if let (Some((handle, _)), Some(pose)) = (self.blade, blade) {
            let body = &mut self.world.bodies[handle];
            let mut target = to_rapier(pose, self.origin);
            target.rotation = in_one_hemisphere(*body.rotation(), target.rotation);
            body.set_next_kinematic_position(target);
        }
        self.world.step_with_events(&self.seams, &());
        if self.scenery.scene.brink().is_some() {
            self.leave_fallen();
        }
    }

    /// Disables objects that have fallen off the table; they keep their poses.
    fn leave_fallen(&mut self) {
        for (handle, start) in self.plates.iter().zip(&self.scenery.starts) {
            let body = &mut self.world.bodies[*handle];
            if body.is_enabled() && body.translation().z < start.position.z - FALLEN {
                body.set_linvel(RapierVector::ZERO, false);
                body.set_angvel(RapierVector::ZERO, false);
                body.set_enabled(false);
            }
        }
    }

    /// Returns `true` if an object has fallen off a finite table.
    pub fn has_fallen(&self, index: usize) -> bool {
        !self.world.bodies[self.plates[index]].is_enabled()
    }

    /// Takes up a blade with its centre at `at`, in place of the previous one.
    pub fn take_up(&mut self, blade: &Blade, at: &Pose3) {
        let at = to_rapier(at, self.origin);
        let body = RigidBodyBuilder::kinematic_position_based().pose(at).can_sleep(false);
        let body = self.world.insert_body(body);
        let solid = self.insert(solids::blade(blade), Body::Part(0), Some(body));
        self.blade = Some((body, solid));
        self.rub();
    }

    /// Lays the blade aside, where it collides with nothing.
    pub fn lay_aside(&mut self) {
        if let Some((_, solid)) = self.blade {
            self.world.colliders[solid].set_enabled(false);
        }
    }

    /// Returns `true` if a blade is present and not laid aside.
    pub fn has_blade(&self) -> bool {
        self.blade.is_some_and(|(_, solid)| self.world.colliders[solid].is_enabled())
    }

    /// Sets a tool down with its frame at `at`; returns the index of a plate below it, if any.
    pub fn set_down(&mut self, motion: &ToolMotion, at: &Pose) -> Option<usize> {
        let pose = to_rapier(&Pose3::upright(*at, motion.lift), self.origin);
        let body = RigidBodyBuilder::kinematic_velocity_based().pose(pose).can_sleep(false);
        // rapier's velocity refers to the centre of mass, which therefore is at the tool frame's
        // origin.
        let mass = MassProperties::new(RapierVector::ZERO, 1.0, RapierVector::ONE);
        let tool = self.world.insert_body(body.additional_mass_properties(mass));
        self.tool = Some(tool);
        for (k, part) in motion.tool.outline().iter().enumerate() {
            let middle = Pose3::upright(part.pose, part.shape.height() / 2.0);
            let placed = to_rapier(&middle, Vector::zeros());
            let part = solid(&part.shape, placed, motion.tool.friction).density(0.0);
            self.insert(part, Body::Part(k), Some(tool));
        }
        self.rub();
        let down = |handle: &ColliderHandle| {
            let part = &self.world.colliders[*handle];
            let part = (pose * *part.position_wrt_parent().unwrap_or(&RapierPose::IDENTITY), part);
            self.plates.iter().position(|plate| self.overlaps(*plate, &part))
        };
        self.world.bodies[tool].colliders().iter().find_map(down)
    }

    /// Returns `true` if a part of a tool is deeper inside a plate than a touch.
    fn overlaps(&self, plate: RigidBodyHandle, (at, part): &(RapierPose, &Collider)) -> bool {
        self.world.bodies[plate].colliders().iter().any(|handle| {
            let own = &self.world.colliders[*handle];
            let found = contact(at, part.shape(), own.position(), own.shape(), 0.0);
            found.is_ok_and(|found| found.is_some_and(|found| found.dist < -TOUCHING))
        })
    }

    /// Begins a stroke with the tool that is down.
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

    /// Returns the frame of a plate.
    pub fn plate(&self, index: usize) -> Pose3 {
        from_rapier(self.world.bodies[self.plates[index]].position(), self.origin)
    }

    /// Returns the frames of all plates.
    pub fn plates(&self) -> Vec<Pose3> {
        (0..self.plates.len()).map(|index| self.plate(index)).collect()
    }

    /// Returns the speed of the fastest point of any plate, m/s.
    pub fn speed(&self) -> f64 {
        let speed = |(handle, reach): (&RigidBodyHandle, &f64)| {
            let body = &self.world.bodies[*handle];
            body.linvel().length() + body.angvel().length() * reach
        };
        self.plates.iter().zip(&self.reaches).map(speed).fold(0.0, f64::max)
    }

    /// Returns `true` if a plate touches the blade.
    pub fn is_held(&self, index: usize) -> bool {
        let plate = self.plates[index];
        let touches = |pair: &ContactPair| {
            let mut points = pair.manifolds.iter().flat_map(solved);
            points.any(|(_, point)| point.data.impulse > 0.0 || point.dist <= NEAR)
        };
        self.on_blade().any(|(other, _, pair)| other == plate && touches(pair))
    }

    /// Returns the force of the plates that `of` selects on the blade or the pushing tool during
    /// the last step, newtons.
    pub fn force_on_tool(&self, of: &dyn Fn(usize) -> bool) -> f64 {
        let is_of = |(body, ..): &(RigidBodyHandle, f64, &ContactPair)| {
            let plate = self.plates.iter().position(|plate| plate == body);
            plate.is_none_or(of)
        };
        let blade = self.force(self.on_blade().filter(is_of));
        let Some(tool) = self.tool else { return blade };
        let parts = self.world.bodies[tool].colliders();
        let parts = parts.iter().flat_map(|part| self.on(*part));
        blade.max(self.force(parts.filter(is_of)))
    }

    /// Returns the sum of the contact forces of the last step, newtons.
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

    /// Returns the contacts of the blade, see [`LeverWorld::on`].
    fn on_blade(&self) -> impl Iterator<Item = (RigidBodyHandle, f64, &ContactPair)> {
        self.blade.into_iter().flat_map(|(_, solid)| self.on(solid))
    }

    /// Returns the contacts of a solid: the other body, and the sign of normals that point into the
    /// solid (1) or out of it (-1).
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

    fn add_plates(&mut self) {
        let scenery = Arc::clone(&self.scenery);
        for (k, (plate, start)) in scenery.plates.iter().zip(&scenery.starts).enumerate() {
            let body = RigidBodyBuilder::dynamic()
                .pose(to_rapier(start, self.origin))
                .additional_mass_properties(solids::weight(&scenery.weight(k)))
                .can_sleep(false);
            let handle = self.world.insert_body(body);
            let (feet, height) =
                (scenery.stands_on(k), if plate.has_feet() { plate.z } else { 0.0 });
            for (s, slab) in plate.slabs.iter().enumerate() {
                let (label, friction) = scenery.surface(k, s);
                let hangs = feet.is_some() && height == 0.0 && slab.bottom == 0.0;
                let slab = if hangs { &solids::clear(slab) } else { slab };
                for part in solids::slab_parts(slab, friction) {
                    self.insert(part.density(0.0), label, Some(handle));
                }
            }
            let (label, friction) = scenery.surface(k, 0);
            for foot in solids::feet(feet.as_deref().unwrap_or_default(), height, friction) {
                self.insert(foot.density(0.0), label, Some(handle));
            }
            self.plates.push(handle);
            let far = plate.slabs.iter().flat_map(|slab| &slab.corners).map(|corner| corner.norm());
            self.reaches.push(far.fold(0.0, f64::max));
        }
    }

    fn add_obstacles(&mut self) {
        let scene = Arc::clone(&self.scenery.scene);
        for (k, obstacle) in scene.obstacles.iter().enumerate() {
            let middle = Pose3::upright(obstacle.pose, obstacle.z + 0.5 * obstacle.size[2]);
            let collider = solids::cuboid(obstacle.size, obstacle.friction);
            let collider = collider.position(to_rapier(&middle, self.origin));
            self.insert(collider, Body::Obstacle(k), None);
        }
    }

    /// Adds all joints of the scene; `frame` is rapier's frame on the table.
    fn join(&mut self, frame: &Pose) {
        let (scene, physics) = (&self.scenery.scene, &self.scenery.physics);
        let on = |k: usize| {
            let thing = scene.thing(k);
            let local = scene.objects[k].whole.map_or_else(Pose::default, |whole| whole.place);
            Anchored { body: self.plates[thing], local, height: self.scenery.plates[thing].z }
        };
        let objects: Vec<Anchored> = (0..scene.objects.len()).map(on).collect();
        add_joints(&mut self.world, scene, (&physics.joints, frame), &objects);
    }
}
