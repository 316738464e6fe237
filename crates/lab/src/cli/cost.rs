//! `pushplan-lab cost`: costs of pushes, networks and searches.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use pushplan::internals::asset::load_task;
use pushplan::internals::effect::{EffectModel, Network, Simulated};
use pushplan::internals::sim::Simulator;
use pushplan::internals::solve::Effort;
use pushplan_command::bench::common::Common;
use pushplan_command::error::CliError;
use pushplan_command::form::Form;
use pushplan_command::session::Session;
use pushplan_command::solve::solve_error;
use pushplan_command::{model, output};

use crate::bench::{
    FAR_COUNTS, Suite, SuiteKind, crowd_cases, equation_costs, far_costs, inference_costs,
    push_costs, search_costs,
};
use crate::report::{cost_document, crowd_cost_document, equation_document, far_document};

/// Measure the time of one push by every model, and of a search of one-push candidates
#[derive(Args, Debug)]
#[command(
    after_help = "There are no shards, because only times on the same machine can be compared. The \
measurement takes a few minutes at most. `crates/lab/benches/cost.py --help` describes the paired \
comparison of two versions of `pushplan solve`: cost, statuses, and robustness of the plans."
)]
pub struct CostArgs {
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    form: Form,
    /// Task of the search
    #[arg(value_name = "TASK", required_unless_present_any = ["crowd", "far", "equations"])]
    task: Option<PathBuf>,
    /// Measure the network alone, on scenes with this many objects, some joined
    #[arg(long, value_name = "OBJECTS", num_args = 0..=1, default_missing_value = "10",
          conflicts_with = "task", value_parser = clap::value_parser!(u16).range(2..=12))]
    crowd: Option<u16>,
    /// Measure pushes with up to 100 objects out of reach of the push, and draw the curves
    #[arg(long, conflicts_with_all = ["task", "crowd"])]
    far: bool,
    /// Count and time the equations of the analytic model with 1 to 12 objects, free and jointed
    #[arg(long, conflicts_with_all = ["task", "crowd", "far"])]
    equations: bool,
    /// Folder for far.svg, the curves of --far
    #[arg(long, value_name = "DIR", requires = "far")]
    out: Option<PathBuf>,
    /// Maximum number of candidates of the search
    #[arg(long, value_name = "N", default_value_t = 500,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    candidates: u32,
    /// Number of lateral offsets per face [default: as for the effort `standard`]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=999))]
    offsets: Option<u16>,
    /// Number of pushes predicted together
    #[arg(long, value_name = "N", default_value_t = 64,
          value_parser = clap::value_parser!(u16).range(1..=4096))]
    batch: u16,
    /// Number of timed pushes
    #[arg(long, value_name = "N", default_value_t = 32,
          value_parser = clap::value_parser!(u16).range(1..=4096))]
    pushes: u16,
    /// Seed of the pushes
    #[arg(long, value_name = "N", default_value_t = 7)]
    seed: u64,
}

/// Numbers of candidate-steps that the network is timed on: one, a search's batch, many.
const NETWORK_BATCHES: [usize; 3] = [1, 64, 512];

pub fn run(args: &CostArgs, session: &Session) -> Result<(), CliError> {
    let Some(task) = &args.task else {
        return match args {
            CostArgs { equations: true, .. } => equation_cost(args, session),
            CostArgs { far: true, .. } => far_cost(args, session),
            _ => crowd_cost(args, session),
        };
    };
    let library = args.common.library.load()?;
    let task = load_task(task, &library)?;
    let model = args.common.load_model()?;
    let suite = Suite::draw(SuiteKind::Single, &library, args.seed, usize::from(args.pushes));
    let spinner = session.spinner("timing");
    let pushes = push_costs(&model, &suite, usize::from(args.batch))
        .map_err(|error| CliError::unexpected("cannot time a push", &error))?;
    let networks = match model::weights(&args.common.model_or_network())? {
        Some(weights) => inference_costs(&weights, &suite.cases, &NETWORK_BATCHES),
        None => Vec::new(),
    };
    let planar: Arc<dyn EffectModel> = Arc::new(Simulated::new(Simulator::planar()));
    let models = [Arc::clone(&model), planar];
    let standard = Effort::Standard.settings().offsets;
    let offsets = args.offsets.map_or(standard, usize::from);
    let searches = session
        .compute(|| search_costs(&models, &task, &library, offsets, args.candidates as usize));
    spinner.finish_and_clear();
    let searches = searches.map_err(solve_error)?;
    args.form.show(session, &cost_document(&networks, &pushes, &searches))
}

fn crowd_cost(args: &CostArgs, session: &Session) -> Result<(), CliError> {
    let objects = args.crowd.map_or(10, usize::from);
    let weights = model::weights(&args.common.model_or_network())?
        .ok_or_else(|| CliError::usage("--crowd needs a network", "omit --model"))?;
    let spinner = session.spinner("timing");
    let cases = crowd_cases(objects, args.seed, usize::from(args.pushes));
    let networks = inference_costs(&weights, &cases, &NETWORK_BATCHES);
    spinner.finish_and_clear();
    args.form.show(session, &crowd_cost_document(objects, &networks))
}

fn equation_cost(args: &CostArgs, session: &Session) -> Result<(), CliError> {
    let library = args.common.library.load()?;
    let spinner = session.spinner("counting and timing");
    let costs = equation_costs(&library, args.seed, usize::from(args.pushes));
    spinner.finish_and_clear();
    args.form.show(session, &equation_document(&costs))
}

fn far_cost(args: &CostArgs, session: &Session) -> Result<(), CliError> {
    let weights = model::weights(&args.common.model_or_network())?
        .ok_or_else(|| CliError::usage("--far needs a network", "omit --model"))?;
    if let Some(out) = &args.out {
        output::prepare(out)?;
    }
    let library = args.common.library.load()?;
    let suite = Suite::draw(SuiteKind::Single, &library, args.seed, usize::from(args.pushes));
    let network = Network::new(weights);
    let planar = Simulated::new(Simulator::planar());
    let batch = usize::from(args.batch);
    let models: [(&dyn EffectModel, usize); 2] = [(&network, batch), (&planar, 1)];
    let spinner = session.spinner("timing");
    let costs = far_costs(&models, &suite, &FAR_COUNTS)
        .map_err(|error| CliError::unexpected("cannot time a push", &error))?;
    spinner.finish_and_clear();
    let document = far_document(&costs);
    if let Some(out) = &args.out {
        output::write_figures(out, document.figures())?;
    }
    args.form.show(session, &document)
}
