//! Conversion of the bodies of a file to a tool or a scene.

mod admitted;
mod draft;
mod feet;
mod frictions;
mod groups;
mod joints;
mod lowered;
mod names;
mod objects;
mod occupancy;
mod pieces;
mod scene;
mod shadow;
mod slices;
mod statics;
mod thing;
mod tool;
mod upright;
mod wanted;
mod weighed;

pub(crate) use occupancy::is_convex_above;
pub use scene::{ImportedScene, objects};
pub use tool::tool;
pub use wanted::{Imported, Wanted};
