//! The planar engine: rapier2d seen from above, with support friction of our own.
//!
//! No gravity; every object is a disc or a convex polygon that [`Support`] slows down during each
//! step. The world is centred on the objects, because rapier2d computes in `f32`; what it
//! reports is taken as a change against its own start, so a body at rest stays where it is to
//! the last bit of `f64`.

use rapier2d::prelude::{
    ActiveHooks, CoefficientCombineRule, Collider, ColliderBuilder, ColliderHandle, ContactData,
    ContactManifold, GenericJointBuilder, Group as Layer, InteractionGroups, InteractionTestMode,
    JointAxesMask, JointAxis, MassProperties, PhysicsWorld, Pose2 as RapierPose, Real,
    RigidBodyBuilder, RigidBodyHandle, SpringCoefficients, TrackedContact, Vector as RapierVector,
};

use crate::geometry::{Footprint, Pose, Vector, wrap_angle};
use crate::scene::{Body, FrameStep, JointKind, Physics, Scene, Span, State, ToolMotion, Velocity};

use super::drive::World;
use super::groups::{Group, Member};
use super::parameters::{
    ALLOWED_ERROR, ARTICULATED_ITERATIONS, PLANAR_CONTACT, STIFF_CONTACT, centre, is_articulated,
    needs_stiff_contacts,
};
use super::seams::Seams;
use super::strain::{Overlap, force, overlap};
use super::support::{Pressed, Support};

/// Tool parts.
const PART: Layer = Layer::GROUP_1;
/// Objects tall enough for the tool's parts to meet them.
const TALL: Layer = Layer::GROUP_2;
/// Objects that the lifted tool passes over.
const LOW: Layer = Layer::GROUP_3;
/// Obstacles.
const OBSTACLE: Layer = Layer::GROUP_4;

/// A scene in rapier2d.
pub(super) struct PlanarWorld {
    world: PhysicsWorld,
    /// Where rapier's origin lies in the world frame, metres.
    origin: Vector,
    tool: RigidBodyHandle,
    bodies: Vec<Tracked>,
    objects: Vec<(Member, Support)>,
    /// What the `user_data` of a collider stands for.
    labels: Vec<Body>,
    seams: Seams,
}

/// A body and how far it has come since the world was built.
struct Tracked {
    handle: RigidBodyHandle,
    first_position: RapierVector,
    last_angle: f64,
    turned: f64,
    pressed: Pressed,
    /// How hard it is pressed in this step.
    pressing: Vector,
}

impl World for PlanarWorld {
    /// Below mu g dt, 16 mm/s at mu 0.4, friction falls with the speed.
    const SLOWEST: f64 = 0.05;

    fn hurry(&mut self, factor: f64) {
        if factor == 1.0 {
            return;
        }
        for tracked in &self.bodies {
            let body = &mut self.world.bodies[tracked.handle];
            let (linear, angular) = (body.linvel(), body.angvel());
            body.set_linvel(linear * factor as Real, true);
            body.set_angvel(angular * factor as Real, true);
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
            world: empty_world(physics),
            origin: centre(state).unwrap_or(tool.position),
            tool: RigidBodyHandle::invalid(),
            bodies: Vec::with_capacity(scene.objects.len()),
            objects: Vec::with_capacity(scene.objects.len()),
            labels: Vec::new(),
            seams: Seams::default(),
        };
        this.add_tool(motion, tool);
        let groups = Group::of(scene, state, physics);
        groups.iter().for_each(|group| this.add_body(group));
        for index in 0..scene.objects.len() {
            let member = Member::of(&groups, state, index);
            this.add_object(scene, physics, motion, index, member);
        }
        this.add_obstacles(scene);
        for label in this.seams.rub(&this.labels, physics) {
            this.ask_for_contacts(label);
        }
        this.add_joints(scene, physics);
        this
    }

    fn begin_frame(&mut self, frame: &FrameStep, step: f64) {
        let pose = to_rapier(&frame.from, self.origin);
        let velocity = (frame.to.position - frame.from.position) / frame.duration;
        let turning = (frame.to.heading - frame.from.heading) / frame.duration;
        self.world.integration_parameters.dt = step as Real;
        let tool = &mut self.world.bodies[self.tool];
        tool.set_position(pose, true);
        tool.set_linvel(vector(velocity), true);
        tool.set_angvel(turning as Real, true);
    }

    fn step(&mut self) {
        let dt = f64::from(self.world.integration_parameters.dt);
        for tracked in &mut self.bodies {
            let body = &mut self.world.bodies[tracked.handle];
            body.reset_forces(true);
            body.reset_torques(true);
            let velocity = body.linvel();
            let velocity = Vector::new(velocity.x.into(), velocity.y.into());
            tracked.pressing = tracked.pressed.look(velocity, dt);
        }
        for (member, support) in &self.objects {
            let tracked = &mut self.bodies[member.body];
            let body = &mut self.world.bodies[tracked.handle];
            let arm = vector(member.arm(tracked.turned));
            let turning = body.angvel();
            let velocity = body.linvel() + arm.perp() * turning;
            let heading = member.start.heading + tracked.turned;
            let velocity = Vector::new(velocity.x.into(), velocity.y.into());
            let (force, torque) =
                support.drag(heading, velocity, turning.into(), tracked.pressing, dt);
            tracked.pressed.rub(force);
            let force = vector(force);
            body.add_force(force, true);
            body.add_torque(torque as Real + arm.perp_dot(force), true);
        }
        self.world.step_with_events(&self.seams, &());
        for tracked in &mut self.bodies {
            let angle = f64::from(self.world.bodies[tracked.handle].rotation().angle());
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
            let moved = Vector::new(moved.x.into(), moved.y.into());
            state.poses.push(member.pose(moved, tracked.turned));
            let linear = body.linvel();
            let linear = Vector::new(linear.x.into(), linear.y.into());
            let velocity = Velocity { linear, angular: body.angvel().into() };
            state.velocities.push(member.velocity(velocity, tracked.turned));
        }
        state
    }

    fn touches(&self, found: &mut dyn FnMut(usize, Body)) {
        for pair in self.world.narrow_phase.contact_pairs() {
            let touching =
                pair.manifolds.iter().flat_map(solved).any(|(_, point)| {
                    point.data.impulse > 0.0 || point.dist <= ALLOWED_ERROR as Real
                });
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
            let depth = pair
                .manifolds
                .iter()
                .flat_map(solved)
                .fold(0.0, |most: f64, (_, point)| most.max(-f64::from(point.dist)));
            if depth > 0.0 {
                let (a, b) = (self.label(pair.collider1), self.label(pair.collider2));
                overlap(a, b, depth, found);
            }
        }
    }

    fn force_on_tool(&self) -> f64 {
        let mut impulse = RapierVector::ZERO;
        for pair in self.world.narrow_phase.contact_pairs() {
            let (a, b) = (self.label(pair.collider1), self.label(pair.collider2));
            let sign = match (a, b) {
                (Body::Part(_), _) => -1.0,
                (_, Body::Part(_)) => 1.0,
                _ => continue,
            };
            for (manifold, point) in pair.manifolds.iter().flat_map(solved) {
                impulse += manifold.data.normal * (sign * point.data.impulse);
            }
        }
        let settings = &self.world.integration_parameters;
        force(impulse.length().into(), settings.dt.into(), settings.num_solver_iterations)
    }
}

impl PlanarWorld {
    fn label(&self, collider: ColliderHandle) -> Body {
        self.labels[self.world.colliders[collider].user_data as usize]
    }

    fn add_tool(&mut self, motion: &ToolMotion, at: &Pose) {
        let body = RigidBodyBuilder::kinematic_velocity_based()
            .pose(to_rapier(at, self.origin))
            .can_sleep(false);
        self.tool = self.world.insert_body(body);
        for (index, part) in motion.tool.outline.iter().enumerate() {
            // Without mass the centre of mass, which rapier's velocity is of, is the tool frame.
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
            .angvel(group.velocity.angular as Real)
            .can_sleep(false);
        let handle = self.world.insert_body(body);
        self.bodies.push(Tracked {
            handle,
            first_position: self.world.bodies[handle].translation(),
            last_angle: self.world.bodies[handle].rotation().angle().into(),
            turned: 0.0,
            pressed: Pressed::default(),
            pressing: Vector::zeros(),
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
        let (shape, friction) = (&scene.objects[index].shape, physics.frictions[index]);
        let footprint = shape.footprint();
        // All parts have their underside at the same height, so the object alone decides.
        let own = if shape.height() > motion.lift { TALL } else { LOW };
        let collider = weighing(collider(&footprint, friction), &footprint, physics.masses[index])
            .position(to_rapier(&member.local, Vector::zeros()))
            .collision_groups(groups(own, Layer::ALL));
        self.insert(collider, Body::Object(index), self.bodies[member.body].handle);
        let table = physics.support_friction(index);
        let (feet, mass) = (&physics.feet[index], physics.masses[index]);
        let (object, lift) = (&scene.objects[index], motion.lift);
        let lean = physics.lean(object, table, (&motion.tool, lift));
        let support = Support::new(feet, &footprint, table, mass, lean);
        self.bodies[member.body].pressed.add(&support);
        self.objects.push((member, support));
    }

    fn add_obstacles(&mut self, scene: &Scene) {
        for (index, obstacle) in scene.obstacles.iter().enumerate() {
            let pose = to_rapier(&obstacle.pose, self.origin);
            let body = self.world.insert_body(RigidBodyBuilder::fixed().pose(pose));
            let collider = collider(&obstacle.shape().footprint(), obstacle.friction)
                .collision_groups(groups(OBSTACLE, TALL | LOW));
            self.insert(collider, Body::Obstacle(index), body);
        }
    }

    fn add_joints(&mut self, scene: &Scene, physics: &Physics) {
        for joint in &physics.joints {
            let (axes, free) = match joint.kind {
                // Its objects are one body.
                JointKind::Fixed => continue,
                JointKind::Revolute { .. } => {
                    (JointAxesMask::LOCKED_REVOLUTE_AXES, JointAxis::AngX)
                }
                JointKind::Prismatic { .. } => {
                    (JointAxesMask::LOCKED_PRISMATIC_AXES, JointAxis::LinX)
                }
            };
            let [first, second] = joint.between.map(|index| &self.objects[index].0);
            let [at_first, at_second] = joint.frames(&scene.objects);
            let mut built = GenericJointBuilder::new(axes)
                .local_frame1(to_rapier(&(first.local * at_first), Vector::zeros()))
                .local_frame2(to_rapier(&(second.local * at_second), Vector::zeros()));
            // The frames coincide where the scene states its objects, so zero is there.
            if let Some(Span { low, high }) = joint.limits() {
                built = built.limits(free, [low as Real, high as Real]);
            }
            let [first, second] = [first, second].map(|member| self.bodies[member.body].handle);
            self.world.insert_impulse_joint(first, second, built);
        }
    }

    /// Lets contacts of the collider with this label be changed before they are solved.
    fn ask_for_contacts(&mut self, label: usize) {
        let labelled = |collider: &&mut Collider| collider.user_data == label as u128;
        let mut colliders = self.world.colliders.iter_mut().map(|(_, collider)| collider);
        if let Some(collider) = colliders.find(labelled) {
            collider.set_active_hooks(ActiveHooks::MODIFY_SOLVER_CONTACTS);
        }
    }

    fn insert(&mut self, collider: ColliderBuilder, label: Body, body: RigidBodyHandle) {
        let collider = collider.user_data(self.labels.len() as u128);
        self.labels.push(label);
        self.world.insert_collider(collider, Some(body));
    }
}

fn empty_world(physics: &Physics) -> PhysicsWorld {
    let mut world = PhysicsWorld { gravity: RapierVector::ZERO, ..PhysicsWorld::default() };
    let settings = &mut world.integration_parameters;
    settings.normalized_allowed_linear_error = ALLOWED_ERROR as Real;
    let articulated = is_articulated(physics);
    if articulated {
        settings.num_solver_iterations = ARTICULATED_ITERATIONS;
    }
    let stiff = articulated || needs_stiff_contacts(&physics.masses);
    let (frequency, damping) = if stiff { STIFF_CONTACT } else { PLANAR_CONTACT };
    settings.contact_softness = SpringCoefficients::new(frequency as Real, damping as Real);
    world
}

/// The points of a manifold that were solved, and not taken away as those of a seam.
fn solved(
    manifold: &ContactManifold,
) -> impl Iterator<Item = (&ContactManifold, &TrackedContact<ContactData>)> {
    let contacts = manifold.data.solver_contacts.iter();
    contacts.map(move |contact| (manifold, &manifold.points[contact.contact_id[0] as usize]))
}

fn collider(footprint: &Footprint, friction: f64) -> ColliderBuilder {
    let shape = match *footprint {
        Footprint::Disc { radius } => ColliderBuilder::ball(radius as Real),
        Footprint::Rectangle { half } => ColliderBuilder::cuboid(half.x as Real, half.y as Real),
        Footprint::Polygon(polygon) => {
            let corners = polygon.corners().iter().copied().map(vector).collect();
            // Of three corners and more there always is one.
            ColliderBuilder::convex_polyline(corners)
                .unwrap_or_else(|| ColliderBuilder::ball(polygon.inner_radius() as Real))
        }
    };
    shape.friction(friction as Real).friction_combine_rule(CoefficientCombineRule::Average)
}

/// The collider with its mass (kg) about the footprint's origin.
fn weighing(collider: ColliderBuilder, footprint: &Footprint, mass: f64) -> ColliderBuilder {
    match footprint {
        Footprint::Polygon(_) => {
            let inertia = mass * footprint.gyration_radius().powi(2);
            let (mass, inertia) = (mass as Real, inertia as Real);
            collider.mass_properties(MassProperties::new(RapierVector::ZERO, mass, inertia))
        }
        _ => collider.mass(mass as Real),
    }
}

fn groups(own: Layer, meets: Layer) -> InteractionGroups {
    InteractionGroups::new(own, meets, InteractionTestMode::And)
}

fn vector(v: Vector) -> RapierVector {
    RapierVector::new(v.x as Real, v.y as Real)
}

fn to_rapier(pose: &Pose, origin: Vector) -> RapierPose {
    RapierPose::new(vector(pose.position - origin), wrap_angle(pose.heading) as Real)
}
