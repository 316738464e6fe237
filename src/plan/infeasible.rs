//! Reasons why a push cannot be made.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Reason why a push cannot be made.
#[derive(
    Clone, Copy, Debug, Error, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(rename_all = "snake_case")]
pub enum Infeasible {
    /// The face passes next to or above the object.
    #[error("the face misses the object")]
    NoContact,
    /// Another part of the tool meets the object before the face does, or overlaps it.
    #[error("another part of the tool meets the object first")]
    OtherPartFirst,
    /// The tool would come down on an object.
    #[error("the tool would come down on an object")]
    OnObject,
    /// The tool would come down on an obstacle or pass through one.
    #[error("an obstacle or a keep-out region obstructs the tool")]
    Obstacle,
    /// The hand or the handle of the tool would meet an obstacle or an object taller than the tool.
    #[error("the hand would collide with another body")]
    Hand,
    /// A body higher than the travel height obstructs the lifted tool on its way from home.
    #[error("a tall body or a keep-out region obstructs the way of the lifted tool")]
    NoWay,
    /// The object would topple instead of sliding.
    #[error("the object would topple at this height; see `pushes.lift`")]
    Topples,
    /// The end effector would leave the robot's reach.
    #[error("the end effector would leave the robot's reach")]
    Reach,
    /// Hardly any travel is left before the end of the reach or an obstacle.
    #[error("there is no room for a push")]
    NoRoom,
}
