//! A levered body in the midst of a lever-up as a graph.

use crate::geometry::{Box3, BoxContact, Matrix3, Pose3, Vector3};

use super::bodies::LeverBodies;
use super::graphs::{NODE, PartGraphs, RELATION};
use super::state::{Motion, PartState};

/// Unit of distances between bodies and of ways, metres.
const NEAR: f64 = 0.005;

/// Unit of lengths of bodies, metres.
const SIZE: f64 = 0.05;

/// A body that may close a smaller gap in a step is near, metres: more than a body falls from rest.
const REACH: f64 = 0.015;

/// Nor is anything near that is farther than this, metres.
const FARTHEST: f64 = 0.05;

/// Points of a pair count less the farther they are beyond the nearest one, metres.
const BLUR: f64 = 1e-3;

/// Durations are told in this unit, seconds.
const DURATION: f64 = 0.05;

/// Two bodies that are near each other: their points of contact in one.
struct Near {
    /// On the receiver, metres.
    at: Vector3,
    /// Towards it.
    normal: Vector3,
    /// The smallest gap and the mean one, metres.
    gaps: [f64; 2],
    /// Mean products of the points' places about `at`, square metres.
    spread: Matrix3,
}

/// A step that is described: when it begins and ends and how long the one before took, seconds; how the
/// body would move without the network, and how far it is from where that begins (metres; turn, radians).
pub(super) struct Step {
    pub from: f64,
    pub to: f64,
    pub last: f64,
    pub base: Motion,
    pub aside: [Vector3; 2],
}

/// Appends the graph of a body that is in `state`; gives its distance from the blade, metres, infinite
/// where that is not near.
pub(super) fn describe(
    bodies: &LeverBodies,
    state: &PartState,
    Step { from, to, last, base, aside }: &Step,
    graphs: &mut PartGraphs,
) -> f64 {
    let (step, frame) = (to - from, Pose3 { position: state.centre, rotation: state.turn });
    // As far as it would move if it went on.
    let pace = step / last.max(1e-9);
    let (way, spin) = (state.way * pace, state.spin * pace);
    let reach = (REACH + way.norm() + spin.norm() * bodies.reach).min(FARTHEST);
    let blades = [bodies.blade(*from), bodies.blade(*to)];
    let up = state.turn * Vector3::z();
    let turn = base.turn.scaled_axis();
    graphs.begin();
    let parts: Vec<Box3> =
        bodies.parts.iter().map(|part| Box3 { pose: frame * part.pose, ..*part }).collect();
    for (k, part) in parts.iter().enumerate() {
        let away = (part.pose.position - state.centre) / SIZE;
        let axes = part.pose.rotation.to_rotation_matrix();
        let squares =
            Matrix3::from_diagonal(&(part.half / SIZE).component_mul(&(part.half / SIZE)));
        let shape = axes * squares * axes.inverse();
        let even = [
            is(k == 0),
            away.x,
            away.z,
            shape[(0, 0)],
            shape[(1, 1)],
            shape[(2, 2)],
            shape[(0, 2)],
            up.x,
            up.z,
            way.x / NEAR,
            way.z / NEAR,
            spin.y,
            step / DURATION,
            base.way.x / NEAR,
            base.way.z / NEAR,
            turn.y,
            aside[0].x / NEAR,
            aside[0].z / NEAR,
            aside[1].y,
        ];
        let odd = [
            away.y,
            shape[(0, 1)],
            shape[(1, 2)],
            up.y,
            way.y / NEAR,
            spin.x,
            spin.z,
            base.way.y / NEAR,
            turn.x,
            turn.z,
            aside[0].y / NEAR,
            aside[1].x,
            aside[1].z,
        ];
        graphs.node(even, odd);
    }
    for k in 1..parts.len() {
        let away = (parts[k].pose.position - parts[0].pose.position) / SIZE;
        for (pair, away) in [((0, Some(k)), away), ((k, Some(0)), -away)] {
            let (mut even, mut odd) = ([0.0; RELATION[0]], [0.0; RELATION[1]]);
            (even[0], even[8], even[9], odd[1]) = (1.0, away.x, away.z, away.y);
            graphs.relation(pair, even, odd);
        }
    }
    let mut blade = f64::INFINITY;
    for (k, part) in parts.iter().enumerate() {
        let moving = |at: &Vector3| way + spin.cross(&(at - state.centre));
        let mut tell = |near: Near, kind: [bool; 2], surface: Vector3, friction: f64| {
            let (arm, n) = ((near.at - state.centre) / SIZE, near.normal);
            let (torque, own) = (arm.cross(&n), moving(&near.at) / NEAR);
            let (surface, spread) = (surface / NEAR, near.spread / (SIZE * SIZE));
            let [least, mean] = near.gaps;
            let even = [
                0.0,
                is(kind[0]),
                is(kind[1]),
                is(k == 0),
                least / NEAR,
                mean / NEAR,
                n.x,
                n.z,
                arm.x,
                arm.z,
                torque.y,
                spread[(0, 0)],
                spread[(1, 1)],
                spread[(2, 2)],
                spread[(0, 2)],
                surface.x,
                surface.z,
                surface.dot(&n),
                own.x,
                own.z,
                own.dot(&n),
                friction,
                (least / BLUR).clamp(-2.0, 2.0),
                (-least.max(0.0) / (0.5 * BLUR)).exp(),
            ];
            let odd =
                [n.y, arm.y, torque.x, torque.z, spread[(0, 1)], spread[(1, 2)], surface.y, own.y];
            graphs.relation((k, None), even, odd);
        };
        for (j, (fixed, friction)) in bodies.fixed.iter().enumerate() {
            if let Some(near) = near(part, fixed, reach) {
                tell(near, [false, j == 0], Vector3::zeros(), *friction);
            }
        }
        if let Some(near) = near(part, &blades[0], reach) {
            blade = blade.min(near.gaps[0]);
            // Where the blade's point goes that is there now.
            let local = blades[0].pose.local_point(near.at);
            let surface = blades[1].pose.point(local) - near.at;
            tell(near, [true, false], surface, bodies.rub);
        }
    }
    blade
}

/// How `part` is near to `other`, if it is.
fn near(part: &Box3, other: &Box3, reach: f64) -> Option<Near> {
    let mut found: Vec<BoxContact> = Vec::new();
    part.contacts(other, reach, |contact| {
        if contact.gap <= reach {
            found.push(contact);
        }
    });
    let least = found.iter().map(|contact| contact.gap).fold(f64::INFINITY, f64::min);
    let normal = found.first()?.normal;
    let weights: Vec<f64> = found.iter().map(|c| (-(c.gap - least) / BLUR).exp()).collect();
    let whole: f64 = weights.iter().sum();
    let mean = |of: &dyn Fn(&BoxContact) -> Vector3| -> Vector3 {
        found.iter().zip(&weights).map(|(contact, w)| of(contact) * (w / whole)).sum()
    };
    let at = mean(&|contact| contact.point);
    let spread = found.iter().zip(&weights).fold(Matrix3::zeros(), |sum, (contact, w)| {
        let away = contact.point - at;
        sum + away * away.transpose() * (w / whole)
    });
    let gap = found.iter().map(|contact| contact.gap).sum::<f64>() / found.len() as f64;
    Some(Near { at, normal, gaps: [least, gap], spread })
}

fn is(is: bool) -> f64 {
    f64::from(u8::from(is))
}

const _: () = assert!(NODE[0] == 19 && NODE[1] == 13 && RELATION[0] == 24 && RELATION[1] == 8);
