//! The prior of every object in a frame: what contacts, joints, friction and inertia make of it
//! to first order, for the network to correct.

use nalgebra::{Vector2, Vector3};

use crate::{
    geometry::{Vector, perpendicular, wrap_angle},
    scene::{Body, FrameStep, JointKind, State},
};

use super::{
    bodies::{Bodies, Jointed, Motion},
    contact::Contact,
    system::{Constraint, GIVEN, Law, System, Tie, Unknown, along, shift},
};

/// A limit this far off, or nearer, is watched: metres, or radians at [`ARM`].
const NEAR_LIMIT: f64 = 0.03;

/// A target that no motion of a frame falls short of, metres.
const OUT_OF_REACH: f64 = -10.0;

/// What turns a row of angles into metres.
const ARM: f64 = 0.05;

/// The prior and what it is made of.
#[derive(Clone, Debug, Default)]
pub(super) struct Prior {
    /// Of every object.
    pub motions: Vec<Motion>,
    pub system: System,
    /// The tie of every joint that is not within a group.
    pub joints: Vec<Option<usize>>,
    velocities: System,
}

impl Prior {
    /// Solves the frame. Constraint k of the system is contact k, along its normal and its
    /// tangent; those of the joints follow.
    pub fn solve(
        &mut self,
        bodies: &Bodies,
        state: &State,
        step: &FrameStep,
        axis: Vector,
        coasts: &[Motion],
        contacts: &[Contact],
    ) {
        let travel = (step.to.position - step.from.position).norm();
        let fastest = coasts.iter().map(|coast| coast.shift.norm()).fold(travel, f64::max);
        let system = &mut self.system;
        system.begin(bodies, state, coasts, step.duration, fastest);
        for contact in contacts {
            let groups = &bodies.groups.of;
            let centre = |group: usize| system.unknowns[group].centre;
            let a = groups[contact.object];
            let point = state.poses[contact.object].position + contact.arm;
            let (b, from) = match contact.with {
                Body::Object(other) => {
                    let b = groups[other];
                    let arm = state.poses[other].position + contact.other_arm - centre(b);
                    (b, Some(arm))
                }
                _ => (GIVEN, None),
            };
            let directions = [contact.normal, perpendicular(contact.normal)];
            let arm = point - centre(a);
            let to = directions.map(|direction| along(direction, arm));
            let from = match from {
                Some(arm) => directions.map(|direction| along(direction, arm)),
                None => [Vector3::zeros(); 2],
            };
            let [sent, carried] = directions.map(|direction| contact.given.dot(&direction));
            let law = Law::Contact { friction: contact.friction };
            let target = [sent - contact.gap, carried];
            system.constraints.push(Constraint::new((a, to), (b, from), target, law));
        }
        self.joints.clear();
        for joint in &bodies.joints {
            let ties = system.ties.len();
            constrain(bodies, state, joint, axis, system);
            self.joints.push((system.ties.len() > ties).then_some(ties));
        }
        system.solve(bodies, state, coasts, step.duration, |constraints, unknowns| {
            for (contact, constraint) in contacts.iter().zip(constraints) {
                slide_only_in_touch(bodies, state, coasts, contact, constraint, unknowns);
            }
        });
        self.end_velocities(bodies, state, step, coasts, contacts);
        self.collect(bodies, state, step.duration);
    }

    /// The velocities at the frame's end: the same equations for v T, in which what has come
    /// into contact stays there.
    fn end_velocities(
        &mut self,
        bodies: &Bodies,
        state: &State,
        step: &FrameStep,
        coasts: &[Motion],
        contacts: &[Contact],
    ) {
        let ends: Vec<Motion> = coasts
            .iter()
            .map(|coast| Motion {
                shift: coast.velocity * step.duration,
                turn: coast.spin * step.duration,
                ..*coast
            })
            .collect();
        let velocities = &mut self.velocities;
        velocities.unknowns.clone_from(&self.system.unknowns);
        velocities.constraints.clone_from(&self.system.constraints);
        for (k, constraint) in velocities.constraints.iter_mut().enumerate() {
            let touching = constraint.force.x > 0.0;
            let (normal, tangent) = match contacts.get(k) {
                Some(c) => (c.given.dot(&c.normal), c.given.dot(&perpendicular(c.normal))),
                None => (0.0, 0.0),
            };
            constraint.target = [if touching { normal } else { OUT_OF_REACH }, tangent];
        }
        velocities.ties.clone_from(&self.system.ties);
        velocities.ties.iter_mut().for_each(|tie| tie.target = [0.0; 2]);
        velocities.solve(bodies, state, &ends, step.duration, |_, _| {});
    }

    /// Every object's motion from those of its group; groups turn exactly, so that what is
    /// fixed stays so.
    fn collect(&mut self, bodies: &Bodies, state: &State, duration: f64) {
        self.motions.clear();
        for (k, &group) in bodies.groups.of.iter().enumerate() {
            let unknown = &self.system.unknowns[group];
            let arm = state.poses[k].position - unknown.centre;
            let twist = &unknown.twist;
            let (sin, cos) = twist.z.sin_cos();
            let turned = Vector::new(cos * arm.x - sin * arm.y, sin * arm.x + cos * arm.y);
            let end = &self.velocities.unknowns[group].twist;
            self.motions.push(Motion {
                shift: Vector::new(twist.x, twist.y) + turned - arm,
                turn: twist.z,
                velocity: shift(end, arm) / duration,
                spin: end.z / duration,
            });
        }
    }

    /// The motion that the force of contact `k` alone gives to an object of group `group`
    /// whose centre lies at `position`: shift (metres) and turn (radians).
    pub fn answer(&self, k: usize, group: usize, position: Vector) -> (Vector, f64) {
        let c = &self.system.constraints[k];
        let pressed = if c.a == group {
            c.to[0] * c.force.x + c.to[1] * c.force.y
        } else {
            -(c.from[0] * c.force.x + c.from[1] * c.force.y)
        };
        self.moved(group, position, &pressed)
    }

    /// The same for the force of joint `k`; nothing for one within a group.
    pub fn joint_answer(&self, k: usize, group: usize, position: Vector) -> (Vector, f64) {
        let Some(tie) = self.joints[k].map(|tie| &self.system.ties[tie]) else {
            return (Vector::zeros(), 0.0);
        };
        let pressed = if tie.b == group {
            tie.to[0] * tie.force.x + tie.to[1] * tie.force.y
        } else {
            -(tie.from[0] * tie.force.x + tie.from[1] * tie.force.y)
        };
        self.moved(group, position, &pressed)
    }

    fn moved(&self, group: usize, position: Vector, pressed: &Vector3<f64>) -> (Vector, f64) {
        let unknown = &self.system.unknowns[group];
        let twist = unknown.inverse * pressed;
        (shift(&twist, position - unknown.centre), twist.z)
    }
}

/// Friction acts only after the gap has closed: the sliding before is not held back.
fn slide_only_in_touch(
    bodies: &Bodies,
    state: &State,
    coasts: &[Motion],
    contact: &Contact,
    constraint: &mut Constraint,
    unknowns: &[Unknown],
) {
    let tangent = perpendicular(contact.normal);
    let held = contact.given.dot(&tangent);
    if contact.gap <= 0.0 {
        constraint.target[1] = held;
        return;
    }
    let moved = |object: usize, arm: Vector| {
        let unknown = &unknowns[bodies.groups.of[object]];
        shift(&unknown.twist, state.poses[object].position + arm - unknown.centre)
    };
    let (other, other_coast) = match contact.with {
        Body::Object(other) => {
            (moved(other, contact.other_arm), coasts[other].at(contact.other_arm))
        }
        _ => (contact.given, contact.given),
    };
    let (own, own_coast) =
        (moved(contact.object, contact.arm), coasts[contact.object].at(contact.arm));
    // How far the two would have come into each other had either only coasted.
    let closing =
        (other - own_coast).dot(&contact.normal).max((other_coast - own).dot(&contact.normal));
    let before = if closing > contact.gap { contact.gap / closing } else { 1.0 };
    constraint.target[1] = held + before * ((own_coast - other_coast).dot(&tangent));
}

/// The constraints of a joint between different groups: of the second against the first.
fn constrain(bodies: &Bodies, state: &State, joint: &Jointed, axis: Vector, system: &mut System) {
    let [a, b] = joint.between.map(|object| bodies.groups.of[object]);
    if a == b {
        return;
    }
    let [first, second] = joint.between.map(|object| state.poses[object]);
    let [on_first, on_second] = [first * joint.frames[0], second * joint.frames[1]];
    // What has opened at a guessed joint is no error of the objects but of the guess.
    let apart =
        if joint.guessed { Vector::zeros() } else { on_second.position - on_first.position };
    let turned = if joint.guessed { 0.0 } else { wrap_angle(on_second.heading - on_first.heading) };
    let [centre_a, centre_b] = [a, b].map(|group| system.unknowns[group].centre);
    let turn = Vector3::new(0.0, 0.0, ARM);
    let System { constraints, ties, .. } = system;
    let mut add = |to, from, target, law| match law {
        Some(law) => constraints.push(Constraint::new((b, to), (a, from), target, law)),
        None => ties.push(Tie { a, b, to, from, target, force: Vector2::zeros() }),
    };
    match joint.kind {
        JointKind::Fixed => {}
        JointKind::Revolute { .. } => {
            // Along the tool's motion and across it, so that they turn with the scene.
            let directions = [axis, perpendicular(axis)];
            add(
                directions.map(|d| along(d, on_second.position - centre_b)),
                directions.map(|d| along(d, on_first.position - centre_a)),
                directions.map(|d| -apart.dot(&d)),
                None,
            );
            if let Some(limits) = joint.limits {
                for (sign, left) in [(1.0, turned - limits.low), (-1.0, limits.high - turned)] {
                    if left * ARM < NEAR_LIMIT {
                        let only = [sign * turn, Vector3::zeros()];
                        add(only, only, [-left * ARM, 0.0], Some(Law::AtLeast));
                    }
                }
            }
        }
        JointKind::Prismatic { .. } => {
            // Both bodies at the second's frame: it slides along an axis that turns with the
            // first.
            let slide = on_first.vector(Vector::x());
            let across = perpendicular(slide);
            let rows =
                |direction: Vector, centre: Vector| along(direction, on_second.position - centre);
            let target = [-apart.dot(&across), -turned * ARM];
            add([rows(across, centre_b), turn], [rows(across, centre_a), turn], target, None);
            if let Some(limits) = joint.limits {
                let slid = apart.dot(&slide);
                for (sign, left) in [(1.0, slid - limits.low), (-1.0, limits.high - slid)] {
                    if left < NEAR_LIMIT {
                        let only = |centre| [rows(sign * slide, centre), Vector3::zeros()];
                        add(only(centre_b), only(centre_a), [-left, 0.0], Some(Law::AtLeast));
                    }
                }
            }
        }
    }
}
