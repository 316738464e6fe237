//! An additive layer on propagated states, which recordings of one table can fit.

use crate::graph::Correction;

/// Number of halves of a hidden row: even and odd under mirroring.
const PARITIES: usize = 2;

/// Number of outputs that a head changes, in this order: displacements along and across the tool's
/// motion, and the rotation.
pub const HEAD_OUTPUTS: usize = 3;

/// Numbers that map the propagated state of a node to a change of its correction.
///
/// The hidden rows of the last layer are zero in steady pushes, so that a head on them could not
/// change these.
///
/// A trained network mirrors exactly: displacements along the motion are read from the even half of
/// the row, the others from the odd half. A real table does not mirror, because an object may rest
/// unevenly or a camera is off to one side. A head therefore reads both halves for every output:
/// [3, 2, h] numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Head {
    values: Vec<f64>,
    half: usize,
}

impl Head {
    /// Returns the number of values of a head on rows of twice `half`.
    pub const fn len_of(half: usize) -> usize {
        HEAD_OUTPUTS * PARITIES * half
    }

    /// Creates a head from its values, [3, 2, h]; `None` for any other number of values.
    pub fn new(values: Vec<f64>, half: usize) -> Option<Self> {
        (values.len() == Self::len_of(half)).then_some(Self { values, half })
    }

    /// Returns the head that changes nothing.
    pub fn none(half: usize) -> Self {
        Self { values: vec![0.0; Self::len_of(half)], half }
    }

    /// Returns the values, [3, 2, h].
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Returns the width of the half of a hidden row.
    pub fn half(&self) -> usize {
        self.half
    }

    /// Returns `true` if the head changes nothing.
    pub fn is_none(&self) -> bool {
        self.values.iter().all(|value| *value == 0.0)
    }

    /// Returns the head multiplied by `share`.
    pub fn scaled(&self, share: f64) -> Self {
        let values = self.values.iter().map(|value| share * value).collect();
        Self { values, half: self.half }
    }

    /// Adds the head's outputs for every node to `corrections`; `hidden` are their rows, [2, N, h].
    pub(super) fn add(&self, hidden: &[f32], corrections: &mut [Correction]) {
        let (even, odd) = hidden.split_at(hidden.len() / PARITIES);
        let rows = even.chunks_exact(self.half).zip(odd.chunks_exact(self.half));
        let dot = |values: &[f64], row: &[f32]| -> f64 {
            values.iter().zip(row).map(|(value, hidden)| value * f64::from(*hidden)).sum()
        };
        for ((even, odd), correction) in rows.zip(corrections) {
            let outputs = self.values.chunks_exact(PARITIES * self.half);
            for (k, values) in outputs.enumerate() {
                let (of_even, of_odd) = values.split_at(self.half);
                let change = dot(of_even, even) + dot(of_odd, odd);
                correction.head[k] += change;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_output_reads_both_halves_of_its_own_row() {
        // h = 1, two nodes: rows (2, 3) and (5, 7).
        let head = Head::new(vec![1.0, 10.0, 0.0, 1.0, 1.0, 0.0], 1).expect("six numbers");
        let one = Correction { head: [1.0; 3], ..Correction::default() };
        let mut corrections = [one; 2];
        head.add(&[2.0, 5.0, 3.0, 7.0], &mut corrections);
        assert_eq!(corrections[0].head, [33.0, 4.0, 3.0]);
        assert_eq!(corrections[1].head, [76.0, 8.0, 6.0]);
        assert!(Head::new(vec![0.0; 5], 1).is_none() && head.scaled(0.0).is_none());
    }
}
