//! Tests of `regression`.

use super::*;
use pushplan::scene::{HeadSpread, Narrowed};

/// Returns 60 final poses of two values that are linear in the parameters (0.3, -0.2), with an
/// error of alternating sign.
fn ends(error: f64) -> Vec<Observed> {
    (0..60)
        .map(|k| {
            let (a, b) = ((0.7 * f64::from(k)).sin(), (1.3 * f64::from(k)).cos());
            let rows = vec![vec![a, 0.0], vec![0.2 * a, b]];
            let sign = if k % 2 == 0 { error } else { -error };
            let explained = |row: &Vec<f64>| 0.3 * row[0] - 0.2 * row[1] + sign;
            Observed { residual: rows.iter().map(explained).collect(), rows }
        })
        .collect()
}

#[test]
fn the_mean_is_that_of_the_numbers_and_one_wild_end_hardly_moves_it() {
    let mut ends = ends(1e-3);
    ends[7].residual = vec![3.0, 3.0];
    let of = |law| Regression::new(&ends, &[0.0; 2], law, 1e-6).solve(1.0).expect("a posterior");
    let robust = of(NoiseLaw::Student);
    assert!((robust.mean[0] - 0.3).abs() < 3e-3, "{:?}", robust.mean);
    assert!((robust.mean[1] + 0.2).abs() < 3e-3, "{:?}", robust.mean);
    let gaussian = of(NoiseLaw::Gaussian);
    assert!(robust.noise < 0.1 * gaussian.noise, "{} {}", robust.noise, gaussian.noise);
}

#[test]
fn the_remaining_prior_equals_the_normal_equations() {
    let regression = Regression::new(&ends(1e-2), &[0.0; 2], NoiseLaw::Gaussian, 1e-6);
    let solved = regression.solve(0.5).expect("one");
    let directions = regression.directions(&solved, 8);
    assert_eq!(directions.len(), 2);
    let exact = (DMatrix::identity(2, 2) * 4.0
        + regression.rows.transpose() * &regression.rows / solved.noise.powi(2))
    .try_inverse()
    .expect("regular");
    let variance = |x: [f64; 2]| {
        let known =
            directions.iter().map(|(left, d)| (1.0 - left) * (x[0] * d[0] + x[1] * d[1]).powi(2));
        0.25 * (x[0] * x[0] + x[1] * x[1] - known.sum::<f64>())
    };
    assert!((variance([1.0, 0.0]) / exact[(0, 0)] - 1.0).abs() < 0.05);
    assert!((variance([0.0, 1.0]) / exact[(1, 1)] - 1.0).abs() < 0.05);
}

#[test]
fn sequential_updates_equal_one_batch_update() {
    let ends = ends(1e-2);
    // The lower bound of the noise is active in both, so observations are weighted equally.
    let of = |ends: &[Observed]| Regression::new(ends, &[0.0; 2], NoiseLaw::Gaussian, 2e-2);
    let solve = |regression: &Regression| regression.solve(0.5).expect("a posterior");
    let (all, half) = (of(&ends), of(&ends[..30]));
    let (together, first) = (solve(&all), solve(&half));
    let narrowed = half.directions(&first, 8).into_iter().map(|(left, direction)| Narrowed {
        left,
        direction: direction.into_iter().map(|value| value as f32).collect(),
    });
    let spread = HeadSpread { prior: 0.5, directions: narrowed.collect() };
    let before = TableFit { head: first.mean, spread, ..TableFit::default() };
    let later = of(&ends[30..]).after(&before);
    let then = solve(&later);
    for (a, b) in then.mean.iter().zip(&together.mean) {
        assert!((a - b).abs() < 1e-6, "{:?} {:?}", then.mean, together.mean);
    }
    let lefts = |regression: &Regression, solved| -> Vec<f64> {
        regression.directions(solved, 8).into_iter().map(|(left, _)| left).collect()
    };
    for (a, b) in lefts(&later, &then).iter().zip(lefts(&all, &together)) {
        assert!((a - b).abs() < 1e-6 * b.max(1e-3));
    }
}
