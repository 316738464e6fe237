//! The command `pushplan-lab`: one file per subcommand.

mod adapted;
mod app;
mod convergence;
mod cost;
mod evaluate;
mod hdd;
mod joints;
mod kept;
mod lever_points;
mod lever_tasks;
mod levers;
mod masses;
mod measure;
mod probes;
mod random;
mod refinement;
mod rest_of_way;
mod run;
mod tasks;
mod tradeoff;
mod train;
mod value_enums;

pub use app::run;
