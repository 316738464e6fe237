//! Joints as equations of a frame: ties, and limits that are near.

use nalgebra::{Vector2, Vector3};

use crate::{
    geometry::{Vector, perpendicular},
    scene::{JOINT_ARM, JointKind, Span},
};

use super::{
    bodies::{Jointed, Mounted},
    constraint::{Constraint, Law, Tie},
    index::GroupIndex,
    points::Scenery,
    twist::along,
    unknown::Unknown,
};

/// Distance to a limit below which it is a constraint: metres, or radians at [`JOINT_ARM`].
const NEAR_LIMIT: f64 = 0.03;

/// Two rows of a joint between two groups, or between the world and a group: motion of the second
/// relative to the first.
pub(super) struct Rows {
    between: (Option<GroupIndex>, GroupIndex),
    to: [Vector3<f64>; 2],
    from: [Vector3<f64>; 2],
    target: [f64; 2],
    /// Whether the rows are a limit, with one row only, and not the joint itself.
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

/// A joint between different groups, or between the world and a group, in its initial state.
pub(super) struct Held {
    between: (Option<GroupIndex>, GroupIndex),
    kind: JointKind,
    limits: Option<Span>,
    /// Position of the joint's frame on either side, and the sliding axis of a prismatic joint.
    ends: [Vector; 2],
    slides: Vector,
    /// Initial offset and rotation of the second side relative to the first.
    apart: Vector,
    turned: f64,
}

impl Held {
    /// Creates the joint of two objects; `None` if they are in one group.
    pub fn between(Scenery { bodies, state, turns, .. }: Scenery, joint: &Jointed) -> Option<Self> {
        let [first, second] = joint.between.map(|object| bodies.groups.of[object]);
        if first == second {
            return None;
        }
        let (start, slides) = joint.separation_turned(&state.poses, turns);
        // A gap at a guessed joint is an error of the guess, not of the objects.
        let (apart, turned) = if joint.guessed {
            (Vector::zeros(), 0.0)
        } else {
            (start.apart(), start.turned(&joint.kind))
        };
        Some(Self {
            between: (Some(first), second),
            kind: joint.kind,
            limits: joint.limits,
            ends: start.ends.map(|end| end.position),
            slides,
            apart,
            turned,
        })
    }

    /// Creates the joint of an object and the world.
    pub fn to_world(Scenery { bodies, state, .. }: Scenery, mount: &Mounted) -> Self {
        let start = mount.separation(&state.poses[mount.object]);
        Self {
            between: (None, bodies.groups.of[mount.object]),
            kind: mount.kind,
            limits: mount.limits,
            ends: start.ends.map(|end| end.position),
            slides: start.ends[0].vector(Vector::x()),
            apart: start.apart(),
            turned: start.turned(&mount.kind),
        }
    }

    /// Returns the rows at the groups' present positions through `add`: first of the joint, then of
    /// its limits. Their number depends on the start of the frame alone.
    pub fn rows(&self, axis: Vector, unknowns: &[Unknown], mut add: impl FnMut(Rows)) {
        let Self { between, limits, ends, slides, apart, turned, .. } = *self;
        let first = between.0.map(|group| &unknowns[group.0]);
        let second = &unknowns[between.1.0];
        let on_second = second.moved(ends[1]);
        let (turn, none) = (Vector3::new(0.0, 0.0, JOINT_ARM), Vector3::zeros());
        let centre = second.moved(second.centre);
        let to = |direction, at| along(direction, at - centre);
        // The world does not move.
        let other = first.map(|group| group.moved(group.centre));
        let from = |direction, at| other.map_or(none, |centre| along(direction, at - centre));
        let turn_from = if first.is_some() { turn } else { none };
        let mut add = |to, from, target, limit| add(Rows { between, to, from, target, limit });
        match self.kind {
            JointKind::Fixed => {}
            JointKind::Revolute { .. } => {
                let on_first = first.map_or(ends[0], |group| group.moved(ends[0]));
                // Directions along and across the tool's motion, so that they rotate with the
                // scene.
                let directions = [axis, perpendicular(axis)];
                add(
                    directions.map(|d| to(d, on_second)),
                    directions.map(|d| from(d, on_first)),
                    directions.map(|d| -apart.dot(&d)),
                    false,
                );
                if let Some(limits) = limits {
                    for (sign, left) in [(1.0, turned - limits.low), (-1.0, limits.high - turned)] {
                        if left * JOINT_ARM < NEAR_LIMIT {
                            let only = |turn: Vector3<f64>| [sign * turn, none];
                            add(only(turn), only(turn_from), [-left * JOINT_ARM, 0.0], true);
                        }
                    }
                }
            }
            JointKind::Prismatic { .. } => {
                // Both bodies at the second's frame, which slides along an axis that rotates with
                // the first.
                let slide = first.map_or(slides, |group| group.turn.of(slides));
                let across = perpendicular(slide);
                let at = on_second;
                let target = [-apart.dot(&perpendicular(slides)), -turned * JOINT_ARM];
                add([to(across, at), turn], [from(across, at), turn_from], target, false);
                if let Some(limits) = limits {
                    let slid = apart.dot(&slides);
                    for (sign, left) in [(1.0, slid - limits.low), (-1.0, limits.high - slid)] {
                        if left < NEAR_LIMIT {
                            let unit = sign * slide;
                            let only = [to(unit, at), none];
                            add(only, [from(unit, at), none], [-left, 0.0], true);
                        }
                    }
                }
            }
        }
    }
}

/// Returns all joints of a frame: between objects that move relative to each other, then to the
/// world.
fn all(scenery: Scenery<'_>) -> impl Iterator<Item = Held> + '_ {
    let bodies = scenery.bodies;
    let between = bodies.joints.iter().filter_map(move |joint| Held::between(scenery, joint));
    between.chain(bodies.mounts.iter().map(move |mount| Held::to_world(scenery, mount)))
}

/// Rotates the rows of all joints and limits to the groups' present positions.
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
    all(scenery).for_each(|held| held.rows(axis, unknowns, &mut turn));
}
