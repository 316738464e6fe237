//! Accuracy of a regulator on held-out lessons.

use std::fmt;

use pushplan_act::regulator::{Memory, Regulator};
use serde::{Deserialize, Serialize};

use crate::dataset::Lesson;

/// Accuracy of final beliefs about pairs of which an object moved by more than 1 cm.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RegulatorScore {
    /// Number of pairs that count.
    pub pairs: usize,
    /// Share of pairs whose most probable type is correct, by the filter alone and regulated.
    pub right: [f64; 2],
    /// Mean negative log-probability of the true type, by the filter alone and regulated.
    pub nll: [f64; 2],
}

/// Summary for the progress display.
impl fmt::Display for RegulatorScore {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([filter, right], [of_filter, nll]) = (self.right.map(|share| 1e2 * share), self.nll);
        write!(f, "correct {right:.1} % (filter {filter:.1} %), nll {nll:.3} ({of_filter:.3})")
    }
}

/// Evaluates `regulator` on `lessons`.
pub fn score(regulator: &Regulator, lessons: &[Lesson]) -> RegulatorScore {
    let mut score = RegulatorScore::default();
    for lesson in lessons {
        let mut memory = Memory::default();
        // Results of the filter alone and of the regulator.
        let mut probabilities = vec![None; lesson.pairs.len()];
        for window in &lesson.windows {
            let pairs = (&lesson.pairs[..], lesson.objects);
            let answers = regulator.step(&window.features, &window.informative, pairs, &mut memory);
            for (p, answer) in answers.into_iter().enumerate() {
                let Some(answer) = answer else { continue };
                probabilities[p] =
                    Some([window.filtered[p], answer.of_filtered(&window.filtered[p])]);
            }
        }
        for p in (0..lesson.pairs.len()).filter(|p| lesson.moved[*p]) {
            let Some(both) = probabilities[p] else { continue };
            score.pairs += 1;
            for (which, shares) in both.into_iter().enumerate() {
                let all: f64 = shares.iter().sum();
                let truth = shares[lesson.types[p] as usize];
                let right = shares.iter().all(|share| *share <= truth);
                score.right[which] += f64::from(u8::from(right));
                score.nll[which] -= (truth / all).max(1e-12).ln();
            }
        }
    }
    let count = score.pairs.max(1) as f64;
    score.right = score.right.map(|right| right / count);
    score.nll = score.nll.map(|nll| nll / count);
    score
}
