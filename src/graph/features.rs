//! The feature layout: meaning and unit of each number of a node or relation.
//!
//! Axes: x along the tool's motion, y to its left, origin at the receiver's centre. The features
//! are invariant to translation and rotation of the scene; even ones also to mirroring.

use crate::{
    contact::{Motion, Movable, Partner},
    geometry::{Vector, cross},
    scene::{Feet, GRAVITY, JointKind},
};

use super::{
    node::{Node, READOUTS, UNIT},
    prescribed::PrescribedNode,
    relation::{Relation, RelationKind},
};

/// Unit of body-sized lengths, metres.
const BODY: f64 = 0.05;

/// Unit of frame durations, seconds.
const TIME: f64 = 0.1;

/// Distance to a joint limit below which the limit counts, radians or metres.
const NEAR: f64 = 0.05;

/// Even features of a node.
pub const NODE_EVEN: usize = 20;
/// Odd features of a node.
pub const NODE_ODD: usize = 11;
/// Even features of a body with prescribed motion.
pub const GIVEN_EVEN: usize = 6;
/// Odd features of a body with prescribed motion.
pub const GIVEN_ODD: usize = 3;
/// Even features of a relation.
pub const RELATION_EVEN: usize = 26;
/// Odd features of a relation.
pub const RELATION_ODD: usize = 12;
/// Even outputs of a node: displacement x of every readout.
pub const OUTPUT_EVEN: usize = READOUTS;
/// Odd outputs of a node: displacement y and rotation of every readout.
pub const OUTPUT_ODD: usize = 2 * READOUTS;

/// Unit of heights, metres.
const HEIGHT: f64 = 0.1;

/// Support of an object, and whether its load is known.
pub(super) struct Underside<'a> {
    pub feet: &'a Feet,
    /// Cosine and sine of the rotation from the node's x axis to the object's own.
    pub turn: Vector,
    pub push_height_known: bool,
    pub supports_known: bool,
}

/// Returns the features of an object that would slide freely by `coast` and moves by `node.prior`
/// in the analytic model. `pressed` is the sum of its contacts' overlaps in [`UNIT`]s.
pub(super) fn node_features(
    node: &Node,
    body: &Movable,
    underside: &Underside<'_>,
    coast: &Motion,
    pressed: f64,
) -> ([f64; NODE_EVEN], [f64; NODE_ODD]) {
    let [coast_x, coast_vx, coast_y, coast_turn, coast_vy, coast_spin] = node.encode(coast);
    let [x, vx, y, turn, vy, spin] = node.prior;
    let braking = body.deceleration * node.duration * node.duration / UNIT;
    let Underside { feet, turn: turned, push_height_known, supports_known } = *underside;
    let [second, third, fourth] = feet.harmonics_turned(turned);
    (
        [
            coast_x,
            coast_vx,
            x,
            vx,
            (node.duration / TIME).ln(),
            braking.ln_1p(),
            body.support / BODY - 1.0,
            pressed,
            (body.height / HEIGHT).ln(),
            body.face_height / BODY,
            body.lean / UNIT,
            flag(push_height_known),
            flag(supports_known),
            body.deceleration / GRAVITY,
            flag(feet.round),
            body.spin.sqrt() - 1.0,
            feet.mean_square.sqrt() / feet.mean_radius - 1.0,
            second.x,
            third.x,
            fourth.x,
        ],
        [coast_y, coast_turn, coast_vy, coast_spin, y, turn, vy, spin, second.y, third.y, fourth.y],
    )
}

fn flag(value: bool) -> f64 {
    f64::from(u8::from(value))
}

/// Returns the features of a body with prescribed motion, in the axes given by `axis`.
pub(super) fn given_features(
    given: &PrescribedNode,
    axis: Vector,
) -> ([f64; GIVEN_EVEN], [f64; GIVEN_ODD]) {
    let PrescribedNode { tool, area, spread: [along, mixed, across], shift, turn } = *given;
    let deviation = |square: f64| (square.sqrt() / BODY).ln_1p();
    (
        [
            flag(tool),
            flag(!tool),
            deviation(area),
            deviation(along),
            deviation(across),
            axis.dot(&shift) / UNIT,
        ],
        [
            cross(axis, shift) / UNIT,
            turn * (along + across).sqrt() / UNIT,
            mixed / (along * across).sqrt(),
        ],
    )
}

/// Returns the features of a relation from its receiver's view. Contacts leave the columns of
/// joints empty, and vice versa.
pub(super) fn relation_features(
    node: &Node,
    relation: &Relation,
) -> ([f64; RELATION_EVEN], [f64; RELATION_ODD]) {
    let axis = node.axis;
    let along = |v: Vector| axis.x * v.x + axis.y * v.y;
    let across = |v: Vector| axis.x * v.y - axis.y * v.x;
    let [of_part, of_obstacle, of_object] = match relation.sender {
        Partner::Part(_) => [1.0, 0.0, 0.0],
        Partner::Obstacle(_) => [0.0, 1.0, 0.0],
        Partner::Object(_) => [0.0, 0.0, 1.0],
    };
    let Relation { arm, sender_arm, relative, answer: (shift, turn), .. } = *relation;
    let mut even = [0.0; RELATION_EVEN];
    let mut odd = [0.0; RELATION_ODD];
    even[..10].copy_from_slice(&[
        along(arm) / BODY,
        along(relative) / UNIT,
        of_part,
        of_obstacle,
        of_object,
        relation.mass_ratio,
        along(sender_arm) / BODY,
        relation.sender_support / BODY,
        along(shift) / UNIT,
        arm.norm() / BODY,
    ]);
    odd[..6].copy_from_slice(&[
        across(arm) / BODY,
        across(relative) / UNIT,
        across(sender_arm) / BODY,
        across(shift) / UNIT,
        turn * node.support / UNIT,
        cross(arm, relative) / (BODY * UNIT),
    ]);
    match relation.kind {
        RelationKind::Contact { normal, gap, friction, overlap, remaining, left, slip, load } => {
            even[10..21].copy_from_slice(&[
                along(normal),
                gap / UNIT,
                overlap / UNIT,
                relative.dot(&normal) / UNIT,
                arm.dot(&normal) / BODY,
                sender_arm.dot(&normal) / BODY,
                friction,
                remaining,
                left / UNIT,
                slip.abs() / UNIT,
                load.ln_1p(),
            ]);
            odd[6..11].copy_from_slice(&[
                across(normal),
                cross(arm, normal) / BODY,
                cross(normal, relative) / UNIT,
                cross(sender_arm, normal) / BODY,
                slip / UNIT,
            ]);
        }
        RelationKind::Joint { kind, axis: slide, room: (down, up) } => {
            let [fixed, revolute, prismatic] = match kind {
                JointKind::Fixed => [1.0, 0.0, 0.0],
                JointKind::Revolute { .. } => [0.0, 1.0, 0.0],
                JointKind::Prismatic { .. } => [0.0, 0.0, 1.0],
            };
            // Twice the angle, because the sign of a slide direction has no meaning.
            let (x, y) = (along(slide), across(slide));
            let near = |room: f64| 1.0 - (room / NEAR).clamp(0.0, 1.0);
            even[21..26].copy_from_slice(&[
                fixed,
                revolute,
                prismatic,
                prismatic * (x * x - y * y),
                near(down.min(up)),
            ]);
            odd[11] = prismatic * 2.0 * x * y;
        }
    }
    (even, odd)
}
