//! `pushplan-lab train`: rejected networks of lever-ups, for comparison with the shipped one.

mod command;
mod memory;
mod parts;

use command::RunArgs;
pub use command::{TrainArgs, run};
