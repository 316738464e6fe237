//! Joints as equations of a frame: ties, and limits where they are near.

use nalgebra::{Vector2, Vector3};

use crate::{
    geometry::{Vector, perpendicular, wrap_angle},
    scene::{JointKind, State},
};

use super::{
    bodies::{Bodies, Jointed},
    constraint::{Constraint, Law, Tie, along},
    system::System,
};

/// A limit this far off, or nearer, is watched: metres, or radians at [`ARM`].
const NEAR_LIMIT: f64 = 0.03;

/// What turns a row of angles into metres.
const ARM: f64 = 0.05;

/// The constraints of a joint between different groups: of the second against the first.
pub(super) fn constrain(
    bodies: &Bodies,
    state: &State,
    joint: &Jointed,
    axis: Vector,
    system: &mut System,
) {
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
