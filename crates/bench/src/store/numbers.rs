//! Lists of shards in the format of array jobs.

use std::fmt;

/// Ascending numbers, with consecutive ones as a range: `3,7-9`.
pub(super) struct Numbers<'a>(pub &'a [usize]);

impl fmt::Display for Numbers<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rows = self.0.chunk_by(|a, b| a + 1 == *b);
        for (k, row) in rows.enumerate() {
            let comma = if k == 0 { "" } else { "," };
            match row {
                [first, .., last] => write!(f, "{comma}{first}-{last}")?,
                [one] => write!(f, "{comma}{one}")?,
                [] => {}
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_a_range() {
        for (list, text) in
            [(&[][..], ""), (&[3], "3"), (&[3, 7, 8, 9], "3,7-9"), (&[1, 2, 4, 6, 7], "1-2,4,6-7")]
        {
            assert_eq!(Numbers(list).to_string(), text);
        }
    }
}
