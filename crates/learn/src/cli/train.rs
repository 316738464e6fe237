//! `pushplan-learn train`: weights from data, in a folder that holds the whole run.

use std::path::{Path, PathBuf};

use clap::Args;
use pushplan::cli::error::CliError;
use pushplan::cli::follow::Following;
use pushplan::cli::session::Session;
use pushplan::cli::words::words;
use pushplan::cli::{exit_code, interrupt, output};
use pushplan::internals::network::Config;
use pushplan::internals::store::FolderLock;
use pushplan::internals::watch::Watch;

use crate::cli::generate::data_error;
use crate::cli::words::{EXPOSURES, PRESETS};
use crate::dataset::{Dataset, DatasetConfig, Preset};
use crate::report::training_document;
use crate::train::{CheckpointError, Exposure, MetricLine, Settings, TrainError, train};

/// Train the network; the same command goes on with an interrupted run
#[derive(Args, Debug)]
#[command(
    after_help = "The folder holds the run: checkpoint.safetensors to go on from, metrics.jsonl, curves.svg, and
best.safetensors, the weights with the lowest held-out error, and last.safetensors, those of the
last evaluation: often the better ones once the schedule is through. Ctrl-C saves and stops; the same
command then goes on, to the same bits as a run that never stopped.

Examples:
  pushplan-learn train runs/small --episodes 2000 --steps 2000 --width 64
  pushplan-learn train runs/full --data data/train
  pushplan-lab evaluate --model runs/full/best.safetensors"
)]
pub struct TrainArgs {
    /// Folder of the run
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Folder with data made by `generate`; by default they are made in memory
    #[arg(long, value_name = "DIR", conflicts_with_all = ["episodes", "data_seed"])]
    data: Option<PathBuf>,
    /// Family of the episodes made in memory
    #[arg(long, value_parser = words(&PRESETS), default_value = "mixed", conflicts_with = "data")]
    preset: Preset,
    /// Number of episodes made in memory
    #[arg(long, value_name = "N", default_value_t = DatasetConfig::default().episodes)]
    episodes: u64,
    /// Seed of the episodes made in memory
    #[arg(long, value_name = "N", default_value_t = DatasetConfig::default().seed)]
    data_seed: u64,
    /// Number of held-out episodes
    #[arg(long, value_name = "N", default_value_t = 600)]
    held_out: u64,
    /// Seed of the held-out episodes; must differ from that of the data
    #[arg(long, value_name = "N", default_value_t = 2)]
    held_out_seed: u64,
    /// Steps of the whole schedule
    #[arg(long, value_name = "N", default_value_t = Settings::default().steps,
          value_parser = clap::value_parser!(u64).range(1..))]
    steps: u64,
    /// Steps between held-out evaluations and checkpoints
    #[arg(long, value_name = "N", default_value_t = Settings::default().evaluate_every,
          value_parser = clap::value_parser!(u64).range(1..))]
    evaluate_every: u64,
    /// Graphs per step, an even number
    #[arg(long, value_name = "N", default_value_t = Settings::default().batch as u32,
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
    #[arg(long, value_name = "X", default_value_t = Settings::default().learning_rate)]
    learning_rate: f64,
    /// Largest shift of noisy inputs, metres
    #[arg(long, value_name = "X", default_value_t = Settings::default().noise.shift)]
    noise: f64,
    /// Largest number of frames that the network's own rollout leads up to an example; none by
    /// default, as the corrections wanted are those at the true state either way
    #[arg(long, value_name = "N", default_value_t = Settings::default().noise.lead)]
    lead: usize,
    /// How that number is drawn
    #[arg(long, value_parser = words(&EXPOSURES), default_value = "pushforward")]
    exposure: Exposure,
    /// Seed of first weights, batches and noise
    #[arg(long, value_name = "N", default_value_t = Settings::default().seed)]
    seed: u64,
}

/// Follows training, and draws its curves again with every line.
struct Followed<'a> {
    folder: &'a Path,
    following: Following<'a>,
}

pub fn run(args: &TrainArgs, session: &Session) -> Result<u8, CliError> {
    let settings = args.settings()?;
    interrupt::watch();
    let following = Following::bar(session, "data");
    let folder = FolderLock::take(&args.folder, &following)?;
    let made = session.compute(|| {
        let data = match &args.data {
            Some(folder) => Dataset::open(folder)?,
            None => {
                let preset = args.preset;
                let default = DatasetConfig { preset, ..DatasetConfig::default() };
                Dataset::in_memory(&default.split(args.data_seed, args.episodes), &following)?
            }
        };
        let held_out = data.config().split(args.held_out_seed, args.held_out);
        Ok((Dataset::in_memory(&held_out, &following)?, data))
    });
    following.finish()?;
    let (held_out, data) = made.map_err(data_error)?;
    if data.config().seed == args.held_out_seed {
        let message = "the held-out episodes have the seed of the data";
        return Err(CliError::usage(message, "choose another --held-out-seed"));
    }
    let followed = Followed { folder: &args.folder, following: Following::bar(session, "steps") };
    let best = session.compute(|| train(&settings, &data, &held_out, &folder, &followed));
    let drawn = followed.draw();
    followed.following.finish()?;
    let best = best.map_err(train_error)?;
    drawn?;
    if interrupt::requested() {
        let message = "stopped; the run is saved, the same command goes on with it";
        return Err(CliError::Interrupted(message.to_owned()));
    }
    if let Some(best) = best {
        session.print(&format!("wrote {}\n", best.display()))?;
    }
    Ok(exit_code::DONE)
}

impl TrainArgs {
    fn settings(&self) -> Result<Settings, CliError> {
        let default = Settings::default();
        let mut settings = Settings {
            config: Config { width: self.width as usize, steps: self.propagation as usize },
            seed: self.seed,
            steps: self.steps,
            batch: self.batch as usize,
            learning_rate: self.learning_rate,
            // A short run must get past its warm-up as well.
            warm_up: default.warm_up.min(self.steps / 10),
            evaluate_every: self.evaluate_every,
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
        let lines: Vec<MetricLine> =
            text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
        output::write_figures(self.folder, training_document(&lines).figures()).map(|_| ())
    }
}

pub fn train_error(error: TrainError) -> CliError {
    match error {
        TrainError::Data(error) => data_error(error),
        TrainError::Write(faults) => CliError::Output(faults),
        TrainError::Checkpoint(_, CheckpointError::Other(_)) => CliError::usage(
            error.to_string(),
            "the same settings go on with a run; every setting counts",
        ),
        TrainError::Checkpoint(..) => CliError::File(error.to_string()),
        _ => CliError::Unexpected(error.to_string()),
    }
}
