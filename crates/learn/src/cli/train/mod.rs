//! `pushplan-learn train NETWORK DIR`: makes a network's data and weights in the folder of a run.

mod command;
mod lever;
mod predictor;
mod regulator;

use command::written;
pub use command::{TrainArgs, data, run, take, weights};
pub use lever::{distinct, opened};
