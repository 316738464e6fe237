//! Regression in its dual form, whose size is the number of recorded values instead of parameters.

use nalgebra::{DMatrix, DVector};

use crate::fit::NoiseLaw;
use crate::fit::likelihood::FREEDOM;
use pushplan::scene::TableFit;

use super::observed::Observed;

/// Number of reweighting rounds, after which weights and width change by less than 0.001.
const ROUNDS: usize = 8;

/// Regression problem over all recorded values.
#[derive(Clone, Debug)]
pub(super) struct Regression {
    /// Recorded values, [n].
    targets: DVector<f64>,
    /// Rows of the Jacobian, [n, P].
    rows: DMatrix<f64>,
    /// Gram matrix of the rows, [n, n].
    gram: DMatrix<f64>,
    /// First value and number of values of each object.
    blocks: Vec<(usize, usize)>,
    /// Prior mean, [P].
    before: Vec<f64>,
    /// Variances of the trailing pseudo-observations from an earlier fit, relative to the prior.
    known: Vec<f64>,
    law: NoiseLaw,
    /// Minimum width of the noise, metres.
    least: f64,
}

/// Posterior for one width of the prior.
#[derive(Clone, Debug)]
pub(super) struct Solved {
    /// Standard deviation of the prior.
    pub prior: f64,
    /// Posterior mean, [P].
    pub mean: Vec<f64>,
    /// Width of the noise, metres.
    pub noise: f64,
    /// Noise variance of every value, [n].
    variances: DVector<f64>,
}

impl Regression {
    /// Creates the regression from observations linearised at a head of `mean`.
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
                let explained: f64 = row.iter().zip(mean).map(|(a, b)| a * b).sum();
                targets[next] = residual + explained;
                rows.row_mut(next).iter_mut().zip(row).for_each(|(to, value)| *to = *value);
                next += 1;
            }
        }
        let gram = &rows * rows.transpose();
        let (before, known) = (vec![0.0; mean.len()], Vec::new());
        Self { targets, rows, gram, blocks, before, known, law, least }
    }

    /// Adds the posterior of an earlier fit as prior knowledge.
    ///
    /// Each direction in which that posterior is narrow becomes a pseudo-observation. Across these
    /// directions its mean becomes the prior mean.
    pub fn after(mut self, TableFit { head, spread, .. }: &TableFit) -> Self {
        let dot = |direction: &[f32], values: &[f64]| -> f64 {
            direction.iter().zip(values).map(|(a, b)| f64::from(*a) * b).sum()
        };
        // A remaining variance of zero would cause a division by zero.
        let narrowed = spread.directions.iter().filter(|one| one.left < 1.0 && one.left > 0.0);
        let narrowed: Vec<_> = narrowed.collect();
        let mut across = head.clone();
        for one in &narrowed {
            let along = dot(&one.direction, head);
            let pairs = across.iter_mut().zip(&one.direction);
            pairs.for_each(|(value, part)| *value -= along * f64::from(*part));
        }
        let (seen, all) = (self.targets.len(), self.targets.len() + narrowed.len());
        for (target, row) in self.targets.iter_mut().zip(self.rows.row_iter()) {
            *target -= row.iter().zip(&across).map(|(a, b)| a * b).sum::<f64>();
        }
        self.targets = self.targets.resize_vertically(all, 0.0);
        self.rows = self.rows.resize_vertically(all, 0.0);
        for (k, one) in narrowed.iter().enumerate() {
            self.targets[seen + k] = dot(&one.direction, head) / (1.0 - one.left);
            let mut row = self.rows.row_mut(seen + k);
            row.iter_mut().zip(&one.direction).for_each(|(to, part)| *to = f64::from(*part));
            self.known.push(one.left / (1.0 - one.left));
        }
        self.gram = &self.rows * self.rows.transpose();
        self.before = across;
        self
    }

    /// Returns the posterior for this prior standard deviation; `None` if it does not exist.
    pub fn solve(&self, prior: f64) -> Option<Solved> {
        let count = self.targets.len();
        let seen = count - self.known.len();
        let signal = &self.gram * (prior * prior);
        let off = self.targets.rows(0, seen).norm_squared() / seen as f64;
        let mut square = (off / 2.0).max(self.least.powi(2));
        let mut weights = vec![1.0; self.blocks.len()];
        let mut state = None;
        for _ in 0..ROUNDS {
            let mut variances = DVector::zeros(count);
            for ((first, size), weight) in self.blocks.iter().zip(&weights) {
                variances.rows_mut(*first, *size).fill(square / weight);
            }
            for (variance, known) in
                variances.rows_mut(seen, count - seen).iter_mut().zip(&self.known)
            {
                *variance = prior * prior * known;
            }
            let mut sum = signal.clone();
            (0..count).for_each(|k| sum[(k, k)] += variances[k]);
            let inverse = sum.cholesky()?.inverse();
            let dual = &inverse * &self.targets;
            let residual = dual.component_mul(&variances);
            let free: f64 = (0..seen).map(|k| variances[k] * inverse[(k, k)]).sum();
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
        let mean = mean.iter().zip(&self.before).map(|(change, before)| before + change).collect();
        Some(Solved { prior, mean, noise: square.sqrt(), variances })
    }

    /// Returns at most `most` directions along which `solved` is narrowest, each with the remaining
    /// share of the prior's variance.
    pub fn directions(&self, solved: &Solved, most: usize) -> Vec<(f64, Vec<f64>)> {
        if solved.prior == 0.0 {
            return Vec::new();
        }
        // Left singular vectors of the weighted rows; the directions are the right singular
        // vectors.
        let mut weighted = self.rows.clone();
        for (k, mut row) in weighted.row_iter_mut().enumerate() {
            row *= solved.prior / solved.variances[k].sqrt();
        }
        let eigen = (&weighted * weighted.transpose()).symmetric_eigen();
        let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
        let narrowed =
            order.into_iter().filter(|&k| eigen.eigenvalues[k] > LEAST_INFORMATION).take(most);
        let direction = |k: usize| {
            let along = weighted.transpose() * eigen.eigenvectors.column(k);
            let length = along.norm();
            (1.0 / (1.0 + eigen.eigenvalues[k]), along.iter().map(|x| x / length).collect())
        };
        narrowed.map(direction).collect()
    }
}

/// Minimum information of a direction kept, relative to the prior's.
const LEAST_INFORMATION: f64 = 0.02;

#[cfg(test)]
mod tests;
