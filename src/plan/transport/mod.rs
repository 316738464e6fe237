//! Which things are carried where, and in which order, if every push carried one of them straight along
//! without turning it: what is left of a task without its physics, as a skeleton for plans of many pushes.
//!
//! [`Transport`] finds legs, each of one push, on a grid of places: every goal's object on its way around
//! what stands still, and things that stand in each other's way aside first, or where they wait until
//! another has passed (as in navigation among movable obstacles, Stilman and Kuffner 2005, "Navigation
//! among movable obstacles: real-time reasoning in complex environments"). Nothing is rolled out for that;
//! [`follow`] then makes real pushes of them, one after another.

mod follow;
mod group;
mod lattice;
mod path;
mod reach;
mod schedule;

pub use follow::{FollowSettings, Followed, follow};
pub use reach::{Groups, Leg, Transport};
