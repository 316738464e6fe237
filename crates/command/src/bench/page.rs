//! The page of one task of a benchmark: its plan is replayed with the settings of the measurement.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;

use crate::{action::LibraryArgs, error::CliError, output, page, session::Session};
use pushplan::asset::{PlanFile, load_task};
use pushplan::scene::{Engine, ModelSpec, Situation};
use pushplan::verify::{Verifier, VerifySettings};
use pushplan_bench::store::RunManifest;
use pushplan_bench::{End, SolvedTask};
use pushplan_report::{PageView, TaskSource};

/// Task of the page, and the tools of its plan.
#[derive(Args, Debug)]
pub struct PageArgs {
    /// Task file of the run; also write a page that plays its plan
    #[arg(long, value_name = "TASK", requires = "out")]
    page: Option<PathBuf>,
    #[command(flatten)]
    library: LibraryArgs,
}

impl PageArgs {
    /// Returns the task file, if a page is wanted.
    pub fn wanted(&self) -> Option<&Path> {
        self.page.as_deref()
    }

    /// Replays the plan of the task in `path` with the run's seed of perturbed replays, and writes
    /// its page. The task must be among those `solved` in the run.
    ///
    /// # Errors
    /// Returns an error if the run does not contain the task, or contains it with other results.
    /// Also returns errors of writing the page.
    pub fn write<'a>(
        &self,
        path: &Path,
        out: &Path,
        session: &Session,
        (run, seed): (&RunManifest, u64),
        mut solved: impl Iterator<Item = &'a SolvedTask>,
    ) -> Result<PathBuf, CliError> {
        output::prepare(out)?;
        let library = self.library.load()?;
        let task = load_task(path, &library)?;
        let found = solved.find(|record| record.task == task.name);
        let record = found.ok_or_else(|| {
            let message = format!("the run contains no task `{}`", task.name);
            CliError::usage(message, "name the file of a measured task")
        })?;
        let plan = record.plan.clone().ok_or_else(|| {
            let message = format!("`{}` has no plan, because no push is possible", task.name);
            CliError::usage(message, "name another task")
        })?;
        let tool = library.get(plan.tool()).ok_or_else(|| {
            let message = format!("the plan uses the unknown tool `{}`", plan.tool());
            CliError::usage(message, "repeat --tools or --more-tools of the run")
        })?;
        let replays = run.settings["budget"]["replays"].as_u64().unwrap_or(0) as usize;
        let verifier = Verifier::new(VerifySettings { replays, seed }).until_clear();
        let situation = Situation::stated(&task.scene);
        let verdict = session
            .compute(|| verifier.verify(&task, &situation, std::slice::from_ref(tool), &plan));
        let end = |engine| verdict.nominal(engine).map(|evidence| End::of(&evidence.outcome));
        if [record.planar, record.spatial] != Engine::ALL.map(end) {
            return Err(CliError::usage(
                format!("the replays of `{}` end differently than in the run", task.name),
                "use exactly the task, the tools and the program version of the run",
            ));
        }
        let model: Option<ModelSpec> = run.model.parse().ok();
        let recipe = self.library.origin(TaskSource::of(path), model.clone()).plan(&plan);
        let file = PlanFile { model, ..PlanFile::new(task, vec![Arc::clone(tool)], plan) };
        page::write(out, session, &file, &verdict, (recipe, PageView::Above))
    }
}
