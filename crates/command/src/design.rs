//! `pushplan design`: a tool for a task that no existing tool solves.

use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;

use pushplan::outcome::warning_lines;
use pushplan::scene::Tool;
use pushplan::solve::{Effort, Planner};
use pushplan_design::DesignSettings;
use pushplan_report::{Origin, design_document};

use super::{
    error::CliError,
    exit_code,
    form::Form,
    interrupt,
    output::{self, ResultArgs},
    progress::TerminalProgress,
    session::Session,
    solve::{Results, ending, share, solve_error, time_limit},
    task_argument::TaskArgs,
    value_enums::{EFFORTS, possible_values},
};

/// Folder of proposed tools, within the folder of results.
const TOOLS: &str = "tools";

/// Propose a new tool for a task that no existing tool solves, or solves only with little margin
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  pushplan design my-task.yaml
  pushplan design my-task.yaml --parts 4 --candidates 2000
  pushplan solve my-task.yaml --more-tools plans/tools

The search draws bars, hooks, cranks, forks and rings of cuboids, and varies the best of them. It \
proposes the simplest tool that has a verified plan.

Writes the editable tool file <out>/tools/<tool>.yaml, and <out>/<tool>.plan.json, \
<out>/<tool>.svg and <out>/<tool>.html. Writes nothing if an existing tool solves the task and no \
new tool solves it with more margin. Without a working plan there is no tool file; exit codes and \
file names are the same as for `solve`.")]
pub struct DesignArgs {
    #[command(flatten)]
    task: TaskArgs,
    /// Maximum number of parts of the tool
    #[arg(long, value_name = "N", default_value_t = DesignSettings::PARTS as u8,
          value_parser = clap::value_parser!(u8).range(1..=DesignSettings::MOST_PARTS as i64))]
    parts: u8,
    /// Number of candidate tools
    #[arg(long, value_name = "N", default_value_t = DesignSettings::CANDIDATES as u32,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    candidates: u32,
    /// Draw all candidates at random: the baseline of the search
    #[arg(long, hide = true)]
    random: bool,
    /// Search effort for each of the best tools
    #[arg(long, value_parser = possible_values(&EFFORTS), default_value = "standard")]
    effort: Effort,
    /// Seed of the tools, the refinement samples and the perturbed replays
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Share of the perturbed replays that must reach the goal, 0 to 1 [default: `robustness` of
    /// the task, otherwise 0.75]
    #[arg(long, value_name = "SHARE", value_parser = share)]
    robustness: Option<f64>,
    /// Time limit in seconds, after which the best proposal so far is reported
    #[arg(long, value_name = "SECONDS", value_parser = time_limit)]
    time_limit: Option<Duration>,
    #[command(flatten)]
    results: ResultArgs,
    /// Also write an animation of the 3-D replay
    #[arg(long)]
    animate: bool,
    #[command(flatten)]
    form: Form,
}

pub fn run(args: &DesignArgs, session: &Session) -> Result<u8, CliError> {
    let library = args.results.library.load()?;
    let mut task = args.task.load(&library)?;
    task.robustness = args.robustness.unwrap_or(task.robustness);
    if task.levers.is_some() {
        let advice = "`design` proposes no tools with blades; choose a pushing task";
        return Err(CliError::usage("this is a levering task, not a pushing task", advice));
    }
    let planner = Planner::for_effort(args.effort)?.seed(args.seed);
    let planner = match args.time_limit {
        Some(limit) => planner.time_limit(limit).build(),
        None => planner.build(),
    };
    output::prepare(&args.results.out)?;
    let settings = DesignSettings::looking_at(args.candidates as usize);
    let settings = DesignSettings { parts: args.parts.into(), ..settings };
    let settings = if args.random { settings.at_random() } else { settings };
    interrupt::watch();
    let following = TerminalProgress::spinner(session, "designing");
    let designed = session
        .compute(|| pushplan_design::design(&planner, &task, &library, &settings, &following));
    following.finish()?;
    let design = designed.map_err(solve_error)?;
    session.warn_each(&warning_lines(&design.best().warnings));
    let (code, suffix) = ending(design.status());
    let mut document = design_document(&task, &design);
    let written = match design.proposal.as_ref().and_then(|one| Some((one, one.solution.best()?))) {
        Some((proposal, best)) => {
            let tools = args.results.out.join(TOOLS);
            let origin = |model| Origin {
                more_tools: Some(tools.display().to_string()),
                ..args.results.library.origin(args.task.source(), model)
            };
            let results = Results {
                out: &args.results.out,
                name: format!("{}{suffix}", proposal.tool.name),
                page: args.results.page,
                animate: args.animate,
                design: Some(&design),
                origin: &origin,
            };
            let works = code != exit_code::NO_PLAN && code != exit_code::FAILED_VERIFICATION;
            let tool = if works { write_tool(&tools, &proposal.tool).map(Some) } else { Ok(None) };
            tool.and_then(|tool| {
                let plan = (&proposal.solution, best);
                let plan = results.write(session, &task, &planner, plan)?;
                Ok(tool.into_iter().chain(plan).collect())
            })
        }
        None => Ok(Vec::new()),
    };
    // A tool is shown even if it cannot be saved.
    document.wrote(written.as_deref().unwrap_or_default());
    args.form.show(session, &document)?;
    written.map(|_: Vec<PathBuf>| interrupt::code(code))
}

/// Writes the file of a tool into the folder and returns its path.
fn write_tool(folder: &Path, tool: &Tool) -> Result<PathBuf, CliError> {
    output::prepare(folder)?;
    output::write(folder, &format!("{}.yaml", tool.name), tool.to_yaml()?.as_bytes())
}
