//! `pushplan-learn train predictor`: the physics predictor.

use std::path::{Path, PathBuf};

use clap::Args;
use pushplan::cli::error::CliError;
use pushplan::cli::follow::Following;
use pushplan::cli::output;
use pushplan::cli::session::Session;
use pushplan::cli::words::words;
use pushplan::internals::network::Config;
use pushplan::internals::store::Shard;
use pushplan::internals::watch::Watch;

use crate::cli::train::{data, take, written};
use crate::cli::words::{EXPOSURES, PRESETS};
use crate::dataset::{Dataset, DatasetConfig, Preset, generate};
use crate::report::training_document;
use crate::train::{Descent, Exposure, HeldOutError, Line, PredictorSettings, train_predictor};

/// Episodes that the shipped weights have learned from.
const EPISODES: u64 = 24_000;

/// Episodes that they were judged on.
const HELD_OUT: u64 = 300;

/// The physics predictor
#[derive(Args, Debug)]
#[command(
    after_help = "curves.svg in the folder of the run shows the held-out errors. The weights of the last evaluation,
last.safetensors, are often the better ones once the schedule is through.

Examples:
  pushplan-learn train predictor runs/predictor
  pushplan-learn train predictor runs/small --episodes 2000 --steps 2000 --width 64
  pushplan-learn train predictor runs/own --data data/train
  pushplan-lab evaluate --model runs/own/best.safetensors"
)]
pub struct PredictorArgs {
    /// Folder of the run
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Folder with data made by `generate` [default: they are made in DIR]
    #[arg(long, value_name = "DIR", conflicts_with_all = ["episodes", "data_seed"])]
    data: Option<PathBuf>,
    /// Family of the episodes made in DIR
    #[arg(long, value_parser = words(&PRESETS), default_value = "mixed", conflicts_with = "data")]
    preset: Preset,
    /// Number of episodes made in DIR
    #[arg(long, value_name = "N", default_value_t = EPISODES)]
    episodes: u64,
    /// Seed of the episodes made in DIR
    #[arg(long, value_name = "N", default_value_t = DatasetConfig::default().seed)]
    data_seed: u64,
    /// Number of held-out episodes
    #[arg(long, value_name = "N", default_value_t = HELD_OUT)]
    held_out: u64,
    /// Seed of the held-out episodes; must differ from that of the data
    #[arg(long, value_name = "N", default_value_t = 2)]
    held_out_seed: u64,
    /// Steps of the whole schedule
    #[arg(long, value_name = "N", default_value_t = PredictorSettings::default().descent.steps,
          value_parser = clap::value_parser!(u64).range(1..))]
    steps: u64,
    /// Steps between held-out evaluations and checkpoints
    #[arg(long, value_name = "N", default_value_t = PredictorSettings::default().descent.evaluate_every,
          value_parser = clap::value_parser!(u64).range(1..))]
    evaluate_every: u64,
    /// Graphs per step, an even number
    #[arg(long, value_name = "N", default_value_t = PredictorSettings::default().descent.batch as u32,
          value_parser = clap::value_parser!(u32).range(2..=65_536))]
    batch: u32,
    /// Hidden width, an even number
    #[arg(long, value_name = "N", default_value_t = Config::default().width as u32,
          value_parser = clap::value_parser!(u32).range(2..=4096))]
    width: u32,
    /// Propagation steps
    #[arg(long, value_name = "N", default_value_t = Config::default().steps as u32,
          value_parser = clap::value_parser!(u32).range(1..=16))]
    propagation: u32,
    /// Highest learning rate
    #[arg(long, value_name = "X", default_value_t = PredictorSettings::default().descent.learning_rate)]
    learning_rate: f64,
    /// Largest shift of noisy inputs, metres
    #[arg(long, value_name = "X", default_value_t = PredictorSettings::default().noise.shift)]
    noise: f64,
    /// Largest number of frames that the network's own rollout leads up to an example; none by
    /// default, as the corrections wanted are those at the true state either way
    #[arg(long, value_name = "N", default_value_t = PredictorSettings::default().noise.lead)]
    lead: usize,
    /// How that number is drawn
    #[arg(long, value_parser = words(&EXPOSURES), default_value = "pushforward")]
    exposure: Exposure,
    /// Seed of first weights, batches and noise
    #[arg(long, value_name = "N", default_value_t = PredictorSettings::default().seed)]
    seed: u64,
}

/// Follows training, and draws its curves again with every line.
struct Followed<'a> {
    folder: &'a Path,
    following: Following<'a>,
}

pub fn run(args: &PredictorArgs, session: &Session) -> Result<u8, CliError> {
    let settings = args.settings()?;
    let folder = take(&args.folder, session)?;
    let made = |name: &str, config: DatasetConfig| {
        let folder = args.folder.join(name);
        data(session, name, |watch| {
            generate(&config, Shard::WHOLE, &folder, watch)?;
            Dataset::open(&folder)
        })
    };
    let learned = match &args.data {
        Some(folder) => data(session, "data", |_| Dataset::open(folder))?,
        None => {
            let default = DatasetConfig { preset: args.preset, ..DatasetConfig::default() };
            made("data", default.split(args.data_seed, args.episodes))?
        }
    };
    if learned.config().seed == args.held_out_seed {
        let message = "the held-out episodes have the seed of the data";
        return Err(CliError::usage(message, "choose another --held-out-seed"));
    }
    let held_out = made("held-out", learned.config().split(args.held_out_seed, args.held_out))?;
    let followed = Followed { folder: &args.folder, following: Following::bar(session, "steps") };
    let best =
        session.compute(|| train_predictor(&settings, &learned, &held_out, &folder, &followed));
    let drawn = followed.draw();
    followed.following.finish()?;
    drawn?;
    written(session, best)
}

impl PredictorArgs {
    fn settings(&self) -> Result<PredictorSettings, CliError> {
        let default = PredictorSettings::default();
        let mut settings = PredictorSettings {
            config: Config { width: self.width as usize, steps: self.propagation as usize },
            seed: self.seed,
            descent: Descent {
                batch: self.batch as usize,
                evaluate_every: self.evaluate_every,
                learning_rate: self.learning_rate,
                ..default.descent.in_steps(self.steps)
            },
            ..default
        };
        settings.noise.shift = self.noise;
        settings.noise.lead = self.lead;
        settings.noise.exposure = self.exposure;
        for (name, even) in [("--width", self.width), ("--batch", self.batch)] {
            if even % 2 == 1 {
                let message = format!("{name} must be even, not {even}");
                return Err(CliError::usage(message, format!("try {}", even + 1)));
            }
        }
        let sound = |value: f64, largest: f64| (0.0..=largest).contains(&value);
        if !sound(self.learning_rate, 1.0) || self.learning_rate == 0.0 {
            return Err(CliError::usage(
                "--learning-rate must be above 0 and at most 1",
                "try 0.002",
            ));
        }
        if !sound(self.noise, 0.1) {
            return Err(CliError::usage("--noise must be 0 to 0.1 m", "try 0.001"));
        }
        Ok(settings)
    }
}

impl Watch for Followed<'_> {
    fn progress(&self, done: u64, total: u64) {
        self.following.progress(done, total);
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
    /// The curves of the whole run, also of the part before it was interrupted.
    fn draw(&self) -> Result<(), CliError> {
        let path = self.folder.join("metrics.jsonl");
        let text = std::fs::read_to_string(&path)
            .map_err(|error| CliError::unexpected("cannot read the metrics", &error))?;
        let lines: Vec<Line<HeldOutError>> =
            text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
        output::write_figures(self.folder, training_document(&lines).figures()).map(|_| ())
    }
}
