//! Page data of runs and recordings, and tables of further results.

use serde::Serialize;

use crate::table::{Align, Table};

/// Pushes of a run or a recording, and the belief over time.
#[derive(Serialize)]
pub struct Run {
    /// Kind of record, in one word.
    pub kind: &'static str,
    /// Explanation of when the belief changes, in a sentence.
    pub words: &'static str,
    /// Names of the columns of [`Made::cells`].
    pub columns: Vec<String>,
    /// Whether each column is numeric.
    pub numeric: Vec<bool>,
    pub made: Vec<Made>,
    /// Times at which the belief changes, the start first.
    pub times: Vec<i64>,
    /// Names of the types of joints.
    pub types: Vec<String>,
    pub joints: Vec<Joined>,
    pub numbers: Vec<Believed>,
}

/// Table of further results.
#[derive(Serialize)]
pub struct Found {
    pub title: String,
    pub columns: Vec<String>,
    /// Whether each column is numeric.
    pub numeric: Vec<bool>,
    pub rows: Vec<Vec<String>>,
}

impl Found {
    /// Returns a table with a title.
    pub fn of(title: &str, table: &Table) -> Self {
        let columns = table.columns();
        Self {
            title: title.to_owned(),
            columns: columns.iter().map(|(name, _)| name.clone()).collect(),
            numeric: columns.iter().map(|(_, side)| *side == Align::Right).collect(),
            rows: table.rows().to_vec(),
        }
    }
}

/// Continuous pushing sequence.
#[derive(Serialize)]
pub struct Made {
    /// Start time.
    pub at: i64,
    pub cells: Vec<String>,
}

/// Belief about the joint of two objects.
#[derive(Serialize)]
pub struct Joined {
    pub name: String,
    /// Type probabilities at each of [`Run::times`], in thousandths.
    pub shares: Vec<[i64; 4]>,
    /// Index of the true type, if known.
    pub really: Option<usize>,
}

/// Belief about a number.
#[derive(Serialize)]
pub struct Believed {
    pub name: String,
    pub unit: &'static str,
    /// Mean and standard deviation at each of [`Run::times`], in thousandths.
    pub values: Vec<[i64; 2]>,
    /// True value, if known.
    pub really: Option<i64>,
}
