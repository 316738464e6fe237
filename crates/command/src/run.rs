//! `pushplan run`: plan, push, observe, update the belief, plan again.

use std::path::{Path, PathBuf};

use clap::Args;

use pushplan::asset::{ToolLibrary, load_world};
use pushplan::effect::{EffectModels, OutOfRange};
use pushplan::solve::{Effort, Planner};
use pushplan::{
    scene::ModelSpec,
    task::{Task, Truth},
};
use pushplan_act::act::{
    ActError, End, ProbeRule, RunSettings, Runner, SimulatedWorld, Trace, hidden, really,
};
use pushplan_bench::store::FolderLock;
use pushplan_report::{Recipe, Setting, run_document, run_page, table_fit_section};

use super::{
    error::CliError,
    exit_code,
    form::Form,
    interrupt,
    model::{self, OutOfRangeArgs, TableArgs},
    output::{self, ResultArgs},
    progress::TerminalProgress,
    regulator::RegulatorArgs,
    session::Session,
    solve::{share, solve_error},
    task_argument::TaskArgs,
    value_enums::{EFFORTS, PROBES, possible_values},
};

/// Execute a task in a partly unknown world: push, observe, update the belief, plan again
#[derive(Args, Debug)]
#[command(
    after_help = "The task's `unknown` lists the unknown properties of its scene: joints, masses, \
frictions, support. Their true values are hidden in the world: a file (`pushplan check --schema \
world`), or a seed from which they are drawn. Every plan is evaluated on samples of the belief. \
After every push, the rest of the plan is evaluated again; if too few samples reach the goal, the \
planner makes a new plan.

Writes <out>/<task>.run.json after every push. After an interruption, rerun the same command with \
--resume; the final file is byte-identical to an uninterrupted run. <task>.run.html plays the \
predictions, the observations and the beliefs. Drawings are <task>.run.svg and <task>.belief.svg.

Exit code 0: the last observation meets the goal. 4: no push brings the object nearer to the goal. \
5: the maximum number of pushes is reached. 9: an object is observed to break `keep` or `keep_out`.

Examples:
  pushplan run --example hidden-hinge --world 1
  pushplan run my-task.yaml --world my-world.yaml --max-pushes 20 --out runs --resume"
)]
pub struct RunArgs {
    #[command(flatten)]
    task: TaskArgs,
    /// Ground truth: a world file, or a seed from which the world is drawn
    #[arg(long, value_name = "FILE|SEED")]
    world: String,
    /// Search effort of every plan
    #[arg(long, value_parser = possible_values(&EFFORTS), default_value = "draft")]
    effort: Effort,
    #[arg(long, value_name = "MODEL", help = model::HELP_WITH_EFFORT)]
    model: Option<ModelSpec>,
    #[command(flatten)]
    table: TableArgs,
    /// Train the network on the pushes of the run, and write the final table fit to this file.
    /// Needs a task without `unknown`; without --fit, learning needs ten pushes
    #[arg(long, value_name = "FILE")]
    save_fit: Option<PathBuf>,
    #[command(flatten)]
    regulator: RegulatorArgs,
    #[command(flatten)]
    out_of_range: OutOfRangeArgs,
    /// Maximum number of pushes
    #[arg(long, value_name = "N", default_value_t = 12,
          value_parser = clap::value_parser!(u16).range(1..=1000))]
    max_pushes: u16,
    /// Number of belief samples on which plans are evaluated
    #[arg(long, value_name = "N", default_value_t = 16,
          value_parser = clap::value_parser!(u16).range(1..=1000))]
    samples: u16,
    /// Share of the belief samples in which a plan must reach the goal, 0 to 1
    #[arg(long, value_name = "SHARE", default_value_t = 0.8, value_parser = share)]
    min_success: f64,
    /// Maximum number of exploratory pushes
    #[arg(long, value_name = "N", default_value_t = 3,
          value_parser = clap::value_parser!(u16).range(0..=1000))]
    max_probes: u16,
    /// Rule for choosing exploratory pushes
    #[arg(long, value_parser = possible_values(&PROBES), value_name = "RULE",
          default_value = "task")]
    probe_rule: ProbeRule,
    /// Seed of the belief samples and the plans
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Resume the run in --out, if there is one
    #[arg(long)]
    resume: bool,
    #[command(flatten)]
    results: ResultArgs,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &RunArgs, session: &Session) -> Result<u8, CliError> {
    let library = args.results.library.load()?;
    let mut task = args.task.load(&library)?;
    if task.levers.is_some() {
        return Err(CliError::usage(
            "`run` does not support levering, because no observation follows a lever-up",
            "use `pushplan solve`, which plans and verifies the whole task",
        ));
    }
    if args.save_fit.is_some() && task.unknown.any() {
        return Err(CliError::usage(
            "--save-fit needs a task without `unknown`, because the pushes identify those values",
            "omit --save-fit, or state the values in the task",
        ));
    }
    let truth = world(&args.world, &task, &library)?;
    let spec = args.model.clone().unwrap_or_else(|| args.effort.model());
    let fit = args.table.load()?;
    if let Some(fit) = &fit {
        model::state(fit, &mut task.scene, session);
    }
    let planner = Planner::fitted(&spec, fit.as_ref())?
        .effort(args.effort)
        .seed(args.seed)
        .out_of_range(args.out_of_range.out_of_range())
        .build();
    output::prepare(&args.results.out)?;
    let path = args.results.out.join(format!("{}.run.json", task.name));
    let settings = RunSettings {
        max_pushes: args.max_pushes.into(),
        samples: args.samples.into(),
        min_success: args.min_success,
        max_probes: args.max_probes.into(),
        probe_rule: args.probe_rule,
        noise: truth.noise,
        seed: args.seed,
        ..RunSettings::default()
    };
    if args.save_fit.is_some() && EffectModels::weights_of(&spec)?.is_none() {
        let advice = "omit --save-fit, or use a network: --model network";
        return Err(CliError::usage(format!("{spec} contains no network to train"), advice));
    }
    let regulator = args.regulator.load()?;
    let mut planned_by = format!(
        "{spec}, effort {}, out-of-range {}",
        args.effort,
        args.out_of_range.out_of_range()
    );
    if let Some((_, digest)) = &regulator {
        planned_by += &format!(", regulator {digest}");
    }
    if let Some(fit) = &fit {
        planned_by += &format!(", fit {}", fit.checksum());
    }
    let mut runner = Runner::new(&planner, &library).learning(fit)?;
    if let Some((regulator, _)) = regulator {
        runner = runner.regulated(regulator);
    }
    interrupt::watch();
    let following = TerminalProgress::bar(session, "pushes");
    // The lock is held until the results are written, because another run could overwrite them.
    let _alone = FolderLock::take(&args.results.out, &following)?;
    let begun = Trace::new(task, settings, planned_by, Some(truth.clone()));
    let mut trace = begin(&path, begun, args.resume)?;
    let mut world = SimulatedWorld::new(truth).pushed_with(trace.task.robot.max_force);
    let mut keep = |trace: &Trace| trace.write(&path);
    let ran = session.compute(|| runner.run_with(&mut trace, &mut world, &mut keep, &following));
    following.finish()?;
    if let Err(error) = ran {
        if matches!(error, ActError::Stopped { .. }) {
            args.form.show_rest(session, &run_document(&trace), false)?;
        }
        return Err(act_error(error, &path));
    }
    for note in trace.all_notes() {
        session.warn(&note.words(&trace.task.scene));
    }
    let mut document = run_document(&trace);
    let mut written = vec![path];
    if let (Some(file), Some(learnt)) = (&args.save_fit, &trace.learnt) {
        document.sections.push(table_fit_section(learnt));
        learnt.write(file).map_err(CliError::Output)?;
        written.push(file.clone());
    }
    written.extend(output::write_figures(&args.results.out, document.figures())?);
    let real = session.compute(|| really(&trace));
    let page = run_page(&trace, &real, recipe(args), args.results.page);
    let name = format!("{}.run.html", trace.task.name);
    written.push(output::write(&args.results.out, &name, page.as_bytes())?);
    document.wrote(&written);
    args.form.show(session, &document)?;
    Ok(match trace.end {
        Some(End::Reached) => exit_code::DONE,
        Some(End::BudgetExhausted) => exit_code::FAILED_VERIFICATION,
        Some(End::NoImprovingPush) | None => exit_code::NO_PLAN,
        Some(End::RuleBroken) => exit_code::RULE_BROKEN,
    })
}

/// Returns the recipe that repeats the run, with the non-default settings.
fn recipe(args: &RunArgs) -> Recipe {
    let word = |table: &[(&str, ProbeRule, &str)]| {
        let own = table.iter().find(|(_, rule, _)| *rule == args.probe_rule);
        own.map_or(String::new(), |(word, ..)| (*word).to_owned())
    };
    let out_of_range = args.out_of_range.out_of_range();
    let usual = RunSettings::default();
    let given = [
        (args.effort != Effort::Draft, "--effort", Some("effort"), args.effort.to_string()),
        (
            out_of_range != OutOfRange::Warn,
            "--out-of-range",
            Some("out_of_range"),
            out_of_range.to_string(),
        ),
        (
            usize::from(args.max_pushes) != usual.max_pushes,
            "--max-pushes",
            Some("max_pushes"),
            args.max_pushes.to_string(),
        ),
        (
            usize::from(args.samples) != usual.samples,
            "--samples",
            Some("samples"),
            args.samples.to_string(),
        ),
        (
            args.min_success != usual.min_success,
            "--min-success",
            Some("min_success"),
            args.min_success.to_string(),
        ),
        (
            usize::from(args.max_probes) != usual.max_probes,
            "--max-probes",
            Some("max_probes"),
            args.max_probes.to_string(),
        ),
        (args.probe_rule != usual.probe_rule, "--probe-rule", None, word(&PROBES)),
        (args.seed != usual.seed, "--seed", Some("seed"), args.seed.to_string()),
    ];
    let given = given.into_iter().filter(|(unusual, ..)| *unusual);
    let files = [args.table.setting(), args.regulator.setting()];
    let settings = given.map(|(_, option, keyword, value)| Setting { option, keyword, value });
    let settings: Vec<Setting> = settings.chain(files.into_iter().flatten()).collect();
    args.results.library.origin(args.task.source(), args.model.clone()).run(&args.world, &settings)
}

/// Returns the world from a file, or sampled from a seed.
fn world(argument: &str, task: &Task, library: &ToolLibrary) -> Result<Truth, CliError> {
    match argument.parse() {
        Ok(seed) => Ok(hidden(task, library, seed)?),
        Err(_) => Ok(load_world(argument, task)?),
    }
}

/// Returns the trace to continue.
fn begin(path: &Path, begun: Trace, resume: bool) -> Result<Trace, CliError> {
    if !resume || !path.exists() {
        return Ok(begun);
    }
    let there = Trace::load(path).map_err(|error| CliError::File(error.to_string()))?;
    match there.is_of(&begun) {
        true => Ok(there),
        false => Err(CliError::usage(
            format!("{} belongs to another task, world or settings", path.display()),
            "repeat the command of the run to resume it, or omit --resume to start a new run",
        )),
    }
}

fn act_error(error: ActError, path: &Path) -> CliError {
    let message = error.to_string();
    match error {
        ActError::Solve(error) => solve_error(error),
        ActError::Model(error) => error.into(),
        ActError::Keep(faults) => CliError::Output(faults),
        ActError::Trace(_) => CliError::File(format!("{}: {message}", path.display())),
        ActError::Stopped { .. } => CliError::Interrupted(format!(
            "{message}; rerun the same command with --resume to continue"
        )),
        ActError::Objects { .. } => CliError::File(format!("{}: {message}", path.display())),
        ActError::World(_) | ActError::Lost { .. } | ActError::Ambiguous { .. } => {
            CliError::Ended(format!("{message}; the pushes made are in {}", path.display()))
        }
    }
}
