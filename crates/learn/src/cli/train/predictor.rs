//! `pushplan-learn train predictor`: trains the physics predictor.

use std::path::{Path, PathBuf};

use clap::Args;
use pushplan::internals::network::Config;
use pushplan::internals::progress::Progress;
use pushplan_bench::store::Shard;
use pushplan_command::error::CliError;
use pushplan_command::output;
use pushplan_command::progress::TerminalProgress;
use pushplan_command::session::Session;

use crate::cli::train::{data, take, written};
use crate::dataset::{Dataset, DatasetConfig, Preset, Truth, generate};
use crate::report::training_document;
use crate::train::{Descent, HeldOutError, Line, PredictorSettings, train_predictor};

/// Data sets of the shipped weights: name, preset, engine, training episodes and held-out episodes.
///
/// A MuJoCo episode takes about a second, thirty times as long as one of the 3-D engine.
const SETS: [(&str, Preset, Truth, u64, u64); 4] = [
    ("planar", Preset::Placed, Truth::Planar, 8000, 300),
    ("3d", Preset::Placed, Truth::Spatial, 20_000, 300),
    ("mujoco", Preset::Placed, Truth::Mujoco, 3600, 200),
    ("crowds", Preset::Crowds, Truth::Both, 1600, 40),
];

/// Train the physics predictor
#[derive(Args, Debug)]
#[command(
    after_help = "The data are crowds, and pushes with tools simulated by three engines: the 2-D \
engine, the 3-D engine and MuJoCo. MuJoCo needs a Python with the package `mujoco`; \
PUSHPLAN_PYTHON names it. The data take 20 minutes of a core, and MuJoCo an hour; the \
training takes some minutes.

curves.svg in the folder of the run shows the held-out errors. After the whole schedule, the \
weights of the last evaluation (last.safetensors) are often better than best.safetensors.

Examples:
  pushplan-learn train predictor runs/predictor
  pushplan-learn train predictor runs/small --without-mujoco --share 0.1 --steps 2000 --width 64
  pushplan-learn train predictor runs/own --data data/train
  pushplan-lab evaluate --model runs/own/best.safetensors"
)]
pub struct PredictorArgs {
    /// Folder of the run
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Folders of data from `generate` [default: data generated in DIR]
    #[arg(long, value_name = "DIR", num_args = 1..,
          conflicts_with_all = ["share", "data_seed", "without_mujoco"])]
    data: Vec<PathBuf>,
    /// Number of episodes to generate in DIR, relative to the training of the shipped weights
    #[arg(long, value_name = "X", default_value_t = 1.0)]
    share: f64,
    /// Omit the episodes simulated by MuJoCo
    #[arg(long)]
    without_mujoco: bool,
    /// Seed of the episodes generated in DIR
    #[arg(long, value_name = "N", default_value_t = DatasetConfig::default().seed)]
    data_seed: u64,
    /// Seed of the held-out episodes; it must differ from the seed of the training data
    #[arg(long, value_name = "N", default_value_t = 2)]
    held_out_seed: u64,
    /// Number of training steps of the whole schedule
    #[arg(long, value_name = "N", default_value_t = PredictorSettings::default().descent.steps,
          value_parser = clap::value_parser!(u64).range(1..))]
    steps: u64,
    /// Number of steps between held-out evaluations and checkpoints
    #[arg(long, value_name = "N",
          default_value_t = PredictorSettings::default().descent.evaluate_every,
          value_parser = clap::value_parser!(u64).range(1..))]
    evaluate_every: u64,
    /// Number of pushes per step, even
    #[arg(long, value_name = "N",
          default_value_t = PredictorSettings::default().descent.batch as u32,
          value_parser = clap::value_parser!(u32).range(2..=65_536))]
    batch: u32,
    /// Hidden width, even
    #[arg(long, value_name = "N", default_value_t = Config::default().width as u32,
          value_parser = clap::value_parser!(u32).range(2..=4096))]
    width: u32,
    /// Number of propagation steps
    #[arg(long, value_name = "N", default_value_t = Config::default().steps as u32,
          value_parser = clap::value_parser!(u32).range(1..=16))]
    propagation: u32,
    /// Maximum learning rate
    #[arg(long, value_name = "X",
          default_value_t = PredictorSettings::default().descent.learning_rate)]
    learning_rate: f64,
    /// Seed of the initial weights and the batches
    #[arg(long, value_name = "N", default_value_t = PredictorSettings::default().seed)]
    seed: u64,
}

/// Progress of training that redraws the curves with every line.
struct Followed<'a> {
    folder: &'a Path,
    following: TerminalProgress<'a>,
}

pub fn run(args: &PredictorArgs, session: &Session) -> Result<u8, CliError> {
    let settings = args.settings()?;
    let folder = take(&args.folder, session)?;
    let made = |name: &str, config: DatasetConfig| {
        let folder = args.folder.join(name);
        data(session, name, |progress| {
            generate(&config, Shard::WHOLE, &folder, progress)?;
            Dataset::open(&folder)
        })
    };
    let mut learned = Vec::new();
    for folder in &args.data {
        learned.push(data(session, "data", |_| Dataset::open(folder))?);
    }
    if learned.is_empty() {
        for (name, config, _) in args.sets() {
            learned.push(made(&format!("data-{name}"), config)?);
        }
    }
    if learned.iter().any(|set| set.config().seed == args.held_out_seed) {
        let message = "training episodes and held-out episodes have the same seed";
        return Err(CliError::usage(message, "choose another --held-out-seed"));
    }
    let mut held_out = Vec::new();
    for (k, set) in learned.iter().enumerate() {
        let config = set.config();
        let known = SETS
            .iter()
            .find(|(_, preset, truth, ..)| (*preset, *truth) == (config.preset, config.truth));
        let count = known.map_or(config.episodes.div_ceil(20).min(300), |set| args.of(set.4));
        let name = known.map_or_else(|| (k + 1).to_string(), |set| set.0.to_owned());
        let config = config.split(args.held_out_seed, count);
        held_out.push(made(&format!("held-out-{name}"), config)?);
    }
    let followed =
        Followed { folder: &args.folder, following: TerminalProgress::bar(session, "steps") };
    let best =
        session.compute(|| train_predictor(&settings, &learned, &held_out, &folder, &followed));
    let drawn = followed.draw();
    followed.following.finish()?;
    drawn?;
    written(session, best)
}

impl PredictorArgs {
    /// Returns the data sets made in the folder: name, configuration and number of held-out
    /// episodes.
    fn sets(&self) -> impl Iterator<Item = (&'static str, DatasetConfig, u64)> {
        let asked = |set: &&(_, _, Truth, _, _)| !self.without_mujoco || set.2 != Truth::Mujoco;
        SETS.iter().filter(asked).map(|&(name, preset, truth, episodes, held_out)| {
            let config = DatasetConfig { preset, truth, ..DatasetConfig::default() };
            (name, config.split(self.data_seed, self.of(episodes)), self.of(held_out))
        })
    }

    /// Returns the requested share of a number of episodes, at least one.
    fn of(&self, episodes: u64) -> u64 {
        ((episodes as f64 * self.share).round() as u64).max(1)
    }

    fn settings(&self) -> Result<PredictorSettings, CliError> {
        let default = PredictorSettings::default();
        let settings = PredictorSettings {
            config: Config { width: self.width as usize, steps: self.propagation as usize },
            seed: self.seed,
            descent: Descent {
                batch: self.batch as usize,
                evaluate_every: self.evaluate_every,
                learning_rate: self.learning_rate,
                ..default.descent.in_steps(self.steps)
            },
        };
        for (name, even) in [("--width", self.width), ("--batch", self.batch)] {
            if even % 2 == 1 {
                let message = format!("{name} must be even, not {even}");
                return Err(CliError::usage(message, format!("try {}", even + 1)));
            }
        }
        if !(self.share > 0.0 && self.share <= 100.0) {
            return Err(CliError::usage("--share must be above 0 and at most 100", "try 0.1"));
        }
        let sound = |value: f64, largest: f64| (0.0..=largest).contains(&value);
        if !sound(self.learning_rate, 1.0) || self.learning_rate == 0.0 {
            return Err(CliError::usage(
                "--learning-rate must be above 0 and at most 1",
                "try 0.002",
            ));
        }
        Ok(settings)
    }
}

impl Progress for Followed<'_> {
    fn update(&self, done: u64, total: u64) {
        self.following.update(done, total);
    }

    fn line(&self, text: &str) {
        self.following.line(text);
        self.following.keep(self.draw());
    }

    fn cancelled(&self) -> bool {
        self.following.cancelled()
    }
}

impl Followed<'_> {
    /// Draws the curves of the whole run, including the part before an interruption.
    fn draw(&self) -> Result<(), CliError> {
        let path = self.folder.join("metrics.jsonl");
        let text = std::fs::read_to_string(&path)
            .map_err(|error| CliError::unexpected("cannot read the metrics", &error))?;
        let lines: Vec<Line<HeldOutError>> =
            text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
        output::write_figures(self.folder, training_document(&lines).figures()).map(|_| ())
    }
}
