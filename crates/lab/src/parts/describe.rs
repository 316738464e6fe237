//! The graph of a levered body during a lever-up.

use pushplan::internals::geometry::{Box3, BoxContact, Matrix3, Pose3, Vector3};

use super::bodies::{LeverBodies, bounds};
use super::graphs::{NODE, PartGraphs, RELATION};
use super::state::{Motion, PartState};

/// Unit of distances between bodies and of displacements, metres.
const NEAR: f64 = 0.005;

/// Unit of lengths of bodies, metres.
const SIZE: f64 = 0.05;

/// Gap below which a body is near, metres, plus its motion in a step: more than a body falls from
/// rest.
const REACH: f64 = 0.015;

/// Largest gap at which a body is near, metres.
const FARTHEST: f64 = 0.05;

/// Length scale by which points of a pair lose weight beyond the nearest one, metres.
const BLUR: f64 = 1e-3;

/// Unit of durations, seconds.
const DURATION: f64 = 0.05;

/// The nearness of two bodies, with their points of contact reduced to one.
struct Near {
    /// Point on the receiver, metres.
    at: Vector3,
    /// Normal towards the receiver.
    normal: Vector3,
    /// Smallest gap and mean gap, metres.
    gaps: [f64; 2],
    /// Mean products of the points' coordinates about `at`, square metres.
    spread: Matrix3,
}

/// A described step: its begin and end and the duration of the step before, seconds. Also the
/// motion of the body without the network, and the deviation from its start (metres; rotation,
/// radians).
pub(super) struct Step {
    pub from: f64,
    pub to: f64,
    pub last: f64,
    pub base: Motion,
    pub aside: [Vector3; 2],
}

/// Appends the graph of a body in `state`. Returns its distance from the blade, metres, or infinity
/// if the blade is not near.
pub(super) fn describe(
    bodies: &LeverBodies,
    state: &PartState,
    step: &Step,
    graphs: &mut PartGraphs,
) -> f64 {
    // Displacement if its motion continued.
    let pace = (step.to - step.from) / step.last.max(1e-9);
    let going = PartState { way: state.way * pace, spin: state.spin * pace, ..*state };
    let reach = (REACH + going.fastest(bodies.reach)).min(FARTHEST);
    let frame = Pose3 { position: state.centre, rotation: state.turn };
    let seen = |part: &Box3| {
        let solid = Box3 { pose: frame * part.pose, ..*part };
        let axes = solid.pose.rotation.to_rotation_matrix().into_inner();
        Part { solid, axes, bounds: bounds(&solid, &axes) }
    };
    let parts: Vec<Part> = bodies.parts.iter().map(seen).collect();
    graphs.begin();
    for (k, part) in parts.iter().enumerate() {
        let (even, odd) = node(part, k == 0, &going, step);
        graphs.node(even, odd);
    }
    for k in 1..parts.len() {
        let away = (parts[k].solid.pose.position - parts[0].solid.pose.position) / SIZE;
        for (pair, away) in [((0, Some(k)), away), ((k, Some(0)), -away)] {
            let (mut even, mut odd) = ([0.0; RELATION[0]], [0.0; RELATION[1]]);
            (even[0], even[8], even[9], odd[1]) = (1.0, away.x, away.z, away.y);
            graphs.relation(pair, even, odd);
        }
    }
    let blades = [bodies.blade(step.from), bodies.blade(step.to)];
    let axes = blades[0].pose.rotation.to_rotation_matrix().into_inner();
    let around_blade = bounds(&blades[0], &axes);
    let mut blade = f64::INFINITY;
    let mut found = Vec::new();
    for (k, part) in parts.iter().enumerate() {
        let mut add = |near: Near, other: Other| {
            let (even, odd) = relation(&near, k == 0, &going, &other);
            graphs.relation((k, None), even, odd);
        };
        for (j, fixed) in bodies.fixed.iter().enumerate() {
            if part.may_meet(&fixed.bounds, reach)
                && let Some(near) = near(&part.solid, &fixed.solid, reach, &mut found)
            {
                let surface = Vector3::zeros();
                add(near, Other { blade: false, table: j == 0, surface, rub: fixed.rub });
            }
        }
        if part.may_meet(&around_blade, reach)
            && let Some(near) = near(&part.solid, &blades[0], reach, &mut found)
        {
            blade = blade.min(near.gaps[0]);
            // Motion of the blade's point that is at the contact.
            let surface = blades[1].pose.point(blades[0].pose.local_point(near.at)) - near.at;
            add(near, Other { blade: true, table: false, surface, rub: bodies.rub });
        }
    }
    blade
}

/// A cuboid of the body at its present pose.
struct Part {
    solid: Box3,
    axes: Matrix3,
    bounds: [Vector3; 2],
}

impl Part {
    /// Returns `true` if a body within these bounds may be as near as `reach`.
    fn may_meet(&self, [least, most]: &[Vector3; 2], reach: f64) -> bool {
        let [from, to] = &self.bounds;
        (0..3).all(|k| from[k] - reach <= most[k] && to[k] + reach >= least[k])
    }
}

/// The body on the other side of a relation.
struct Other {
    blade: bool,
    table: bool,
    /// Displacement of its point in the step, metres.
    surface: Vector3,
    /// Friction coefficient.
    rub: f64,
}

/// Returns the features of a cuboid of the body, whose motion continues.
fn node(
    part: &Part,
    first: bool,
    going: &PartState,
    Step { from, to, base, aside, .. }: &Step,
) -> ([f64; NODE[0]], [f64; NODE[1]]) {
    let away = (part.solid.pose.position - going.centre) / SIZE;
    let half = part.solid.half / SIZE;
    let shape =
        part.axes * Matrix3::from_diagonal(&half.component_mul(&half)) * part.axes.transpose();
    let (up, way, spin) = (going.turn * Vector3::z(), going.way / NEAR, going.spin);
    let (base, turn) = (base.way / NEAR, base.turn.scaled_axis());
    let [aside, askew] = [aside[0] / NEAR, aside[1]];
    let even = [
        is(first),
        away.x,
        away.z,
        shape[(0, 0)],
        shape[(1, 1)],
        shape[(2, 2)],
        shape[(0, 2)],
        up.x,
        up.z,
        way.x,
        way.z,
        spin.y,
        (to - from) / DURATION,
        base.x,
        base.z,
        turn.y,
        aside.x,
        aside.z,
        askew.y,
    ];
    let odd = [
        away.y,
        shape[(0, 1)],
        shape[(1, 2)],
        up.y,
        way.y,
        spin.x,
        spin.z,
        base.y,
        turn.x,
        turn.z,
        aside.y,
        askew.x,
        askew.z,
    ];
    (even, odd)
}

/// Returns the features of nearness to another body.
fn relation(
    near: &Near,
    first: bool,
    going: &PartState,
    other: &Other,
) -> ([f64; RELATION[0]], [f64; RELATION[1]]) {
    let away = near.at - going.centre;
    let (arm, n) = (away / SIZE, near.normal);
    let own = (going.way + going.spin.cross(&away)) / NEAR;
    let (surface, spread) = (other.surface / NEAR, near.spread / (SIZE * SIZE));
    let torque = arm.cross(&n);
    let [least, mean] = near.gaps;
    let even = [
        0.0,
        is(other.blade),
        is(other.table),
        is(first),
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
        other.rub,
        (least / BLUR).clamp(-2.0, 2.0),
        (-least.max(0.0) / (0.5 * BLUR)).exp(),
    ];
    let odd = [n.y, arm.y, torque.x, torque.z, spread[(0, 1)], spread[(1, 2)], surface.y, own.y];
    (even, odd)
}

/// Returns the nearness of `part` to `other`, if any; `found` is a reused buffer.
fn near(part: &Box3, other: &Box3, reach: f64, found: &mut Vec<BoxContact>) -> Option<Near> {
    found.clear();
    part.contacts(other, reach, |contact| {
        if contact.gap <= reach {
            found.push(contact);
        }
    });
    let normal = found.first()?.normal;
    let least = found.iter().map(|contact| contact.gap).fold(f64::INFINITY, f64::min);
    let weight = |contact: &BoxContact| (-(contact.gap - least) / BLUR).exp();
    let (mut whole, mut sum, mut gaps) = (0.0, Vector3::zeros(), 0.0);
    for contact in found.iter() {
        (whole, gaps) = (whole + weight(contact), gaps + contact.gap);
        sum += contact.point * weight(contact);
    }
    let at = sum / whole;
    let mut spread = Matrix3::zeros();
    for contact in found.iter() {
        let away = contact.point - at;
        spread += away * away.transpose() * (weight(contact) / whole);
    }
    Some(Near { at, normal, gaps: [least, gaps / found.len() as f64], spread })
}

fn is(is: bool) -> f64 {
    f64::from(u8::from(is))
}
