//! The prior of every object in a frame: what contacts, joints, friction and inertia make of it
//! to second order in time, for the network to correct.

use nalgebra::Vector3;

use crate::geometry::{Vector, perpendicular};

use super::{
    bodies::Partner,
    constraint::{Constraint, Law},
    joint::{rows, turn_joints},
    midway::{Midway, midway},
    motion::Motion,
    points::{Contact, Scenery},
    system::System,
    twist::{along, shift},
    unknown::{Course, Quantity, Unknown},
};

/// A target that no motion of a frame falls short of, metres.
const OUT_OF_REACH: f64 = -10.0;

/// Where in a frame contacts and joints are taken: half-way for displacements, at the end for
/// velocities.
pub(super) const HALF: f64 = 0.5;
pub(super) const WHOLE: f64 = 1.0;

/// The prior and what it is made of.
#[derive(Clone, Debug, Default)]
pub(super) struct Prior {
    /// Of every object.
    pub motions: Vec<Motion>,
    pub system: System,
    /// The tie of every joint that is not within a group.
    pub joints: Vec<Option<usize>>,
    pub velocities: System,
}

impl Prior {
    /// Solves the frame. Constraint k of the system is contact k, along its normal and its
    /// tangent; those of the joints follow.
    pub fn solve(&mut self, scenery: Scenery, axis: Vector, contacts: &[Contact]) {
        self.press(scenery, axis, contacts, None);
        self.end(scenery, axis, contacts);
    }

    /// The same for a frame after one just solved that had the contacts `last`: forces begin as
    /// they were there.
    pub fn follow(
        &mut self,
        scenery: Scenery,
        axis: Vector,
        contacts: &[Contact],
        last: &[Contact],
    ) {
        self.press(scenery, axis, contacts, Some(last));
        self.end(scenery, axis, contacts);
    }

    /// From the displacements on: the velocities, and both for every object.
    fn end(&mut self, scenery: Scenery, axis: Vector, contacts: &[Contact]) {
        self.release(scenery, axis, contacts);
        self.collect(scenery);
    }

    /// The displacements and what forces make them, which begin as those of the contacts `last` of
    /// the frame before, if this one follows it; the motions are not touched.
    pub fn press(
        &mut self,
        scenery: Scenery,
        axis: Vector,
        contacts: &[Contact],
        last: Option<&[Contact]>,
    ) {
        let Scenery { bodies, state, step, coasts, turns, .. } = scenery;
        let Self { system, joints, .. } = self;
        let duration = step.duration;
        let follows = last.is_some();
        let last = last.unwrap_or_default();
        let quantity = Quantity::Displacement;
        let of = Course { bodies, state, coasts, turns, duration, quantity };
        let travel = (step.to.position - step.from.position).norm();
        let fastest = coasts.iter().map(|coast| coast.shift.norm()).fold(travel, f64::max);
        system.begin(of, fastest, follows);
        for contact in contacts {
            let groups = &bodies.groups.of;
            let other = match contact.with {
                Partner::Object(other) => Some(groups[other]),
                _ => None,
            };
            let law = Law::Contact { friction: contact.friction };
            // Their rows follow when it is known how things move.
            let rows = [Vector3::zeros(); 2];
            let ends = ((groups[contact.object], rows), (other, rows));
            system.constraints.push(Constraint::new(ends.0, ends.1, [0.0; 2], law));
        }
        for (k, contact) in contacts.iter().enumerate() {
            // By the points on both, so that it does not matter which comes first.
            let far = |n: usize| {
                (last[n].arm - contact.arm).norm_squared()
                    + (last[n].other_arm - contact.other_arm).norm_squared()
            };
            let same = (0..last.len()).filter(|&n| last[n].pair == contact.pair);
            if let Some(n) = same.min_by(|&a, &b| far(a).total_cmp(&far(b))) {
                system.warm(k, n);
            }
        }
        joints.clear();
        let System { unknowns, constraints, ties, .. } = &mut *system;
        for joint in &bodies.joints {
            let before = ties.len();
            rows(of, joint, axis, unknowns, |rows| match rows.limit {
                true => constraints.push(rows.constraint()),
                false => ties.push(rows.tie()),
            });
            joints.push((ties.len() > before).then_some(before));
        }
        system.solve(of, |constraints, ties, unknowns| {
            unknowns.iter_mut().for_each(|unknown| unknown.look(HALF));
            for (contact, constraint) in contacts.iter().zip(&mut *constraints) {
                let at = midway(bodies, state, contact, unknowns, HALF);
                face(contact, &at, constraint);
                constraint.target = [
                    contact.given.dot(&at.normal) - contact.gap,
                    sliding_in_touch(coasts, contact, &at, constraint, unknowns),
                ];
            }
            let limits = &mut constraints[contacts.len()..];
            turn_joints(of, axis, unknowns, ties, limits);
        });
    }

    /// The velocities at the frame's end: the same equations for v T, with everything where it
    /// has come to, in which what has come into contact stays there.
    fn release(&mut self, scenery: Scenery, axis: Vector, contacts: &[Contact]) {
        let Scenery { bodies, state, step, coasts, turns, .. } = scenery;
        let duration = step.duration;
        let Self { system, velocities, .. } = self;
        let quantity = Quantity::Velocity;
        let of = Course { bodies, state, coasts, turns, duration, quantity };
        velocities.continue_from(system, of);
        system.unknowns.iter_mut().for_each(|unknown| unknown.look(WHOLE));
        let ended = &system.unknowns;
        let pressing = contacts.iter().zip(&system.constraints);
        let pressing = pressing.filter(|(_, constraint)| constraint.presses());
        let count = pressing.clone().count();
        for ((contact, _), constraint) in pressing.zip(&mut velocities.constraints) {
            let end = midway(bodies, state, contact, ended, WHOLE);
            face(contact, &end, constraint);
            let given = contact.given;
            constraint.target = [given.dot(&end.normal), given.dot(&perpendicular(end.normal))];
        }
        let System { constraints, ties, .. } = &mut *velocities;
        let limits = &mut constraints[count..];
        turn_joints(of, axis, ended, ties, limits);
        for limit in limits {
            limit.target = [if limit.presses() { 0.0 } else { OUT_OF_REACH }, 0.0];
        }
        ties.iter_mut().for_each(|tie| tie.target = [0.0; 2]);
        velocities.solve(of, |_, _, _| {});
    }

    /// Every object's motion from those of its group; groups turn exactly, so that what is
    /// fixed stays so.
    fn collect(&mut self, Scenery { bodies, state, step, coasts, .. }: Scenery) {
        self.motions.clear();
        for (k, &group) in bodies.groups.of.iter().enumerate() {
            let unknown = &self.system.unknowns[group.0];
            let alone = bodies.groups.members[group.0].len() == 1;
            if alone && unknown.pressed == Vector3::zeros() {
                // Nothing holds it: it coasts, exactly.
                self.motions.push(coasts[k]);
                continue;
            }
            let arm = state.poses[k].position - unknown.centre;
            let twist = &unknown.twist;
            let turned = unknown.turn.of(arm);
            let end = &self.velocities.unknowns[group.0].twist;
            self.motions.push(Motion {
                shift: Vector::new(twist.x, twist.y) + turned - arm,
                turn: twist.z,
                velocity: shift(end, arm) / step.duration,
                spin: end.z / step.duration,
            });
        }
    }
}

/// Turns the rows of a contact's constraint to where the contact is `at`.
fn face(contact: &Contact, at: &Midway, constraint: &mut Constraint) {
    let directions = [at.normal, perpendicular(at.normal)];
    constraint.to = directions.map(|direction| along(direction, at.arm));
    if let Partner::Object(_) = contact.with {
        constraint.from = directions.map(|direction| along(direction, at.other_arm));
    }
}

/// The tangential displacement at which a contact does not slide. Friction acts only after the
/// gap has closed: the sliding before is not held back.
fn sliding_in_touch(
    coasts: &[Motion],
    contact: &Contact,
    at: &Midway,
    constraint: &Constraint,
    unknowns: &[Unknown],
) -> f64 {
    let tangent = perpendicular(at.normal);
    let held = contact.given.dot(&tangent);
    if contact.gap <= 0.0 {
        return held;
    }
    let own = shift(&unknowns[constraint.a.0].twist, at.arm);
    let own_coast = coasts[contact.object].at(contact.arm);
    let (other, other_coast) = match (contact.with, constraint.b) {
        (Partner::Object(object), Some(group)) => {
            (shift(&unknowns[group.0].twist, at.other_arm), coasts[object].at(contact.other_arm))
        }
        _ => (contact.given, contact.given),
    };
    // How far the two would have come into each other had either only coasted.
    let closing = (other - own_coast).dot(&at.normal).max((other_coast - own).dot(&at.normal));
    let before = if closing > contact.gap { contact.gap / closing } else { 1.0 };
    held + before * ((own_coast - other_coast).dot(&tangent))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        contact::{bodies::Bodies, coast::coast, points::find_contacts},
        geometry::{Pose, Shape, Turn, cross},
        scene::{FrameStep, Joint, JointKind, Object, Obstacle, Part, Physics, Scene, Tool},
    };

    fn cuboid(x: f64, y: f64) -> Object {
        Object::cuboid(format!("{x} {y}"), [0.06, 0.06, 0.1]).mass(0.5).friction(0.5).at(x, y, 0.0)
    }

    fn can(x: f64, y: f64) -> Object {
        Object { shape: Shape::Cylinder { radius: 0.03, height: 0.1 }, ..cuboid(x, y) }
    }

    /// Pushed at the table's height, so that the load stays where it is.
    fn table(objects: Vec<Object>) -> Scene {
        Scene { push_height: Some(0.0), ..Scene::new(objects) }
    }

    /// The motions of one slow frame in which a round finger of 2 cm, its far side touching the
    /// line x = 0, moves by `travel`.
    fn prior(scene: &Scene, travel: Vector) -> Vec<Motion> {
        let finger = Part {
            name: "finger".into(),
            shape: Shape::Cylinder { radius: 0.01, height: 0.1 },
            pose: Pose::new(-0.01, 0.0, 0.0),
        };
        let tool = Tool::new("finger", [finger]).expect("one part is one piece").friction(0.5);
        let bodies = Bodies::new(scene, &tool, 0.002, &Physics::stated(scene));
        let state = scene.start();
        let to = Pose { position: travel, heading: 0.0 };
        let step = FrameStep { from: Pose::default(), to, duration: 0.5 };
        let coasts: Vec<Motion> = (bodies.objects.iter().zip(&state.velocities))
            .map(|(body, velocity)| coast(body, velocity, step.duration))
            .collect();
        let turns: Vec<Turn> = state.poses.iter().map(Pose::turn).collect();
        let mut contacts = Vec::new();
        let scenery = Scenery {
            bodies: &bodies,
            state: &state,
            step: &step,
            coasts: &coasts,
            turns: &turns,
            margin: crate::contact::MARGIN,
        };
        find_contacts(scenery, &mut contacts);
        let mut prior = Prior::default();
        prior.solve(scenery, Vector::x(), &contacts);
        prior.motions
    }

    #[test]
    fn a_push_through_the_centre_only_shifts() {
        let [motion] = prior(&table(vec![cuboid(0.03, 0.0)]), Vector::new(0.008, 0.0))[..] else {
            panic!("one object")
        };
        assert!((motion.shift - Vector::new(0.008, 0.0)).norm() < 5e-5, "{motion:?}");
        assert!(motion.turn.abs() < 1e-9, "{motion:?}");
    }

    /// A slow push at one point that sticks: friction over the whole underside and the force at that
    /// point balance, as forces and as torques (Goyal, Ruina and Papadopoulos 1991).
    #[test]
    fn an_off_centre_push_that_sticks_balances_friction_under_even_pressure() {
        let scene = table(vec![cuboid(0.03, -0.01)]);
        let [motion] = prior(&scene, Vector::new(0.002, 0.0))[..] else { panic!("one object") };
        let arm = Vector::new(-0.03, 0.01);
        assert!((motion.at(arm) - Vector::new(0.002, 0.0)).norm() < 5e-5, "{motion:?}");
        let (mut force, mut torque, count) = (Vector::zeros(), 0.0, 200);
        for k in 0..count * count {
            let place = |k: i32| 0.06 * ((f64::from(k) + 0.5) / f64::from(count) - 0.5);
            let at = Vector::new(place(k % count), place(k / count));
            let drag = motion.at(at).normalize() / f64::from(count * count);
            force += drag;
            torque += cross(at, drag);
        }
        // Off by the arm of a millimetre.
        assert!((torque - cross(arm, force)).abs() < 1e-3 * force.norm(), "{torque} {force}");
        assert!(motion.turn < -0.01, "{motion:?}");
    }

    #[test]
    fn a_sliding_contact_moves_the_object_along_the_edge_of_the_friction_cone() {
        let slippery = |object: Object| Object { friction: 0.0, ..object };
        let scene = Scene { table_friction: 1.0, ..table(vec![slippery(can(0.03, 0.0))]) };
        // Short, as the contact moves round the disc.
        let travel = Vector::new(0.0002, 0.0003);
        let [motion] = prior(&scene, travel)[..] else { panic!("one object") };
        // Coefficient 0.25 with the finger's 0.5; a disc's rim also turns, which takes no
        // displacement from its centre.
        assert!((motion.shift.y / motion.shift.x - 0.25).abs() < 0.01, "{motion:?}");
        assert!((motion.shift.x - travel.x).abs() < 2.5e-6, "{motion:?}");
    }

    #[test]
    fn a_row_is_pushed_through_to_its_end() {
        let row = (0..4).map(|k| can(0.03 + 0.06 * f64::from(k), 0.0)).collect();
        for motion in prior(&table(row), Vector::new(0.01, 0.0)) {
            // Contacts give way by a share of the load, here that of four cans.
            assert!((motion.shift - Vector::new(0.01, 0.0)).norm() < 8e-4, "{motion:?}");
        }
    }

    #[test]
    fn what_is_pushed_against_a_wall_stays_finite_and_between() {
        let mut scene = table(vec![can(0.03, 0.0)]);
        scene.obstacles.push(Obstacle {
            name: "wall".into(),
            size: [0.02, 0.3, 0.1],
            pose: Pose::new(0.07, 0.0, 0.0),
            friction: 0.5,
        });
        let [motion] = prior(&scene, Vector::new(0.01, 0.0))[..] else { panic!("one object") };
        assert!(motion.shift.x > 0.0 && motion.shift.x < 0.01, "{motion:?}");
        assert!(motion.shift.y.abs() < 1e-6 && motion.turn.abs() < 1e-6, "{motion:?}");
    }

    #[test]
    fn a_revolute_pair_keeps_its_anchor_and_a_prismatic_one_its_line() {
        for kind in [
            JointKind::Revolute { at: Vector::new(0.07, 0.0), limits: None },
            JointKind::Prismatic { axis: Vector::y(), limits: None },
        ] {
            let mut scene = table(vec![can(0.03, -0.015), can(0.11, 0.0)]);
            scene.joints.push(Joint::new([0, 1], kind));
            let motions = prior(&scene, Vector::new(0.008, 0.0));
            let joint = &scene.joints[0];
            let frames = joint.frames(&scene.objects);
            let shifted = |k: usize| {
                let at = scene.objects[joint.between[k]].pose * frames[k];
                motions[k].at(at.position - scene.objects[k].pose.position)
            };
            let apart = shifted(1) - shifted(0);
            match kind {
                JointKind::Revolute { .. } => {
                    assert!(apart.norm() < 1e-8 + motions[0].turn.powi(2), "{apart}");
                    assert!((motions[0].turn - motions[1].turn).abs() > 1e-3, "{motions:?}");
                }
                _ => {
                    assert!((motions[0].turn - motions[1].turn).abs() < 1e-9, "{motions:?}");
                    assert!(motions[1].shift.x > 0.004, "pushed along: {motions:?}");
                }
            }
        }
    }
}
