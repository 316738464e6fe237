//! `pushplan generate`: training data in a folder.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use indicatif::ProgressBar;

use crate::dataset::{DatasetConfig, DatasetError, Preset, Watch, generate};

use super::{error::CliError, exit_code, interrupt, session::Session};

/// Make training data: random scenes, tools and pushes, simulated in the plane
#[derive(Args, Debug)]
#[command(
    after_help = "The same settings always give the same files. An interrupted run (Ctrl-C) keeps its finished
files; the same command goes on from there.

Example:
  pushplan generate data/train --episodes 20000 --seed 1"
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
    #[arg(long, value_enum, default_value_t)]
    preset: PresetName,
    /// Episodes in one file; an interruption loses at most one file's worth
    #[arg(long, value_name = "N", default_value_t = DatasetConfig::default().episodes_per_shard)]
    episodes_per_shard: u64,
}

/// [`Preset`] with words for `--help`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum PresetName {
    /// One to three objects, sometimes obstacles, random tools of cuboids
    #[default]
    Tools,
}

/// Shows how far a generation is, and stops it on Ctrl-C.
pub struct Following<'a> {
    session: &'a Session,
    bar: ProgressBar,
}

impl<'a> Following<'a> {
    pub fn new(session: &'a Session, what: &str) -> Self {
        Self { session, bar: session.bar(what) }
    }

    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Watch for Following<'_> {
    fn progress(&self, done: u64, total: u64) {
        self.bar.set_length(total);
        self.bar.set_position(done);
    }

    fn note(&self, message: &str) {
        self.bar.suspend(|| self.session.warn(message));
    }

    fn cancelled(&self) -> bool {
        interrupt::requested()
    }
}

pub fn run(args: &GenerateArgs, session: &Session) -> Result<u8, CliError> {
    let config = DatasetConfig {
        seed: args.seed,
        episodes: args.episodes,
        episodes_per_shard: args.episodes_per_shard,
        preset: match args.preset {
            PresetName::Tools => Preset::Tools,
        },
    };
    interrupt::watch();
    let following = Following::new(session, "episodes");
    let made = session.compute(|| generate(&config, &args.folder, &following));
    following.finish();
    let manifest = made.map_err(data_error)?;
    let bytes: u64 = manifest.shards.iter().map(|shard| shard.bytes).sum();
    session.print(&format!(
        "{} episodes of seed {} in {} files, {:.1} MB, in {}\n",
        config.episodes,
        config.seed,
        manifest.shards.len(),
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
        DatasetError::OtherSettings { .. } => {
            CliError::usage(error.to_string(), "the same settings go on with an unfinished set")
        }
        DatasetError::Io { .. } => CliError::Unexpected(error.to_string()),
        DatasetError::Manifest { .. }
        | DatasetError::Damaged { .. }
        | DatasetError::Missing { .. }
        | DatasetError::Unfinished { .. } => CliError::File(error.to_string()),
    }
}
