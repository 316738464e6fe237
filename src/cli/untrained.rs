//! `pushplan train`, `train-regulator` and `train-lever` in builds without candle: how to get them.

use std::ffi::OsString;

use clap::Args;

use super::error::CliError;

/// What training would be told.
#[derive(Args, Debug)]
#[command(after_help = "Training needs candle, which would double the time that building takes:

  cargo run --release --features train -- train ...   in a clone
  cargo install pushplan --features train             from the registry")]
pub struct UntrainedArgs {
    /// What training would be told
    #[arg(hide = true, trailing_var_arg = true, allow_hyphen_values = true)]
    _rest: Vec<OsString>,
}

/// The error that says so.
pub fn run() -> CliError {
    CliError::usage(
        "this pushplan was built without training",
        "build it with `--features train`, as `cargo run --release --features train -- train`",
    )
}
