//! Small dense quadratic programmes, solved with Clarabel: minimise 1/2 x'Px + q'x subject to Ax <=
//! b.
//!
//! The solver is reused while the shape stays equal, and its numbers are replaced in place. All
//! entries are stored, including zeros, so that the sparsity pattern never changes. Invalid numbers
//! never cause a panic: each failure has a [`QpStatus`].
//!
//! The solver's tolerances are absolute. The objective and every constraint are therefore divided
//! by their largest entry, which does not change the minimiser. This handles distant goals, tiny
//! columns and rows of different units equally well.

#[cfg(test)]
mod extremes;

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};
use serde::{Deserialize, Serialize};

/// Largest entry of a well-posed problem.
const LARGEST: f64 = 1e12;

/// Maximum number of interior-point iterations; tiny problems take about ten.
const MOST_STEPS: u32 = 60;

/// Dense quadratic programme, with matrices by rows. It serialises to JSON, so that difficult
/// problems can be stored and analysed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct QpProblem {
    /// Symmetric positive semidefinite matrix, n by n.
    pub p: Vec<Vec<f64>>,
    /// Linear objective, length n.
    pub q: Vec<f64>,
    /// Constraint matrix, m by n.
    pub a: Vec<Vec<f64>>,
    /// Upper bounds of the constraints, length m.
    pub b: Vec<f64>,
}

/// Status of the solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum QpStatus {
    /// Solved to full accuracy.
    Solved,
    /// Solved to reduced accuracy, sufficient for a step that a rollout checks.
    AlmostSolved,
    /// No x satisfies the constraints.
    Infeasible,
    /// The objective has no lower bound.
    Unbounded,
    /// Too many iterations, or iterations without progress.
    NoProgress,
    /// Dimensions do not match, or a number is not finite or too large.
    BadProblem,
}

/// Solution of a quadratic programme.
#[derive(Clone, Debug, PartialEq)]
pub struct QpSolution {
    /// Status of the solution.
    pub status: QpStatus,
    /// Minimiser; empty unless solved or almost solved.
    pub x: Vec<f64>,
}

impl QpSolution {
    fn none(status: QpStatus) -> Self {
        Self { status, x: Vec::new() }
    }
}

/// Solver that is reused for consecutive problems.
#[derive(Default)]
pub struct QpSolver {
    kept: Option<(usize, usize, DefaultSolver<f64>)>,
}

impl QpSolver {
    /// Solves a problem.
    pub fn solve(&mut self, problem: &QpProblem) -> QpSolution {
        let Some((n, m)) = problem.shape() else {
            return QpSolution::none(QpStatus::BadProblem);
        };
        if n == 0 {
            let holds = problem.b.iter().all(|&b| b >= 0.0);
            let status = if holds { QpStatus::Solved } else { QpStatus::Infeasible };
            return QpSolution::none(status);
        }
        let Some(solver) = self.load(&problem.scaled(), n, m) else {
            return QpSolution::none(QpStatus::BadProblem);
        };
        solver.solve();
        let status = match solver.solution.status {
            SolverStatus::Solved => QpStatus::Solved,
            SolverStatus::AlmostSolved => QpStatus::AlmostSolved,
            SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => {
                QpStatus::Infeasible
            }
            SolverStatus::DualInfeasible | SolverStatus::AlmostDualInfeasible => {
                QpStatus::Unbounded
            }
            _ => QpStatus::NoProgress,
        };
        let x = &solver.solution.x;
        match status {
            QpStatus::Solved | QpStatus::AlmostSolved if x.iter().all(|v| v.is_finite()) => {
                QpSolution { status, x: x.clone() }
            }
            QpStatus::Solved | QpStatus::AlmostSolved => QpSolution::none(QpStatus::NoProgress),
            other => QpSolution::none(other),
        }
    }

    /// Returns the stored solver with the problem's numbers, or a new one if the shape differs.
    fn load(&mut self, problem: &QpProblem, n: usize, m: usize) -> Option<&mut DefaultSolver<f64>> {
        let (p, a) = (upper(&problem.p, n), full(&problem.a, n, m));
        let fits = self.kept.as_ref().is_some_and(|&(columns, rows, _)| (columns, rows) == (n, m));
        if fits {
            let solver = &mut self.kept.as_mut()?.2;
            let updated = solver.update_P(&p).is_ok()
                && solver.update_A(&a).is_ok()
                && solver.update_q(&problem.q).is_ok()
                && solver.update_b(&problem.b).is_ok();
            if updated {
                return self.kept.as_mut().map(|kept| &mut kept.2);
            }
        }
        let settings = DefaultSettings {
            verbose: false,
            max_iter: MOST_STEPS,
            // Presolving would prevent later updates of the numbers.
            presolve_enable: false,
            // Equilibration is fixed at the first problem, but the problems differ and are already
            // scaled.
            equilibrate_enable: false,
            ..DefaultSettings::default()
        };
        let cones = [SupportedConeT::NonnegativeConeT(m)];
        let solver = DefaultSolver::new(&p, &problem.q, &a, &problem.b, &cones, settings).ok()?;
        self.kept = Some((n, m, solver));
        self.kept.as_mut().map(|kept| &mut kept.2)
    }
}

impl QpProblem {
    /// Returns the numbers of unknowns and constraints, if all dimensions match and all numbers are
    /// valid.
    fn shape(&self) -> Option<(usize, usize)> {
        let (n, m) = (self.q.len(), self.b.len());
        let square = self.p.len() == n && self.p.iter().all(|row| row.len() == n);
        let matching = self.a.len() == m && self.a.iter().all(|row| row.len() == n);
        let sane = |v: &f64| v.is_finite() && v.abs() <= LARGEST;
        let numbers = self.p.iter().chain(&self.a).flatten().chain(&self.q).chain(&self.b);
        (square && matching && numbers.into_iter().all(sane)).then_some((n, m))
    }
}

impl QpProblem {
    /// Returns the problem with its objective and every constraint divided by their largest entry.
    fn scaled(&self) -> Self {
        let objective = largest(self.p.iter().flatten().chain(&self.q));
        let over = |row: &[f64], size: f64| row.iter().map(|v| v / size).collect::<Vec<f64>>();
        let (a, b) = (self.a.iter().zip(&self.b))
            .map(|(row, bound)| {
                let size = largest(row.iter());
                (over(row, size), bound / size)
            })
            .unzip();
        Self {
            p: self.p.iter().map(|row| over(row, objective)).collect(),
            q: over(&self.q, objective),
            a,
            b,
        }
    }
}

/// Returns the largest absolute value; 1 if all values are zero or too small to divide by.
fn largest<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    let size = values.fold(0.0f64, |most, v| most.max(v.abs()));
    if size > 1.0 / LARGEST { size } else { 1.0 }
}

/// Returns the upper triangle in column-major form, with every entry stored.
fn upper(rows: &[Vec<f64>], n: usize) -> CscMatrix<f64> {
    let mut starts = vec![0];
    let (mut indices, mut values) = (Vec::new(), Vec::new());
    for column in 0..n {
        for (row, numbers) in rows.iter().enumerate().take(column + 1) {
            indices.push(row);
            values.push(numbers[column]);
        }
        starts.push(values.len());
    }
    CscMatrix::new(n, n, starts, indices, values)
}

/// Returns the whole matrix in column-major form, with every entry stored.
fn full(rows: &[Vec<f64>], n: usize, m: usize) -> CscMatrix<f64> {
    let starts = (0..=n).map(|column| column * m).collect();
    let indices = (0..n).flat_map(|_| 0..m).collect();
    let values = (0..n).flat_map(|column| rows.iter().map(move |row| row[column])).collect();
    CscMatrix::new(m, n, starts, indices, values)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the problem of minimising (x0 - 1)^2 + (x1 + 2)^2 within plus and minus `bound`.
    fn boxed(bound: f64) -> QpProblem {
        QpProblem {
            p: vec![vec![2.0, 0.0], vec![0.0, 2.0]],
            q: vec![-2.0, 4.0],
            a: vec![vec![1.0, 0.0], vec![0.0, 1.0], vec![-1.0, 0.0], vec![0.0, -1.0]],
            b: vec![bound; 4],
        }
    }

    #[test]
    fn bounds_hold_and_a_kept_solver_answers_like_a_new_one() {
        let mut kept = QpSolver::default();
        for bound in [5.0, 0.5, 1.5, 1e-3, 1e3] {
            let expected = [1.0f64.min(bound), -(2.0f64.min(bound))];
            for solution in [kept.solve(&boxed(bound)), QpSolver::default().solve(&boxed(bound))] {
                assert_eq!(solution.status, QpStatus::Solved, "{bound}");
                for (x, e) in solution.x.iter().zip(expected) {
                    assert!((x - e).abs() < 1e-5 * (1.0 + e.abs()), "{bound}: {x} {e}");
                }
            }
        }
    }

    #[test]
    fn unsupported_problems_also_have_a_status() {
        let mut solver = QpSolver::default();
        // Without constraints and curvature, the objective has no lower bound.
        let free = QpProblem { p: vec![vec![0.0]], q: vec![1.0], a: vec![], b: vec![] };
        assert!(solver.solve(&free).x.is_empty());
        let mut ragged = boxed(1.0);
        ragged.a[1].pop();
        assert_eq!(solver.solve(&ragged).status, QpStatus::BadProblem);
        assert_eq!(solver.solve(&QpProblem::default()).status, QpStatus::Solved);
    }

    #[test]
    fn a_problem_survives_json() {
        let text = serde_json::to_string(&boxed(0.1)).unwrap();
        assert_eq!(serde_json::from_str::<QpProblem>(&text).unwrap(), boxed(0.1));
    }
}
