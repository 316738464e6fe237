//! `pushplan-learn train NETWORK DIR`: a network's data and weights, in a folder that holds the whole run.

mod command;
mod lever;
mod predictor;
mod regulator;

use command::written;
pub use command::{TrainArgs, data, run, take, weights};
pub use lever::{distinct, opened};
