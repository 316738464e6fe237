//! `pushplan-learn train-lever`: a network of lever-ups, in a folder that holds the whole run.

use std::path::PathBuf;

use clap::Args;
use pushplan::cli::error::CliError;
use pushplan::cli::follow::Following;
use pushplan::cli::session::Session;
use pushplan::cli::words::words;
use pushplan::cli::{exit_code, interrupt};
use pushplan::internals::network::Config;
use pushplan::internals::scene::LeverFeatures;
use pushplan::internals::store::FolderLock;

use crate::cli::generate::data_error;
use crate::cli::train::train_error;
use crate::cli::words::{LEVER_FEATURES, LEVER_FORMS, LeverForm};
use crate::dataset::{LeverDataset, LeverEpisode, LeverPart};
use crate::train::{Descent, LeverSettings, PartsSettings, train_lever, train_parts};

/// Train a network of lever-ups; the same command goes on with an interrupted run
#[derive(Args, Debug)]
#[command(
    after_help = "Lever-ups are those of `pushplan-learn generate --preset levers`. In the folder lie checkpoint.safetensors
to go on from, metrics.jsonl, and best.safetensors, the weights with the lowest held-out error.
With `--features image-code` an autoencoder is trained first, for as many steps; its state is in code.safetensors.
Ctrl-C saves and stops; the same command then goes on, to the same bits as a run that never stopped.

Examples:
  pushplan-learn generate data/levers --preset levers --episodes 8000 --seed 1
  pushplan-learn generate data/levers-held-out --preset levers --episodes 1000 --seed 2
  pushplan-learn train-lever runs/context --data data/levers --held-out data/levers-held-out \\
      --features shape-context --no-prior
  pushplan-learn train-lever runs/image --data data/levers --held-out data/levers-held-out \\
      --features image --no-prior
  pushplan-lab levers --network runs/context/best.safetensors
  pushplan-learn train-lever runs/parts --data data/hdd --held-out data/hdd-held-out --model parts --no-prior
  pushplan-lab hdd --network runs/parts/best.safetensors"
)]
pub struct TrainLeverArgs {
    /// Folder of the run
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Folders of lever-ups to learn from
    #[arg(long, value_name = "DIR", required = true, num_args = 1..)]
    data: Vec<PathBuf>,
    /// Folders of held-out lever-ups, of other seeds
    #[arg(long, value_name = "DIR", required_unless_present = "random_split", num_args = 1..)]
    held_out: Vec<PathBuf>,
    /// As in the thesis, learn from 14 in 18 lever-ups of every folder, hold one out, and leave the
    /// others to `pushplan-lab levers --random-split`: their shapes have been seen
    #[arg(long, conflicts_with_all = ["held_out", "share"])]
    random_split: bool,
    /// As in the thesis, tell the pose of the frame before: the true one while learning, the predicted
    /// one after
    #[arg(long, requires = "no_prior")]
    feedback: bool,
    /// As in the thesis, leave out the frames from a slip on
    #[arg(long)]
    cut: bool,
    /// What the network is; parts are those of lever-ups `hdd`, and all of them are seen
    #[arg(long, value_parser = words(&LEVER_FORMS), default_value = "memory")]
    model: LeverForm,
    /// What the network is told of the shape
    #[arg(long, value_parser = words(&LEVER_FEATURES), default_value = "support",
          default_value_if("model", "parts", None))]
    features: Option<LeverFeatures>,
    /// Predict everything, and correct no prior
    #[arg(long)]
    no_prior: bool,
    /// Learn from this share of every folder only, its first lever-ups
    #[arg(long, value_name = "PERCENT", default_value_t = 100,
          value_parser = clap::value_parser!(u8).range(1..=100))]
    share: u8,
    /// Leave out plates of this many corners
    #[arg(long, value_name = "CORNERS")]
    leave_out: Option<usize>,
    /// Steps of the whole schedule [default: 8000; of parts 20000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    steps: Option<u64>,
    /// Steps between held-out evaluations and checkpoints
    #[arg(long, value_name = "N", default_value_t = LeverSettings::default().evaluate_every,
          value_parser = clap::value_parser!(u64).range(1..))]
    evaluate_every: u64,
    /// Width of the hidden state, of parts even [default: 56; of parts 64]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    width: Option<u32>,
    /// Seed of first weights and batches
    #[arg(long, value_name = "N", default_value_t = LeverSettings::default().seed)]
    seed: u64,
}

impl TrainLeverArgs {
    /// The schedule, of as many steps as were asked for.
    fn descent(&self, default: Descent) -> Descent {
        let steps = self.steps.unwrap_or(default.steps);
        // A short run must get past its warm-up as well.
        Descent { steps, warm_up: default.warm_up.min(steps / 10), ..default }
    }

    /// Refuses what only a memory knows, and widths that have no halves.
    fn check_parts(&self) -> Result<(), CliError> {
        let others = self.feedback || self.cut || self.random_split || self.leave_out.is_some();
        if others || self.features.is_some() || self.width.is_some_and(|width| width % 2 != 0) {
            let message = "parts know no features, feedback, cut, split or corners, nor odd widths";
            return Err(CliError::usage(message, "leave them out"));
        }
        Ok(())
    }

    /// The settings of a network of parts, else as those of a memory.
    fn parts(&self, of: &LeverSettings) -> PartsSettings {
        let default = PartsSettings::default();
        let width = self.width.map_or(default.config.width, |width| width as usize);
        PartsSettings {
            config: Config { width, ..default.config },
            prior: of.prior,
            seed: of.seed,
            evaluate_every: of.evaluate_every,
            descent: self.descent(default.descent),
            data: of.data.clone(),
            ..default
        }
    }
}

pub fn run(args: &TrainLeverArgs, session: &Session) -> Result<u8, CliError> {
    if args.model == LeverForm::Parts {
        args.check_parts()?;
    }
    let read = |folders: &[PathBuf]| {
        let open = |folder: &PathBuf| LeverDataset::open(folder).map_err(data_error);
        folders.iter().map(open).collect::<Result<Vec<_>, CliError>>()
    };
    let (data, held_out) = (read(&args.data)?, read(&args.held_out)?);
    let seeds =
        |sets: &[LeverDataset]| sets.iter().map(|set| set.config().seed).collect::<Vec<_>>();
    if seeds(&data).iter().any(|seed| seeds(&held_out).contains(seed)) {
        let message = "held-out lever-ups have the seed of others";
        return Err(CliError::usage(message, "generate them with another --seed"));
    }
    let default = LeverSettings::default();
    let share = |count: usize| (count * usize::from(args.share)).div_ceil(100);
    let settings = LeverSettings {
        features: args.features.unwrap_or(default.features),
        prior: !args.no_prior,
        width: args.width.map_or(default.width, |width| width as usize),
        seed: args.seed,
        evaluate_every: args.evaluate_every,
        descent: args.descent(default.descent),
        data: data
            .iter()
            .map(|set| set.config().split(set.config().seed, share(set.episodes().len()) as u64))
            .collect(),
        feedback: args.feedback,
        cut: args.cut,
        split: args.random_split,
        left_out: args.leave_out,
        ..default
    };
    let corners =
        |episode: &LeverEpisode| episode.scene.plates[episode.lever.plate].corners().len();
    let part = |set: &LeverDataset, part: LeverPart| {
        let seed = set.config().seed;
        let among =
            |episode: &&LeverEpisode| !args.random_split || LeverPart::of(seed, episode) == part;
        set.episodes().iter().filter(among).cloned().collect::<Vec<_>>()
    };
    let kept = |set: &LeverDataset| {
        let some = part(set, LeverPart::Learned).into_iter().take(share(set.episodes().len()));
        some.filter(|episode| Some(corners(episode)) != args.leave_out).collect::<Vec<_>>()
    };
    let known: Vec<LeverEpisode> = data.iter().flat_map(kept).collect();
    let held_out = if args.random_split { &data } else { &held_out };
    let asked: Vec<LeverEpisode> =
        held_out.iter().flat_map(|set| part(set, LeverPart::ChosenBy)).collect();
    interrupt::watch();
    let folder = FolderLock::take(&args.folder, &Following::bar(session, "folder"))?;
    let following = Following::bar(session, "steps");
    let best = session.compute(|| match args.model {
        LeverForm::Memory => train_lever(&settings, &known, &asked, &folder, &following),
        LeverForm::Parts => {
            train_parts(&args.parts(&settings), &known, &asked, &folder, &following)
        }
    });
    following.finish()?;
    let best = best.map_err(train_error)?;
    if interrupt::requested() {
        let message = "stopped; the run is saved, the same command goes on with it";
        return Err(CliError::Interrupted(message.to_owned()));
    }
    if let Some(best) = best {
        session.print(&format!("wrote {}\n", best.display()))?;
    }
    Ok(exit_code::DONE)
}
