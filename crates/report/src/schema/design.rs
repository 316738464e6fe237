//! Schema of a proposed tool.

use serde_json::Value as Json;

use pushplan::asset::tool_schema;

use super::shape::{Shape, count, flag, nullable, text};
use super::solution;

/// Returns the schema of a design.
pub(super) fn shape() -> Shape {
    let spent = Shape::new()
        .key("looked_at", "Number of screened tools.", count())
        .key("rollouts", "Number of rollouts of the screening.", count())
        .key("promising", "Number of screened tools predicted to reach the goal.", count())
        .key("solved", "Number of tools with which the task was solved in full.", count());
    Shape::new()
        .key("task", "Name of the task.", text())
        .key("status", "Status of the best solution.", solution::status())
        .key("stopped", "Whether a time limit or Ctrl-C ended the search early.", flag())
        .key("tool", "Proposed tool as in a tool file; null without a proposal.", nullable(tool()))
        .key(
            "solution",
            "Solution with the proposed tool, or with the existing tools without a proposal.",
            solution::shape(),
        )
        .key("known", "Solution with the existing tools.", solution::shape())
        .key("spent", "Cost of the proposal.", spent)
}

/// Returns the schema of tool files as a part of another schema.
fn tool() -> Json {
    let mut schema = tool_schema();
    if let Some(keys) = schema.as_object_mut() {
        keys.remove("$schema");
    }
    schema
}
