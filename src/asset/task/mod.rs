//! Task files: what they may hold, their reading, and the rules that span several keys.

mod build;
mod emit;
mod frictions;
mod joints;
mod load;
mod rules;
mod spec;

pub(super) use build::support as support_of;
pub(super) use frictions::{FRICTIONS, name_of_surface};
pub(super) use joints::joint as joint_of;
pub use load::load_task;
pub(super) use load::{parse_with, scene_of, task_of};
pub(super) use spec::{
    JOINTS, LIFT, OBJECT_NAME, OBJECT_SHAPE, OBJECT_SUPPORT, OBSTACLES, PUSH_HEIGHT, TABLE, TASK,
    TASK_KEYS,
};
