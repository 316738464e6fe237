//! The planar engine: rapier2d seen from above, with support friction of our own.
//!
//! No gravity; every object is a disc or a rectangle that [`Support`] slows down during each
//! step. The world is centred on the objects, because rapier2d computes in `f32`; what it
//! reports is taken as a change against its own start, so a body at rest stays where it is to
//! the last bit of `f64`.

use rapier2d::prelude::{
    CoefficientCombineRule, ColliderBuilder, ColliderHandle, GenericJointBuilder, Group,
    InteractionGroups, InteractionTestMode, JointAxesMask, JointAxis, PhysicsWorld,
    Pose2 as RapierPose, Real, RigidBodyBuilder, RigidBodyHandle, SpringCoefficients,
    Vector as RapierVector,
};

use crate::geometry::{Footprint, Pose, Vector, wrap_angle};
use crate::scene::{
    Body, FrameStep, Hypothesis, JointKind, Scene, Span, State, ToolMotion, Velocity,
};

use super::drive::World;
use super::joints::{JointFrames, neighbours_touch};
use super::parameters::{ALLOWED_ERROR, STIFF_CONTACT, centre, needs_stiff_contacts};
use super::support::Support;

/// Tool parts.
const PART: Group = Group::GROUP_1;
/// Objects tall enough for the tool's parts to meet them.
const TALL: Group = Group::GROUP_2;
/// Objects that the lifted tool passes over.
const LOW: Group = Group::GROUP_3;
/// Obstacles.
const OBSTACLE: Group = Group::GROUP_4;

/// A scene in rapier2d.
pub(super) struct PlanarWorld {
    world: PhysicsWorld,
    /// Where rapier's origin lies in the world frame, metres.
    origin: Vector,
    tool: RigidBodyHandle,
    objects: Vec<Tracked>,
    /// What the `user_data` of a collider stands for.
    labels: Vec<Body>,
}

/// An object and how far it has come since the world was built.
struct Tracked {
    body: RigidBodyHandle,
    support: Support,
    start: Pose,
    first_position: RapierVector,
    last_angle: f64,
    turned: f64,
}

impl World for PlanarWorld {
    fn build(
        scene: &Scene,
        state: &State,
        parameters: &Hypothesis,
        motion: &ToolMotion,
        tool: &Pose,
    ) -> Self {
        let mut this = Self {
            world: empty_world(parameters),
            origin: centre(state).unwrap_or(tool.position),
            tool: RigidBodyHandle::invalid(),
            objects: Vec::with_capacity(scene.objects.len()),
            labels: Vec::new(),
        };
        this.add_tool(motion, parameters, tool);
        for index in 0..scene.objects.len() {
            this.add_object(scene, state, parameters, motion.lift, index);
        }
        this.add_obstacles(scene);
        this.add_joints(scene);
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
        for object in &self.objects {
            let body = &mut self.world.bodies[object.body];
            let (velocity, turning) = (body.linvel(), body.angvel());
            let (force, torque) =
                object.support.drag(f64::from(velocity.length()), f64::from(turning), dt);
            body.reset_forces(true);
            body.reset_torques(true);
            body.add_force(velocity * -force as Real, true);
            body.add_torque(turning * -torque as Real, true);
        }
        self.world.step();
        for object in &mut self.objects {
            let angle = f64::from(self.world.bodies[object.body].rotation().angle());
            object.turned += wrap_angle(angle - object.last_angle);
            object.last_angle = angle;
        }
    }

    fn state(&self) -> State {
        let mut state = State::default();
        for object in &self.objects {
            let body = &self.world.bodies[object.body];
            let moved = body.translation() - object.first_position;
            state.poses.push(Pose {
                position: object.start.position + Vector::new(moved.x.into(), moved.y.into()),
                heading: object.start.heading + object.turned,
            });
            let linear = body.linvel();
            state.velocities.push(Velocity {
                linear: Vector::new(linear.x.into(), linear.y.into()),
                angular: body.angvel().into(),
            });
        }
        state
    }

    fn touches(&self, found: &mut dyn FnMut(usize, Body)) {
        for pair in self.world.narrow_phase.contact_pairs() {
            let touching = pair.manifolds.iter().any(|manifold| {
                manifold
                    .points
                    .iter()
                    .any(|point| point.data.impulse > 0.0 || point.dist <= ALLOWED_ERROR as Real)
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
}

impl PlanarWorld {
    fn label(&self, collider: ColliderHandle) -> Body {
        self.labels[self.world.colliders[collider].user_data as usize]
    }

    fn add_tool(&mut self, motion: &ToolMotion, parameters: &Hypothesis, at: &Pose) {
        let body = RigidBodyBuilder::kinematic_velocity_based()
            .pose(to_rapier(at, self.origin))
            .can_sleep(false);
        self.tool = self.world.insert_body(body);
        for (index, part) in motion.tool.parts.iter().enumerate() {
            // Without mass the centre of mass, which rapier's velocity is of, is the tool frame.
            let collider = collider(&part.footprint(), parameters.tool_friction)
                .density(0.0)
                .position(to_rapier(&part.pose, Vector::zeros()))
                .collision_groups(groups(PART, TALL));
            self.insert(collider, Body::Part(index), self.tool);
        }
    }

    fn add_object(
        &mut self,
        scene: &Scene,
        state: &State,
        parameters: &Hypothesis,
        lift: f64,
        index: usize,
    ) {
        let (pose, velocity) = (state.poses[index], state.velocities[index]);
        let (shape, friction) = (&scene.objects[index].shape, parameters.frictions[index]);
        let footprint = shape.footprint();
        let body = RigidBodyBuilder::dynamic()
            .pose(to_rapier(&pose, self.origin))
            .linvel(vector(velocity.linear))
            .angvel(velocity.angular as Real)
            .can_sleep(false);
        let body = self.world.insert_body(body);
        // All parts have their underside at the same height, so the object alone decides.
        let own = if shape.height() > lift { TALL } else { LOW };
        let collider = collider(&footprint, friction)
            .mass(parameters.masses[index] as Real)
            .collision_groups(groups(own, Group::ALL));
        self.insert(collider, Body::Object(index), body);
        let table = Scene::pair_friction(friction, parameters.table_friction);
        self.objects.push(Tracked {
            body,
            support: Support::new(&footprint, table, parameters.masses[index]),
            start: pose,
            first_position: self.world.bodies[body].translation(),
            last_angle: self.world.bodies[body].rotation().angle().into(),
            turned: 0.0,
        });
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

    fn add_joints(&mut self, scene: &Scene) {
        for joint in &scene.joints {
            let axes = match joint.kind {
                JointKind::Fixed => JointAxesMask::LOCKED_FIXED_AXES,
                JointKind::Revolute { .. } => JointAxesMask::LOCKED_REVOLUTE_AXES,
                JointKind::Prismatic { .. } => JointAxesMask::LOCKED_PRISMATIC_AXES,
            };
            let frames = JointFrames::new(scene, joint);
            let mut built = GenericJointBuilder::new(axes)
                .local_frame1(to_rapier(&frames.first, Vector::zeros()))
                .local_frame2(to_rapier(&frames.second, Vector::zeros()))
                .contacts_enabled(neighbours_touch(&joint.kind));
            // Both frames lie on each other where the scene states its objects, so zero is there.
            match joint.kind {
                JointKind::Revolute { limits: Some(Span { low, high }), .. } => {
                    built = built.limits(JointAxis::AngX, [low as Real, high as Real]);
                }
                JointKind::Prismatic { limits: Some(Span { low, high }), .. } => {
                    built = built.limits(JointAxis::LinX, [low as Real, high as Real]);
                }
                _ => {}
            }
            let [first, second] = joint.between.map(|index| self.objects[index].body);
            self.world.insert_impulse_joint(first, second, built);
        }
    }

    fn insert(&mut self, collider: ColliderBuilder, label: Body, body: RigidBodyHandle) {
        let collider = collider.user_data(self.labels.len() as u128);
        self.labels.push(label);
        self.world.insert_collider(collider, Some(body));
    }
}

fn empty_world(parameters: &Hypothesis) -> PhysicsWorld {
    let mut world = PhysicsWorld { gravity: RapierVector::ZERO, ..PhysicsWorld::default() };
    let settings = &mut world.integration_parameters;
    settings.normalized_allowed_linear_error = ALLOWED_ERROR as Real;
    if needs_stiff_contacts(&parameters.masses) {
        let (frequency, damping) = STIFF_CONTACT;
        settings.contact_softness = SpringCoefficients::new(frequency as Real, damping as Real);
    }
    world
}

fn collider(footprint: &Footprint, friction: f64) -> ColliderBuilder {
    let shape = match *footprint {
        Footprint::Disc { radius } => ColliderBuilder::ball(radius as Real),
        Footprint::Rectangle { half } => ColliderBuilder::cuboid(half.x as Real, half.y as Real),
    };
    shape.friction(friction as Real).friction_combine_rule(CoefficientCombineRule::Average)
}

fn groups(own: Group, meets: Group) -> InteractionGroups {
    InteractionGroups::new(own, meets, InteractionTestMode::And)
}

fn vector(v: Vector) -> RapierVector {
    RapierVector::new(v.x as Real, v.y as Real)
}

fn to_rapier(pose: &Pose, origin: Vector) -> RapierPose {
    RapierPose::new(vector(pose.position - origin), wrap_angle(pose.heading) as Real)
}
