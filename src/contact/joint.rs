//! Joints as equations of a frame: ties, and limits where they are near.

use nalgebra::{Vector2, Vector3};

use crate::{
    geometry::{Vector, perpendicular},
    scene::{JOINT_ARM, JointKind},
};

use super::{
    bodies::{Jointed, Mounted},
    constraint::{Constraint, Law, Tie},
    index::GroupIndex,
    points::Scenery,
    twist::along,
    unknown::Unknown,
};

/// A limit this far off, or nearer, is watched: metres, or radians at [`JOINT_ARM`].
const NEAR_LIMIT: f64 = 0.03;

/// Two rows of a joint between two groups, or between the world and a group: of the second against
/// the first.
pub(super) struct Rows {
    between: (Option<GroupIndex>, GroupIndex),
    to: [Vector3<f64>; 2],
    from: [Vector3<f64>; 2],
    target: [f64; 2],
    /// Whether they are a limit, of one row, and not the joint itself.
    pub limit: bool,
}

impl Rows {
    pub fn tie(&self) -> Tie {
        let (a, b) = self.between;
        let Self { to, from, target, .. } = *self;
        Tie { a, b, to, from, target, force: Vector2::zeros() }
    }

    pub fn constraint(&self) -> Constraint {
        let (a, b) = self.between;
        Constraint::new((b, self.to), (a, self.from), self.target, Law::AtLeast)
    }

    pub fn turn_tie(&self, tie: &mut Tie) {
        (tie.to, tie.from, tie.target) = (self.to, self.from, self.target);
    }

    pub fn turn_constraint(&self, constraint: &mut Constraint) {
        (constraint.to, constraint.from) = (self.to, self.from);
        constraint.target = self.target;
    }
}

/// The rows of a joint between different groups where these have come to: first its own, then
/// its limits. How many there are depends on the start of the frame alone.
pub(super) fn rows(
    Scenery { bodies, state, turns, .. }: Scenery,
    joint: &Jointed,
    axis: Vector,
    unknowns: &[Unknown],
    mut add: impl FnMut(Rows),
) {
    let between = joint.between.map(|object| bodies.groups.of[object]);
    if between[0] == between[1] {
        return;
    }
    let (start, slides) = joint.separation_turned(&state.poses, turns);
    // A gap at a guessed joint is an error of the guess, not of the objects.
    let (apart, turned) =
        if joint.guessed { (Vector::zeros(), 0.0) } else { (start.apart(), start.turned()) };
    let groups = between.map(|group| &unknowns[group.0]);
    let [on_first, on_second] = [0, 1].map(|end| groups[end].moved(start.ends[end].position));
    let [centre_a, centre_b] = groups.map(|group| group.moved(group.centre));
    let turn = Vector3::new(0.0, 0.0, JOINT_ARM);
    let none = Vector3::zeros();
    let between = (Some(between[0]), between[1]);
    let mut add = |to, from, target, limit| add(Rows { between, to, from, target, limit });
    match joint.kind {
        JointKind::Fixed => {}
        JointKind::Revolute { .. } => {
            // Along the tool's motion and across it, so that they turn with the scene.
            let directions = [axis, perpendicular(axis)];
            add(
                directions.map(|d| along(d, on_second - centre_b)),
                directions.map(|d| along(d, on_first - centre_a)),
                directions.map(|d| -apart.dot(&d)),
                false,
            );
            if let Some(limits) = joint.limits {
                for (sign, left) in [(1.0, turned - limits.low), (-1.0, limits.high - turned)] {
                    if left * JOINT_ARM < NEAR_LIMIT {
                        let only = [sign * turn, none];
                        add(only, only, [-left * JOINT_ARM, 0.0], true);
                    }
                }
            }
        }
        JointKind::Prismatic { .. } => {
            // Both bodies at the second's frame: it slides along an axis that turns with the
            // first.
            let slide = groups[0].turn.of(slides);
            let across = perpendicular(slide);
            let at = on_second;
            let target = [-apart.dot(&perpendicular(slides)), -turned * JOINT_ARM];
            let row = |centre| along(across, at - centre);
            add([row(centre_b), turn], [row(centre_a), turn], target, false);
            if let Some(limits) = joint.limits {
                let slid = apart.dot(&slides);
                for (sign, left) in [(1.0, slid - limits.low), (-1.0, limits.high - slid)] {
                    if left < NEAR_LIMIT {
                        let only = |centre| [along(sign * slide, at - centre), none];
                        add(only(centre_b), only(centre_a), [-left, 0.0], true);
                    }
                }
            }
        }
    }
}

/// The same of a joint between an object and the world.
pub(super) fn mounted_rows(
    Scenery { bodies, state, .. }: Scenery,
    mount: &Mounted,
    axis: Vector,
    unknowns: &[Unknown],
    mut add: impl FnMut(Rows),
) {
    let index = bodies.groups.of[mount.object];
    let group = &unknowns[index.0];
    let start = mount.separation(&state.poses[mount.object]);
    // Turns are counted, so that a limit beyond half of one is one.
    let turned = start.ends[1].heading - start.ends[0].heading;
    let arm = group.moved(start.ends[1].position) - group.moved(group.centre);
    let (turn, none) = (Vector3::new(0.0, 0.0, JOINT_ARM), Vector3::zeros());
    let between = (None, index);
    let mut add = |to, target, limit| add(Rows { between, to, from: [none; 2], target, limit });
    let (unit, come) = match mount.kind {
        JointKind::Fixed => return,
        JointKind::Revolute { .. } => {
            let directions = [axis, perpendicular(axis)];
            let target = directions.map(|d| -start.apart().dot(&d));
            add(directions.map(|d| along(d, arm)), target, false);
            (turn, turned * JOINT_ARM)
        }
        JointKind::Prismatic { .. } => {
            let slide = start.ends[0].vector(Vector::x());
            let across = perpendicular(slide);
            let target = [-start.apart().dot(&across), -turned * JOINT_ARM];
            add([along(across, arm), turn], target, false);
            (along(slide, arm), start.apart().dot(&slide))
        }
    };
    let scale = if matches!(mount.kind, JointKind::Revolute { .. }) { JOINT_ARM } else { 1.0 };
    if let Some(limits) = mount.limits {
        let (low, high) = (limits.low * scale, limits.high * scale);
        for (sign, left) in [(1.0, come - low), (-1.0, high - come)] {
            if left < NEAR_LIMIT {
                add([sign * unit, none], [-left, 0.0], true);
            }
        }
    }
}

/// Turns the rows of all joints, and of their limits, to where the groups have come to.
pub(super) fn turn_joints(
    scenery: Scenery,
    axis: Vector,
    unknowns: &[Unknown],
    ties: &mut [Tie],
    limits: &mut [Constraint],
) {
    let (mut ties, mut limits) = (ties.iter_mut(), limits.iter_mut());
    let mut turn = |rows: Rows| {
        if rows.limit {
            limits.next().into_iter().for_each(|limit| rows.turn_constraint(limit));
        } else {
            ties.next().into_iter().for_each(|tie| rows.turn_tie(tie));
        }
    };
    for joint in &scenery.bodies.joints {
        rows(scenery, joint, axis, unknowns, &mut turn);
    }
    for mount in &scenery.bodies.mounts {
        mounted_rows(scenery, mount, axis, unknowns, &mut turn);
    }
}
