//! Transport of objects in straight pushes without rotation: a simplified model that yields
//! skeletons for plans of many pushes.
//!
//! Groups of solids translate on a grid of places, each pushed by a tool behind it; a pushed group
//! may carry others along. [`Transport`] searches sequences of such pushes: their order, their
//! ends, and the groups to clear or park first. This is navigation and rearrangement among movable
//! obstacles (Stilman and Kuffner 2005, "Navigation among movable obstacles: real-time reasoning in
//! complex environments"). No rollouts are needed. [`Follow`] then finds real pushes for the legs,
//! one after another, and searches again from where they lead elsewhere.

mod chained;
mod collision;
mod distance;
mod follow;
mod group;
mod held;
mod lattice;
mod legs;
mod moves;
mod reach;
mod room;
mod sequence;
mod station;
mod tool_solids;
mod travel;

pub use follow::{Follow, FollowSettings, Followed};
pub use legs::Leg;
pub use reach::{Groups, Transport};
pub use sequence::find_legs;
