//! The door for files that users name: the product opens them through `plain_file` only.

use super::reading::{code_of, sources};

/// Crates and modules of the product.
const PRODUCT: [&str; 9] = [
    "src",
    "crates/act/src",
    "crates/arm/src",
    "crates/bench/src",
    "crates/command/src",
    "crates/design/src",
    "crates/export/src",
    "crates/import/src",
    "crates/report/src",
];

/// Calls that open a file without a check of its kind.
const OPENING: [&str; 5] =
    ["File::open(", "File::create(", "fs::read(", "fs::read_to_string(", ".open(&path)"];

/// Files of the system that are read by a constant path.
const OF_THE_SYSTEM: [&str; 2] = ["\"/proc/", "\"/sys/"];

#[test]
fn user_files_are_opened_behind_one_door() {
    for (path, text) in PRODUCT.iter().flat_map(|folder| sources(folder)) {
        if path.ends_with("src/plain_file.rs") {
            continue;
        }
        let product = text.split("#[cfg(test)]").next().unwrap_or_default();
        for line in code_of(product).lines() {
            let opens = OPENING.iter().any(|call| line.contains(call));
            let system = OF_THE_SYSTEM.iter().any(|start| line.contains(start));
            assert!(
                !opens || system,
                "{}: `{}` may wait for a pipe; use `pushplan::plain_file`",
                path.display(),
                line.trim()
            );
        }
    }
}
