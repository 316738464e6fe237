//! `pushplan-learn generate`: writes training data into a folder.

use std::fs;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use pushplan::internals::asset::write_atomic;
use pushplan::internals::geometry::Pose3;
use pushplan::internals::outcome::LeverTrajectory;
use pushplan_bench::store::{Shard, StoreError};
use pushplan_command::error::CliError;
use pushplan_command::progress::TerminalProgress;
use pushplan_command::session::Session;
use pushplan_command::value_enums::possible_values;
use pushplan_command::{exit_code, interrupt};
use pushplan_export::{LEVER_SCRIPT, lever_mjcf};
use serde_json::json;

use crate::cli::value_enums::{DATA, Data, JOINTS, SOLIDS, TRUTHS};
use crate::dataset::{
    Constraints, DatasetConfig, DatasetError, JointRule, LeverConfig, LeverDataset, Solids, Truth,
    generate, generate_npz,
};

/// Generate training data by simulating pushes or lever-ups in random scenes
#[derive(Args, Debug)]
#[command(
    after_help = "The same settings always give the same files. An interrupted run (Ctrl-C) keeps \
its finished episodes; rerun the same command to resume. --shard 2/3 generates every third \
episode, for example on another machine. `pushplan-learn merge DIR SHARD...` merges the shards \
into the files of a single run, and `pushplan-learn status SHARD...` lists missing shards.

In crowds, the objects, joints, solids and speed are random by default. The options above fix them \
for test sets such as the published test sets (hand at 0.21 m/s). Lever-ups with different seeds \
have no random shape in common.

Examples:
  pushplan-learn generate data/train --episodes 20000 --seed 1
  pushplan-learn generate data/dense-9 --preset dense --episodes 200 --seed 7 \\
      --objects 9 --joints mixed --solids cylinders --speed 0.21
  pushplan-learn generate data/levers --preset levers --episodes 1600 --seed 1
  pushplan-learn generate data/arrays --episodes 2000 --format npz

mjcf writes every lever-up as a MuJoCo scene, and lever.py, which plays such scenes. It also \
writes ours.jsonl, with the results of pushplan's 3-D engine in the format of lever.py.

npz writes 128 episodes per file, so an interruption loses up to 128 episodes. It also writes \
statistics.json and a README.md that documents every array. The arrays contain poses, velocities \
and tool poses of all frames, masses, frictions, sizes, scenes and tools, in metres, kilograms, \
seconds and radians."
)]
pub struct GenerateArgs {
    /// Folder for the data
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Number of episodes, each a scene with a sequence of pushes or with one lever-up
    #[arg(long, value_name = "N", default_value_t = DatasetConfig::default().episodes)]
    episodes: u64,
    /// Seed of the episodes; training and held-out data need different seeds
    #[arg(long, value_name = "N", default_value_t = DatasetConfig::default().seed)]
    seed: u64,
    /// Family of scenes
    #[arg(long, value_parser = possible_values(&DATA), default_value = "tools")]
    preset: Data,
    /// Source of the ground truth for pushes with tools
    #[arg(long, value_parser = possible_values(&TRUTHS), default_value = "both")]
    truth: Truth,
    /// Number of objects of a crowd, 2 to 12 [default: random]
    #[arg(long, value_name = "N")]
    objects: Option<usize>,
    /// Joints between near neighbours of a crowd [default: redrawn every 25 episodes]
    #[arg(long, value_parser = possible_values(&JOINTS), value_name = "RULE")]
    joints: Option<JointRule>,
    /// Solids of a crowd [default: redrawn every 25 episodes]
    #[arg(long, value_parser = possible_values(&SOLIDS), value_name = "KIND")]
    solids: Option<Solids>,
    /// Format of the files
    #[arg(long, value_enum, default_value_t = Format::Records)]
    format: Format,
    /// Speed of the hand, 0.05 to 0.25 m/s [default: random]
    #[arg(long, value_name = "M/S")]
    speed: Option<f64>,
    /// Generate only shard I of N; every shard needs its own folder
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Records for `pushplan-learn train`
    Records,
    /// MuJoCo scenes of lever-ups, with the results of the 3-D engine
    Mjcf,
    /// NumPy arrays, 128 episodes per file, with statistics
    Npz,
}

impl GenerateArgs {
    fn constraints(&self) -> Constraints {
        Constraints {
            objects: self.objects,
            joints: self.joints,
            solids: self.solids,
            speed: self.speed,
        }
    }

    /// Returns the shard of episodes to generate.
    fn shard(&self) -> Shard {
        self.shard.unwrap_or(Shard::WHOLE)
    }

    /// Generates the data and returns the number of episodes and their size in bytes.
    fn make(&self, following: &TerminalProgress) -> Result<(usize, u64), DatasetError> {
        let &Self { seed, episodes, truth, .. } = self;
        let shard = self.shard();
        let constraints = self.constraints();
        match self.preset {
            Data::Pushes(preset) => {
                let config = DatasetConfig { seed, episodes, preset, constraints, truth };
                match self.format {
                    Format::Mjcf => {
                        let why = "mjcf is for lever-ups; `pushplan export` exports pushes";
                        Err(DatasetError::Constraint(why.to_owned()))
                    }
                    Format::Records => generate(&config, shard, &self.folder, following),
                    Format::Npz if shard != Shard::WHOLE => {
                        Err(DatasetError::Constraint("npz files cannot be sharded".to_owned()))
                    }
                    Format::Npz => {
                        let bytes = generate_npz(&config, &self.folder, following)?;
                        Ok((episodes as usize, bytes))
                    }
                }
            }
            Data::Levers(_) if constraints != Constraints::default() => {
                let why = "--objects, --joints, --solids and --speed are for crowds only";
                Err(DatasetError::Constraint(why.to_owned()))
            }
            Data::Levers(preset) => {
                let config = LeverConfig { seed, episodes, preset };
                match self.format {
                    Format::Records => generate(&config, shard, &self.folder, following),
                    Format::Mjcf if shard == Shard::WHOLE => {
                        twins(&config, &self.folder, following)
                    }
                    _ => {
                        let why = "lever-ups cannot be written as npz, or in shards as mjcf";
                        Err(DatasetError::Constraint(why.to_owned()))
                    }
                }
            }
        }
    }
}

/// Writes a scene of every lever-up, the MuJoCo script that plays them, and `ours.jsonl` with our
/// results in the script's format. Returns their number and size in bytes.
fn twins(
    config: &LeverConfig,
    folder: &Path,
    following: &TerminalProgress,
) -> Result<(usize, u64), DatasetError> {
    let set = LeverDataset::in_memory(config, following)?;
    let mut size = 0;
    let mut write = |name: String, text: String| {
        size += text.len() as u64;
        write_atomic(folder.join(name), text.as_bytes()).map_err(StoreError::Write)
    };
    fs::create_dir_all(folder).map_err(|source| StoreError::Io {
        doing: "make the folder",
        path: folder.to_owned(),
        source,
    })?;
    let mut ours = String::new();
    for episode in set.episodes() {
        let name = format!("{}-{:05}.xml", config.preset, episode.index);
        let numbers = |pose: &Pose3| {
            let ([x, y, z], [i, j, k, w]) = (pose.position.into(), pose.quaternion());
            [x, y, z, w, i, j, k]
        };
        let LeverTrajectory { lift, rest, .. } = &episode.trajectory;
        let lift: Vec<_> = lift.iter().map(numbers).collect();
        let slips = episode.trajectory.slipped();
        let line = json!({"scene": name, "lift": lift, "rest": numbers(rest), "slips": slips});
        ours += &format!("{line}\n");
        write(name, lever_mjcf(&episode.job()))?;
    }
    write("lever.py".to_owned(), LEVER_SCRIPT.to_owned())?;
    write("ours.jsonl".to_owned(), ours)?;
    Ok((set.episodes().len(), size))
}

pub fn run(args: &GenerateArgs, session: &Session) -> Result<u8, CliError> {
    interrupt::watch();
    let following = TerminalProgress::bar(session, "episodes");
    let made = session.compute(|| args.make(&following));
    following.finish()?;
    let (episodes, bytes) = made.map_err(data_error)?;
    let part = match args.shard() {
        Shard::WHOLE => String::new(),
        shard => format!(", shard {shard}"),
    };
    session.print(&format!(
        "{episodes} episodes of seed {}{part}, {:.1} MB, in {}\n",
        args.seed,
        bytes as f64 / 1e6,
        args.folder.display()
    ))?;
    Ok(exit_code::DONE)
}

/// Maps an error of making or reading data to an exit code.
pub fn data_error(error: DatasetError) -> CliError {
    match error {
        DatasetError::Cancelled => CliError::Interrupted(error.to_string()),
        DatasetError::Empty(_) => CliError::usage(error.to_string(), "increase the number"),
        DatasetError::Constraint(_) => CliError::usage(
            error.to_string(),
            "`pushplan-learn generate --help` lists presets and options",
        ),
        DatasetError::Foreign { .. } | DatasetError::Shard { .. } => {
            CliError::File(error.to_string())
        }
        DatasetError::Player(_) => CliError::usage(
            error.to_string(),
            "run `pip install mujoco`, or choose another --truth",
        ),
        DatasetError::Store(error) => error.into(),
    }
}
