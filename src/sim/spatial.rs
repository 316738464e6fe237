//! The 3-D engine: rapier3d in `f64`, with gravity and table.
//!
//! Every object stands on feet, small balls at the points of its support. On rapier's own contacts
//! a cuboid would rest on its corners and a cylinder on four points of its rim, whatever support is
//! stated. The solid hangs slightly above the table, which it touches when it tips beyond its feet.
//! The friction model, the allowed error and the plain cylinder were chosen by measurements;
//! rapier's defaults have errors of centimetres.

use rapier3d_f64::prelude::{
    ActiveHooks, Collider, ColliderBuilder, ColliderHandle, MassProperties, PhysicsWorld, Pose3,
    RigidBodyBuilder, RigidBodyHandle, Rotation, Vector as RapierVector,
};

use crate::geometry::{Pose, Vector, wrap_angle};
use crate::scene::{Body, Feet, Physics, Scene, State, Velocity};
use crate::task::{FrameStep, ToolMotion};

use super::asleep::Asleep;
use super::groups::{Group, Member, stands};
use super::parameters::{ALLOWED_ERROR, STIFF_CONTACT, is_articulated, needs_stiff_contacts};
use super::seams::Seams;
use super::solids::{CLEAR, FOOT, floor, foot, raised, solid, table, undersides, weighing};
use super::solved::solved;
use super::support::Support;
use super::upright::{Standing, Upright};
use super::violations::{Overlap, force, overlap};
use super::world::World;

pub(super) mod empty;
pub(super) mod joints;
pub(super) mod place;

use empty::empty_world;
use joints::{Anchored, add_joints};
use place::{LOCAL, brink, frame_of, to_rapier, yaw};

/// Lean of an object's axis above which it has toppled, radians (10 degrees).
pub(super) const TOPPLED: f64 = 10.0 * std::f64::consts::PI / 180.0;

/// Distance below its start at which an object has left the table for good, metres.
const FALLEN: f64 = 0.1;

/// The `user_data` of the table, which no contact names.
const TABLE: u128 = u128::MAX;

/// A scene in rapier3d, in which objects can tip or only rotate about the vertical.
pub(super) struct SpatialWorld<const TIPS: bool> {
    world: PhysicsWorld,
    /// Rapier's frame on the table, see [`frame_of`].
    frame: Pose,
    lift: f64,
    tool: RigidBodyHandle,
    bodies: Vec<Tracked>,
    objects: Vec<(Member, f64)>,
    /// Supports of bodies that cannot tip.
    upright: Upright,
    /// Body of a collider, by its `user_data`.
    labels: Vec<Body>,
    seams: Seams,
    asleep: Asleep<RigidBodyHandle>,
    /// Whether the table is finite.
    ends: bool,
}

/// A body and its motion since the world was built.
struct Tracked {
    handle: RigidBodyHandle,
    first_position: RapierVector,
    first_rotation: Rotation,
    last_angle: f64,
    turned: f64,
    /// Whether it has fallen off the table, so that it is no longer in rapier's world.
    fallen: bool,
}

impl<const TIPS: bool> World for SpatialWorld<TIPS> {
    fn build(
        scene: &Scene,
        state: &State,
        physics: &Physics,
        motion: &ToolMotion,
        tool: &Pose,
    ) -> Self {
        let articulated = is_articulated(scene, physics);
        let stiff = articulated || needs_stiff_contacts(physics);
        let mut this = Self {
            world: empty_world(articulated, stiff.then_some(STIFF_CONTACT)),
            frame: frame_of(state, motion, tool),
            lift: motion.lift,
            tool: RigidBodyHandle::invalid(),
            bodies: Vec::with_capacity(scene.objects.len()),
            objects: Vec::with_capacity(scene.objects.len()),
            upright: Upright::default(),
            labels: Vec::new(),
            seams: Seams::default(),
            asleep: Asleep::none(),
            ends: TIPS && scene.brink().is_some(),
        };
        let top = brink(scene, &this.frame).filter(|_| TIPS);
        for table in [table(physics.table_friction, top), floor(top)] {
            this.world.insert_collider(table.user_data(TABLE), None);
        }
        this.add_tool(motion, tool);
        let groups = Group::of(scene, state, physics);
        groups.iter().for_each(|group| this.add_body(scene, group));
        for index in 0..scene.objects.len() {
            let member = Member::of(&groups, state, index);
            this.add_object(scene, physics, motion, index, member);
        }
        if !TIPS {
            this.upright.join(&groups, &physics.masses);
        }
        this.add_obstacles(scene);
        for label in this.seams.rub(&this.labels, &physics.pairs) {
            this.ask_for_contacts(label);
        }
        let on = |object: usize| {
            let (member, _) = &this.objects[object];
            let Tracked { handle, first_position, .. } = &this.bodies[member.body];
            Anchored { body: *handle, local: member.local, height: first_position.z }
        };
        let frame = this.frame;
        let joints: Vec<Anchored> = (0..scene.objects.len()).map(on).collect();
        add_joints(&mut this.world, scene, (&physics.joints, &frame), &joints);
        if TIPS {
            let bodies = this.bodies.iter().map(|tracked| tracked.handle);
            this.asleep = Asleep::new(&mut this.world, (&groups, bodies), this.tool, |group| {
                stands(scene, state, physics, group)
            });
            for mount in scene.mounts.iter().filter(|mount| mount.spring > 0.0) {
                this.asleep.keep_awake(&mut this.world, joints[mount.object].body);
            }
        }
        this
    }

    fn begin_frame(&mut self, frame: &FrameStep, step: f64) {
        let pose = to_rapier(&frame.from, &self.frame, self.lift);
        let way = self.frame.local_vector(frame.to.position - frame.from.position);
        let velocity = way / frame.duration;
        let turning = (frame.to.heading - frame.from.heading) / frame.duration;
        self.world.integration_parameters.dt = step;
        let tool = &mut self.world.bodies[self.tool];
        tool.set_position(pose, true);
        tool.set_linvel(RapierVector::new(velocity.x, velocity.y, 0.0), true);
        tool.set_angvel(RapierVector::Z * turning, true);
    }

    fn step(&mut self) {
        if !TIPS {
            let state = self.state();
            let dt = self.world.integration_parameters.dt;
            self.upright.load(&state, &mut self.world.colliders, dt);
        }
        self.asleep.wake_near(&mut self.world);
        self.world.step_with_events(&self.seams, &());
        for tracked in &mut self.bodies {
            let body = &self.world.bodies[tracked.handle];
            let angle = if body.is_enabled() { yaw(body.rotation()) } else { tracked.last_angle };
            tracked.turned += wrap_angle(angle - tracked.last_angle);
            tracked.last_angle = angle;
        }
        if self.ends {
            self.leave_fallen();
        }
    }

    fn state(&self) -> State {
        let mut state = State::default();
        for (member, rise) in &self.objects {
            let tracked = &self.bodies[member.body];
            let body = &self.world.bodies[tracked.handle];
            let moved = body.translation() - tracked.first_position;
            // A leaning body moves its objects' centres aside.
            let lean = *body.rotation() * tracked.first_rotation.inverse();
            let leaned = lean * (RapierVector::Z * *rise);
            let moved = self.frame.vector(Vector::new(moved.x + leaned.x, moved.y + leaned.y));
            state.poses.push(member.pose(moved, tracked.turned));
            let (linear, angular) = (body.linvel(), body.angvel());
            let linear = self.frame.vector(Vector::new(linear.x, linear.y));
            let velocity = Velocity { linear, angular: angular.z };
            state.velocities.push(member.velocity(velocity, tracked.turned));
        }
        state
    }

    fn touches(&self, found: &mut dyn FnMut(usize, Body)) {
        for pair in self.world.narrow_phase.contact_pairs() {
            let (Some(a), Some(b)) = (self.label(pair.collider1), self.label(pair.collider2))
            else {
                continue;
            };
            let touching = pair
                .manifolds
                .iter()
                .flat_map(solved)
                .any(|(_, point)| point.data.impulse > 0.0 || point.dist <= ALLOWED_ERROR);
            if touching {
                for (object, with) in [(a, b), (b, a)] {
                    if let Body::Object(object) = object {
                        found(object, with);
                    }
                }
            }
        }
    }

    fn toppled(&self) -> Vec<usize> {
        let leans = |(member, _): &(Member, f64)| {
            let body = &self.world.bodies[self.bodies[member.body].handle];
            (*body.rotation() * RapierVector::Z).z < TOPPLED.cos()
        };
        (0..self.objects.len()).filter(|&index| leans(&self.objects[index])).collect()
    }

    fn has_fallen(&self, object: usize) -> Option<bool> {
        let tracked = &self.bodies[self.objects[object].0.body];
        self.ends.then_some(tracked.fallen)
    }

    fn overlaps(&self, found: &mut dyn FnMut(Overlap)) {
        for pair in self.world.narrow_phase.contact_pairs() {
            let points = pair.manifolds.iter().flat_map(solved);
            let depths = points.map(|(manifold, point)| (-point.dist, manifold.data.normal));
            let deepest = depths.filter(|one| one.0 > 0.0).max_by(|a, b| a.0.total_cmp(&b.0));
            let labels = (self.label(pair.collider1), self.label(pair.collider2));
            if let (Some((depth, normal)), (Some(a), Some(b))) = (deepest, labels) {
                let normal = self.frame.vector(Vector::new(normal.x, normal.y));
                overlap((a, b), depth, normal, found);
            }
        }
    }

    fn force_on_tool(&self, of: &dyn Fn(usize) -> bool) -> f64 {
        let mut impulse = RapierVector::ZERO;
        for pair in self.world.narrow_phase.contact_pairs() {
            let sign = match (self.label(pair.collider1), self.label(pair.collider2)) {
                (Some(Body::Part(_)), Some(Body::Object(object))) if of(object) => -1.0,
                (Some(Body::Object(object)), Some(Body::Part(_))) if of(object) => 1.0,
                _ => continue,
            };
            for (manifold, point) in pair.manifolds.iter().flat_map(solved) {
                impulse += manifold.data.normal * (sign * point.data.impulse);
            }
        }
        let settings = &self.world.integration_parameters;
        force(impulse.length(), settings.dt, settings.num_solver_iterations)
    }
}

impl<const TIPS: bool> SpatialWorld<TIPS> {
    fn label(&self, collider: ColliderHandle) -> Option<Body> {
        let index = usize::try_from(self.world.colliders[collider].user_data).ok()?;
        self.labels.get(index).copied()
    }

    /// Disables bodies that have fallen off the table; they keep their poses.
    fn leave_fallen(&mut self) {
        for tracked in &mut self.bodies {
            let body = &mut self.world.bodies[tracked.handle];
            if body.is_enabled() && body.translation().z < tracked.first_position.z - FALLEN {
                tracked.fallen = true;
                body.set_linvel(RapierVector::ZERO, false);
                body.set_angvel(RapierVector::ZERO, false);
                body.set_enabled(false);
            }
        }
    }

    fn add_tool(&mut self, motion: &ToolMotion, at: &Pose) {
        // rapier's velocity refers to the centre of mass, which therefore is at the tool frame's
        // origin.
        let mass = MassProperties::new(RapierVector::ZERO, 1.0, RapierVector::ONE);
        let pose = to_rapier(at, &self.frame, self.lift);
        let body = RigidBodyBuilder::kinematic_velocity_based().pose(pose).can_sleep(false);
        self.tool = self.world.insert_body(body.additional_mass_properties(mass));
        for (index, part) in motion.tool.outline().iter().enumerate() {
            // The tool frame is at the parts' underside.
            let placed = to_rapier(&part.pose, &LOCAL, part.shape.height() / 2.0);
            let collider = solid(&part.shape, placed, motion.tool.friction).density(0.0);
            let collider = match &part.rim {
                Some(rim) => {
                    self.seams.set(self.labels.len(), rim);
                    collider.active_hooks(ActiveHooks::MODIFY_SOLVER_CONTACTS)
                }
                None => collider,
            };
            self.insert(collider, Body::Part(index), self.tool);
        }
    }

    fn add_body(&mut self, scene: &Scene, group: &Group) {
        // Objects may differ in height, so the frame of a group is on the table.
        let height = match group.objects[..] {
            [only] => scene.objects[only].shape.height() / 2.0,
            _ => 0.0,
        };
        let Velocity { linear, angular } = group.velocity;
        let linear = self.frame.local_vector(linear);
        let body = RigidBodyBuilder::dynamic()
            .pose(to_rapier(&group.pose, &self.frame, height))
            .linvel(RapierVector::new(linear.x, linear.y, 0.0))
            .angvel(RapierVector::Z * angular)
            .enabled_rotations(TIPS, TIPS, true)
            .can_sleep(false);
        let handle = self.world.insert_body(body);
        let body = &self.world.bodies[handle];
        self.bodies.push(Tracked {
            handle,
            first_position: body.translation(),
            first_rotation: *body.rotation(),
            last_angle: yaw(body.rotation()),
            turned: 0.0,
            fallen: false,
        });
    }

    fn add_object(
        &mut self,
        scene: &Scene,
        physics: &Physics,
        motion: &ToolMotion,
        index: usize,
        member: Member,
    ) {
        let object = &scene.objects[index];
        let footprint = object.shape.footprint();
        let Tracked { handle, first_position, .. } = self.bodies[member.body];
        let friction = physics.support_friction(index);
        let points = &physics.feet[index];
        let feet = match TIPS {
            true => scene.contacts(index, points, &physics.masses),
            // An object without load has no feet.
            false => {
                if object.is_raised() {
                    Feet::none()
                } else {
                    Feet::clone(points)
                }
            }
        };
        let place = |at: Vector| {
            let pose = member.local * Pose { position: at, heading: 0.0 };
            to_rapier(&pose, &LOCAL, FOOT - first_position.z)
        };
        let feet = feet
            .each()
            .map(|(at, _)| self.insert(foot(place(at), friction), Body::Object(index), handle))
            .collect();
        if !TIPS {
            let lean = physics.lean(scene, index, (&motion.tool, motion.lift));
            let mass = physics.masses[index];
            let support = Support::new(points, &footprint, friction, mass, lean);
            self.upright.add(Standing { support, feet, friction });
        }
        let rise = object.middle() - first_position.z;
        let (shape, clear) = match object.is_raised() {
            true => (object.shape, 0.0),
            false => (raised(&object.shape), CLEAR),
        };
        let placed = to_rapier(&member.local, &LOCAL, rise + clear / 2.0);
        let (own, mass) = (physics.frictions[index], physics.masses[index]);
        let solid = weighing(solid(&shape, placed, own), &shape, mass);
        self.insert(solid, Body::Object(index), handle);
        for underside in undersides(&shape, placed, own) {
            self.insert(underside, Body::Object(index), handle);
        }
        self.objects.push((member, rise));
    }

    fn add_obstacles(&mut self, scene: &Scene) {
        for (index, obstacle) in scene.obstacles.iter().enumerate() {
            let middle = obstacle.z + obstacle.size[2] / 2.0;
            let pose = to_rapier(&obstacle.pose, &self.frame, middle);
            let body = self.world.insert_body(RigidBodyBuilder::fixed().pose(pose));
            let collider = solid(&obstacle.shape(), Pose3::IDENTITY, obstacle.friction);
            self.insert(collider, Body::Obstacle(index), body);
        }
    }

    /// Enables changes to the contacts of the collider with this label before they are solved.
    fn ask_for_contacts(&mut self, label: usize) {
        let labelled = |collider: &&mut Collider| collider.user_data == label as u128;
        let mut colliders = self.world.colliders.iter_mut().map(|(_, collider)| collider);
        if let Some(collider) = colliders.find(labelled) {
            collider.set_active_hooks(ActiveHooks::MODIFY_SOLVER_CONTACTS);
        }
    }

    fn insert(
        &mut self,
        collider: ColliderBuilder,
        label: Body,
        body: RigidBodyHandle,
    ) -> ColliderHandle {
        let collider = collider.user_data(self.labels.len() as u128);
        self.labels.push(label);
        self.world.insert_collider(collider, Some(body))
    }
}
