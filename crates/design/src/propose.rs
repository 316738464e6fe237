//! Design of a tool for a task.

use std::sync::Arc;

use pushplan::asset::ToolLibrary;
use pushplan::plan::{CostToGo, Uncertainty};
use pushplan::progress::{Progress, Until};
use pushplan::scene::Tool;
use pushplan::solve::{Class, Grade, Planner, Solution, SolveError, stated};
use pushplan::task::{Task, ToolChoice};

use super::proposal::Spent;
use super::screening::Looking;
use super::search::{Seen, kept, search};
use super::{Design, DesignSettings, Proposal};

/// Maximum number of tools of one form that are solved in full, because similar tools usually fail
/// alike.
const OF_A_FORM: usize = 3;

/// Maximum number of characters of the task's name in the tool's name, because file names have a
/// limit.
const LONGEST_NAME: usize = 48;

/// Proposes a tool for a pushing task that no tool of `library` solves, or that the new tool solves
/// with more margin. Its plan is verified as for any other tool.
///
/// The result is the same for any number of threads. If `progress` cancels, or after the time limit
/// of the planner, the best proposal so far is returned.
///
/// ```
/// use pushplan::progress::NoProgress;
/// use pushplan::{Effort, PlanStatus, Planner, Task, ToolLibrary};
/// use pushplan_design::{DesignSettings, design};
///
/// let library = ToolLibrary::embedded()?;
/// let task = Task::parse(include_str!("../../../tasks/pull-back.yaml"), "pull-back.yaml")?;
/// let planner = Planner::for_effort(Effort::Draft)?.build();
/// let settings = DesignSettings::looking_at(20);
/// let design = design(&planner, &task, &library, &settings, &NoProgress)?;
/// assert_eq!(design.status(), PlanStatus::Solved);
/// # Ok::<(), pushplan::Error>(())
/// ```
///
/// # Errors
/// Returns [`SolveError`] for invalid input only, which includes a task of levering.
pub fn design(
    planner: &Planner,
    task: &Task,
    library: &ToolLibrary,
    settings: &DesignSettings,
    progress: &dyn Progress,
) -> Result<Design, SolveError> {
    if task.in_space() {
        let what = "tools are proposed only for tasks of pushing, but this task has lever-ups";
        return Err(SolveError::bad_task(task, "levers", what));
    }
    let progress = &Until::new(progress, planner.time_limit());
    let situation = stated(task);
    progress.stage("existing tools");
    let all = Task { tools: ToolChoice::All, ..task.clone() };
    let known = planner.solve_from(&situation, &all, library, progress)?;
    let mut design =
        Design { known, proposal: None, spent: Spent::default(), stopped: progress.cancelled() };
    let bar = grade(&design.known);
    if design.stopped || bar.is_some_and(|bar| bar.is_best()) {
        return Ok(design);
    }

    progress.stage("evaluating proposed tools");
    let (model, field) = (planner.model(), CostToGo::new(task));
    let spread = Uncertainty::around(&situation);
    let looking = Looking { task, situation: &situation, model, field, spread, progress };
    let mut seen = search(&looking, settings, planner.seed());
    design.spent = Spent {
        looked_at: seen.len(),
        rollouts: seen.iter().map(|one| one.look.rollouts).sum(),
        promising: seen.iter().filter(|one| one.look.misses <= 1.0).count(),
        solved: 0,
    };
    // The remaining tools cannot push at all.
    seen.retain(|one| one.look.misses.is_finite());
    let mut best: Option<(Option<Grade>, Proposal)> = None;
    let finalists = kept(&seen, settings.solved, OF_A_FORM);
    for (k, one) in finalists.iter().enumerate() {
        progress.stage("solving with the best proposed tools");
        progress.update(k as u64, finalists.len() as u64);
        let tool = named(one, task, library);
        let Some(proposal) = tool.map(|tool| solved(planner, task, tool, progress)) else {
            continue;
        };
        let proposal = proposal?;
        design.spent.solved += 1;
        let worth = grade(&proposal.solution);
        let better = |best: &(Option<Grade>, Proposal)| {
            is_better((&worth, pushes(&proposal)), (&best.0, pushes(&best.1)))
        };
        if best.as_ref().is_none_or(better) {
            best = Some((worth, proposal));
        }
        if worth.is_some_and(|grade| grade.class == Class::Safe) || progress.cancelled() {
            break;
        }
    }
    design.proposal = best.filter(|(worth, _)| has_more(worth, &bar)).map(|(_, one)| one);
    design.stopped = progress.cancelled();
    Ok(design)
}

/// Solves the task with this tool only.
fn solved(
    planner: &Planner,
    task: &Task,
    tool: Tool,
    progress: &dyn Progress,
) -> Result<Proposal, SolveError> {
    let tool = Arc::new(tool);
    let library = ToolLibrary::default().with(Arc::clone(&tool))?;
    let task = Task { tools: ToolChoice::All, ..task.clone() };
    let solution = planner.solve_from(&stated(&task), &task, &library, progress)?;
    Ok(Proposal { tool, solution })
}

/// Builds a screened tool, under a name that is not in the library.
fn named(seen: &Seen, task: &Task, library: &ToolLibrary) -> Option<Tool> {
    let short: String = task.name.chars().take(LONGEST_NAME).collect();
    let name = format!("{short}-{}", seen.assembly.name());
    let others = (2..).map(|k| format!("{name}-{k}"));
    let mut names = std::iter::once(name.clone()).chain(others);
    let name = names.find(|name| library.get(name).is_none())?;
    let description = format!("Proposed by `pushplan design` for the task {}.", task.name);
    Some(seen.assembly.tool(&name)?.described(description))
}

/// Returns the grade of a solution's best plan, if it was verified.
fn grade(solution: &Solution) -> Option<Grade> {
    let verdict = solution.best()?.verdict.as_ref()?;
    Some(Grade::of(verdict))
}

/// Returns the number of pushes of a proposal's best plan.
fn pushes(proposal: &Proposal) -> usize {
    proposal.solution.best().map_or(0, |best| best.plan.steps.len())
}

/// Compares the grades of two tools, each with the number of pushes of its plan.
fn is_better(one: (&Option<Grade>, usize), other: (&Option<Grade>, usize)) -> bool {
    match (one.0, other.0) {
        (Some(a), Some(b)) if a.is_as_good_as(b) && one.1 != other.1 => one.1 < other.1,
        (Some(one), Some(other)) => one.compare(other).is_gt(),
        (one, other) => one.is_some() && other.is_none(),
    }
}

/// Returns `true` if a tool is worth proposing, where `bar` is the grade of the existing tools.
fn has_more(one: &Option<Grade>, bar: &Option<Grade>) -> bool {
    match (one, bar) {
        (Some(one), Some(bar)) => one.has_more_margin(bar) && !one.is_as_good_as(bar),
        (_, bar) => bar.is_none(),
    }
}
