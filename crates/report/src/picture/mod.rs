//! A picture of a scene from above: what stood where, what the tool did, where things ended
//! by prediction and by simulation, and the goal.
//!
//! It draws what it is given and computes nothing: no rollouts, no verdicts.

mod bodies;
mod extent;
mod joints;
mod legend;
mod moving_picture;
mod moving_tool;
mod palette;
mod scene_picture;
mod space_picture;
mod stage;
mod story;
mod strokes;
mod timeline;
mod view;

pub use moving_picture::MovingPicture;
pub use scene_picture::{ScenePicture, Source, Track};
pub use space_picture::SpacePicture;
