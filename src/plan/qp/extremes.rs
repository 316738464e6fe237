//! Tests of quadratic programmes with extreme numbers, which refinement should not produce.
//!
//! Problems have the form used in refinement: 1/2 x'Px + q'x within low <= x <= high. The reference
//! is coordinate descent, which for a convex quadratic over a box converges to the minimum (Tseng
//! 2001, J. Optim. Theory Appl. 109, 475).

use super::{QpProblem, QpSolver, QpStatus};

/// Allowed violation of a bound, relative to its size.
const VIOLATION: f64 = 1e-6;

/// Allowed excess of the objective over the reference, relative to its range.
const EXCESS: f64 = 1e-4;

/// Number of sweeps of the reference.
const SWEEPS: usize = 20_000;

/// Expected result of a programme.
#[derive(Clone, Copy, Debug)]
enum Expected {
    /// The minimum.
    Minimum,
    /// This status and no solution.
    Status(QpStatus),
    /// Any status, but no solution that is not finite or violates a bound.
    Anything,
}

use Expected::{Anything, Minimum, Status};

#[derive(Clone, Debug)]
struct Programme {
    p: [[f64; 2]; 2],
    q: [f64; 2],
    low: f64,
    high: f64,
    /// Factor of the constraints' rows and bounds.
    rows: f64,
}

/// Programme that minimises (x0 - 1)^2 + (x1 + 2)^2 within plus and minus 1.5.
const ORDINARY: Programme =
    Programme { p: [[2.0, 0.0], [0.0, 2.0]], q: [-2.0, 4.0], low: -1.5, high: 1.5, rows: 1.0 };

/// Returns the programme with the columns of the fitted model multiplied by `by`.
fn scaled(by: [f64; 2]) -> Programme {
    let mut programme = ORDINARY;
    for i in 0..2 {
        for j in 0..2 {
            programme.p[i][j] *= by[i] * by[j];
        }
        programme.q[i] *= by[i];
    }
    programme
}

/// Returns the programme with the columns [1, 0] and [1, apart] of J, where P = 2 J'J.
fn parallel(apart: f64) -> Programme {
    let p = [[2.0, 2.0], [2.0, 2.0 + 2.0 * apart * apart]];
    Programme { p, q: [-2.0, -2.0 - 2.0 * apart], ..ORDINARY }
}

fn within(low: f64, high: f64) -> Programme {
    Programme { low, high, ..ORDINARY }
}

fn pulled(q: [f64; 2]) -> Programme {
    Programme { q, ..ORDINARY }
}

fn curved(p: [[f64; 2]; 2], q: [f64; 2]) -> Programme {
    Programme { p, q, ..ORDINARY }
}

fn list() -> Vec<(&'static str, Programme, Expected)> {
    let (first_flat, flat) = ([[0.0, 0.0], [0.0, 2.0]], [[0.0; 2]; 2]);
    let (infeasible, bad) = (Status(QpStatus::Infeasible), Status(QpStatus::BadProblem));
    vec![
        ("an ordinary one", ORDINARY, Minimum),
        ("zero column, nothing pulls", curved(first_flat, [0.0, 4.0]), Minimum),
        ("zero column that pulls", curved(first_flat, ORDINARY.q), Minimum),
        ("all columns zero", curved(flat, [0.0; 2]), Minimum),
        ("parallel columns", parallel(0.0), Minimum),
        ("columns 1e-3 from parallel", parallel(1e-3), Minimum),
        ("columns 1e-8 from parallel", parallel(1e-8), Minimum),
        ("columns 1 : 1e3", scaled([1.0, 1e3]), Minimum),
        ("columns 1e-3 : 1e3", scaled([1e-3, 1e3]), Minimum),
        ("columns 1e-5 : 1e5", scaled([1e-5, 1e5]), Minimum),
        ("columns all times 1e-6", scaled([1e-6; 2]), Minimum),
        ("columns all times 1e5", scaled([1e5; 2]), Minimum),
        ("goal 1e9 tolerances away", pulled([-2e9, 4e9]), Minimum),
        ("rows times 1e-6", Programme { rows: 1e-6, ..ORDINARY }, Minimum),
        ("rows times 1e6", Programme { rows: 1e6, ..ORDINARY }, Minimum),
        ("zero trust region", within(0.0, 0.0), Minimum),
        ("trust region 1e-9", within(-1e-9, 1e-9), Minimum),
        ("trust region 1e9", within(-1e9, 1e9), Minimum),
        ("bounds on one side only", within(0.0, 1e6), Minimum),
        ("contradictory bounds", within(1.0, -1.0), infeasible),
        ("bounds that miss by 1e-3", within(5e-4, -5e-4), infeasible),
        ("bounds that miss by 1e-9", within(5e-10, -5e-10), Anything),
        ("curved downwards", curved([[-2.0, 0.0], [0.0, 2.0]], ORDINARY.q), Anything),
        ("curvatures 1e11 : 1e-11", curved([[1e11, 0.0], [0.0, 1e-11]], ORDINARY.q), Anything),
        ("NaN", pulled([f64::NAN, 4.0]), bad),
        ("an infinite number", pulled([f64::INFINITY, 4.0]), bad),
        ("a number of 1e300", pulled([1e300, 4.0]), bad),
        // The solver must still solve an ordinary problem afterwards.
        ("an ordinary one at the end", ORDINARY, Minimum),
    ]
}

#[test]
fn one_solver_answers_soundly_whatever_came_before() {
    let mut solver = QpSolver::default();
    for (name, programme, expected) in list() {
        let solution = solver.solve(&programme.problem());
        assert!(solution.x.iter().all(|v| v.is_finite()), "{name}: {solution:?}");
        let answered = matches!(solution.status, QpStatus::Solved | QpStatus::AlmostSolved);
        assert_eq!(solution.x.len(), if answered { 2 } else { 0 }, "{name}: {solution:?}");
        let Programme { low, high, .. } = programme;
        let beyond = solution.x.iter().map(|x| (x - high).max(low - x));
        let violation = beyond.fold(0.0, f64::max) / (1.0 + high.abs());
        assert!(violation <= VIOLATION, "{name}: {violation:e}");
        match expected {
            Minimum => {
                assert!(answered, "{name}: {solution:?}");
                let above = programme.objective(&solution.x) - programme.minimum();
                let excess = above / programme.range();
                assert!(excess <= EXCESS, "{name}: {excess:e}");
            }
            Status(status) => assert_eq!(solution.status, status, "{name}"),
            Anything => {}
        }
    }
}

impl Programme {
    fn problem(&self) -> QpProblem {
        let (mut a, mut b) = (Vec::new(), Vec::new());
        for i in 0..2 {
            for (sign, limit) in [(1.0, self.high), (-1.0, -self.low)] {
                let mut row = vec![0.0; 2];
                row[i] = sign * self.rows;
                a.push(row);
                b.push(limit * self.rows);
            }
        }
        let p = self.p.iter().map(|row| row.to_vec()).collect();
        QpProblem { p, q: self.q.to_vec(), a, b }
    }

    fn objective(&self, x: &[f64]) -> f64 {
        let product = |row: &[f64]| -> f64 { row.iter().zip(x).map(|(a, b)| a * b).sum() };
        let curved: f64 = x.iter().zip(&self.p).map(|(v, row)| 0.5 * v * product(row)).sum();
        curved + product(&self.q)
    }

    /// Returns the range of the objective within the box, with a minimum size of a thousandth of a
    /// step, because smaller differences do not affect a push.
    fn range(&self) -> f64 {
        let reach = self.low.abs().max(self.high.abs()).max(1e-3);
        let curved =
            |i: usize| -> f64 { self.p[i].iter().map(|v| 0.5 * v.abs() * reach * reach).sum() };
        let range: f64 = (0..2).map(|i| self.q[i].abs() * reach + curved(i)).sum();
        range.max(f64::MIN_POSITIVE)
    }

    /// Returns the minimum of the objective over the box.
    fn minimum(&self) -> f64 {
        let mut x = [0.0f64; 2];
        for _ in 0..SWEEPS {
            for i in 0..2 {
                let pull = self.q[i] + self.p[i][1 - i] * x[1 - i];
                let free = if self.p[i][i] > 0.0 {
                    -pull / self.p[i][i]
                } else if pull == 0.0 {
                    x[i]
                } else {
                    -pull.signum() * f64::MAX
                };
                x[i] = free.max(self.low).min(self.high);
            }
        }
        self.objective(&x)
    }
}
