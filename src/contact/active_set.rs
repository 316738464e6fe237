//! Active-set method: exact contact forces of a frame at fixed weights.
//!
//! The equations are linear for known states of all contacts (sticking, sliding or open), and their
//! solution determines the states. Alternating the two is Newton's method on a semismooth equation
//! (Alart and Curnier 1991, doi:10.1016/0045-7825(91)90022-X), and in the plane it nearly always
//! ends after one or two rounds. Otherwise [`super::iterative`] is used.

use nalgebra::{Vector2, Vector3};
use pushplan_kernel::{
    SolverStats,
    settings::{ROUNDS, TOGETHER},
};

use super::{
    blocks::{Blocks, NOBODY},
    constraint::{Constraint, Status, Tie},
    eliminated::Eliminated,
    elimination::solve_in_place,
    index::GroupIndex,
    unknown::Unknown,
};

/// Maximum number of simultaneous equations; larger jams are cheaper by iteration.
const MOST: usize = 64;

/// Reusable memory of the method.
#[derive(Clone, Debug, Default)]
pub(super) struct ActiveSet {
    /// Values of all constraints without their forces.
    free: Vec<Vector2<f64>>,
    rows: Vec<Row>,
    /// Rows sorted by block.
    order: Vec<(usize, usize)>,
    blocks: Blocks,
    /// Contribution of force and torque on every group to the present row, transmitted through
    /// joints.
    felt: Vec<Vector3<f64>>,
    /// The equations of a block, row by row, each with its target at the end.
    matrix: Vec<f64>,
    /// Numbers of the sets tried so far.
    seen: Vec<u64>,
}

/// An equation of a pressing constraint, and the force that satisfies it.
#[derive(Clone, Copy, Debug)]
struct Row {
    constraint: usize,
    /// Index of the equation among the constraint's two.
    equation: usize,
    /// Groups of the equation; the second is [`NOBODY`] for a body with prescribed motion.
    groups: [GroupIndex; 2],
    /// Unit force along normal and tangent.
    along: Vector2<f64>,
    /// Force and torque on the groups.
    press: [Vector3<f64>; 2],
    /// Contribution of a force and torque on either group to the equation's value.
    moved: [Vector3<f64>; 2],
    /// Additional compliance of the force.
    give: f64,
    target: f64,
    force: f64,
}

impl ActiveSet {
    /// Computes forces and twists, starting from the last states of the constraints. Returns `true`
    /// on success; otherwise the constraints keep their previous forces.
    pub fn solve(
        &mut self,
        unknowns: &mut [Unknown],
        constraints: &mut [Constraint],
        ties: &mut [Tie],
        joints: &mut Eliminated,
        tally: &mut SolverStats,
    ) -> bool {
        constraints.iter_mut().for_each(|constraint| constraint.trial = Vector2::zeros());
        joints.release(unknowns, ties);
        for constraint in constraints.iter_mut() {
            constraint.read(unknowns);
            if constraint.status != Status::Open {
                joints.weigh(constraint, unknowns);
            }
        }
        self.free.clear();
        self.free.extend(constraints.iter().map(|constraint| constraint.value));
        let several = unknowns.len() > 1;
        let mut together = TOGETHER;
        self.seen.clear();
        for round in 0..ROUNDS {
            // The next set depends on the present set alone, so a repeated set means a cycle. The
            // check starts after two rounds, which nearly always suffice. It is omitted for a
            // single group, whose bits must match the kernel's lanes.
            if several && round > 1 {
                let set = number(constraints);
                if self.seen.contains(&set) {
                    if round >= together {
                        return false;
                    }
                    together = round;
                    self.seen.clear();
                }
                self.seen.push(set);
            }
            self.list(constraints);
            tally.rounds += 1;
            let count = unknowns.len();
            if self.rows.len() > MOST || !self.eliminate(count, constraints, joints, tally) {
                return false;
            }
            self.apply(constraints);
            joints.spread(unknowns, constraints, ties);
            if agreed(unknowns, constraints, joints, round < together) {
                return true;
            }
        }
        false
    }

    /// Lists the equations implied by the assumed states of the constraints.
    fn list(&mut self, constraints: &[Constraint]) {
        let Self { rows, free, .. } = self;
        rows.clear();
        for (constraint, (c, free)) in constraints.iter().zip(free).enumerate() {
            let mut add = |equation: usize, along, press: [Vector3<f64>; 2], give: f64| {
                rows.push(Row {
                    constraint,
                    equation,
                    groups: [c.a, c.b.unwrap_or(NOBODY)],
                    along,
                    press: [press[0], -press[1]],
                    moved: [c.moved[0][equation], c.moved[1][equation]],
                    give,
                    target: c.target[equation] - free[equation],
                    force: 0.0,
                });
            };
            match c.status {
                Status::Open => {}
                Status::Sticks => {
                    add(0, Vector2::x(), [c.to[0], c.from[0]], c.give);
                    add(1, Vector2::y(), [c.to[1], c.from[1]], c.give);
                }
                Status::Slides(edge) => {
                    let press = [c.to, c.from].map(|rows| rows[0] + rows[1] * edge);
                    add(0, Vector2::new(1.0, edge), press, c.give + c.wedge(edge));
                }
            }
        }
    }

    /// Sets up the equations of `count` groups and solves them block by block; returns `true` if
    /// they have a solution.
    fn eliminate(
        &mut self,
        count: usize,
        constraints: &[Constraint],
        joints: &Eliminated,
        tally: &mut SolverStats,
    ) -> bool {
        let Self { rows, order, blocks, felt, matrix, .. } = self;
        blocks.find(count, rows.iter().map(|row| row.groups), joints);
        order.clear();
        order.extend(rows.iter().enumerate().map(|(k, row)| (blocks.of(row.groups[0]), k)));
        order.sort_unstable();
        for block in order.chunk_by(|one, next| one.0 == next.0) {
            let n = block.len();
            tally.solve(n);
            matrix.clear();
            for row in block.iter().map(|&(_, row)| &rows[row]) {
                let others = block.iter().map(|&(_, other)| &rows[other]);
                if joints.is_empty() {
                    // The force only acts on the two groups.
                    let [a, b] = row.groups;
                    matrix.extend(others.map(|other| {
                        let felt = |k: usize| match other.groups[k] {
                            group if group == a => row.moved[0].dot(&other.press[k]),
                            group if group == b => row.moved[1].dot(&other.press[k]),
                            _ => 0.0,
                        };
                        felt(0) + felt(1)
                    }));
                } else {
                    let c = &constraints[row.constraint];
                    felt.clear();
                    felt.resize(count, Vector3::zeros());
                    joints.feel(c.a, &c.to[row.equation], felt);
                    if let Some(b) = c.b {
                        joints.feel(b, &-c.from[row.equation], felt);
                    }
                    matrix.extend(others.map(|Row { groups: [a, b], press, .. }| {
                        let second = felt.get(b.0).map_or(0.0, |felt| felt.dot(&press[1]));
                        felt[a.0].dot(&press[0]) + second
                    }));
                }
                matrix.push(row.target);
            }
            for (k, &(_, row)) in block.iter().enumerate() {
                matrix[k * (n + 1) + k] += rows[row].give;
            }
            if !solve_in_place(matrix, n) {
                return false;
            }
            for (&(_, row), line) in block.iter().zip(matrix.chunks_exact(n + 1)) {
                rows[row].force = line[n];
            }
        }
        true
    }

    /// Stores the computed trial forces.
    fn apply(&self, constraints: &mut [Constraint]) {
        constraints.iter_mut().for_each(|constraint| constraint.trial = Vector2::zeros());
        for row in &self.rows {
            constraints[row.constraint].trial += row.along * row.force;
        }
    }
}

/// Returns `true` if every constraint's state under its trial force is the assumed one, and then
/// accepts the trial forces. Otherwise all constraints take their new states, or, if not
/// `together`, only the one with the largest error.
fn agreed(
    unknowns: &[Unknown],
    constraints: &mut [Constraint],
    joints: &Eliminated,
    together: bool,
) -> bool {
    let several = unknowns.len() > 1;
    let mut worst: Option<(usize, Status, f64)> = None;
    for (k, constraint) in constraints.iter_mut().enumerate() {
        constraint.read(unknowns);
        // Open contacts without violation stay open, and most are such. A single group must match
        // the bits of the kernel's lanes.
        if several && constraint.status == Status::Open && !constraint.asks() {
            continue;
        }
        joints.weigh(constraint, unknowns);
        let alone = constraint.alone();
        let (status, force) = constraint.respond(&alone);
        if status == constraint.status {
            continue;
        }
        let off = (alone * (force - constraint.trial)).amax();
        if worst.is_none_or(|(.., most)| off > most) {
            worst = Some((k, status, off));
        }
        if together {
            constraint.status = status;
        }
    }
    let Some((worst, status, _)) = worst else {
        constraints.iter_mut().for_each(|constraint| constraint.force = constraint.trial);
        return true;
    };
    constraints[worst].status = status;
    false
}

/// Returns a hash of the states of all constraints.
fn number(constraints: &[Constraint]) -> u64 {
    constraints.iter().fold(0, |number: u64, constraint| {
        let does = match constraint.status {
            Status::Open => 1,
            Status::Sticks => 2,
            Status::Slides(edge) if edge < 0.0 => 3,
            Status::Slides(_) => 4,
        };
        number.wrapping_mul(5).wrapping_add(does)
    })
}

#[cfg(test)]
mod tests;
