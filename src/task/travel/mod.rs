//! Travel of a lifted tool: from home to the first step, between steps, at changes of tools, and
//! back home.

mod detour;
mod legs;
mod space;
#[cfg(test)]
mod tests;

pub use detour::ReachablePositions;
pub use legs::{BlockedLeg, TravelLeg};
