//! `pushplan-lab adapted`: benefit of fitting a network to a table.

use std::path::PathBuf;

use clap::Args;
use pushplan::internals::effect::Network;
use pushplan::internals::scene::{ModelKind, ModelSpec};
use pushplan_act::judge::Trial;
use pushplan_command::error::CliError;
use pushplan_command::form::Form;
use pushplan_command::model;
use pushplan_command::recordings::load_recordings;
use pushplan_command::session::Session;
use rayon::prelude::*;

use crate::bench::{adapted_rows, measure_split, splits};
use crate::report::adapted_document;

/// Measure errors of a network on recorded pushes, after a fit to other pushes on the same table
#[derive(Args, Debug)]
#[command(
    after_help = "Every folder is a set of one object or support. In the first part, test pushes \
are drawn from all sets together; in the second part, each set is left out of the fit in turn."
)]
pub struct AdaptedArgs {
    /// Folders of recordings
    #[arg(required = true, value_name = "RECORDINGS")]
    recordings: Vec<PathBuf>,
    /// Weights file of the network, or `network` for the shipped weights
    #[arg(long, value_name = "MODEL", default_value = model::DEFAULT)]
    model: ModelSpec,
    /// Numbers of training pushes
    #[arg(long, value_name = "N", value_delimiter = ',', default_value = "20,50,100")]
    learn: Vec<usize>,
    /// Number of random draws for each number of training pushes
    #[arg(long, value_name = "N", default_value_t = 5)]
    draws: u32,
    /// Seed of the draws
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &AdaptedArgs, session: &Session) -> Result<u8, CliError> {
    let sets = load_recordings(&args.recordings)?;
    let mut trials: Vec<Trial> = Vec::new();
    let mut ranges = Vec::new();
    for set in &sets {
        let first = trials.len();
        trials.extend(set.recordings.iter().map(Trial::of_recording));
        ranges.push((set.title.clone(), first..trials.len()));
    }
    let Some(weights) = model::weights(&args.model)? else {
        return Err(CliError::usage("only a network can be fitted", "use --model network"));
    };
    let ModelKind::Network { .. } = args.model.first().kind else {
        return Err(CliError::usage("only a network can be fitted", "use --model network"));
    };
    let network = Network::new(weights);
    let splits = splits(&ranges, &args.learn, args.draws, args.seed);
    let measured = session.compute(|| {
        let of = |split| measure_split(&network, &trials, split);
        splits.par_iter().map(of).collect::<Result<Vec<_>, _>>()
    });
    let measured =
        measured.map_err(|error| CliError::unexpected("cannot identify the weights", &error))?;
    let found: Vec<_> = splits
        .iter()
        .zip(measured)
        .filter_map(|(split, found)| {
            let (table, pushes) = found?;
            let learnt = table.head.iter().any(|value| *value != 0.0);
            Some((split.title.clone(), split.asked, learnt, pushes))
        })
        .collect();
    args.form.show(session, &adapted_document(&adapted_rows(&found), args.draws, args.seed))?;
    Ok(pushplan_command::exit_code::DONE)
}
