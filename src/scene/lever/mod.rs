//! Plates, blades and the scenes in which one lifts the other.
//!
//! Plates move in all six degrees of freedom.

mod features;
mod plate;
mod scene;
mod stand;
mod weight;

pub use features::LeverFeatures;
pub use plate::{Plate, Slab};
pub use scene::{Blade, LeverScene};
pub use stand::stands_on;
pub use weight::Weight;
