//! Task files, for pushes and lever-ups: keys, parsing, and rules that span several keys.

mod blades;
mod bodies;
mod build;
mod emit;
mod frictions;
mod goal_rules;
mod goals;
mod joints;
mod keep;
mod levers;
mod load;
mod object;
mod obstacles;
mod part;
mod parts;
mod plates;
mod refused;
mod rules;
mod spec;
mod support;
mod tools;
mod world_joints;

pub(super) use frictions::{FRICTIONS, name_of_surface};
pub(super) use goals::emitted_goals;
pub(super) use joints::{KEYS as JOINT_KEYS, joint as joint_of};
pub(super) use keep::emitted as region;
pub(super) use levers::emitted_levers;
pub use load::{load_task, parse_task};
pub(super) use load::{parse_with, scene_of, task_of};
pub(super) use object::{OBJECT_NAME, OBJECT_SHAPE, emitted_object};
pub(super) use obstacles::{OBSTACLES, emitted as emitted_obstacle};
pub(super) use part::shares as shares_of_mass;
pub(super) use spec::{JOINTS, LIFT, PUSH_HEIGHT, TABLE, TASK, TASK_KEYS};
pub(super) use support::{OBJECT_SUPPORT, emitted as emitted_support, support as support_of};
pub(super) use tools::emitted_tools;
pub(super) use world_joints::{WORLD, mount as mount_of};
