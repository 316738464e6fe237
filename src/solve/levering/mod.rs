//! Tasks in which something leaves the plane: lever-ups, pushes that follow them, and pushes that make
//! room for them.

mod check;
mod doubt;
mod manual_lever;
mod search;
mod settings;
mod steps;

pub(super) use check::check;
pub use manual_lever::{LeverActionError, ManualLever, ManualPlace, manual_lever};
pub use settings::LeverSettings;
pub(super) use steps::Steps;
