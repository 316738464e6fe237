//! Poses over time, as rows for other programs.

use serde_json::{Value as Json, json};

use pushplan::geometry::Pose;

use super::document::Document;
use super::table::{
    Align::{Left, Right},
    Table,
};

/// Pose of an object at an instant, predicted or recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseRow {
    /// Name of the recording or task.
    pub name: String,
    /// Name of the model, or `recorded`.
    pub by: String,
    /// Name of the object.
    pub object: String,
    /// Time since the start, seconds.
    pub time: f64,
    /// Pose in metres and radians.
    pub pose: Pose,
}

/// Source name of recorded rows.
pub const RECORDED: &str = "recorded";

/// Returns the rows as CSV and JSON: `name`, `by`, `object`, `time` (seconds), `x`, `y` (metres)
/// and `heading` (radians counter-clockwise, unwrapped).
pub fn poses_document(rows: &[PoseRow]) -> Document {
    let table = Table::of(
        rows,
        &[
            ("name", Left, &|row| row.name.clone()),
            ("by", Left, &|row| row.by.clone()),
            ("object", Left, &|row| row.object.clone()),
            ("time", Right, &|row| row.time.to_string()),
            ("x", Right, &|row| row.pose.position.x.to_string()),
            ("y", Right, &|row| row.pose.position.y.to_string()),
            ("heading", Right, &|row| row.pose.heading.to_string()),
        ],
    );
    let poses: Vec<Json> = rows
        .iter()
        .map(|row| {
            json!({
                "name": row.name,
                "by": row.by,
                "object": row.object,
                "time": row.time,
                "x": row.pose.position.x,
                "y": row.pose.position.y,
                "heading": row.pose.heading,
            })
        })
        .collect();
    Document { rows: table, json: json!({"poses": poses}), ..Document::default() }
}
