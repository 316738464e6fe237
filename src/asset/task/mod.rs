//! Task files: what they may hold, their reading, and the rules that span several keys.

mod build;
mod coverage;
mod emit;
mod falls;
mod frictions;
mod gap;
mod goals;
mod joints;
mod keep;
mod load;
mod mounts;
mod obstacles;
mod parts;
mod rules;
mod spec;
mod tools;

pub(super) use build::{
    pushes as pushes_of, robot as reach_of, support as support_of, unknown as unknown_of,
};
pub(super) use coverage::emitted_coverage;
pub(super) use falls::emitted_fall;
pub(super) use frictions::{FRICTIONS, name_of_surface};
pub(super) use gap::emitted_gap;
pub(super) use joints::joint as joint_of;
pub(super) use keep::{emitted as region, emitted_area as area_of};
pub use load::{load_task, parse_task};
pub(super) use load::{parse_with, scene_of, task_of};
pub(super) use mounts::WORLD;
pub(super) use obstacles::{
    OBSTACLES, PLACE, emitted as emitted_obstacle, height as height_of, obstacle as obstacle_of,
};
pub(super) use parts::shares as shares_of_mass;
pub(super) use rules::{
    push_rules as check_pushes, robot as check_robot, unknown as check_unknown,
};
pub(super) use spec::{
    JOINTS, LIFT, MAX_FORCE, OBJECT_NAME, OBJECT_SHAPE, OBJECT_SUPPORT, PUSH_HEIGHT, PUSHES,
    REACH_KEY, ROBUSTNESS, TABLE, TASK_FILE, TASK_KEYS, UNKNOWN_KEY,
};
pub(super) use tools::{TOOLS, check_free, check_tools, emitted_tools, tools as named_tools};
