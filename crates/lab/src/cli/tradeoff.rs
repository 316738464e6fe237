//! `pushplan-lab tradeoff`: every level of the ladder on the same pushes and tasks.

use std::path::PathBuf;

use clap::Args;
use pushplan::internals::progress::Progress;
use pushplan_bench::store::{RunManifest, Seconds, Shard, Store};
use pushplan_command::action::LibraryArgs;
use pushplan_command::bench::weights_digest;
use pushplan_command::error::CliError;
use pushplan_command::form::Form;
use pushplan_command::progress::TerminalProgress;
use pushplan_command::session::Session;
use pushplan_command::{exit_code, interrupt, output};

use crate::bench::{TradeOff, TradeOffSettings, Unit, levels, plan_levels};
use crate::report::tradeoff_document;

/// Measure speed against accuracy: every predictor and every budget of planning
#[derive(Args, Debug)]
#[command(
    after_help = "Errors are measured on held-out pushes, success on random tasks, replayed in 3-D; costs are
processor time of one thread, all levels in turn. With --out every finished unit is kept: the same
command goes on after an interruption. The folder then holds tradeoff.json, tradeoff.md,
tradeoff-push.svg and tradeoff-task.svg.

--shard 2/3 measures every third unit, on another machine say; when `pushplan-lab merge OUT
SHARD...` has put the parts together, the same command with --out OUT and without --shard finds
nothing left to measure and writes the results. Errors and successes are the same as of one run.
Costs are times: shards on different processors give costs of no real machine.

Examples:
  pushplan-lab tradeoff --quick
  pushplan-lab tradeoff --out runs/tradeoff --weights runs/w64/best.safetensors"
)]
pub struct TradeOffArgs {
    /// Other networks to measure as well as the shipped one
    #[arg(long, value_name = "FILE", num_args = 1..)]
    weights: Vec<PathBuf>,
    /// Held-out pushes of each kind [default: 2000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pushes: Option<u32>,
    /// Random tasks [default: 200]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    tasks: Option<u32>,
    /// Tolerance of the tasks, as a share of the usual 2 cm
    #[arg(long, value_name = "SHARE", default_value_t = USUAL.tolerance,
          value_parser = tolerance_share)]
    tolerance: f64,
    /// Rounds of timing; the fastest counts [default: 7]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1000))]
    rounds: Option<u32>,
    /// A first look: 200 pushes, 6 tasks and 2 rounds where no number is given
    #[arg(long)]
    quick: bool,
    /// Only levels of planning whose name contains one of these
    #[arg(long, value_name = "WORDS", num_args = 1..)]
    plans: Vec<String>,
    /// Seed of pushes and tasks
    #[arg(long, value_name = "N", default_value_t = USUAL.seed)]
    seed: u64,
    /// Folder that keeps every finished unit and the results
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Measure only part I of N of the units; the results are made of all
    #[arg(long, value_name = "I/N", requires = "out")]
    shard: Option<Shard>,
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    form: Form,
}

/// Default size of a run. Two hundred tasks give the success rate to 1.5 %; seven rounds include an
/// undisturbed one even on a busy machine.
const USUAL: TradeOffSettings =
    TradeOffSettings { pushes: 2000, timed: 32, rounds: 7, tasks: 200, tolerance: 1.0, seed: 7 };

/// Size of a run with `--quick`.
const QUICK: TradeOffSettings =
    TradeOffSettings { pushes: 200, timed: 8, rounds: 2, tasks: 6, tolerance: 1.0, seed: 7 };

pub fn run(args: &TradeOffArgs, session: &Session) -> Result<u8, CliError> {
    let library = args.library.load()?;
    if let Some(out) = &args.out {
        output::prepare(out)?;
    }
    let others: Vec<String> = args.weights.iter().map(|path| path.display().to_string()).collect();
    let levels = levels(&others)?;
    let networks = levels.iter().map(|level| weights_digest(level.spec()));
    let mut digests = networks.collect::<Result<Vec<Option<String>>, CliError>>()?;
    digests.dedup();
    let digests: Vec<String> = digests.into_iter().flatten().collect();
    let mut plans = plan_levels(&levels);
    plans.retain(|plan| {
        args.plans.is_empty() || args.plans.iter().any(|words| plan.name.contains(words))
    });
    let run = TradeOff::new(&library, levels, plans, args.settings())
        .map_err(|error| CliError::unexpected("cannot start a thread", &error))?;
    let shard = args.shard.unwrap_or(Shard::WHOLE);
    let store = measure(args, session, &run, run.manifest(&digests).with_shard(shard))?;
    let finished = store.finished().iter();
    let units: Vec<(Unit, Seconds)> =
        finished.map(|unit| (unit.record.clone(), unit.seconds.clone())).collect();
    if shard != Shard::WHOLE {
        let count = units.len();
        session
            .print(&format!("{count} units, shard {shard}; merge all shards to see results\n"))?;
        return Ok(exit_code::DONE);
    }
    let document = tradeoff_document(&run.report(&units));
    if let Some(out) = &args.out {
        output::write(out, "tradeoff.json", document.to_json().as_bytes())?;
        output::write(out, "tradeoff.md", document.to_page().as_bytes())?;
        output::write_figures(out, document.figures())?;
    }
    args.form.show(session, &document)?;
    Ok(exit_code::DONE)
}

impl TradeOffArgs {
    fn settings(&self) -> TradeOffSettings {
        let usual = if self.quick { QUICK } else { USUAL };
        let or = |given: Option<u32>, usual| given.map_or(usual, |given| given as usize);
        TradeOffSettings {
            pushes: or(self.pushes, usual.pushes),
            timed: usual.timed,
            rounds: or(self.rounds, usual.rounds),
            tasks: or(self.tasks, usual.tasks),
            tolerance: self.tolerance,
            seed: self.seed,
        }
    }
}

fn measure(
    args: &TradeOffArgs,
    session: &Session,
    run: &TradeOff,
    manifest: RunManifest,
) -> Result<Store<Unit>, CliError> {
    interrupt::watch();
    let following = TerminalProgress::bar(session, "units");
    let mut store: Store<Unit> = match &args.out {
        Some(folder) => Store::open(folder, manifest, &following)?,
        None => Store::in_memory(manifest),
    };
    let done = session.compute(|| {
        store.run::<CliError>(&following, |index| {
            following.stage(&run.title(index));
            run.measure(index)
                .map_err(|error| CliError::usage(error.to_string(), "try it with other tools"))
        })
    });
    following.finish()?;
    done?;
    Ok(store)
}

/// Parses a share from 0.05 (a millimetre, about the difference between the engines' steps) to 5.
fn tolerance_share(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(share) if (0.05..=5.0).contains(&share) => Ok(share),
        _ => Err("use a number from 0.05 to 5; 1 is 2 cm".to_owned()),
    }
}
