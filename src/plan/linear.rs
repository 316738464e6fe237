//! Linear model fitted to a few points by least squares.
//!
//! Around a known point y0 = f(0), the slopes J of y - y0 = J u are fitted to samples (u, y) by the
//! normal equations. A small ridge gives zero slope to directions without samples.

use nalgebra::{DMatrix, DVector};

/// Ridge in units of the mean square of the samples, far below any meaningful slope.
const RIDGE: f64 = 1e-6;

/// Returns the slopes by output: `slopes[k][i]` is the change of output k per unit of u_i. All
/// slopes are zero if there are no samples or the numbers do not allow a fit.
pub(super) fn slopes(
    samples: &[(Vec<f64>, Vec<f64>)],
    inputs: usize,
    outputs: usize,
) -> Vec<Vec<f64>> {
    let none = vec![vec![0.0; inputs]; outputs];
    if samples.is_empty() || inputs == 0 {
        return none;
    }
    let u = DMatrix::from_fn(samples.len(), inputs, |row, column| samples[row].0[column]);
    let mut normal = u.transpose() * &u;
    let scale = normal.trace() / inputs as f64;
    for i in 0..inputs {
        normal[(i, i)] += RIDGE * scale + f64::MIN_POSITIVE;
    }
    let Some(factor) = normal.cholesky() else { return none };
    (0..outputs)
        .map(|k| {
            let y = DVector::from_fn(samples.len(), |row, _| samples[row].1[k]);
            let slope = factor.solve(&(u.transpose() * y));
            let sound = slope.iter().all(|v| v.is_finite());
            if sound { slope.iter().copied().collect() } else { vec![0.0; inputs] }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_function_is_found_and_an_untried_direction_is_flat() {
        let samples: Vec<_> = [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]
            .into_iter()
            .map(|u| (u.to_vec(), vec![3.0 * u[0] - u[1], 0.5 * u[1]]))
            .collect();
        let found = slopes(&samples, 3, 2);
        let expected = [[3.0, -1.0, 0.0], [0.0, 0.5, 0.0]];
        for (row, wanted) in found.iter().zip(expected) {
            for (a, b) in row.iter().zip(wanted) {
                assert!((a - b).abs() < 1e-4, "{found:?}");
            }
        }
        assert_eq!(slopes(&[], 2, 1), vec![vec![0.0, 0.0]]);
    }
}
