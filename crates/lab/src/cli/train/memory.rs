//! `pushplan-lab train memory`: a long short-term memory with other inputs than the shipped one.

use std::path::PathBuf;

use clap::Args;
use pushplan::internals::scene::LeverFeatures;
use pushplan_command::error::CliError;
use pushplan_command::session::Session;
use pushplan_command::value_enums::possible_values;
use pushplan_learn::cli::train::{distinct, opened, take, weights};
use pushplan_learn::dataset::{LeverDataset, LeverEpisode, LeverPart};
use pushplan_learn::train::{Descent, LeverSettings, train_lever};

use super::RunArgs;
use crate::cli::value_enums::{LEVER_FEATURES, ShapeFeatures};
use crate::image::{ImageSettings, train_image};

/// Train a long short-term memory on the whole motion at once
#[derive(Args, Debug)]
#[command(
    after_help = "With `--features image-code`, an autoencoder is trained first, for the same \
number of steps, in the subfolder `code`.

Examples:
  pushplan-learn generate data/levers --preset levers --episodes 8000 --seed 1
  pushplan-learn generate data/held-levers --preset levers --episodes 1500 --seed 3
  pushplan-lab train memory runs/context --data data/levers --held-out data/held-levers \\
      --features shape-context --no-prior
  pushplan-lab train memory runs/image --data data/levers --held-out data/held-levers \\
      --features image --no-prior
  pushplan-lab levers --network runs/context/best.safetensors runs/image/best.safetensors"
)]
pub struct MemoryArgs {
    #[command(flatten)]
    run: RunArgs,
    /// Folders of held-out lever-ups with other seeds
    #[arg(long, value_name = "DIR", required_unless_present = "random_split", num_args = 1..)]
    held_out: Vec<PathBuf>,
    /// Split as in Tekden (2020): of 18 lever-ups of every folder, train on 14, hold out 1, and
    /// leave 3 to `pushplan-lab levers --random-split`, whose shapes then occur in training
    #[arg(long, conflicts_with_all = ["held_out", "share"])]
    random_split: bool,
    /// Use the pose of the previous frame as input, as in Tekden (2020): the true pose in training,
    /// the predicted pose afterwards
    #[arg(long, requires = "no_prior")]
    feedback: bool,
    /// Omit the frames after a slip, as in Tekden (2020)
    #[arg(long)]
    cut: bool,
    /// Features of the shape that the network sees
    #[arg(long, value_parser = possible_values(&LEVER_FEATURES), default_value = "support")]
    features: ShapeFeatures,
    /// Omit plates with this many corners
    #[arg(long, value_name = "CORNERS")]
    leave_out: Option<usize>,
    /// Number of training steps of the whole schedule
    #[arg(long, value_name = "N", default_value_t = LeverSettings::default().descent.steps,
          value_parser = clap::value_parser!(u64).range(1..))]
    steps: u64,
    /// Width of the hidden state
    #[arg(long, value_name = "N", default_value_t = LeverSettings::default().width as u32,
          value_parser = clap::value_parser!(u32).range(1..=1024))]
    width: u32,
}

pub fn run(args: &MemoryArgs, session: &Session) -> Result<u8, CliError> {
    let (data, held_out) = (opened(&args.run.data, session)?, opened(&args.held_out, session)?);
    distinct(&data, &held_out)?;
    let settings = args.settings(&data);
    let known: Vec<LeverEpisode> = data.iter().flat_map(|set| args.known(set)).collect();
    let held_out = if args.random_split { &data } else { &held_out };
    let asked: Vec<LeverEpisode> =
        held_out.iter().flat_map(|set| args.part(set, LeverPart::ChosenBy)).cloned().collect();
    let folder = take(&args.run.folder, session)?;
    match args.features {
        ShapeFeatures::Numbers(features) => {
            let settings = LeverSettings { features, ..settings };
            weights(session, |progress| train_lever(&settings, &known, &asked, &folder, progress))
        }
        ShapeFeatures::Image(features) => {
            let settings = ImageSettings { features, memory: settings };
            weights(session, |progress| train_image(&settings, &known, &asked, &folder, progress))
        }
    }
}

impl MemoryArgs {
    /// Returns the settings of a network without features of the shape.
    fn settings(&self, data: &[LeverDataset]) -> LeverSettings {
        let config = |set: &LeverDataset| {
            let share = self.run.share(set.episodes().len()) as u64;
            set.config().split(set.config().seed, share)
        };
        let default = LeverSettings::default();
        LeverSettings {
            features: LeverFeatures::Nothing,
            prior: !self.run.no_prior,
            width: self.width as usize,
            seed: self.run.seed,
            descent: Descent {
                evaluate_every: self.run.evaluate_every,
                ..default.descent.in_steps(self.steps)
            },
            data: data.iter().map(config).collect(),
            feedback: self.feedback,
            cut: self.cut,
            split: self.random_split,
            left_out: self.leave_out,
        }
    }

    /// Returns the training set.
    fn known(&self, set: &LeverDataset) -> Vec<LeverEpisode> {
        let corners =
            |episode: &LeverEpisode| episode.scene.plates[episode.lever.plate].corners().len();
        let some = self.part(set, LeverPart::Learned).take(self.run.share(set.episodes().len()));
        some.filter(|episode| Some(corners(episode)) != self.leave_out).cloned().collect()
    }

    /// Returns a part of a random split, or everything without a split.
    fn part<'a>(
        &self,
        set: &'a LeverDataset,
        part: LeverPart,
    ) -> impl Iterator<Item = &'a LeverEpisode> + use<'a> {
        let (seed, split) = (set.config().seed, self.random_split);
        set.episodes().iter().filter(move |one| !split || LeverPart::of(seed, one) == part)
    }
}
