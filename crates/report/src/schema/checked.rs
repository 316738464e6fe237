//! Schemas of the results on files: checked and exported ones.

use super::shape::{Shape, count, flag, list, nullable, text, words};

/// Returns the schema of checked files.
pub(super) fn check() -> Shape {
    let kinds = ["tool", "task", "plan", "trajectory", "recording", "world", "run"];
    let fault = Shape::new()
        .key("file", "Name of the file with the fault.", text())
        .key("line", "Line, from 1; null for a fault of the whole file.", nullable(count()))
        .key("column", "Column in characters, from 1.", nullable(count()))
        .key("message", "Expected and found content.", text())
        .key("remedy", "Suggested correction; may be empty.", text());
    let file = Shape::new()
        .key("file", "Name of the file or shipped task.", text())
        .key("kind", "Kind of the file; null with faults.", nullable(words(&kinds)))
        .key("valid", "Whether the file has no faults.", flag())
        .key("faults", "All faults.", fault.list())
        .key(
            "warnings",
            "Warnings that a solution of the task would carry, such as values outside the model's \
             range.",
            list(text()),
        )
        .key("why", "Reason why the task has no plan, with `--why`.", nullable(text()));
    Shape::new().key("files", "Checked files, in the given order.", file.list())
}

/// Returns the schema of exported files.
pub(super) fn export() -> Shape {
    Shape::new().key("files", "Paths of the written files.", list(text()))
}
