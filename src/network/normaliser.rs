//! Feature scales, measured on training data and stored with the weights.

use serde::{Deserialize, Serialize};

use super::{Rows, Tables};

/// Mean and standard deviation of one feature table's columns.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Statistics {
    /// Mean of each column; zero for odd features, whose sign must be kept.
    pub mean: Vec<f32>,
    /// Standard deviation of each column, at least `MIN_DEVIATION`.
    pub deviation: Vec<f32>,
}

/// Minimum scale of a column, in feature units, for columns that hardly vary.
pub(super) const MIN_DEVIATION: f32 = 0.02;

impl Statistics {
    /// Returns the statistics of a table without columns.
    fn none() -> Self {
        Self { mean: Vec::new(), deviation: Vec::new() }
    }

    /// Measures a table [N, `columns`]. Without `centred` means are zero, so that signs are kept.
    pub fn measure(table: &[f32], columns: usize, centred: bool) -> Self {
        if columns == 0 {
            return Self::none();
        }
        let rows = (table.len() / columns).max(1) as f64;
        let mut mean = vec![0.0f64; columns];
        let mut square = vec![0.0f64; columns];
        for row in table.chunks_exact(columns) {
            for (k, &x) in row.iter().enumerate() {
                mean[k] += f64::from(x) / rows;
                square[k] += f64::from(x) * f64::from(x) / rows;
            }
        }
        if !centred {
            mean.fill(0.0);
        }
        let deviation = mean
            .iter()
            .zip(&square)
            .map(|(m, s)| ((s - m * m).max(0.0).sqrt() as f32).max(MIN_DEVIATION))
            .collect();
        Self { mean: mean.iter().map(|&m| m as f32).collect(), deviation }
    }

    /// Returns `table` with every column shifted and scaled.
    pub fn apply(&self, table: &[f32]) -> Vec<f32> {
        let columns = self.mean.len();
        table
            .iter()
            .enumerate()
            .map(|(k, x)| (x - self.mean[k % columns]) / self.deviation[k % columns])
            .collect()
    }
}

/// Scales of all feature tables.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Normaliser {
    /// Statistics of even node features.
    pub node_even: Statistics,
    /// Statistics of odd node features.
    pub node_odd: Statistics,
    /// Statistics of even features of bodies with prescribed motion.
    #[serde(default = "Statistics::none")]
    pub given_even: Statistics,
    /// Statistics of odd features of bodies with prescribed motion.
    #[serde(default = "Statistics::none")]
    pub given_odd: Statistics,
    /// Statistics of even relation features.
    pub relation_even: Statistics,
    /// Statistics of odd relation features.
    pub relation_odd: Statistics,
}

impl Normaliser {
    /// Measures the scales on a large batch.
    pub fn measure<'a>(tables: &Tables, rows: impl Into<Rows<'a>>) -> Self {
        let Tables { node, given, relation, .. } = *tables;
        let rows = rows.into();
        Self {
            node_even: Statistics::measure(rows.node_even, node[0], true),
            node_odd: Statistics::measure(rows.node_odd, node[1], false),
            given_even: Statistics::measure(rows.given_even, given[0], true),
            given_odd: Statistics::measure(rows.given_odd, given[1], false),
            relation_even: Statistics::measure(rows.relation_even, relation[0], true),
            relation_odd: Statistics::measure(rows.relation_odd, relation[1], false),
        }
    }
}
