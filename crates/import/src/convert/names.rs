//! Conversion of names in a file to names in pushplan.

use pushplan::asset::named_after;

/// Prefixes that `pushplan export` adds to names.
const OURS: [&str; 3] = ["object/", "obstacle/", "tool/"];

/// Names with a special meaning in a task file.
const RESERVED: [&str; 2] = ["table", "tool"];

/// Returns the name of a body without the prefix that `pushplan export` adds.
pub(super) fn bare(name: &str) -> &str {
    OURS.iter().find_map(|before| name.strip_prefix(before)).unwrap_or(name)
}

/// Returns `true` if both names denote the same body.
pub(super) fn same(asked: &str, name: &str) -> bool {
    asked == name || asked == bare(name) || named_after(asked) == named_after(bare(name))
}

/// Set of names in use, all different.
#[derive(Default)]
pub(super) struct Names(Vec<String>);

impl Names {
    /// Returns a free name for `name`: invalid characters become dashes, and a number is appended
    /// if the name is taken.
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
