//! Transport of objects in straight pushes without rotation: a simplified model that yields
//! skeletons for plans of many pushes.
//!
//! [`Transport`] finds legs of one push each on a grid of places. Every goal's object moves around
//! fixed bodies. Obstructing objects are first cleared, or wait until another object has passed.
//! This is navigation among movable obstacles (Stilman and Kuffner 2005, "Navigation among movable
//! obstacles: real-time reasoning in complex environments"). No rollouts are needed; [`follow`]
//! then finds real pushes for the legs, one after another.

mod follow;
mod group;
mod lattice;
mod path;
mod reach;
mod schedule;

pub use follow::{FollowSettings, Followed, follow};
pub use reach::{Groups, Leg, Transport};
