//! `pushplan-lab train`: networks of lever-ups that are compared with the shipped one, and lost.

mod command;
mod memory;
mod parts;

use command::RunArgs;
pub use command::{TrainArgs, run};
