//! Small dense quadratic programmes, solved by clarabel:
//! minimise 1/2 x'Px + q'x subject to Ax <= b.
//!
//! One solver is kept as long as the shape stays the same, and its numbers are replaced in place;
//! every entry is stored, zeros too, so that the sparsity pattern never changes. Nothing here
//! panics on bad numbers: a failure is a [`QpStatus`].
//!
//! The solver's tolerances are absolute, so the objective and every constraint are first divided
//! by their largest entry, which changes no minimiser: a goal far away, tiny columns or rows of
//! another unit are then as good as any.

#[cfg(test)]
mod extremes;

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};
use serde::{Deserialize, Serialize};

/// Entries larger than this make a problem ill-posed rather than informative.
const LARGEST: f64 = 1e12;

/// Interior-point steps allowed; tiny problems take about ten.
const MOST_STEPS: u32 = 60;

/// A quadratic programme, dense, matrices by rows. Serialises to JSON, so that a hard one can
/// be kept and looked at.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct QpProblem {
    /// Symmetric positive semidefinite, n by n.
    pub p: Vec<Vec<f64>>,
    /// n numbers.
    pub q: Vec<f64>,
    /// m by n.
    pub a: Vec<Vec<f64>>,
    /// m numbers.
    pub b: Vec<f64>,
}

/// Status of the solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum QpStatus {
    /// Solved to full accuracy.
    Solved,
    /// Solved to reduced accuracy; good enough for a step that is checked by rolling out.
    AlmostSolved,
    /// No x satisfies the constraints.
    Infeasible,
    /// The objective has no lower bound.
    Unbounded,
    /// Too many steps, or steps that no longer made progress.
    NoProgress,
    /// Dimensions do not match, or a number is not finite or too large.
    BadProblem,
}

/// The answer to a quadratic programme.
#[derive(Clone, Debug, PartialEq)]
pub struct QpSolution {
    /// Status of the solution.
    pub status: QpStatus,
    /// The minimiser; empty unless solved or almost solved.
    pub x: Vec<f64>,
}

impl QpSolution {
    fn none(status: QpStatus) -> Self {
        Self { status, x: Vec::new() }
    }
}

/// A solver that is kept from problem to problem.
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

    /// The kept solver with the problem's numbers, or a new one where the shape is new.
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
            // Presolving would forbid replacing the numbers later.
            presolve_enable: false,
            // Scaling is fixed at the first problem; ours are scaled already and differ.
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
    /// Numbers of unknowns and constraints, if all dimensions match and all numbers are sane.
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
    /// The same problem with its objective and every constraint divided by their largest entry.
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

/// Size of the largest number; 1 if all are zero or so small that dividing by them would not do.
fn largest<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    let size = values.fold(0.0f64, |most, v| most.max(v.abs()));
    if size > 1.0 / LARGEST { size } else { 1.0 }
}

/// The upper triangle by columns, with every entry stored.
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

/// The whole matrix by columns, with every entry stored.
fn full(rows: &[Vec<f64>], n: usize, m: usize) -> CscMatrix<f64> {
    let starts = (0..=n).map(|column| column * m).collect();
    let indices = (0..n).flat_map(|_| 0..m).collect();
    let values = (0..n).flat_map(|column| rows.iter().map(move |row| row[column])).collect();
    CscMatrix::new(m, n, starts, indices, values)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Minimise (x0 - 1)^2 + (x1 + 2)^2 within plus and minus `bound`.
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
    fn what_is_no_problem_of_ours_has_a_status_too() {
        let mut solver = QpSolver::default();
        // No constraints and no curvature: no lower bound.
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
