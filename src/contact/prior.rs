//! The analytic motion of every object in a frame, which the network corrects: the result of
//! contacts, joints, friction and inertia to second order in time.

use nalgebra::Vector3;
use pushplan_kernel::{
    Motion,
    settings::{HALF, Quantity, WHOLE},
};

use crate::geometry::{Vector, perpendicular};

use super::{
    bodies::Partner,
    constraint::{Constraint, Law},
    joint::{Held, turn_joints},
    midpoint::{Midpoint, midpoint},
    points::{Contact, Scenery},
    system::System,
    twist::{along, shift},
    unknown::Unknown,
    warm_start::WarmStart,
};

/// Target of a constraint that no displacement in a frame can violate, metres.
const OUT_OF_REACH: f64 = -10.0;

/// The analytic model and its systems of equations.
#[derive(Clone, Debug, Default)]
pub(super) struct Prior {
    /// Motion of every object.
    pub motions: Vec<Motion>,
    pub system: System,
    /// Tie of every joint; `None` within a group.
    pub joints: Vec<Option<usize>>,
    pub velocities: System,
    /// Speed gain of every group in the last frame.
    starts: Vec<WarmStart>,
}

impl Prior {
    /// Solves the frame. Constraint k of the system is contact k, along its normal and its tangent;
    /// the constraints of joints follow.
    pub fn solve(&mut self, scenery: Scenery, axis: Vector, contacts: &[Contact]) {
        self.press(scenery, axis, contacts, None);
        self.end(scenery, axis, contacts);
    }

    /// Solves a frame that follows the one just solved, which had the contacts `last`. Forces and
    /// motions of that frame are the warm start.
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

    /// Completes the solution after the displacements: velocities, then the motion of every object.
    fn end(&mut self, scenery: Scenery, axis: Vector, contacts: &[Contact]) {
        self.release(scenery, axis, contacts);
        self.collect(scenery);
    }

    /// Computes displacements and their forces. If this frame follows another, the forces of its
    /// contacts `last` are the warm start. The motions are not changed.
    pub fn press(
        &mut self,
        scenery: Scenery,
        axis: Vector,
        contacts: &[Contact],
        last: Option<&[Contact]>,
    ) {
        let Scenery { bodies, state, step, coasts, .. } = scenery;
        let Self { system, joints, starts, .. } = self;
        let starts = last.is_some().then_some(&starts[..]);
        let last = last.unwrap_or_default();
        let travel = (step.to.position - step.from.position).norm();
        let fastest = coasts.iter().map(|coast| coast.shift.norm()).fold(travel, f64::max);
        system.quantity = Quantity::Displacement;
        system.begin(scenery, fastest, starts);
        for contact in contacts {
            let groups = &bodies.groups.of;
            let other = match contact.with {
                Partner::Object(other) => Some(groups[other]),
                _ => None,
            };
            let law = Law::Contact { friction: contact.friction };
            // Rows are set once motions are known.
            let rows = [Vector3::zeros(); 2];
            let ends = ((groups[contact.object], rows), (other, rows));
            system.constraints.push(Constraint::new(ends.0, ends.1, [0.0; 2], law));
        }
        for (k, contact) in contacts.iter().enumerate() {
            // Compared by the points on both bodies, so that their order does not matter.
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
        let mut add = |held: &Held| {
            held.rows(axis, unknowns, |rows| match rows.limit {
                true => constraints.push(rows.constraint()),
                false => ties.push(rows.tie()),
            });
        };
        let mut own = 0;
        for joint in &bodies.joints {
            // Each joint has one tie, and joints between objects come before joints to the world.
            let held = Held::between(scenery, joint);
            held.iter().for_each(&mut add);
            joints.push(held.map(|_| own));
            own += usize::from(joints.last().is_some_and(Option::is_some));
        }
        bodies.mounts.iter().for_each(|mount| add(&Held::to_world(scenery, mount)));
        system.solve(scenery, |constraints, ties, unknowns| {
            unknowns.iter_mut().for_each(|unknown| unknown.look(HALF));
            for (contact, constraint) in contacts.iter().zip(&mut *constraints) {
                let at = midpoint(bodies, state, contact, unknowns, HALF);
                face(contact, &at, constraint);
                constraint.target = [
                    contact.given.dot(&at.normal) - contact.gap,
                    sliding_in_touch(coasts, contact, &at, constraint, unknowns),
                ];
            }
            let limits = &mut constraints[contacts.len()..];
            turn_joints(scenery, axis, unknowns, ties, limits);
        });
    }

    /// Computes the velocities at the frame's end: the same equations for v T, in the final
    /// configuration. Closed contacts stay closed.
    fn release(&mut self, scenery: Scenery, axis: Vector, contacts: &[Contact]) {
        let Scenery { bodies, state, .. } = scenery;
        let Self { system, velocities, starts, .. } = self;
        velocities.quantity = Quantity::Velocity;
        system.unknowns.iter_mut().for_each(|unknown| unknown.look(WHOLE));
        velocities.continue_from(system, starts, scenery);
        let ended = &system.unknowns;
        let pressing = contacts.iter().zip(&system.constraints);
        let pressing = pressing.filter(|(_, constraint)| constraint.presses());
        let count = pressing.clone().count();
        for ((contact, _), constraint) in pressing.zip(&mut velocities.constraints) {
            let end = midpoint(bodies, state, contact, ended, WHOLE);
            face(contact, &end, constraint);
            let given = contact.given;
            constraint.target = [given.dot(&end.normal), given.dot(&perpendicular(end.normal))];
        }
        let System { constraints, ties, .. } = &mut *velocities;
        let limits = &mut constraints[count..];
        turn_joints(scenery, axis, ended, ties, limits);
        for limit in limits {
            limit.target = [if limit.presses() { 0.0 } else { OUT_OF_REACH }, 0.0];
        }
        ties.iter_mut().for_each(|tie| tie.target = [0.0; 2]);
        velocities.solve(scenery, |_, _, _| {});
        starts.clear();
        let groups = system.unknowns.iter().zip(&velocities.unknowns).zip(&bodies.groups.members);
        starts.extend(groups.map(|((moved, ended), members)| {
            WarmStart::of(moved.as_it_began(members, scenery), moved, ended)
        }));
    }

    /// Computes every object's motion from its group's; groups rotate exactly, so that fixed joints
    /// stay fixed.
    fn collect(&mut self, Scenery { bodies, state, step, coasts, .. }: Scenery) {
        self.motions.clear();
        for (k, &group) in bodies.groups.of.iter().enumerate() {
            let unknown = &self.system.unknowns[group.0];
            let alone = bodies.groups.members[group.0].len() == 1;
            if alone && unknown.pressed == Vector3::zeros() {
                // An object without forces slides freely, exactly.
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

/// Rotates the rows of a contact's constraint to the contact geometry `at`.
#[inline]
fn face(contact: &Contact, at: &Midpoint, constraint: &mut Constraint) {
    let directions = [at.normal, perpendicular(at.normal)];
    constraint.to = directions.map(|direction| along(direction, at.arm));
    if let Partner::Object(_) = contact.with {
        constraint.from = directions.map(|direction| along(direction, at.other_arm));
    }
}

/// Returns the tangential displacement at which a contact does not slide. Friction acts only after
/// the gap has closed: earlier sliding is not resisted.
#[inline]
fn sliding_in_touch(
    coasts: &[Motion],
    contact: &Contact,
    at: &Midpoint,
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
    // Overlap of the two bodies if either had only slid freely.
    let closing = (other - own_coast).dot(&at.normal).max((other_coast - own).dot(&at.normal));
    let before = if closing > contact.gap { contact.gap / closing } else { 1.0 };
    held + before * ((own_coast - other_coast).dot(&tangent))
}

#[cfg(test)]
mod tests;
