//! Choice of the network to train, and steps shared by all trainings.

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use pushplan::internals::progress::Progress;
use pushplan_bench::store::FolderLock;
use pushplan_command::error::CliError;
use pushplan_command::progress::TerminalProgress;
use pushplan_command::session::Session;
use pushplan_command::{exit_code, interrupt};

use crate::cli::generate::data_error;
use crate::dataset::DatasetError;
use crate::train::{CheckpointError, TrainError};

use super::{lever, predictor, regulator};

/// Generate the data of a network and train its weights; a rerun resumes an interrupted run
#[derive(Args, Debug)]
#[command(
    after_help = "One command generates the data and the weights of a shipped network. The folder \
of the run contains the data, unless --data is given, metrics.jsonl and checkpoint.safetensors, \
from which a run resumes. best.safetensors contains the weights with the best held-out score, \
last.safetensors the weights of the last evaluation.

Ctrl-C saves the run and stops. A rerun of the same command resumes it, and the result is \
bit-identical to an uninterrupted run.

Examples:
  pushplan-learn train predictor runs/predictor
  pushplan-learn train regulator runs/regulator
  pushplan-learn train lever runs/lever"
)]
pub struct TrainArgs {
    #[command(subcommand)]
    network: Network,
}

#[derive(Debug, Subcommand)]
enum Network {
    Predictor(predictor::PredictorArgs),
    Regulator(regulator::RegulatorArgs),
    Lever(lever::LeverArgs),
}

pub fn run(args: &TrainArgs, session: &Session) -> Result<u8, CliError> {
    match &args.network {
        Network::Predictor(args) => predictor::run(args, session),
        Network::Regulator(args) => regulator::run(args, session),
        Network::Lever(args) => lever::run(args, session),
    }
}

/// Locks the folder of a run against other processes.
///
/// # Errors
/// Returns an error if another process holds the lock, or the folder cannot be created.
pub fn take(folder: &Path, session: &Session) -> Result<FolderLock, CliError> {
    interrupt::watch();
    Ok(FolderLock::take(folder, &TerminalProgress::bar(session, "folder"))?)
}

/// Makes or reads data, with a progress bar called `name`.
///
/// # Errors
/// Returns an error if `make` fails or is interrupted.
pub fn data<D: Send>(
    session: &Session,
    name: &str,
    make: impl FnOnce(&TerminalProgress) -> Result<D, DatasetError> + Send,
) -> Result<D, CliError> {
    let following = TerminalProgress::bar(session, name);
    let made = session.compute(|| make(&following));
    following.finish()?;
    made.map_err(data_error)
}

/// Trains a network and prints the path of its best weights.
///
/// # Errors
/// Returns an error if training fails or is interrupted.
pub fn weights(
    session: &Session,
    train: impl FnOnce(&dyn Progress) -> Result<Option<PathBuf>, TrainError> + Send,
) -> Result<u8, CliError> {
    let following = TerminalProgress::bar(session, "steps");
    let best = session.compute(|| train(&following));
    following.finish()?;
    written(session, best)
}

/// Prints the path of the best weights.
pub(super) fn written(
    session: &Session,
    best: Result<Option<PathBuf>, TrainError>,
) -> Result<u8, CliError> {
    let best = best.map_err(train_error)?;
    if interrupt::requested() {
        let message = "stopped; the run is saved; rerun the same command to resume";
        return Err(CliError::Interrupted(message.to_owned()));
    }
    if let Some(best) = best {
        session.print(&format!("wrote {}\n", best.display()))?;
    }
    Ok(exit_code::DONE)
}

fn train_error(error: TrainError) -> CliError {
    match error {
        TrainError::Data(error) => data_error(error),
        TrainError::Write(faults) => CliError::Output(faults),
        TrainError::Checkpoint(_, CheckpointError::Other) => CliError::usage(
            error.to_string(),
            "to resume a run, repeat its command with exactly the same settings",
        ),
        TrainError::Checkpoint(..) => CliError::File(error.to_string()),
        _ => CliError::Unexpected(error.to_string()),
    }
}
