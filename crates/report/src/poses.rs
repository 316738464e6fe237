//! Poses over time, as rows for other programs.

use serde_json::{Value as Json, json};

use pushplan::geometry::Pose;

use super::document::Document;
use super::table::{
    Align::{Left, Right},
    Table,
};

/// Where an object is at an instant, by a model or as it was recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseRow {
    /// Name of the recording or task.
    pub name: String,
    /// Which model says so, or `recorded`.
    pub by: String,
    /// Name of the object.
    pub object: String,
    /// Since the start, seconds.
    pub time: f64,
    /// Metres and radians.
    pub pose: Pose,
}

/// The source of a row that no model made.
pub const RECORDED: &str = "recorded";

/// The rows as CSV and JSON: `name`, `by`, `object`, `time` (seconds), `x`, `y` (metres) and
/// `heading` (radians counter-clockwise, whole turns counted).
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
