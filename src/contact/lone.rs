//! The forces of [`super::active`] on one group to which nothing is joined.
//!
//! Most frames are of one pushed object in one or two contacts, for which lists of rows and groups
//! take more instructions than the equations. What is computed is the same, to the last bit.

use nalgebra::{Vector2, Vector3};

use super::{
    active::{ROUNDS, agreed},
    constraint::{Constraint, Status, apply},
    elimination,
    tally::Tally,
    unknown::Unknown,
};

/// Most constraints that are solved here.
pub(super) const MOST: usize = 2;

/// Most equations.
const EQUATIONS: usize = 2 * MOST;

/// An equation of a constraint that presses.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    /// The force and torque that a unit of the constraint's force puts on the group.
    press: Vector3<f64>,
    /// How the group answers a unit of what the equation is about.
    moved: Vector3<f64>,
    /// By how much more than that the force gives way.
    give: f64,
    target: f64,
}

/// Finds the forces of at most [`MOST`] constraints and the twist of the group, beginning with what
/// the constraints did last; whether that went well. If not, the constraints' forces are those of
/// before.
pub(super) fn solve(
    unknown: &mut Unknown,
    constraints: &mut [Constraint],
    tally: &mut Tally,
) -> bool {
    for constraint in &mut *constraints {
        constraint.value = apply(&constraint.to, &unknown.free);
    }
    let mut free = [Vector2::zeros(); MOST];
    for (free, constraint) in free.iter_mut().zip(&*constraints) {
        *free = constraint.value;
    }
    for round in 0..ROUNDS {
        let mut rows = [Row::default(); EQUATIONS];
        let mut n = 0;
        for (c, free) in constraints.iter().zip(&free) {
            let left = Vector2::from(c.target) - free;
            match c.status {
                Status::Open => {}
                Status::Sticks => {
                    for equation in 0..2 {
                        let (press, moved) = (c.to[equation], c.moved[0][equation]);
                        rows[n] = Row { press, moved, give: c.give, target: left[equation] };
                        n += 1;
                    }
                }
                Status::Slides(edge) => {
                    let press = c.to[0] + c.to[1] * edge;
                    let (moved, give) = (c.moved[0][0], c.give + c.wedge(edge));
                    rows[n] = Row { press, moved, give, target: left.x };
                    n += 1;
                }
            }
        }
        tally.rounds += 1;
        tally.solve(n);
        let Some(forces) = eliminate(&rows, n) else { return false };
        let mut forces = forces.into_iter();
        let mut force = || forces.next().unwrap_or_default();
        unknown.pressed = Vector3::zeros();
        for c in &mut *constraints {
            c.trial = match c.status {
                Status::Open => Vector2::zeros(),
                Status::Sticks => Vector2::new(force(), force()),
                Status::Slides(edge) => {
                    let normal = force();
                    Vector2::new(normal, edge * normal)
                }
            };
            unknown.pressed += c.to[0] * c.trial.x + c.to[1] * c.trial.y;
        }
        unknown.settle();
        if agreed(std::slice::from_ref(unknown), constraints, round) {
            return true;
        }
    }
    false
}

/// The forces that solve the first `n` equations, if these have an answer.
fn eliminate(rows: &[Row; EQUATIONS], n: usize) -> Option<[f64; EQUATIONS]> {
    match n {
        0 => Some([0.0; EQUATIONS]),
        1 => eliminated::<1>(rows),
        2 => eliminated::<2>(rows),
        3 => eliminated::<3>(rows),
        _ => eliminated::<EQUATIONS>(rows),
    }
}

fn eliminated<const N: usize>(rows: &[Row; EQUATIONS]) -> Option<[f64; EQUATIONS]> {
    let mut matrix = [[0.0; N]; N];
    let mut target = [0.0; N];
    for k in 0..N {
        for j in 0..N {
            matrix[k][j] = rows[k].moved.dot(&rows[j].press);
        }
        matrix[k][k] += rows[k].give;
        target[k] = rows[k].target;
    }
    let mut forces = [0.0; EQUATIONS];
    forces[..N].copy_from_slice(&elimination::solve(matrix, target)?);
    Some(forces)
}

#[cfg(test)]
mod tests {
    use super::*;

    use nalgebra::Matrix3;

    use crate::{
        contact::{
            active::ActiveSet, constraint::Law, eliminated::Eliminated, index::GroupIndex,
            twist::along,
        },
        geometry::{Vector, perpendicular},
    };

    /// A body pushed in up to two points, by numbers that look random.
    fn frame(seed: u64) -> (Unknown, Vec<Constraint>) {
        let count = (seed % 3) as usize;
        let mut seed = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let mut noise = || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let mut unknown = Unknown::default();
        let soft = 1.5 + noise();
        unknown.inverse = Matrix3::from_diagonal(&Vector3::new(soft, soft, 900.0 * soft));
        unknown.free = 1e-3 * Vector3::new(noise(), noise(), 10.0 * noise());
        let constraints = (0..count).map(|_| {
            let (sin, cos) = (0.4 * noise()).sin_cos();
            let (normal, arm) = (Vector::new(cos, sin), 0.03 * Vector::new(noise(), noise()));
            let rows = [normal, perpendicular(normal)].map(|direction| along(direction, arm));
            let target = [4e-3 * noise(), 1e-3 * noise()];
            let law = Law::Contact { friction: 0.3 };
            let mut constraint =
                Constraint::new((GroupIndex(0), rows), (None, Default::default()), target, law);
            constraint.weigh(std::slice::from_ref(&unknown));
            constraint
        });
        let constraints = constraints.collect();
        (unknown, constraints)
    }

    #[test]
    fn the_forces_are_those_of_the_active_set_to_the_bit() {
        let mut pressing = 0;
        for seed in 0..300 {
            let (mut unknown, mut constraints) = frame(seed);
            let (mut others, mut same) = (vec![unknown.clone()], constraints.clone());
            let (mut tally, mut joints) = (Tally::default(), Eliminated::default());
            joints.hang(1, &[]);
            let found = ActiveSet::default().solve(
                &mut others,
                &mut same,
                &mut [],
                &mut joints,
                &mut tally,
            );
            assert_eq!(solve(&mut unknown, &mut constraints, &mut tally), found, "{seed}");
            for (one, other) in constraints.iter().zip(&same) {
                assert_eq!((one.force, one.status), (other.force, other.status), "{seed}");
                pressing += usize::from(one.force.x > 0.0);
            }
            assert!(!found || unknown.twist == others[0].twist, "{seed}");
        }
        assert!(pressing > 50, "{pressing}");
    }
}
