//! Results of the laboratory as documents: values in, tables and charts out.

mod adapted;
mod closed;
mod convergence;
mod cost;
mod crowd;
mod hdd;
mod heldout;
mod joints;
mod lever_points;
mod lever_tasks;
mod levers;
mod masses;
mod probes;
mod random;
mod refinement;
mod tradeoff;

pub use adapted::adapted_document;
pub use closed::{ClosedRun, closed_document};
pub use convergence::convergence_document;
pub use cost::{cost_document, crowd_cost_document, equation_document, far_document};
pub use crowd::{crowd_document, evaluation_document};
pub use hdd::hdd_document;
pub use heldout::heldout_document;
use heldout::length;
pub use joints::{joints_document, recorded_joints_document};
pub use lever_points::lever_points_document;
pub use lever_tasks::lever_tasks_document;
pub use levers::levers_document;
pub use masses::masses_document;
pub use probes::probes_document;
pub use random::{RandomRun, random_document};
pub use refinement::refinement_document;
pub use tradeoff::tradeoff_document;
