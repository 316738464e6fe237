//! Our names for names of a file.

use pushplan::asset::named_after;

/// What `pushplan export` puts before names.
const OURS: [&str; 3] = ["object/", "obstacle/", "tool/"];

/// Names that mean something else in a task file.
const RESERVED: [&str; 2] = ["table", "tool"];

/// The name of a body without what `pushplan export` puts before it.
pub(super) fn bare(name: &str) -> &str {
    OURS.iter().find_map(|before| name.strip_prefix(before)).unwrap_or(name)
}

/// Whether both name the same body.
pub(super) fn same(asked: &str, name: &str) -> bool {
    asked == name || asked == bare(name) || named_after(asked) == named_after(bare(name))
}

/// Names that differ from each other.
#[derive(Default)]
pub(super) struct Names(Vec<String>);

impl Names {
    /// Our name for `name`: with dashes for characters that ours cannot hold, and a number after it
    /// where it is taken.
    pub fn take(&mut self, name: &str) -> String {
        let plain = named_after(bare(name));
        let free = |name: &String| !self.0.contains(name) && !RESERVED.contains(&name.as_str());
        let mut found = plain.clone();
        for number in 2.. {
            if free(&found) {
                break;
            }
            found = format!("{plain}-{number}");
        }
        self.0.push(found.clone());
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_differ_and_hold_nothing_strange() {
        let mut names = Names::default();
        let taken =
            ["object/red can", "red can", "table", "Stra\u{df}e", ""].map(|name| names.take(name));
        assert_eq!(taken, ["red-can", "red-can-2", "table-2", "Stra\u{df}e", "unnamed"]);
        assert!(same("red-can", "object/red can") && same("red can", "red can") && !same("a", "b"));
    }
}
