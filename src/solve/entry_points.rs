//! Entry points of the planner: solutions, causes of infeasibility, and the first pushes of long
//! plans.

use std::sync::Arc;

use rayon::prelude::*;

use crate::asset::{PlanFile, ToolLibrary};
use crate::outcome::{Verdict, Warning};
use crate::plan::{Search, alone};
use crate::progress::{Instant, NoProgress, Progress, Until};
use crate::scene::{Situation, Tool};
use crate::task::Task;
use crate::verify::{Verifier, VerifySettings};

use super::blackboard::Blackboard;
use super::check::{check, common};
use super::choice::solve_one_of;
use super::error::SolveError;
use super::grade::Class;
use super::infeasibility::{self, Cause, Hints, beyond, out_of_reach};
use super::lever_check::check_levers;
use super::partial_goals::meet_some_goals;
use super::planner::{Planner, lacking, stated};
use super::query::Query;
use super::report;
use super::solution::{PlanStatus, Solution};
use super::solving::run;
use super::strategy::{Approach, approach, for_levers, for_pushes};
use super::typical::typical;

impl Planner {
    /// Solves a task with the tools that it allows, on the current rayon pool. The result does not
    /// depend on the number of threads.
    ///
    /// # Errors
    /// Returns [`SolveError`] for invalid input only.
    pub fn solve(&self, task: &Task, library: &ToolLibrary) -> Result<Solution, SolveError> {
        self.solve_with(task, library, &NoProgress)
    }

    /// Solves tasks in parallel on the current rayon pool, with results in the order of the tasks.
    /// Results equal the ones of [`Planner::solve`] for any number of threads, except for
    /// wall-clock times.
    pub fn solve_all(
        &self,
        tasks: &[Task],
        library: &ToolLibrary,
    ) -> Vec<Result<Solution, SolveError>> {
        tasks.par_iter().map(|task| self.solve(task, library)).collect()
    }

    /// Solves a task as [`Planner::solve`] does and reports progress to `progress`. If `progress`
    /// stops it, the best plan so far is returned. A [`Cancel`](crate::progress::Cancel) stops it
    /// from another thread.
    ///
    /// # Errors
    /// Returns [`SolveError`] for invalid input only.
    pub fn solve_with(
        &self,
        task: &Task,
        library: &ToolLibrary,
        progress: &dyn Progress,
    ) -> Result<Solution, SolveError> {
        let until = Until::new(progress, self.time_limit);
        let mut solution = self.solve_from(&stated(task), task, library, &until)?;
        meet_some_goals(self, task, library, &until, &mut solution)?;
        let failed = solution.status == PlanStatus::FailedVerification;
        let searched = failed || solution.status == PlanStatus::NoPlan;
        if searched && !task.in_space() && solution.cause.is_none() {
            let nearest = task.choices(&task.scene.start()).into_iter().next();
            let asked = nearest.as_ref().unwrap_or(task);
            let verdicts = solution.plans.iter().filter_map(|plan| plan.verdict.as_ref());
            let hints = Hints::of(&solution.statistics.search, verdicts);
            let cause = infeasibility::cause(self, asked, library, &hints, &until);
            // A failed replay states more than an unknown cause.
            solution.cause = cause.filter(|cause| !(failed && *cause == Cause::Several));
        }
        if task.unknown.any() {
            solution.warnings.push(Warning::Guessed { unknown: task.unknown });
        }
        Ok(solution)
    }

    /// Solves a task as [`Planner::solve_with`] does, from the current poses and the assumed
    /// parameters of `situation`. Only the robot, the tools, the rules for pushes and the goal are
    /// taken from the task.
    ///
    /// # Errors
    /// Returns [`SolveError`] for invalid input only.
    pub fn solve_from(
        &self,
        situation: &Situation,
        task: &Task,
        library: &ToolLibrary,
        progress: &dyn Progress,
    ) -> Result<Solution, SolveError> {
        let choices = task.choices(&situation.start);
        if !choices.is_empty() {
            let until = Until::new(progress, self.time_limit);
            return solve_one_of(self, (task, situation), &choices, library, &until);
        }
        if task.in_space() {
            let blades = match task.levers {
                Some(_) => task.blades(library)?,
                None => Vec::new(),
            };
            check_levers(task, situation, &blades)?;
            let until = Until::new(progress, self.time_limit);
            let settings = *self.settings();
            let tools = &blades;
            let query = Query { planner: self, task, situation, tools, progress: &until, settings };
            return solve_levers(query, library);
        }
        let tools = task.tools(library)?;
        check(task, situation, &tools[..])?;
        let motion = |tool: &Arc<Tool>| typical(task, &situation.start, tool);
        self.refuse(task, situation, tools.iter().map(motion))?;
        let until = Until::new(progress, self.time_limit);
        let (tools, settings) = (&tools, self.settings().first_attempt(task));
        solve_pushes(Query { planner: self, task, situation, tools, progress: &until, settings })
    }

    /// Returns warnings that a solution of a pushing task will carry with every allowed tool,
    /// before any search: values outside the model's range, and guessed ones. Returns none for
    /// tasks with lever-ups.
    ///
    /// # Errors
    /// Returns [`SolveError`] for invalid input only.
    pub fn doubts(&self, task: &Task, library: &ToolLibrary) -> Result<Vec<Warning>, SolveError> {
        if task.in_space() {
            return Ok(Vec::new());
        }
        let situation = stated(task);
        let nearest = task.choices(&situation.start).into_iter().next();
        let one = nearest.as_ref().unwrap_or(task);
        let tools = one.tools(library)?;
        check(one, &situation, &tools[..])?;
        let doubts = |tool| self.distrust(&situation, typical(one, &situation.start, tool));
        let mut each = tools.iter().map(doubts);
        let mut common = each.next().unwrap_or_default();
        for other in each {
            common.retain(|warning| other.contains(warning));
        }
        common.extend(task.unknown.any().then_some(Warning::Guessed { unknown: task.unknown }));
        Ok(common)
    }

    /// Replays the plan of a file in both engines, as written and perturbed, and judges it. The
    /// number of perturbed replays and their seed are the planner's; replays are added until the
    /// verdict is clear.
    ///
    /// ```
    /// use pushplan::files::PlanFile;
    /// use pushplan::{Effort, Planner, Task, ToolLibrary};
    ///
    /// let planner = Planner::for_effort(Effort::Draft)?.build();
    /// let task = Task::example("pull-back")?;
    /// let solution = planner.solve(&task, &ToolLibrary::embedded()?)?;
    /// let best = solution.best().expect("a plan");
    /// let file = PlanFile::new(task, best.tools.clone(), best.plan.clone());
    /// assert!(planner.verify(&file)?.passed);
    /// # Ok::<(), pushplan::Error>(())
    /// ```
    ///
    /// # Errors
    /// Returns [`SolveError`] for invalid input only.
    pub fn verify(&self, file: &PlanFile) -> Result<Verdict, SolveError> {
        let PlanFile { task, tools, plan, joints, .. } = file;
        let situation = stated(task);
        common(task, &situation).finish(task)?;
        if plan.motions(tools).is_none() {
            return Err(lacking(task, plan));
        }
        let (replays, seed) = (self.settings().replays, self.seed());
        let verifier = Verifier::new(VerifySettings { replays, seed });
        let verifier = verifier.until_clear().moving(joints.as_ref());
        let until = Until::new(&NoProgress, self.time_limit);
        let verifier = verifier.with_progress(&until);
        Ok(verifier.verify(task, &situation, tools, plan))
    }

    /// Returns the cause if a pushing task has no plan, as [`Planner::solve`] reports it. Returns
    /// `None` if a plan is worth verifying, which is not done here, or if `progress` stopped it.
    ///
    /// # Errors
    /// Returns [`SolveError`] for invalid input only.
    pub fn why(
        &self,
        task: &Task,
        library: &ToolLibrary,
        progress: &dyn Progress,
    ) -> Result<Option<Cause>, SolveError> {
        let situation = stated(task);
        let choices = task.choices(&situation.start);
        if let Some((nearest, others)) = choices.split_first() {
            for choice in others {
                if self.why(choice, library, progress)?.is_none() {
                    return Ok(None);
                }
            }
            return self.why(nearest, library, progress);
        }
        let tools = task.tools(library)?;
        check(task, &situation, &tools[..])?;
        let (tools, situation, settings) =
            (&tools, &situation, self.settings().first_attempt(task));
        let query = Query { planner: self, task, situation, tools, progress, settings };
        let unobstructed = unobstructed(&query);
        let mut board = Blackboard::for_pushes(query, query.search());
        board.verification.promising = Some(task.reached(&situation.start));
        run(&mut board, &mut for_pushes(unobstructed.as_ref()))?;
        match board.verification.promising {
            Some(true) => Ok(None),
            _ => {
                let found = board.search.as_ref().map(Search::statistics);
                let hints = Hints::of(found.unwrap_or(&Default::default()), std::iter::empty());
                Ok(infeasibility::cause(self, task, library, &hints, progress))
            }
        }
    }

    /// Returns the first pushes towards the goals if at least `least` pushes are needed in total,
    /// even beyond the allowed number. It serves tasks whose plans would be too long. Nothing is
    /// verified.
    ///
    /// # Errors
    /// Returns [`SolveError`] for invalid input only.
    pub fn approach(
        &self,
        situation: &Situation,
        task: &Task,
        library: &ToolLibrary,
        least: usize,
        progress: &dyn Progress,
    ) -> Result<Option<Approach>, SolveError> {
        if task.in_space() {
            return Ok(None);
        }
        let nearest = task.choices(&situation.start).into_iter().next();
        let task = nearest.as_ref().unwrap_or(task);
        let tools = task.tools(library)?;
        check(task, situation, &tools[..])?;
        let until = Until::new(progress, self.time_limit);
        let (tools, settings) = (&tools, *self.settings());
        let query = Query { planner: self, task, situation, tools, progress: &until, settings };
        let mut board = Blackboard::for_pushes(query, query.search());
        Ok(approach(&mut board, least))
    }
}

/// Solves a task of pushing.
fn solve_pushes(query: Query) -> Result<Solution, SolveError> {
    let began = Instant::now();
    let unobstructed = unobstructed(&query);
    let mut board = Blackboard::for_pushes(query, query.search());
    board.try_idle();
    let Query { task, situation, tools, .. } = query;
    // For an untouchable object the search costs nothing, and states why each push is infeasible.
    if beyond(task, situation, tools).is_some() && out_of_reach(task, situation, tools).is_none() {
        return Ok(report::solution(board, began));
    }
    run(&mut board, &mut for_pushes(unobstructed.as_ref()))?;
    let settling = Instant::now();
    board.verification.settle(&mut board.attempts, Class::Fragile);
    board.timing.verification += settling.elapsed().as_secs_f64();
    Ok(report::solution(board, began))
}

/// Solves a task in which an object leaves the plane.
fn solve_levers(query: Query, library: &ToolLibrary) -> Result<Solution, SolveError> {
    let began = Instant::now();
    let mut board = Blackboard::for_levers(query);
    run(&mut board, &mut for_levers(query, library))?;
    Ok(report::solution(board, began))
}

/// Returns the task without the possible obstructions, if there are other objects on the table.
fn unobstructed(query: &Query) -> Option<(Task, Situation)> {
    alone(query.task, query.situation).filter(|_| query.workspace().is_placed())
}
