//! Tasks in which something leaves the plane: lever-ups, pushes that follow them, and pushes that make
//! room for them.

mod asked;
mod check;
mod doubt;
mod search;
mod settings;
mod steps;

pub use asked::{AskedLever, AskedPlace, LeverActionError, asked_lever};
pub(super) use check::check;
pub use settings::LeverSettings;
pub(super) use steps::Steps;
