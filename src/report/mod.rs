//! Results for people and for programs: tables, pictures, charts, numbers with their units.
//!
//! Pure formatting: values in, text out. Nothing is computed, run or written to disk here.

mod bars;
mod chart;
mod crowd;
mod document;
mod html;
mod keyframes;
mod labels;
mod measured;
mod number;
mod picture;
mod plan_text;
mod random;
mod scope;
mod solution;
mod solved;
mod svg;
mod table;
mod tools;
mod tradeoff;
#[cfg(feature = "train")]
mod training;

pub use bars::{BarChart, Bars};
pub use chart::{Axis, Chart, Mark, Series};
pub use crowd::{CROWD_LEGEND, crowd_chart, crowd_line, crowd_summary, crowd_table};
pub use document::{Document, Drawing, Figure, Section};
pub use measured::{
    group_table, heldout_line, heldout_table, inference_table, push_cost_table, refinement_table,
    search_cost_table,
};
pub use number::{degrees, millimetres, seconds};
pub use picture::{MovingPicture, ScenePicture, Source, Track};
pub use plan_text::{goal_line, outcome_table, plan_line, point, push_table};
pub use random::{RandomRun, random_document};
pub use scope::{far_chart, far_table};
pub use solution::{
    moving_picture, outcomes_text, plan_picture, replay_warnings, solution_json, solution_text,
};
pub use solved::{solved_document, task_table};
pub use table::{Align, NONE, Table};
pub use tools::{single_table, tools_document};
pub use tradeoff::{
    tradeoff_efforts, tradeoff_line, tradeoff_objects, tradeoff_plans, tradeoff_predictors,
    tradeoff_push_chart, tradeoff_task_chart,
};
#[cfg(feature = "train")]
pub use training::training_chart;
