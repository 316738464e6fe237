//! The 2-D engine: rapier2d seen from above, with its own law of support friction.
//!
//! There is no gravity; every object is a disc or a convex polygon that [`Support`] decelerates in
//! each step. The world is centred on the objects. Poses are computed from the change against
//! rapier's own start, so a body at rest keeps its pose bitwise.

mod joints;

use rapier2d_f64::prelude::{
    ActiveHooks, Collider, ColliderBuilder, ColliderHandle, ContactData, ContactManifold,
    Group as Layer, InteractionGroups, InteractionTestMode, MassProperties, PhysicsWorld,
    Pose2 as RapierPose, RigidBody, RigidBodyBuilder, RigidBodyHandle, SpringCoefficients,
    TrackedContact, Vector as RapierVector,
};

use crate::geometry::{Pose, Vector, perpendicular, wrap_angle};
use crate::{
    scene::{Body, Physics, Scene, State, Velocity},
    task::{FrameStep, ToolMotion},
};

use super::asleep::Asleep;
use super::footprints::{collider, vector, weighing};
use super::groups::{Group, Member, stands};
use super::parameters::{
    ALLOWED_ERROR, ARTICULATED_ITERATIONS, PLANAR_CONTACT, STIFF_CONTACT, centre, is_articulated,
    needs_stiff_contacts,
};
use super::seams::Seams;
use super::slowing::{Inertia, Resistance, Twist};
use super::support::{Pressed, Support};
use super::violations::{Overlap, force, overlap};
use super::world::World;

/// Tool parts.
const PART: Layer = Layer::GROUP_1;
/// Objects tall enough for contact with the tool's parts.
const TALL: Layer = Layer::GROUP_2;
/// Objects over which the lifted tool passes.
const LOW: Layer = Layer::GROUP_3;
/// Obstacles.
const OBSTACLE: Layer = Layer::GROUP_4;

/// A scene in rapier2d.
pub(super) struct PlanarWorld {
    world: PhysicsWorld,
    /// Rapier's origin in the world frame, metres.
    origin: Vector,
    tool: RigidBodyHandle,
    bodies: Vec<Tracked>,
    objects: Vec<(Member, Support)>,
    /// Body of a collider, by its `user_data`.
    labels: Vec<Body>,
    seams: Seams,
    asleep: Asleep<RigidBodyHandle>,
}

/// A body and its motion since the world was built.
struct Tracked {
    handle: RigidBodyHandle,
    first_position: RapierVector,
    last_angle: f64,
    turned: f64,
    pressed: Pressed,
    /// Indices of its objects.
    objects: Vec<usize>,
}

impl World for PlanarWorld {
    /// Friction decreases with the speed below a share of mu g dt, which is 16 mm/s at mu 0.4. The
    /// share is all of it in moving joints, and a twentieth elsewhere.
    const SLOWEST: f64 = 0.05;

    fn hurry(&mut self, factor: f64) {
        if factor == 1.0 {
            return;
        }
        for tracked in &mut self.bodies {
            let body = &self.world.bodies[tracked.handle];
            if body.is_sleeping() || !body.is_enabled() {
                continue;
            }
            tracked.pressed.hurry(factor);
            let body = &mut self.world.bodies[tracked.handle];
            let (linear, angular) = (body.linvel(), body.angvel());
            body.set_linvel(linear * factor, true);
            body.set_angvel(angular * factor, true);
        }
    }

    fn build(
        scene: &Scene,
        state: &State,
        physics: &Physics,
        motion: &ToolMotion,
        tool: &Pose,
    ) -> Self {
        let mut this = Self {
            world: empty_world(scene, physics),
            origin: centre(state).unwrap_or(tool.position),
            tool: RigidBodyHandle::invalid(),
            bodies: Vec::with_capacity(scene.objects.len()),
            objects: Vec::with_capacity(scene.objects.len()),
            labels: Vec::new(),
            seams: Seams::default(),
            asleep: Asleep::none(),
        };
        this.add_tool(motion, tool);
        let groups = Group::of(scene, state, physics);
        groups.iter().for_each(|group| this.add_body(group));
        for index in 0..scene.objects.len() {
            let member = Member::of(&groups, state, index);
            this.add_object((scene, state), physics, motion, index, member);
        }
        this.add_obstacles(scene);
        this.seams.pass(&this.labels, scene, motion);
        for label in this.seams.rub(&this.labels, &physics.pairs) {
            this.ask_for_contacts(label);
        }
        this.add_joints(scene, physics);
        let bodies = this.bodies.iter().map(|tracked| tracked.handle);
        this.asleep = Asleep::new(&mut this.world, (&groups, bodies), this.tool, |group| {
            stands(scene, state, physics, group)
        });
        for mount in scene.mounts.iter().filter(|mount| mount.spring > 0.0) {
            let body = this.bodies[this.objects[mount.object].0.body].handle;
            this.asleep.keep_awake(&mut this.world, body);
        }
        this
    }

    fn begin_frame(&mut self, frame: &FrameStep, step: f64) {
        let pose = to_rapier(&frame.from, self.origin);
        let velocity = (frame.to.position - frame.from.position) / frame.duration;
        let turning = (frame.to.heading - frame.from.heading) / frame.duration;
        self.world.integration_parameters.dt = step;
        let tool = &mut self.world.bodies[self.tool];
        tool.set_position(pose, true);
        tool.set_linvel(vector(velocity), true);
        tool.set_angvel(turning, true);
    }

    fn step(&mut self) {
        self.asleep.wake_near(&mut self.world);
        let dt = self.world.integration_parameters.dt;
        for tracked in &mut self.bodies {
            let body = &self.world.bodies[tracked.handle];
            if body.is_sleeping() || !body.is_enabled() {
                continue;
            }
            let body = &mut self.world.bodies[tracked.handle];
            let velocity = velocity(body);
            let inertia = Inertia {
                mass: body.mass(),
                spin: body.mass_properties().local_mprops.principal_inertia(),
            };
            let pressed = tracked.pressed.look(&inertia, &velocity, dt);
            let pressing = tracked.pressed.share(pressed.linear);
            let friction = inertia.friction(&velocity, &pressed, dt, |twist| {
                let mut against = Resistance::default();
                for &object in &tracked.objects {
                    let (member, support) = &self.objects[object];
                    let arm = member.arm(tracked.turned);
                    let heading = member.start.heading + tracked.turned;
                    let linear = twist.linear + twist.angular * perpendicular(arm);
                    let drag = support.drag(heading, (linear, twist.angular), pressing, dt);
                    against.add(support.load(), &drag, arm);
                }
                against
            });
            tracked.pressed.rub(&friction);
            body.reset_forces(true);
            body.reset_torques(true);
            body.add_force(vector(friction.linear), true);
            body.add_torque(friction.angular, true);
        }
        self.world.step_with_events(&self.seams, &());
        for tracked in &mut self.bodies {
            let body = &self.world.bodies[tracked.handle];
            let angle =
                if body.is_enabled() { body.rotation().angle() } else { tracked.last_angle };
            tracked.turned += wrap_angle(angle - tracked.last_angle);
            tracked.last_angle = angle;
        }
    }

    fn state(&self) -> State {
        let mut state = State::default();
        for (member, _) in &self.objects {
            let tracked = &self.bodies[member.body];
            let body = &self.world.bodies[tracked.handle];
            let moved = body.translation() - tracked.first_position;
            let moved = Vector::new(moved.x, moved.y);
            state.poses.push(member.pose(moved, tracked.turned));
            let Twist { linear, angular } = velocity(body);
            let velocity = Velocity { linear, angular };
            state.velocities.push(member.velocity(velocity, tracked.turned));
        }
        state
    }

    fn touches(&self, found: &mut dyn FnMut(usize, Body)) {
        for pair in self.world.narrow_phase.contact_pairs() {
            let touching = pair
                .manifolds
                .iter()
                .flat_map(solved)
                .any(|(_, point)| point.data.impulse > 0.0 || point.dist <= ALLOWED_ERROR);
            if touching {
                let (a, b) = (self.label(pair.collider1), self.label(pair.collider2));
                for (object, with) in [(a, b), (b, a)] {
                    if let Body::Object(object) = object {
                        found(object, with);
                    }
                }
            }
        }
    }

    fn toppled(&self) -> Vec<usize> {
        Vec::new()
    }

    fn overlaps(&self, found: &mut dyn FnMut(Overlap)) {
        for pair in self.world.narrow_phase.contact_pairs() {
            let points = pair.manifolds.iter().flat_map(solved);
            let depths = points.map(|(manifold, point)| (-point.dist, manifold));
            let deepest = depths.max_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((depth, manifold)) = deepest.filter(|(depth, _)| *depth > 0.0) {
                let between = (self.label(pair.collider1), self.label(pair.collider2));
                let normal = manifold.data.normal;
                let normal = Vector::new(normal.x, normal.y);
                overlap(between, depth, normal, found);
            }
        }
    }

    fn force_on_tool(&self, of: &dyn Fn(usize) -> bool) -> f64 {
        let mut impulse = RapierVector::ZERO;
        for pair in self.world.narrow_phase.contact_pairs() {
            let (a, b) = (self.label(pair.collider1), self.label(pair.collider2));
            let sign = match (a, b) {
                (Body::Part(_), Body::Object(object)) if of(object) => -1.0,
                (Body::Object(object), Body::Part(_)) if of(object) => 1.0,
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

impl PlanarWorld {
    fn label(&self, collider: ColliderHandle) -> Body {
        self.labels[self.world.colliders[collider].user_data as usize]
    }

    fn add_tool(&mut self, motion: &ToolMotion, at: &Pose) {
        // rapier's velocity refers to the centre of mass, which therefore is at the tool frame's
        // origin.
        let body = RigidBodyBuilder::kinematic_velocity_based()
            .additional_mass_properties(MassProperties::new(vector(Vector::zeros()), 1.0, 1.0))
            .pose(to_rapier(at, self.origin))
            .can_sleep(false);
        self.tool = self.world.insert_body(body);
        for (index, part) in motion.tool.outline().iter().enumerate() {
            let collider = collider(&part.footprint(), motion.tool.friction)
                .density(0.0)
                .position(to_rapier(&part.pose, Vector::zeros()))
                .collision_groups(groups(PART, TALL));
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

    fn add_body(&mut self, group: &Group) {
        let body = RigidBodyBuilder::dynamic()
            .pose(to_rapier(&group.pose, self.origin))
            .linvel(vector(group.velocity.linear))
            .angvel(group.velocity.angular)
            .can_sleep(false);
        let handle = self.world.insert_body(body);
        self.bodies.push(Tracked {
            handle,
            first_position: self.world.bodies[handle].translation(),
            last_angle: self.world.bodies[handle].rotation().angle(),
            turned: 0.0,
            pressed: Pressed::default(),
            objects: group.objects.clone(),
        });
    }

    fn add_object(
        &mut self,
        (scene, state): (&Scene, &State),
        physics: &Physics,
        motion: &ToolMotion,
        index: usize,
        member: Member,
    ) {
        let (object, friction) = (&scene.objects[index], physics.frictions[index]);
        let footprint = object.shape.footprint();
        // All parts have their underside at one height, so the object alone decides.
        let own = if object.top() > motion.lift { TALL } else { LOW };
        // Fallen objects collide with nothing.
        let meets = if scene.has_left(index, state) { Layer::NONE } else { Layer::ALL };
        // A part above the table may pass over any body.
        let hooks = match object.is_raised() {
            true => ActiveHooks::FILTER_CONTACT_PAIRS,
            false => ActiveHooks::empty(),
        };
        let collider = weighing(collider(&footprint, friction), &footprint, physics.masses[index])
            .position(to_rapier(&member.local, Vector::zeros()))
            .active_hooks(hooks)
            .collision_groups(groups(own, meets));
        self.insert(collider, Body::Object(index), self.bodies[member.body].handle);
        let table = physics.support_friction(index);
        let (feet, mass) = (&physics.feet[index], physics.masses[index]);
        let lean = physics.lean(scene, index, (&motion.tool, motion.lift));
        let support = Support::new(feet, &footprint, table, mass, lean);
        let support = if is_articulated(scene, physics) { support.in_joints() } else { support };
        self.bodies[member.body].pressed.add(&support);
        self.objects.push((member, support));
    }

    fn add_obstacles(&mut self, scene: &Scene) {
        for (index, obstacle) in scene.obstacles.iter().enumerate() {
            let pose = to_rapier(&obstacle.pose, self.origin);
            let body = self.world.insert_body(RigidBodyBuilder::fixed().pose(pose));
            let collider = collider(&obstacle.shape().footprint(), obstacle.friction)
                .active_hooks(ActiveHooks::FILTER_CONTACT_PAIRS)
                .collision_groups(groups(OBSTACLE, TALL | LOW));
            self.insert(collider, Body::Obstacle(index), body);
        }
    }

    /// Enables changes to the contacts of the collider with this label before they are solved.
    fn ask_for_contacts(&mut self, label: usize) {
        let labelled = |collider: &&mut Collider| collider.user_data == label as u128;
        let mut colliders = self.world.colliders.iter_mut().map(|(_, collider)| collider);
        if let Some(collider) = colliders.find(labelled) {
            let hooks = collider.active_hooks() | ActiveHooks::MODIFY_SOLVER_CONTACTS;
            collider.set_active_hooks(hooks);
        }
    }

    fn insert(&mut self, collider: ColliderBuilder, label: Body, body: RigidBodyHandle) {
        let collider = collider.user_data(self.labels.len() as u128);
        self.labels.push(label);
        self.world.insert_collider(collider, Some(body));
    }
}

fn empty_world(scene: &Scene, physics: &Physics) -> PhysicsWorld {
    let mut world = PhysicsWorld { gravity: RapierVector::ZERO, ..PhysicsWorld::default() };
    let settings = &mut world.integration_parameters;
    settings.normalized_allowed_linear_error = ALLOWED_ERROR;
    let articulated = is_articulated(scene, physics);
    if articulated {
        settings.num_solver_iterations = ARTICULATED_ITERATIONS;
    }
    let stiff = articulated || needs_stiff_contacts(physics);
    let (frequency, damping) = if stiff { STIFF_CONTACT } else { PLANAR_CONTACT };
    settings.contact_softness = SpringCoefficients::new(frequency, damping);
    world
}

/// Returns the solved points of a manifold, without points removed at seams.
fn solved(
    manifold: &ContactManifold,
) -> impl Iterator<Item = (&ContactManifold, &TrackedContact<ContactData>)> {
    let contacts = manifold.data.solver_contacts.iter();
    contacts.map(move |contact| (manifold, &manifold.points[contact.contact_id[0] as usize]))
}

fn groups(own: Layer, meets: Layer) -> InteractionGroups {
    InteractionGroups::new(own, meets, InteractionTestMode::And)
}

fn velocity(body: &RigidBody) -> Twist {
    let linear = body.linvel();
    let linear = Vector::new(linear.x, linear.y);
    Twist { linear, angular: body.angvel() }
}

fn to_rapier(pose: &Pose, origin: Vector) -> RapierPose {
    RapierPose::new(vector(pose.position - origin), wrap_angle(pose.heading))
}
