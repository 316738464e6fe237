//! World files: ground truth for the properties that a task leaves unknown.

mod joints;
mod load;
mod spec;

pub(super) use load::check_world;
pub use load::load_world;
pub(super) use spec::{WORLD, WORLD_KEYS};
