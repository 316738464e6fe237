//! Results for people and for programs: tables, pictures, charts, pages, numbers with units.
//!
//! This crate converts values to text. It does not plan, run or write files. A [`Graph`] shows a
//! frame as the network receives it.
#![deny(unsafe_code)]
#![warn(missing_docs)]

mod bars;
mod belief;
mod bystanders;
mod chart;
mod design;
mod detours;
mod document;
mod fit;
mod graph;
mod html;
mod keyframes;
mod labels;
mod number;
mod page;
mod picture;
mod plan_picture;
mod plan_text;
mod poses;
mod prediction;
mod recorded;
mod run;
mod schema;
mod second_opinion;
mod solution;
mod solved;
mod svg;
mod table;
mod tools;
mod trajectory;
mod verdict;

pub use bars::{BarChart, Bars};
pub use belief::belief_document;
pub use chart::{Axis, Chart, Mark, Series};
pub use design::design_document;
pub use document::{Document, Drawing, Figure, Section};
pub use fit::{fit_document, table_fit_section};
pub use graph::{Graph, GraphNode, GraphRelation, NodeKind, RelationName};
pub use number::{degrees, fine_millimetres, millimetres, seconds};
pub use page::{
    Origin, PageView, Recipe, Setting, TaskSource, design_page, plan_stage, prediction_page,
    recording_page, run_page, solution_page, task_stage, verdict_page,
};
pub use picture::{MovingPicture, ScenePicture, Source, Track};
pub use plan_picture::{plan_figures, space_figures};
pub use poses::{PoseRow, RECORDED, poses_document};
pub use prediction::prediction_document;
pub use recorded::{
    beside, end, horizon_chart, model_name, percent, recorded_document, recordings_document, share,
    trials_line,
};
pub use run::run_document;
pub use schema::DocumentKind;
pub use second_opinion::{Judged, SecondOpinion, TimedReplay};
pub use solution::{solution_document, solution_title};
pub use solved::{SOLVED_COLUMNS, error_chart, flat, progress_note, solved_cells, solved_document};
pub use table::{Align, Column, NONE, Table};
pub use tools::tools_document;
pub use trajectory::trajectory_figures;
pub use verdict::{replay_warnings, verdict_document};
