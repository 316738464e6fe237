//! Agreement of predicted probabilities with observed frequencies.

/// Number of bins of probability.
const BINS: usize = 10;

/// Histogram of the probabilities of answers and of the true answers among them.
#[derive(Clone, Debug, Default)]
pub struct Calibration {
    /// Number of probabilities in every bin, their sum, and the number of true answers among them.
    bins: [[f64; 3]; BINS],
}

impl Calibration {
    /// Adds the probabilities of all answers, of which the answer with index `truth` is true.
    pub fn count(&mut self, probabilities: &[f64], truth: usize) {
        for (answer, probability) in probabilities.iter().enumerate() {
            let bin = ((probability * BINS as f64) as usize).min(BINS - 1);
            let hit = if answer == truth { 1.0 } else { 0.0 };
            self.bins[bin][0] += 1.0;
            self.bins[bin][1] += probability;
            self.bins[bin][2] += hit;
        }
    }

    /// Returns the expected calibration error over all answers (Guo et al. 2017, arXiv 1706.04599);
    /// 0 before anything was counted.
    pub fn error(&self) -> f64 {
        let count: f64 = self.bins.iter().map(|[n, ..]| n).sum();
        let apart: f64 = self.bins.iter().map(|[_, share, hit]| (share - hit).abs()).sum();
        if count > 0.0 { apart / count } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn certain_predictions_that_are_half_right_have_a_calibration_error_of_half() {
        let mut sure = Calibration::default();
        assert_eq!(sure.error(), 0.0);
        sure.count(&[1.0, 0.0], 0);
        assert_eq!(sure.error(), 0.0);
        sure.count(&[1.0, 0.0], 1);
        assert_eq!(sure.error(), 0.5);
        let mut even = Calibration::default();
        for truth in 0..4 {
            even.count(&[0.25; 4], truth);
        }
        assert_eq!(even.error(), 0.0);
    }
}
