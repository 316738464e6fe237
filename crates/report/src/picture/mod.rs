//! Top view of a scene: start poses, tool motions, predicted and simulated ends, and the goal.
//!
//! The pictures only draw given data: they compute no rollouts and no verdicts.

mod bodies;
mod captions;
mod extent;
mod joints;
mod legend;
mod moving_picture;
mod moving_tool;
mod palette;
mod scene_picture;
mod space_picture;
mod stage;
mod strokes;
mod timeline;
mod view;

pub use moving_picture::MovingPicture;
pub use scene_picture::{ScenePicture, Source, Track};
pub use space_picture::SpacePicture;
