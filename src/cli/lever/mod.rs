//! Tasks of levering on the command line: the same commands as for pushes.

mod argument;
mod model;
mod predict;
mod solve;
mod verify;

pub use argument::{LEVER_FORM, lever_argument, lever_plan};
pub use model::{lever_model, lever_network};
pub use predict::predict;
pub use solve::solve;
pub use verify::verify;
