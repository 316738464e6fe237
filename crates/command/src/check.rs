//! `pushplan check`: reports all errors of files, or prints the JSON schema of a kind of file that
//! users write.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use pushplan::asset::{
    self, Fault, Faults, Kind, ToolLibrary, recording_schema, task_schema, tool_schema,
    world_schema,
};
use pushplan::solve::{Effort, Planner};
use pushplan_act::act::{ActError, Trace};

use super::{
    action::LibraryArgs, error::CliError, exit_code, progress::TerminalProgress, session::Session,
    solve::solve_error,
};

/// Check files and list every error with its location, or print a JSON schema for editors
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  pushplan check tools/*.yaml tasks/*.yaml
  pushplan check --why my-task.yaml
  pushplan check --schema task > task.schema.json
  # then begin the task file with this line:
  # yaml-language-server: $schema=task.schema.json")]
pub struct CheckArgs {
    /// Tool, task, plan, trajectory, recording, world or run files; the content determines the kind
    #[arg(required_unless_present = "schema", value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Print the JSON schema of this kind of file
    #[arg(long, value_name = "KIND", conflicts_with = "files")]
    schema: Option<Schema>,
    /// Also explain why a pushing task has no plan, as `solve` would, but without verifying plans
    #[arg(long, conflicts_with = "schema")]
    why: bool,
    #[command(flatten)]
    library: LibraryArgs,
}

/// Files that people write.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Schema {
    Tool,
    Task,
    Recording,
    World,
}

fn damaged(file: &Path, error: &ActError) -> Faults {
    let advice = "the file is damaged or from another version; create it again";
    Fault::of_file(&file.display().to_string(), error.to_string(), advice).into()
}

pub fn run(args: &CheckArgs, session: &Session) -> Result<u8, CliError> {
    if let Some(kind) = args.schema {
        let schema = match kind {
            Schema::Tool => tool_schema(),
            Schema::Task => task_schema(),
            Schema::Recording => recording_schema(),
            Schema::World => world_schema(),
        };
        session.print(&format!("{schema:#}\n"))?;
        return Ok(exit_code::DONE);
    }
    let library = args.library.load()?;
    let (mut faults, mut code) = (Vec::new(), exit_code::DONE);
    for file in &args.files {
        let read = |kind| match kind {
            Kind::Run => Trace::load(file).map(|_| kind).map_err(|error| damaged(file, &error)),
            _ => Ok(kind),
        };
        match asset::check(file, Some(&library)).and_then(read) {
            Ok(kind) => {
                session.print(&format!("{}: {kind}, valid\n", file.display()))?;
                if args.why && kind == Kind::Task {
                    code = code.max(why(file, &library, session)?);
                }
            }
            Err(found) => faults.extend(found.0),
        }
    }
    if faults.is_empty() { Ok(code) } else { Err(Faults(faults).into()) }
}

/// Prints the reason why a task has no plan, and returns the exit code.
fn why(file: &Path, library: &ToolLibrary, session: &Session) -> Result<u8, CliError> {
    let task = asset::load_task(file, library)?;
    if task.levers.is_some() {
        session.print("  --why does not support levering tasks; use `pushplan solve`\n")?;
        return Ok(exit_code::DONE);
    }
    let planner = Planner::for_effort(Effort::default())?.build();
    let following = TerminalProgress::spinner(session, "searching for a plan");
    let found = session.compute(|| planner.why(&task, library, &following));
    following.finish()?;
    match found.map_err(solve_error)? {
        Some(cause) => {
            session.print(&format!("  no plan: {cause}\n"))?;
            Ok(exit_code::NO_PLAN)
        }
        None => {
            session.print("  search predicts success; `pushplan solve` verifies the plan\n")?;
            Ok(exit_code::DONE)
        }
    }
}
