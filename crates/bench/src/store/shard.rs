//! Shards of a benchmark.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Shard `number` of `of`: the tasks whose index modulo `of` is `number - 1`, so that alternating
/// kinds of tasks are distributed evenly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "Numbers", into = "Numbers")]
pub struct Shard {
    number: usize,
    of: usize,
}

/// Error of an invalid shard.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error(
    "`{text}` is not a shard; write i/n with i from 1 to n, and n at most {most}",
    most = Shard::MOST
)]
pub struct ShardError {
    text: String,
}

/// Shard as stored in the manifest.
#[derive(Clone, Copy, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Numbers {
    number: usize,
    of: usize,
}

impl Shard {
    /// Maximum number of shards of a run, a bound for practical merges.
    pub const MOST: usize = 100_000;

    /// The only shard of an unsplit run.
    pub const WHOLE: Shard = Shard { number: 1, of: 1 };

    /// Returns shard `number`, from 1, of `of`.
    ///
    /// # Errors
    /// Returns an error if there is no such shard.
    pub fn new(number: usize, of: usize) -> Result<Self, ShardError> {
        if (1..=of).contains(&number) && of <= Self::MOST {
            Ok(Self { number, of })
        } else {
            Err(ShardError { text: format!("{number}/{of}") })
        }
    }

    /// Returns the shard's number, from 1.
    pub fn number(self) -> usize {
        self.number
    }

    /// Returns the number of shards.
    pub fn of(self) -> usize {
        self.of
    }

    /// Returns the indices of the shard's tasks among `count`, ascending.
    pub fn indices(self, count: usize) -> impl ExactSizeIterator<Item = usize> + Clone {
        (self.number - 1..count.max(self.number - 1)).step_by(self.of)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        let wrong = || ShardError { text: text.to_owned() };
        let (number, of) = text.split_once('/').ok_or_else(wrong)?;
        let number = number.parse().map_err(|_| wrong())?;
        Shard::new(number, of.parse().map_err(|_| wrong())?)
    }
}

impl TryFrom<Numbers> for Shard {
    type Error = ShardError;

    fn try_from(numbers: Numbers) -> Result<Self, ShardError> {
        Shard::new(numbers.number, numbers.of)
    }
}

impl From<Shard> for Numbers {
    fn from(shard: Shard) -> Self {
        Self { number: shard.number, of: shard.of }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_task_is_in_one_shard() {
        for (count, of) in [(0, 1), (1, 3), (7, 3), (9, 3), (10, 4)] {
            let mut all: Vec<usize> = (1..=of)
                .flat_map(|number| Shard::new(number, of).expect("a shard").indices(count))
                .collect();
            all.sort_unstable();
            assert_eq!(all, (0..count).collect::<Vec<_>>(), "{count} tasks in {of} shards");
        }
    }

    #[test]
    fn invalid_shards_are_refused() {
        assert_eq!("2/4".parse(), Shard::new(2, 4));
        for text in ["", "2", "0/4", "5/4", "1/0", "-1/2", "1/2/3", "1/100001", "a/b"] {
            let error = text.parse::<Shard>().expect_err(text);
            assert!(error.to_string().contains(&format!("`{text}` is not a shard")), "{error}");
        }
        assert!(serde_json::from_str::<Shard>(r#"{"number": 3, "of": 2}"#).is_err());
    }
}
