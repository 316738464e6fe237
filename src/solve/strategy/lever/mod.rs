//! Strategies for tasks that leave the plane: a lever-up alone, pushes that follow one, and pushes that make
//! room for one.

mod doubt;
mod follow_up;
mod lever_up;
mod make_room;
mod prefix;
mod search;

pub(super) use follow_up::FollowUp;
pub(super) use lever_up::LeverUp;
pub(super) use make_room::MakeRoom;
