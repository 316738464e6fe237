//! From bodies of a file to a tool or a scene.

mod feet;
mod frictions;
mod groups;
mod hull;
mod names;
mod objects;
mod scene;
mod statics;
mod tool;
mod upright;
mod wanted;

pub use scene::{ImportedScene, objects};
pub use tool::tool;
pub use wanted::{Imported, Wanted};
