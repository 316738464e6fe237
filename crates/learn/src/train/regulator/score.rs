//! How right a regulator is on lessons that it did not learn from.

use std::fmt;

use pushplan_act::regulator::{Memory, Regulator};
use serde::{Deserialize, Serialize};

use crate::dataset::Lesson;

/// Beliefs at the end of lessons, about pairs of which one moved by more than 1 cm.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RegulatorScore {
    /// Pairs counted.
    pub pairs: usize,
    /// Share whose likeliest type is the true one, of the filter alone and regulated.
    pub right: [f64; 2],
    /// Mean negative logarithm of the probability of the true type, of the same two.
    pub nll: [f64; 2],
}

/// What a person wants to follow.
impl fmt::Display for RegulatorScore {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([filter, right], [of_filter, nll]) = (self.right.map(|share| 1e2 * share), self.nll);
        write!(f, "right {right:.1} % (filter {filter:.1} %), nll {nll:.3} ({of_filter:.3})")
    }
}

/// How right `regulator` is on `lessons`.
pub fn score(regulator: &Regulator, lessons: &[Lesson]) -> RegulatorScore {
    let mut score = RegulatorScore::default();
    for lesson in lessons {
        let mut memory = Memory::default();
        // By the filter alone and regulated.
        let mut told = vec![None; lesson.pairs.len()];
        for window in &lesson.windows {
            let pairs = (&lesson.pairs[..], lesson.objects);
            let answers = regulator.step(&window.features, &window.told, pairs, &mut memory);
            for (p, answer) in answers.into_iter().enumerate() {
                let Some(answer) = answer else { continue };
                told[p] = Some([window.filtered[p], answer.of_filtered(&window.filtered[p])]);
            }
        }
        for p in (0..lesson.pairs.len()).filter(|p| lesson.moved[*p]) {
            let Some(both) = told[p] else { continue };
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
