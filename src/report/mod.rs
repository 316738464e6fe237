//! Results for people and for programs: tables, pictures, charts, numbers with their units.
//!
//! Pure formatting: values in, text out. Nothing is computed, run or written to disk here.

mod chart;
mod number;
mod picture;
mod plan_text;
mod solution;
mod svg;
mod table;

pub use chart::{Axis, Chart, Mark, Series};
pub use number::{degrees, millimetres, seconds};
pub use picture::{ScenePicture, Source, Track};
pub use plan_text::{goal_line, outcome_table, plan_line, point, push_table};
pub use solution::{outcomes_text, plan_picture, solution_json, solution_text};
pub use table::{Align, Table};
