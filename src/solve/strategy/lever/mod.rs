//! Strategies for tasks that leave the plane: a single lever-up, pushes after one, pushes that make
//! room for one, and consecutive stages for several goals.

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
