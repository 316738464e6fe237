//! Lessons as batched tensors.

use candle_core::{Device, Result, Tensor};
use pushplan::internals::network::Statistics;
use pushplan_act::belief::{JointType, RegulatorFeatures};
use pushplan_act::regulator::{LEAST, TYPES};

use crate::dataset::Lesson;
use crate::network::{RegulatorGraph, Unrolled};

/// Weights of the first and the last window in the loss (Tekden 2020, section 8.1.3, starts at
/// zero). Late beliefs must be correct, early ones may be undecided.
const WEIGHT: [f32; 2] = [0.2, 2.0];

/// Weight of squared changes of hidden states in the loss, as in the original work, which keeps
/// hidden states smooth over time.
const CHANGES: f64 = 1e-6;

/// Bound of normalised features, equal to the bound in the cell.
const BOUND: f32 = 10.0;

/// Lesson with its windows for training.
pub(super) type Heard<'a> = (&'a Lesson, Vec<&'a RegulatorFeatures>);

/// Inputs of the loss apart from the network's outputs.
pub(super) struct Examples {
    unrolled: Unrolled,
    /// T tensors [P, 4]: logarithms of the filter's probabilities.
    filtered: Vec<Tensor>,
    /// T tensors [P, 4]: the weight at the true type, otherwise 0.
    wanted: Vec<Tensor>,
    /// Sum of all weights.
    weight: f64,
}

impl Examples {
    /// Creates a batch of `lessons`; shorter lessons are padded with uninformative windows.
    pub fn new(lessons: &[Heard], scales: &Statistics) -> Result<Self> {
        let windows = lessons.iter().map(|(_, windows)| windows.len()).max().unwrap_or(0);
        let pairs: usize = lessons.iter().map(|(lesson, _)| lesson.pairs.len()).sum();
        let f = scales.mean.len();
        let mut ends = [Vec::with_capacity(pairs), Vec::with_capacity(pairs)];
        let mut objects = 0;
        for (lesson, _) in lessons {
            for pair in &lesson.pairs {
                for (ends, object) in ends.iter_mut().zip(pair) {
                    ends.push((objects + object) as u32);
                }
            }
            objects += lesson.objects;
        }
        let tensor = |values: Vec<f32>, columns: usize| {
            Tensor::from_vec(values, (pairs, columns), &Device::Cpu)
        };
        let [mut features, mut informative, mut filtered, mut wanted] =
            [const { Vec::<Tensor>::new() }; 4];
        let mut weight = 0.0;
        for t in 0..windows {
            let mut rows = vec![0.0; pairs * f];
            let [mut known, mut before, mut right] =
                [vec![0.0; pairs], vec![0.0; pairs * TYPES], vec![0.0; pairs * TYPES]];
            let mut first = 0;
            for (lesson, windows) in lessons {
                let through = windows.len().saturating_sub(1).max(1) as f32;
                if let Some(window) = windows.get(t) {
                    let late = WEIGHT[0] + (WEIGHT[1] - WEIGHT[0]) * t as f32 / through;
                    for p in (0..lesson.pairs.len()).filter(|p| window.informative[*p]) {
                        let row = first + p;
                        known[row] = 1.0;
                        let from = &window.features[p * f..][..f];
                        for (k, (into, x)) in rows[row * f..][..f].iter_mut().zip(from).enumerate()
                        {
                            let x = (x - scales.mean[k]) / scales.deviation[k];
                            *into = x.clamp(-BOUND, BOUND);
                        }
                        for kind in JointType::ALL {
                            let k = kind as usize;
                            before[row * TYPES + k] = window.filtered[p][k].max(LEAST).ln() as f32;
                        }
                        right[row * TYPES + lesson.types[p] as usize] = late;
                        weight += f64::from(late);
                    }
                }
                first += lesson.pairs.len();
            }
            features.push(tensor(rows, f)?);
            informative.push(tensor(known, 1)?);
            filtered.push(tensor(before, TYPES)?);
            wanted.push(tensor(right, TYPES)?);
        }
        let ends = ends.map(|ends| Tensor::from_vec(ends, pairs, &Device::Cpu));
        let [a, b] = ends;
        let unrolled = Unrolled { features, informative, ends: [a?, b?], objects };
        Ok(Self { unrolled, filtered, wanted, weight })
    }

    /// Returns the weighted cross entropy of the regulated beliefs plus the penalty on hidden
    /// changes.
    pub fn loss(&self, network: &RegulatorGraph) -> Result<Tensor> {
        let (outputs, changes) = network.forward(&self.unrolled)?;
        let mut loss = (changes * CHANGES)?;
        for ((outputs, filtered), wanted) in outputs.iter().zip(&self.filtered).zip(&self.wanted) {
            let logits = RegulatorGraph::corrected(outputs, filtered)?;
            let shares = logits.broadcast_sub(&logits.log_sum_exp(1)?.unsqueeze(1)?)?;
            loss = (loss - ((shares * wanted)?.sum_all()? / self.weight.max(1e-9))?)?;
        }
        Ok(loss)
    }
}
