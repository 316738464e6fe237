//! The feature layout: what each number of a node or relation means, and its unit.
//!
//! Axes: x along the tool's motion, y to its left, origin at the receiver's centre. All
//! numbers are invariant to shifting and turning the scene; even ones also to mirroring it.

use crate::{geometry::Vector, scene::Body};

use super::{
    bodies::{Motion, Movable},
    link::Link,
    node::{Node, UNIT},
};

/// Unit of body-sized lengths, metres.
const BODY: f64 = 0.05;

/// Unit of frame durations, seconds.
const TIME: f64 = 0.1;

/// Even features of a node.
pub const NODE_EVEN: usize = 8;
/// Odd features of a node.
pub const NODE_ODD: usize = 8;
/// Even features of a relation.
pub const RELATION_EVEN: usize = 19;
/// Odd features of a relation.
pub const RELATION_ODD: usize = 10;
/// Even outputs of a node: shift x, velocity x.
pub const OUTPUT_EVEN: usize = 2;
/// Odd outputs of a node: shift y, turn, velocity y, spin.
pub const OUTPUT_ODD: usize = 4;

/// Features of an object that would coast by `coast` and by quasi-statics moves by
/// `node.prior`; `pressed` is the sum of its contacts' overlaps in [`UNIT`]s.
pub(super) fn node_features(
    node: &Node,
    body: &Movable,
    coast: &Motion,
    pressed: f64,
) -> ([f64; NODE_EVEN], [f64; NODE_ODD]) {
    let [coast_x, coast_vx, coast_y, coast_turn, coast_vy, coast_spin] = node.encode(coast);
    let [x, vx, y, turn, vy, spin] = node.prior;
    let braking = body.deceleration * node.duration * node.duration / UNIT;
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
        ],
        [coast_y, coast_turn, coast_vy, coast_spin, y, turn, vy, spin],
    )
}

/// Features of a contact point as its receiver sees it.
pub(super) fn relation_features(
    node: &Node,
    link: &Link,
) -> ([f64; RELATION_EVEN], [f64; RELATION_ODD]) {
    let axis = node.axis;
    let along = |v: Vector| axis.x * v.x + axis.y * v.y;
    let across = |v: Vector| axis.x * v.y - axis.y * v.x;
    let cross = |a: Vector, b: Vector| a.x * b.y - a.y * b.x;
    let [of_part, of_obstacle, of_object] = match link.sender {
        Body::Part(_) => [1.0, 0.0, 0.0],
        Body::Obstacle(_) => [0.0, 1.0, 0.0],
        Body::Object(_) => [0.0, 0.0, 1.0],
    };
    let answer = &link.answer;
    (
        [
            along(link.arm) / BODY,
            along(link.normal),
            link.gap / UNIT,
            along(link.relative) / UNIT,
            link.overlap / UNIT,
            link.relative.dot(&link.normal) / UNIT,
            link.arm.dot(&link.normal) / BODY,
            link.friction,
            link.weight,
            link.remaining,
            of_part,
            of_obstacle,
            of_object,
            link.mass_ratio,
            along(link.sender_arm) / BODY,
            link.sender_support / BODY,
            link.sender_arm.dot(&link.normal) / BODY,
            along(answer.shift) / UNIT,
            // Whether the contact's friction holds: the sliding share of its displacement.
            link.slip / UNIT,
        ],
        [
            across(link.arm) / BODY,
            across(link.normal),
            across(link.relative) / UNIT,
            cross(link.arm, link.normal) / BODY,
            cross(link.normal, link.relative) / UNIT,
            across(link.sender_arm) / BODY,
            cross(link.sender_arm, link.normal) / BODY,
            across(answer.shift) / UNIT,
            answer.turn * node.support / UNIT,
            cross(link.arm, link.relative) / (BODY * UNIT),
        ],
    )
}
