//! Quadratic programmes with numbers that refinement should never produce, and may.
//!
//! All are of the shape that refinement solves: 1/2 x'Px + q'x within low <= x <= high, some
//! with scaled or repeated rows. The reference is coordinate descent, which for a convex
//! quadratic over a box converges to the minimum (Tseng 2001, J. Optim. Theory Appl. 109, 475).

use crate::plan::{QpProblem, QpSolver, QpStatus};

use super::report::ProgrammeCell;

/// A constraint may be missed by this share of its row's size.
const VIOLATION: f64 = 1e-6;

/// The objective may be above the reference's by this share of its range.
const EXCESS: f64 = 1e-4;

/// Sweeps of the reference.
const SWEEPS: usize = 20_000;

/// What should come of a programme.
enum Expected {
    /// The minimum.
    Minimum,
    /// This status, and no answer.
    Status(QpStatus),
    /// Any status, but no answer that is not finite or breaks a constraint.
    Anything,
}

struct Programme {
    name: &'static str,
    p: Vec<Vec<f64>>,
    q: Vec<f64>,
    low: Vec<f64>,
    high: Vec<f64>,
    /// Every constraint is multiplied by this.
    rows: f64,
    expected: Expected,
}

/// Solves all of them one after another, with one solver as refinement does.
pub(super) fn programmes() -> Vec<ProgrammeCell> {
    let mut solver = QpSolver::default();
    let mut cells: Vec<ProgrammeCell> =
        list().iter().map(|programme| solve(programme, &mut solver)).collect();
    // After all that it must still solve an ordinary one.
    cells.push(solve(&Programme { name: "an ordinary one at the end", ..ordinary() }, &mut solver));
    cells
}

/// Minimise (x0 - 1)^2 + (x1 + 2)^2 within plus and minus 1.5.
fn ordinary() -> Programme {
    Programme {
        name: "an ordinary one",
        p: vec![vec![2.0, 0.0], vec![0.0, 2.0]],
        q: vec![-2.0, 4.0],
        low: vec![-1.5; 2],
        high: vec![1.5; 2],
        rows: 1.0,
        expected: Expected::Minimum,
    }
}

fn list() -> Vec<Programme> {
    let with = |name: &'static str, change: &dyn Fn(&mut Programme)| {
        let mut programme = Programme { name, ..ordinary() };
        change(&mut programme);
        programme
    };
    let scaled = |by: [f64; 2]| {
        move |programme: &mut Programme| {
            for i in 0..2 {
                for j in 0..2 {
                    programme.p[i][j] *= by[i] * by[j];
                }
                programme.q[i] *= by[i];
            }
        }
    };
    let parallel = |apart: f64| {
        move |programme: &mut Programme| {
            // Columns [1, 0] and [1, apart] of J: P = 2 J'J.
            programme.p = vec![vec![2.0, 2.0], vec![2.0, 2.0 + 2.0 * apart * apart]];
            programme.q = vec![-2.0, -2.0 - 2.0 * apart];
        }
    };
    let bounds = |low: f64, high: f64| {
        move |programme: &mut Programme| {
            programme.low = vec![low; 2];
            programme.high = vec![high; 2];
        }
    };
    let mut list = vec![
        ordinary(),
        with("zero column, nothing pulls", &|p| {
            p.p = vec![vec![0.0, 0.0], vec![0.0, 2.0]];
            p.q = vec![0.0, 4.0];
        }),
        with("zero column that pulls", &|p| p.p = vec![vec![0.0, 0.0], vec![0.0, 2.0]]),
        with("all columns zero", &|p| {
            p.p = vec![vec![0.0; 2]; 2];
            p.q = vec![0.0; 2];
        }),
        with("parallel columns", &parallel(0.0)),
        with("columns 1e-3 from parallel", &parallel(1e-3)),
        with("columns 1e-8 from parallel", &parallel(1e-8)),
        with("columns 1 : 1e3", &scaled([1.0, 1e3])),
        with("columns 1e-3 : 1e3", &scaled([1e-3, 1e3])),
        with("columns 1e-5 : 1e5", &scaled([1e-5, 1e5])),
        with("columns all times 1e-6", &scaled([1e-6; 2])),
        with("columns all times 1e5", &scaled([1e5; 2])),
        with("goal 1e9 tolerances away", &|p| p.q = vec![-2e9, 4e9]),
        with("rows times 1e-6", &|p| p.rows = 1e-6),
        with("rows times 1e6", &|p| p.rows = 1e6),
        with("zero trust region", &bounds(0.0, 0.0)),
        with("trust region 1e-9", &bounds(-1e-9, 1e-9)),
        with("trust region 1e9", &bounds(-1e9, 1e9)),
        with("bounds on one side only", &bounds(0.0, 1e6)),
        Programme {
            expected: Expected::Status(QpStatus::Infeasible),
            ..with("contradictory bounds", &bounds(1.0, -1.0))
        },
        Programme {
            expected: Expected::Status(QpStatus::Infeasible),
            ..with("bounds that miss by 1e-3", &bounds(5e-4, -5e-4))
        },
        Programme {
            expected: Expected::Anything,
            ..with("bounds that miss by 1e-9", &bounds(5e-10, -5e-10))
        },
        Programme {
            expected: Expected::Anything,
            ..with("curved downwards", &|p| p.p = vec![vec![-2.0, 0.0], vec![0.0, 2.0]])
        },
    ];
    for (name, value) in [
        ("a number that is none", f64::NAN),
        ("an infinite number", f64::INFINITY),
        ("a number of 1e300", 1e300),
    ] {
        let bad = with(name, &|p| p.q[0] = value);
        list.push(Programme { expected: Expected::Status(QpStatus::BadProblem), ..bad });
    }
    list
}

fn solve(programme: &Programme, solver: &mut QpSolver) -> ProgrammeCell {
    let Programme { p, q, low, high, rows, .. } = programme;
    let n = q.len();
    let (mut a, mut b) = (Vec::new(), Vec::new());
    for i in 0..n {
        for (sign, limit) in [(1.0, high[i]), (-1.0, -low[i])] {
            let mut row = vec![0.0; n];
            row[i] = sign * rows;
            a.push(row);
            b.push(limit * rows);
        }
    }
    let solution = solver.solve(&QpProblem { p: p.clone(), q: q.clone(), a, b });
    let answered = matches!(solution.status, QpStatus::Solved | QpStatus::AlmostSolved);
    let violation = answered.then(|| {
        let beyond = |i: usize| (solution.x[i] - high[i]).max(low[i] - solution.x[i]);
        (0..n).map(|i| beyond(i) / (1.0 + high[i].abs())).fold(0.0, f64::max)
    });
    let excess = answered.then(|| {
        let best = objective(programme, &descend(programme));
        let above = objective(programme, &solution.x) - best;
        above / range(programme).max(f64::MIN_POSITIVE)
    });
    let kept = violation.is_none_or(|v| v <= VIOLATION);
    let finite = solution.x.iter().all(|v| v.is_finite());
    let sound = finite
        && kept
        && match &programme.expected {
            Expected::Minimum => excess.is_some_and(|excess| excess <= EXCESS),
            Expected::Status(status) => *status == solution.status,
            Expected::Anything => true,
        };
    ProgrammeCell { name: programme.name.into(), status: solution.status, violation, excess, sound }
}

fn objective(programme: &Programme, x: &[f64]) -> f64 {
    let Programme { p, q, .. } = programme;
    let product = |row: &[f64]| -> f64 { row.iter().zip(x).map(|(a, b)| a * b).sum() };
    let curved: f64 = x.iter().zip(p).map(|(v, row)| 0.5 * v * product(row)).sum();
    curved + product(q)
}

/// By how much the objective can differ within the box, or a thousandth of a step where the box
/// is smaller than that: finer answers mean nothing to a push.
fn range(programme: &Programme) -> f64 {
    let Programme { p, q, low, high, .. } = programme;
    let reach = |i: usize| low[i].abs().max(high[i].abs()).max(1e-3);
    let curved = |i: usize| -> f64 {
        p[i].iter().enumerate().map(|(j, v)| 0.5 * v.abs() * reach(i) * reach(j)).sum()
    };
    (0..q.len()).map(|i| q[i].abs() * reach(i) + curved(i)).sum()
}

/// The minimum over the box.
fn descend(programme: &Programme) -> Vec<f64> {
    let Programme { p, q, low, high, .. } = programme;
    let mut x = vec![0.0f64; q.len()];
    for _ in 0..SWEEPS {
        for i in 0..x.len() {
            let rest: f64 = (0..x.len()).filter(|j| *j != i).map(|j| p[i][j] * x[j]).sum();
            let pull = q[i] + rest;
            let free = if p[i][i] > 0.0 {
                -pull / p[i][i]
            } else if pull == 0.0 {
                x[i]
            } else {
                -pull.signum() * f64::MAX
            };
            x[i] = free.max(low[i]).min(high[i]);
        }
    }
    x
}
