//! Results for people and for programs: tables, pictures, charts, pages, numbers with their units.
//!
//! Pure formatting: values in, text out. Nothing is computed, run or written to disk here.

mod bars;
mod belief;
mod chart;
mod closed;
mod convergence;
mod cost;
mod crowd;
mod document;
mod fit;
mod hdd;
mod heldout;
mod html;
mod joints;
mod keyframes;
mod labels;
mod lever_points;
mod lever_tasks;
mod levers;
mod masses;
mod number;
mod page;
mod picture;
mod plan_picture;
mod plan_text;
mod poses;
mod prediction;
mod probes;
mod random;
mod refinement;
mod run;
mod simulation;
mod solution;
mod solved;
mod svg;
mod table;
mod tools;
mod tradeoff;
#[cfg(feature = "train")]
mod training;
mod verdict;

pub use bars::{BarChart, Bars};
pub use belief::belief_document;
pub use chart::{Axis, Chart, Mark, Series};
pub use closed::{ClosedRun, closed_document};
pub use convergence::convergence_document;
pub use cost::{cost_document, crowd_cost_document, equation_document, far_document};
pub use crowd::{crowd_document, evaluation_document};
pub use document::{Document, Drawing, Figure, Section};
pub use fit::fit_document;
pub use hdd::hdd_document;
pub use heldout::heldout_document;
pub use joints::{joints_document, recorded_joints_document};
pub use lever_points::lever_points_document;
pub use lever_tasks::lever_tasks_document;
pub use levers::levers_document;
pub use masses::masses_document;
pub use number::{degrees, millimetres, seconds};
pub use page::{
    Origin, PageView, Recipe, Setting, prediction_page, recording_page, run_page, solution_page,
    verdict_page,
};
pub use picture::{MovingPicture, ScenePicture, Source, Track};
pub use plan_picture::{plan_figures, space_figures};
pub use poses::{PoseRow, RECORDED, poses_document};
pub use prediction::prediction_document;
pub use probes::probes_document;
pub use random::{RandomRun, random_document};
pub use refinement::refinement_document;
pub use run::run_document;
pub use simulation::simulation_document;
pub use solution::solution_document;
pub use solved::solved_document;
pub use table::{Align, Column, NONE, Table};
pub use tools::{single_document, tools_document};
pub use tradeoff::tradeoff_document;
#[cfg(feature = "train")]
pub use training::training_document;
pub use verdict::{replay_warnings, verdict_document};
