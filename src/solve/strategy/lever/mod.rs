//! Strategies for tasks that leave the plane: a lever-up alone, pushes that follow one, pushes that make
//! room for one, and one stage after another for several goals.

mod doubt;
mod follow_up;
mod in_turn;
mod lever_up;
mod make_room;
mod prefix;
mod search;

pub(super) use follow_up::FollowUp;
pub(super) use in_turn::InTurn;
pub(super) use lever_up::LeverUp;
pub(super) use make_room::MakeRoom;
