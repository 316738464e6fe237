//! Which contacts of a frame stick, slide and stay open, found exactly.
//!
//! Where that is known, what contacts ask for are linear equations; where they are solved, it is
//! known from their answer. Taken in turn that is Newton's method on a semismooth equation
//! (Alart and Curnier 1991, doi:10.1016/0045-7825(91)90022-X), and in the plane it nearly always ends
//! after one or two rounds. Where it does not, the iteration of [`super::system`] answers.

use nalgebra::{DMatrix, DVector, Matrix2, Vector2, Vector3};

use super::{
    constraint::{Constraint, Status, Tie},
    unknown::Unknown,
};

/// Rounds after which it is given up: it goes round in circles where things jam.
const ROUNDS: usize = 8;

/// Memory that is reused.
#[derive(Clone, Debug, Default)]
pub(super) struct ActiveSet {
    status: Vec<Status>,
    rows: Vec<Row>,
    /// Values of all constraints without their forces.
    free: Vec<Vector2<f64>>,
}

/// A row of a constraint that presses.
#[derive(Clone, Debug)]
struct Row {
    constraint: usize,
    /// Which of its two equations.
    equation: usize,
    /// The force that it stands for: a unit along the normal, and along the tangent.
    along: Vector2<f64>,
}

/// The frame's equations as they are now.
pub(super) struct Equations<'a> {
    pub unknowns: &'a [Unknown],
    pub ties: &'a [Tie],
    /// (J A^-1 J^T)^-1 of all ties.
    pub tied: &'a DMatrix<f64>,
}

impl Equations<'_> {
    /// J M J^T between constraints, M being A^-1 with the ties eliminated.
    fn between(&self, first: &Constraint, second: &Constraint) -> Matrix2<f64> {
        let mut sum = Matrix2::zeros();
        for (group, to) in second.sides() {
            let Some(felt) = first.side(group) else { continue };
            let moved = to.map(|row| self.unknowns[group.0].inverse * row);
            sum += product(&felt, &moved);
        }
        if self.ties.is_empty() {
            return sum;
        }
        let [left, right] = [first, second].map(|constraint| self.felt(constraint));
        for (k, a) in &left {
            for (l, b) in &right {
                sum -= a.transpose() * self.tied.fixed_view::<2, 2>(2 * k, 2 * l) * b;
            }
        }
        sum
    }

    /// How ties feel the forces of a constraint.
    fn felt(&self, constraint: &Constraint) -> Vec<(usize, Matrix2<f64>)> {
        let mut felt = Vec::new();
        for (k, tie) in self.ties.iter().enumerate() {
            let mut sum: Option<Matrix2<f64>> = None;
            for (group, to) in constraint.sides() {
                if let Some(side) = tie.side(group) {
                    let moved = to.map(|row| self.unknowns[group.0].inverse * row);
                    *sum.get_or_insert_with(Matrix2::zeros) += product(&side, &moved);
                }
            }
            felt.extend(sum.map(|sum| (k, sum)));
        }
        felt
    }
}

fn product(left: &[Vector3<f64>; 2], right: &[Vector3<f64>; 2]) -> Matrix2<f64> {
    Matrix2::new(
        left[0].dot(&right[0]),
        left[0].dot(&right[1]),
        left[1].dot(&right[0]),
        left[1].dot(&right[1]),
    )
}

impl ActiveSet {
    /// Begins where the constraints' forces and values say.
    pub fn begin(&mut self, constraints: &[Constraint]) {
        self.status.clear();
        self.status.extend(constraints.iter().map(|c| c.respond(&c.alone()).0));
    }

    /// Takes the values of the constraints as those without their forces.
    pub fn set_free(&mut self, constraints: &[Constraint]) {
        self.free.clear();
        self.free.extend(constraints.iter().map(|c| c.value));
    }

    /// The forces that meet all constraints if each does what is assumed of it; none where the
    /// equations have no solution.
    pub fn solve(&mut self, equations: &Equations, constraints: &mut [Constraint]) -> Option<()> {
        let Self { status, rows, free } = self;
        rows.clear();
        for (constraint, status) in status.iter().enumerate() {
            let row = |equation, along| Row { constraint, equation, along };
            match *status {
                Status::Open => {}
                Status::Sticks => {
                    rows.extend([row(0, Vector2::x()), row(1, Vector2::y())]);
                }
                Status::Slides(edge) => rows.push(row(0, Vector2::new(1.0, edge))),
            }
        }
        constraints.iter_mut().for_each(|c| c.trial = Vector2::zeros());
        let n = rows.len();
        if n == 0 {
            return Some(());
        }
        let mut matrix = DMatrix::zeros(n, n);
        let mut asked = DVector::zeros(n);
        for (i, row) in rows.iter().enumerate() {
            let c = &constraints[row.constraint];
            for (j, other) in rows.iter().enumerate() {
                let between = equations.between(c, &constraints[other.constraint]);
                matrix[(i, j)] = (between * other.along)[row.equation];
            }
            matrix[(i, i)] += c.give;
            if let Status::Slides(edge) = status[row.constraint] {
                matrix[(i, i)] += c.wedge(edge);
            }
            asked[i] = c.target[row.equation] - free[row.constraint][row.equation];
        }
        let forces = matrix.lu().solve(&asked)?;
        if !forces.iter().all(|force| force.is_finite()) {
            return None;
        }
        for (row, force) in rows.iter().zip(&forces) {
            constraints[row.constraint].trial += row.along * *force;
        }
        Some(())
    }

    /// Whether all constraints do under their forces what was assumed of them; else that is
    /// assumed which they do.
    pub fn agrees(&mut self, constraints: &[Constraint]) -> bool {
        let mut same = true;
        for (status, constraint) in self.status.iter_mut().zip(constraints) {
            let now = constraint.respond(&constraint.alone()).0;
            same &= *status == now;
            *status = now;
        }
        same
    }

    /// Rounds to try.
    pub fn rounds() -> std::ops::Range<usize> {
        0..ROUNDS
    }
}
