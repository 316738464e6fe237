//! `pushplan solve`: from a task file to a verified plan with a picture and a page.

use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;

use pushplan::asset::PlanFile;
use pushplan::outcome::warning_lines;
use pushplan::solve::{Effort, PlanStatus, Planner, RankedPlan, Solution, SolveError};
use pushplan::{
    scene::{ModelSpec, Situation},
    task::Task,
};
use pushplan_design::Design;
use pushplan_report::{
    Origin, PageView, design_page, plan_figures, solution_document, solution_page,
};

use super::{
    error::CliError,
    exit_code,
    form::Form,
    interrupt,
    model::{self, OutOfRangeArgs},
    output::{self, ResultArgs},
    progress::TerminalProgress,
    session::Session,
    task_argument::TaskArgs,
    value_enums::{EFFORTS, possible_values},
};

/// Plan a task: choose a tool and pushes or a lever-up, verify them, write plan, drawing and page
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  pushplan solve my-task.yaml
  pushplan solve --example narrow-gap --effort thorough --json
  pushplan solve --example raise-plate
  pushplan solve my-task.yaml --tools my-tools --out results --animate

Writes <out>/<task>.plan.json, the drawing <out>/<task>.svg and the page <out>/<task>.html. The \
page plays the plan and shows why other plans were rejected. --animate also writes \
<out>/<task>.animated.svg.

Without a working plan, the nearest plan is written as <task>.nearest.* (exit code 4) or \
<task>.failed.* (exit code 5). A fragile plan, which fails in too many perturbed replays, is \
written as <task>.fragile.* (exit code 7). A plan that meets only some of several goals is written \
as <task>.partial.* (exit code 8).")]
pub struct SolveArgs {
    #[command(flatten)]
    task: TaskArgs,
    /// Search effort
    #[arg(long, value_parser = possible_values(&EFFORTS), default_value = "standard")]
    effort: Effort,
    #[arg(long, value_name = "MODEL", help = model::HELP_WITH_EFFORT)]
    model: Option<ModelSpec>,
    #[command(flatten)]
    table: model::TableArgs,
    #[command(flatten)]
    out_of_range: OutOfRangeArgs,
    /// Seed of the refinement samples and the perturbed replays
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u64,
    /// Minimum number of perturbed replays of the best plan per engine; up to 64 until the verdict
    /// is clear. 3-D replays are skipped if too few clearly succeed in 2-D [default: 4, 8 or 16 by
    /// effort]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(0..=10_000))]
    pub replays: Option<u16>,
    /// Share of the perturbed replays that must reach the goal, 0 to 1 [default: `robustness` of
    /// the task, otherwise 0.75]
    #[arg(long, value_name = "SHARE", value_parser = share)]
    robustness: Option<f64>,
    /// Time limit in seconds, after which the best plan so far is reported
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

pub fn run(args: &SolveArgs, session: &Session) -> Result<u8, CliError> {
    let library = args.results.library.load()?;
    let mut task = args.task.load(&library)?;
    task.robustness = args.robustness.unwrap_or(task.robustness);
    let effort = args.effort;
    let fit = args.table.load()?;
    if let Some(fit) = &fit {
        model::state(fit, &mut task.scene, session);
    }
    let spec = args.model.clone().unwrap_or_else(|| effort.model());
    let planner = Planner::fitted(&spec, fit.as_ref())?;
    output::prepare(&args.results.out)?;
    let settings = match args.replays {
        Some(count) => effort.settings().replaying(count.into()),
        None => effort.settings(),
    };
    let planner =
        planner.settings(settings).seed(args.seed).out_of_range(args.out_of_range.out_of_range());
    let planner = match args.time_limit {
        Some(limit) => planner.time_limit(limit).build(),
        None => planner.build(),
    };
    interrupt::watch();
    let following = TerminalProgress::spinner(session, "solving");
    let solved = session.compute(|| planner.solve_with(&task, &library, &following));
    following.finish()?;
    let solution = solved.map_err(solve_error)?;
    session.warn_each(&warning_lines(&solution.warnings));
    let (code, suffix) = ending(solution.status);
    let written = match solution.best() {
        Some(best) => {
            let results = Results {
                out: &args.results.out,
                name: format!("{}{suffix}", task.name),
                page: args.results.page,
                animate: args.animate,
                design: None,
                origin: &|model| args.results.library.origin(args.task.source(), model),
            };
            results.write(session, &task, &planner, (&solution, best))
        }
        None => Ok(Vec::new()),
    };
    let mut document = solution_document(&task, &solution);
    // A plan that took minutes is shown even if it cannot be saved.
    document.wrote(written.as_deref().unwrap_or_default());
    args.form.show(session, &document)?;
    written.map(|_| interrupt::code(code))
}

/// Parses a share from 0 to 1.
pub fn share(text: &str) -> Result<f64, String> {
    let share: f64 = text.parse().map_err(|_| "expected a share from 0 to 1".to_owned())?;
    match (0.0..=1.0).contains(&share) {
        true => Ok(share),
        false => Err("a share must be from 0 to 1; 75 % is 0.75".to_owned()),
    }
}

/// Parses a time in seconds.
pub fn time_limit(text: &str) -> Result<Duration, String> {
    let seconds: f64 = text.parse().map_err(|_| "expected a number of seconds".to_owned())?;
    let limit = Duration::try_from_secs_f64(seconds).map_err(|error| error.to_string())?;
    match limit.is_zero() {
        true => Err("a time limit must be above 0; half a second is 0.5".to_owned()),
        false => Ok(limit),
    }
}

/// Converts an error of solving to an error of the command.
pub fn solve_error(error: SolveError) -> CliError {
    match error {
        SolveError::Tools(faults) => CliError::Files(faults),
        SolveError::BadTask { .. } => CliError::File(error.to_string()),
        SolveError::Refused { .. } => CliError::Refused(error.to_string()),
        SolveError::Model(_) => CliError::unexpected("cannot use the shipped weights", &error),
    }
}

/// Returns the exit code of a status, and the suffix of its file names.
pub fn ending(status: PlanStatus) -> (u8, &'static str) {
    match status {
        PlanStatus::Solved => (exit_code::DONE, ""),
        PlanStatus::Fragile => (exit_code::FRAGILE, ".fragile"),
        PlanStatus::Partial => (exit_code::PARTIAL, ".partial"),
        PlanStatus::NoPlan => (exit_code::NO_PLAN, ".nearest"),
        PlanStatus::FailedVerification => (exit_code::FAILED_VERIFICATION, ".failed"),
    }
}

/// Files written for a solution.
pub struct Results<'a> {
    /// Folder of the files.
    pub out: &'a Path,
    /// Base name of the files.
    pub name: String,
    /// View of the table on the page.
    pub page: PageView,
    /// Whether an animation is drawn.
    pub animate: bool,
    /// Design of the tool, which the page then explains.
    pub design: Option<&'a Design>,
    /// Function that returns the sources of a plan for the given model.
    pub origin: &'a dyn Fn(Option<ModelSpec>) -> Origin,
}

impl Results<'_> {
    /// Writes the plan file, the pictures and the page.
    ///
    /// # Errors
    /// Returns an error if the results cannot be written.
    pub fn write(
        &self,
        session: &Session,
        task: &Task,
        planner: &Planner,
        (solution, best): (&Solution, &RankedPlan),
    ) -> Result<Vec<PathBuf>, CliError> {
        let Self { out, name, .. } = self;
        let situation = Situation::stated(&task.scene);
        let replays = session.compute(|| best.replays(task, &situation));
        let path = out.join(format!("{name}.plan.json"));
        let file = PlanFile { fit: planner.fit().cloned(), ..best.to_file(task) };
        file.write(&path).map_err(CliError::Output)?;
        let mut written = vec![path];
        let figures = plan_figures(task, best, &replays, name, self.animate);
        written.extend(output::write_figures(out, &figures)?);
        let recipe = |ranked: &RankedPlan| {
            let model = Some(ranked.predicted.by.clone());
            (self.origin)(model).plan(&ranked.plan)
        };
        let page = match self.design {
            Some(design) => design_page(task, design, &replays, &recipe, self.page),
            None => solution_page(task, solution, &replays, &recipe, self.page),
        };
        written.push(output::write(out, &format!("{name}.html"), page.as_bytes())?);
        Ok(written)
    }
}
