//! `pushplan-lab levers`: errors of models of lever-ups.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use pushplan::internals::effect::{LeverNetwork, LeverPrior, PriorSettings};
use pushplan::internals::sim::LeverSimulator;
use pushplan::internals::{outcome::LeverTrajectory, scene::LeverFeatures, task::LeverJob};
use pushplan_command::error::CliError;
use pushplan_command::form::Form;
use pushplan_command::interrupt;
use pushplan_command::progress::TerminalProgress;
use pushplan_command::session::Session;
use pushplan_command::value_enums::possible_values;
use pushplan_learn::cli::generate::data_error;
use pushplan_learn::cli::value_enums::LEVER_PRESETS;
use pushplan_learn::dataset::{LeverConfig, LeverDataset, LeverEpisode, LeverPart, LeverPreset};
use pushplan_learn::lever_model::{LeverModel, SimulatedLevers};

use crate::bench::{LeverBaseline, Neighbour, lever_report, load_lever};
use crate::report::levers_document;

/// Measure models of lever-ups against the 3-D engine, on unseen plates
#[derive(Args, Debug)]
pub struct LeversArgs {
    /// Families of lever-ups [default: levers and levers-varied]
    #[arg(value_parser = possible_values(&LEVER_PRESETS), value_name = "FAMILY")]
    families: Vec<LeverPreset>,
    /// Number of lever-ups of each family
    #[arg(long, value_name = "N", default_value_t = 2000,
          value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    cases: u64,
    /// Seed of the lever-ups
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    /// Number of remembered lever-ups of the models without physics
    #[arg(long, value_name = "N", default_value_t = 1600,
          value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    known: u64,
    /// Seed of the remembered lever-ups; it must differ from --seed
    #[arg(long, value_name = "N", default_value_t = 1)]
    known_seed: u64,
    /// Weights of additional networks, see `pushplan-lab train`
    #[arg(long, value_name = "FILE", num_args = 1..)]
    network: Vec<PathBuf>,
    /// Restrict to plates with this many corners
    #[arg(long, value_name = "N")]
    corners: Option<usize>,
    /// Split as in Tekden (2020): test the lever-ups of --seed that `train memory --random-split`
    /// leaves out, and remember its training lever-ups
    #[arg(long, conflicts_with_all = ["known", "known_seed"])]
    random_split: bool,
    /// Measure only up to the first slip, as in Tekden (2020)
    #[arg(long)]
    cut: bool,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &LeversArgs, session: &Session) -> Result<(), CliError> {
    if args.seed == args.known_seed && !args.random_split {
        let message = "remembered lever-ups and tested lever-ups have the same seed";
        return Err(CliError::usage(message, "choose another --known-seed"));
    }
    let others =
        args.network.iter().map(|path| Named::load(path, false)).collect::<Result<Vec<_>, _>>()?;
    let shipped = LeverNetwork::shipped()
        .map_err(|error| CliError::unexpected("cannot use the shipped weights", &error))?;
    interrupt::watch();
    let usual = [LeverPreset::Fixed, LeverPreset::Varied];
    let families = if args.families.is_empty() { &usual[..] } else { &args.families };
    let mut reports = Vec::new();
    for preset in families {
        let draw = |(seed, episodes)| {
            let config = LeverConfig { seed, episodes, preset: *preset };
            let following = TerminalProgress::bar(session, "simulating");
            let drawn = session.compute(|| LeverDataset::in_memory(&config, &following));
            following.finish()?;
            drawn.map_err(data_error)
        };
        let mut asked = draw((args.seed, args.cases))?.episodes().to_vec();
        let known = if args.random_split {
            let part = |episode: &LeverEpisode| LeverPart::of(args.seed, episode);
            let known = asked.iter().filter(|one| part(one) == LeverPart::Learned).cloned();
            let known = known.collect();
            asked.retain(|one| part(one) == LeverPart::Asked);
            known
        } else {
            draw((args.known_seed, args.known))?.episodes().to_vec()
        };
        if args.cut {
            asked = asked.iter().filter_map(LeverEpisode::before_slip).collect();
        }
        asked.retain(|episode| args.corners.is_none_or(|corners| corners_of(episode) == corners));
        let spinner = session.spinner("predicting");
        reports.push(session.compute(|| {
            let models = models(&known);
            let mut models: Vec<&dyn LeverModel> = models.iter().map(|model| &**model).collect();
            models.push(&shipped);
            models.extend(others.iter().map(|network| network as &dyn LeverModel));
            lever_report((*preset, args.seed), &asked, &models)
        }));
        spinner.finish_and_clear();
    }
    let mut document = levers_document(&reports);
    if args.random_split {
        let note = "The shapes of these lever-ups occur in training, with other lever points.";
        document.notes.push(note.to_owned());
    }
    if args.cut {
        let note = "The rotation ends with the last frame before a slip.";
        document.notes.push(note.to_owned());
    }
    args.form.show(session, &document)
}

/// Returns the models, simplest first.
fn models(known: &[LeverEpisode]) -> Vec<Box<dyn LeverModel>> {
    let like = |neighbour| LeverBaseline::like(neighbour, known, 1);
    let nearest = |features| like(Neighbour::Nearest(features));
    vec![
        Box::new(LeverBaseline::still()),
        Box::new(LeverBaseline::mean(known)),
        Box::new(like(Neighbour::Random)),
        Box::new(nearest(LeverFeatures::ShapeContext)),
        Box::new(nearest(LeverFeatures::Corners)),
        Box::new(nearest(LeverFeatures::Support)),
        Box::new(LeverPrior { settings: PriorSettings::FROM_REST }),
        Box::new(LeverPrior::default()),
        Box::new(LeverPrior { settings: PriorSettings::FINE }),
        Box::new(SimulatedLevers { simulator: LeverSimulator::COARSE }),
    ]
}

fn corners_of(episode: &LeverEpisode) -> usize {
    episode.scene.plates[episode.lever.plate].corners().len()
}

/// A network named after its file.
pub(super) struct Named {
    network: Arc<dyn LeverModel>,
    path: String,
    /// Whether it is also measured among blocks, which are outside the domain of shipped networks.
    among_blocks: bool,
}

impl Named {
    /// Loads weights.
    ///
    /// # Errors
    /// Returns [`CliError::File`] if the weights cannot be used.
    pub fn load(path: &Path, among_blocks: bool) -> Result<Self, CliError> {
        let network = load_lever(path).map_err(|error| CliError::File(error.to_string()))?;
        Ok(Self { network, path: path.display().to_string(), among_blocks })
    }
}

impl LeverModel for Named {
    fn name(&self) -> String {
        format!("{}, {}", self.network.name(), self.path)
    }

    fn takes(&self, job: &LeverJob) -> bool {
        self.among_blocks || self.network.takes(job)
    }

    fn rollout(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
        self.network.rollout(jobs)
    }
}
