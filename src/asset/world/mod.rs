//! World files: what is really there where a task does not know it.

mod load;
mod spec;

pub(super) use load::check_world;
pub use load::load_world;
pub(super) use spec::{WORLD, WORLD_KEYS};
