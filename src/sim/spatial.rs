//! The 3-D engine: rapier3d in `f64`, gravity and table included.
//!
//! Every object stands on a half-space with rapier's own contacts: a solid rests on the corners
//! of its underside (a cylinder on four points of its rim), so its resistance to turning is
//! larger than that of the planar engine's even pressure. The friction model, the allowed error
//! and the plain cylinder are choices that were measured; rapier's defaults are centimetres off.

use std::f64::consts::FRAC_PI_2;

use rapier3d_f64::prelude::{
    CoefficientCombineRule, ColliderBuilder, ColliderHandle, FrictionModel, GenericJointBuilder,
    JointAxesMask, JointAxis, PhysicsWorld, Pose3, RigidBodyBuilder, RigidBodyHandle, Rotation,
    SharedShape, SpringCoefficients, Vector as RapierVector,
};

use crate::geometry::{Pose, Shape, Vector, wrap_angle};
use crate::scene::{
    Body, FrameStep, GRAVITY, Hypothesis, JointKind, Scene, Span, State, ToolMotion, Velocity,
};

use super::drive::World;
use super::joints::{JointFrames, neighbours_touch};
use super::parameters::{ALLOWED_ERROR, STIFF_CONTACT, centre, needs_stiff_contacts};

/// An object whose axis leans further than this has toppled, radians (10 degrees).
const TOPPLED: f64 = 10.0 * std::f64::consts::PI / 180.0;

/// The `user_data` of the table, which no contact names.
const TABLE: u128 = u128::MAX;

/// A scene in rapier3d.
pub(super) struct SpatialWorld {
    world: PhysicsWorld,
    /// Where rapier's origin lies on the table, metres.
    origin: Vector,
    lift: f64,
    tool: RigidBodyHandle,
    objects: Vec<Tracked>,
    /// What the `user_data` of a collider stands for.
    labels: Vec<Body>,
}

/// An object and how far it has turned since the world was built.
struct Tracked {
    body: RigidBodyHandle,
    start: Pose,
    first_position: RapierVector,
    last_angle: f64,
    turned: f64,
}

impl World for SpatialWorld {
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
            lift: motion.lift,
            tool: RigidBodyHandle::invalid(),
            objects: Vec::with_capacity(scene.objects.len()),
            labels: Vec::new(),
        };
        let table = rubbing(
            ColliderBuilder::new(SharedShape::halfspace(RapierVector::Z)),
            parameters.table_friction,
        );
        this.world.insert_collider(table.user_data(TABLE), None);
        this.add_tool(motion, parameters, tool);
        for index in 0..scene.objects.len() {
            this.add_object(scene, state, parameters, index);
        }
        this.add_obstacles(scene);
        this.add_joints(scene);
        this
    }

    fn begin_frame(&mut self, frame: &FrameStep, step: f64) {
        let pose = to_rapier(&frame.from, self.origin, self.lift);
        let velocity = (frame.to.position - frame.from.position) / frame.duration;
        let turning = (frame.to.heading - frame.from.heading) / frame.duration;
        self.world.integration_parameters.dt = step;
        let tool = &mut self.world.bodies[self.tool];
        tool.set_position(pose, true);
        tool.set_linvel(RapierVector::new(velocity.x, velocity.y, 0.0), true);
        tool.set_angvel(RapierVector::Z * turning, true);
    }

    fn step(&mut self) {
        self.world.step();
        for object in &mut self.objects {
            let angle = yaw(self.world.bodies[object.body].rotation());
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
                position: object.start.position + Vector::new(moved.x, moved.y),
                heading: object.start.heading + object.turned,
            });
            let (linear, angular) = (body.linvel(), body.angvel());
            state
                .velocities
                .push(Velocity { linear: Vector::new(linear.x, linear.y), angular: angular.z });
        }
        state
    }

    fn touches(&self, found: &mut dyn FnMut(usize, Body)) {
        for pair in self.world.narrow_phase.contact_pairs() {
            let (Some(a), Some(b)) = (self.label(pair.collider1), self.label(pair.collider2))
            else {
                continue;
            };
            let touching = pair.manifolds.iter().any(|manifold| {
                let points = &manifold.points;
                points.iter().any(|p| p.data.impulse > 0.0 || p.dist <= ALLOWED_ERROR)
            });
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
        let leans = |object: &Tracked| {
            let axis = *self.world.bodies[object.body].rotation() * RapierVector::Z;
            axis.z < TOPPLED.cos()
        };
        (0..self.objects.len()).filter(|&index| leans(&self.objects[index])).collect()
    }
}

impl SpatialWorld {
    fn label(&self, collider: ColliderHandle) -> Option<Body> {
        let index = usize::try_from(self.world.colliders[collider].user_data).ok()?;
        self.labels.get(index).copied()
    }

    fn add_tool(&mut self, motion: &ToolMotion, parameters: &Hypothesis, at: &Pose) {
        let body = RigidBodyBuilder::kinematic_velocity_based()
            .pose(to_rapier(at, self.origin, self.lift))
            .can_sleep(false);
        self.tool = self.world.insert_body(body);
        for (index, part) in motion.tool.parts.iter().enumerate() {
            // The tool frame lies at the parts' underside. Without mass the centre of mass,
            // which rapier's velocity is of, is the tool frame.
            let collider = rubbing(solid(&part.shape), parameters.tool_friction)
                .density(0.0)
                .position(to_rapier(&part.pose, Vector::zeros(), part.shape.height() / 2.0));
            self.insert(collider, Body::Part(index), self.tool);
        }
    }

    fn add_object(&mut self, scene: &Scene, state: &State, parameters: &Hypothesis, index: usize) {
        let (pose, velocity) = (state.poses[index], state.velocities[index]);
        let shape = &scene.objects[index].shape;
        let body = RigidBodyBuilder::dynamic()
            .pose(to_rapier(&pose, self.origin, shape.height() / 2.0))
            .linvel(RapierVector::new(velocity.linear.x, velocity.linear.y, 0.0))
            .angvel(RapierVector::Z * velocity.angular)
            .can_sleep(false);
        let body = self.world.insert_body(body);
        let collider =
            rubbing(upright(shape), parameters.frictions[index]).mass(parameters.masses[index]);
        self.insert(collider, Body::Object(index), body);
        self.objects.push(Tracked {
            body,
            start: pose,
            first_position: self.world.bodies[body].translation(),
            last_angle: yaw(self.world.bodies[body].rotation()),
            turned: 0.0,
        });
    }

    fn add_obstacles(&mut self, scene: &Scene) {
        for (index, obstacle) in scene.obstacles.iter().enumerate() {
            let pose = to_rapier(&obstacle.pose, self.origin, obstacle.size[2] / 2.0);
            let body = self.world.insert_body(RigidBodyBuilder::fixed().pose(pose));
            let collider = rubbing(solid(&obstacle.shape()), obstacle.friction);
            self.insert(collider, Body::Obstacle(index), body);
        }
    }

    fn add_joints(&mut self, scene: &Scene) {
        for joint in &scene.joints {
            let (axes, axis) = match joint.kind {
                JointKind::Fixed => (JointAxesMask::LOCKED_FIXED_AXES, Rotation::IDENTITY),
                JointKind::Prismatic { .. } => {
                    (JointAxesMask::LOCKED_PRISMATIC_AXES, Rotation::IDENTITY)
                }
                // rapier turns about the frame's x axis; this turn makes it the vertical.
                JointKind::Revolute { .. } => {
                    (JointAxesMask::LOCKED_REVOLUTE_AXES, Rotation::from_rotation_y(-FRAC_PI_2))
                }
            };
            let frames = JointFrames::new(scene, joint);
            let [first, second] = joint.between;
            let frame = |pose: &Pose, object: usize| {
                let below = -scene.objects[object].shape.height() / 2.0;
                let frame = to_rapier(pose, Vector::zeros(), below);
                Pose3::from_parts(frame.translation, frame.rotation * axis)
            };
            let mut built = GenericJointBuilder::new(axes)
                .local_frame1(frame(&frames.first, first))
                .local_frame2(frame(&frames.second, second))
                .contacts_enabled(neighbours_touch(&joint.kind));
            // Both frames lie on each other where the scene states its objects, so zero is there.
            match joint.kind {
                JointKind::Revolute { limits: Some(Span { low, high }), .. } => {
                    built = built.limits(JointAxis::AngX, [low, high]);
                }
                JointKind::Prismatic { limits: Some(Span { low, high }), .. } => {
                    built = built.limits(JointAxis::LinX, [low, high]);
                }
                _ => {}
            }
            let (first, second) = (self.objects[first].body, self.objects[second].body);
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
    let gravity = RapierVector::Z * -GRAVITY;
    let mut world = PhysicsWorld { gravity, ..PhysicsWorld::default() };
    let settings = &mut world.integration_parameters;
    // One friction constraint per contact point; the simplified model is 2 cm off on cuboids.
    settings.friction_model = FrictionModel::Coulomb;
    settings.normalized_allowed_linear_error = ALLOWED_ERROR;
    if needs_stiff_contacts(&parameters.masses) {
        let (frequency, damping) = STIFF_CONTACT;
        settings.contact_softness = SpringCoefficients::new(frequency, damping);
    }
    world
}

fn solid(shape: &Shape) -> ColliderBuilder {
    match *shape {
        Shape::Cylinder { radius, height } => ColliderBuilder::cylinder(height / 2.0, radius),
        Shape::Cuboid { size: [x, y, z] } => ColliderBuilder::cuboid(x / 2.0, y / 2.0, z / 2.0),
    }
}

/// The solid with its axis along z; rapier's cylinder has it along y.
fn upright(shape: &Shape) -> ColliderBuilder {
    match shape {
        Shape::Cylinder { .. } => solid(shape).rotation(RapierVector::X * FRAC_PI_2),
        Shape::Cuboid { .. } => solid(shape),
    }
}

fn rubbing(collider: ColliderBuilder, friction: f64) -> ColliderBuilder {
    collider.friction(friction).friction_combine_rule(CoefficientCombineRule::Average)
}

fn to_rapier(pose: &Pose, origin: Vector, height: f64) -> Pose3 {
    let position = pose.position - origin;
    let translation = RapierVector::new(position.x, position.y, height);
    Pose3::from_parts(translation, Rotation::from_rotation_z(pose.heading))
}

/// Turn about the vertical, radians.
fn yaw(rotation: &Rotation) -> f64 {
    let (x, y, z, w) = (rotation.x, rotation.y, rotation.z, rotation.w);
    (2.0 * (w * z + x * y)).atan2(1.0 - 2.0 * (y * y + z * z))
}
