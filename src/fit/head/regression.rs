//! The regression in its dual form: as large as there are recorded numbers, not parameters.

use nalgebra::{DMatrix, DVector};

use crate::fit::NoiseLaw;
use crate::fit::likelihood::FREEDOM;

use super::observed::Observed;

/// Rounds of reweighting: weights and width then stand still to a thousandth.
const ROUNDS: usize = 8;

/// All recorded numbers, and what they share.
#[derive(Clone, Debug)]
pub(super) struct Regression {
    /// [n].
    targets: DVector<f64>,
    /// [n, P].
    rows: DMatrix<f64>,
    /// Rows times rows, [n, n].
    gram: DMatrix<f64>,
    /// First number of each object's end, and how many.
    blocks: Vec<(usize, usize)>,
    law: NoiseLaw,
    /// The noise is never taken as narrower, metres.
    least: f64,
}

/// A posterior for one width of the prior.
#[derive(Clone, Debug)]
pub(super) struct Solved {
    /// The prior's deviation.
    pub prior: f64,
    /// The mean, [P].
    pub mean: Vec<f64>,
    /// Width of the noise, metres.
    pub noise: f64,
    /// Variance of every number's noise, [n].
    variances: DVector<f64>,
}

impl Regression {
    /// Of what was observed at a head of `mean`.
    pub fn new<'a>(
        observed: impl IntoIterator<Item = &'a Observed>,
        mean: &[f64],
        law: NoiseLaw,
        least: f64,
    ) -> Self {
        let observed: Vec<&Observed> = observed.into_iter().collect();
        let count = observed.iter().map(|one| one.residual.len()).sum();
        let mut rows = DMatrix::zeros(count, mean.len());
        let mut targets = DVector::zeros(count);
        let mut blocks = Vec::new();
        let mut next = 0;
        for one in observed {
            blocks.push((next, one.residual.len()));
            for (residual, row) in one.residual.iter().zip(&one.rows) {
                let said: f64 = row.iter().zip(mean).map(|(a, b)| a * b).sum();
                targets[next] = residual + said;
                rows.row_mut(next).iter_mut().zip(row).for_each(|(to, value)| *to = *value);
                next += 1;
            }
        }
        let gram = &rows * rows.transpose();
        Self { targets, rows, gram, blocks, law, least }
    }

    /// The posterior with a prior of this deviation; `None` if the numbers allow none.
    pub fn solve(&self, prior: f64) -> Option<Solved> {
        let count = self.targets.len();
        let signal = &self.gram * (prior * prior);
        let mut square = (self.targets.norm_squared() / count as f64 / 2.0).max(self.least.powi(2));
        let mut weights = vec![1.0; self.blocks.len()];
        let mut state = None;
        for _ in 0..ROUNDS {
            let mut variances = DVector::zeros(count);
            for ((first, size), weight) in self.blocks.iter().zip(&weights) {
                variances.rows_mut(*first, *size).fill(square / weight);
            }
            let mut sum = signal.clone();
            (0..count).for_each(|k| sum[(k, k)] += variances[k]);
            let inverse = sum.cholesky()?.inverse();
            let dual = &inverse * &self.targets;
            let residual = dual.component_mul(&variances);
            let free: f64 = (0..count).map(|k| variances[k] * inverse[(k, k)]).sum();
            let mut weighted = 0.0;
            for ((first, size), weight) in self.blocks.iter().zip(&mut weights) {
                let far = residual.rows(*first, *size).norm_squared();
                weighted += *weight * far;
                *weight = match self.law {
                    NoiseLaw::Gaussian => 1.0,
                    NoiseLaw::Student => (FREEDOM + *size as f64) / (FREEDOM + far / square),
                };
            }
            let width = square;
            square = (weighted / free).max(self.least.powi(2));
            state = Some((dual, variances, width));
        }
        let (dual, variances, square) = state?;
        let mean = self.rows.transpose() * &dual * (prior * prior);
        let mean = mean.iter().copied().collect();
        Some(Solved { prior, mean, noise: square.sqrt(), variances })
    }

    /// The directions along which `solved` is narrowest, at most `most`, with the share of the
    /// prior's variance that is left.
    pub fn directions(&self, solved: &Solved, most: usize) -> Vec<(f64, Vec<f64>)> {
        if solved.prior == 0.0 {
            return Vec::new();
        }
        // The left singular vectors of the weighted rows; the directions are the right ones.
        let mut weighted = self.rows.clone();
        for (k, mut row) in weighted.row_iter_mut().enumerate() {
            row *= solved.prior / solved.variances[k].sqrt();
        }
        let eigen = (&weighted * weighted.transpose()).symmetric_eigen();
        let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
        let told = order.into_iter().filter(|&k| eigen.eigenvalues[k] > TOLD).take(most);
        let direction = |k: usize| {
            let along = weighted.transpose() * eigen.eigenvectors.column(k);
            let length = along.norm();
            (1.0 / (1.0 + eigen.eigenvalues[k]), along.iter().map(|x| x / length).collect())
        };
        told.map(direction).collect()
    }
}

/// Directions of which the recordings say less than this share of what the prior does are left out.
const TOLD: f64 = 0.02;

#[cfg(test)]
mod tests {
    use super::*;

    /// 60 ends of two numbers that follow two parameters, (0.3, -0.2) and nothing else, with an
    /// error of alternating sign.
    fn ends(error: f64) -> Vec<Observed> {
        (0..60)
            .map(|k| {
                let (a, b) = ((0.7 * f64::from(k)).sin(), (1.3 * f64::from(k)).cos());
                let rows = vec![vec![a, 0.0], vec![0.2 * a, b]];
                let sign = if k % 2 == 0 { error } else { -error };
                let said = |row: &Vec<f64>| 0.3 * row[0] - 0.2 * row[1] + sign;
                Observed { residual: rows.iter().map(said).collect(), rows }
            })
            .collect()
    }

    #[test]
    fn the_mean_is_that_of_the_numbers_and_one_wild_end_hardly_moves_it() {
        let mut ends = ends(1e-3);
        ends[7].residual = vec![3.0, 3.0];
        let of =
            |law| Regression::new(&ends, &[0.0; 2], law, 1e-6).solve(1.0).expect("a posterior");
        let robust = of(NoiseLaw::Student);
        assert!((robust.mean[0] - 0.3).abs() < 3e-3, "{:?}", robust.mean);
        assert!((robust.mean[1] + 0.2).abs() < 3e-3, "{:?}", robust.mean);
        assert!(robust.noise < 3e-3 && of(NoiseLaw::Gaussian).noise > 0.1);
    }

    #[test]
    fn what_is_left_of_the_prior_is_what_the_normal_equations_say() {
        let regression = Regression::new(&ends(1e-2), &[0.0; 2], NoiseLaw::Gaussian, 1e-6);
        let solved = regression.solve(0.5).expect("one");
        let directions = regression.directions(&solved, 8);
        assert_eq!(directions.len(), 2);
        let exact = (DMatrix::identity(2, 2) * 4.0
            + regression.rows.transpose() * &regression.rows / solved.noise.powi(2))
        .try_inverse()
        .expect("regular");
        let variance = |x: [f64; 2]| {
            let known = directions
                .iter()
                .map(|(left, d)| (1.0 - left) * (x[0] * d[0] + x[1] * d[1]).powi(2));
            0.25 * (x[0] * x[0] + x[1] * x[1] - known.sum::<f64>())
        };
        assert!((variance([1.0, 0.0]) / exact[(0, 0)] - 1.0).abs() < 0.05);
        assert!((variance([0.0, 1.0]) / exact[(1, 1)] - 1.0).abs() < 0.05);
    }
}
