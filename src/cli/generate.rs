//! `pushplan generate`: training data in a folder.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

#[cfg(feature = "formats")]
use crate::dataset::generate_npz;
use crate::dataset::{
    Constraints, DatasetConfig, DatasetError, JointRule, Preset, Solids, generate,
};

use super::{
    error::CliError,
    exit_code,
    follow::Following,
    interrupt,
    session::Session,
    words::{JOINTS, PRESETS, SOLIDS, words},
};

/// Make training data: random scenes, tools and pushes, simulated
#[derive(Args, Debug)]
#[command(
    after_help = "The same settings always give the same files. An interrupted run (Ctrl-C) keeps its finished
episodes; the same command goes on from there.

A crowd's objects, joints, solids and speed are drawn for training; the options below fix them,
for test sets such as the published ones (hand at 0.21 m/s).

Examples:
  pushplan generate data/train --preset mixed --episodes 20000 --seed 1
  pushplan generate data/dense-9 --preset dense --episodes 200 --seed 7 \\
      --objects 9 --joints mixed --solids cylinders --speed 0.21
  pushplan generate data/arrays --episodes 2000 --format npz

npz keeps 128 episodes a file, so that an interruption costs up to so many, and writes
statistics.json and a README.md that says what every array holds: poses, velocities and tool poses
of all frames, masses, frictions, sizes, scenes and tools, in metres, kilograms, seconds, radians."
)]
pub struct GenerateArgs {
    /// Folder for the data
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Number of episodes: one scene and one sequence of pushes each
    #[arg(long, value_name = "N", default_value_t = DatasetConfig::default().episodes)]
    episodes: u64,
    /// Decides every episode; train and held-out data need different ones
    #[arg(long, value_name = "N", default_value_t = DatasetConfig::default().seed)]
    seed: u64,
    /// Family of scenes
    #[arg(long, value_parser = words(&PRESETS), default_value = "tools")]
    preset: Preset,
    /// Number of objects of a crowd, 2 to 12 [default: any of them]
    #[arg(long, value_name = "N")]
    objects: Option<usize>,
    /// Joints between near neighbours of a crowd [default: redrawn every 25 episodes]
    #[arg(long, value_parser = words(&JOINTS), value_name = "RULE")]
    joints: Option<JointRule>,
    /// Solids of a crowd [default: redrawn every 25 episodes]
    #[arg(long, value_parser = words(&SOLIDS), value_name = "KIND")]
    solids: Option<Solids>,
    /// Files for whom
    #[arg(long, value_enum, default_value_t = Format::Records)]
    format: Format,
    /// Speed of the hand, 0.05 to 0.25 m/s [default: any of them]
    #[arg(long, value_name = "M/S")]
    speed: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Our own training
    Records,
    /// NumPy: arrays of 128 episodes a file, and their statistics
    #[cfg(feature = "formats")]
    Npz,
}

impl GenerateArgs {
    fn config(&self) -> DatasetConfig {
        DatasetConfig {
            seed: self.seed,
            episodes: self.episodes,
            preset: self.preset,
            constraints: Constraints {
                objects: self.objects,
                joints: self.joints,
                solids: self.solids,
                speed: self.speed,
            },
        }
    }
}

pub fn run(args: &GenerateArgs, session: &Session) -> Result<u8, CliError> {
    let config = args.config();
    interrupt::watch();
    let following = Following::bar(session, "episodes");
    let made = session.compute(|| match args.format {
        Format::Records => generate(&config, &args.folder, &following),
        #[cfg(feature = "formats")]
        Format::Npz => generate_npz(&config, &args.folder, &following),
    });
    following.finish()?;
    let bytes = made.map_err(data_error)?;
    session.print(&format!(
        "{} episodes of seed {}, {:.1} MB, in {}\n",
        config.episodes,
        config.seed,
        bytes as f64 / 1e6,
        args.folder.display()
    ))?;
    Ok(exit_code::DONE)
}

/// What a failure to make or read data means for the exit code.
pub fn data_error(error: DatasetError) -> CliError {
    match error {
        DatasetError::Cancelled => CliError::Interrupted(error.to_string()),
        DatasetError::Empty(_) => CliError::usage(error.to_string(), "ask for at least one"),
        DatasetError::Constraint(_) => CliError::usage(
            error.to_string(),
            "`pushplan generate --help` says what each preset has",
        ),
        DatasetError::Foreign { .. } => CliError::File(error.to_string()),
        DatasetError::Store(error) => error.into(),
    }
}
