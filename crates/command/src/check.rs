//! `pushplan check`: reports all errors of files, or prints the JSON schema of a kind of file or of
//! a command's output.

use std::path::{Path, PathBuf};

use clap::Args;

use pushplan::asset::{self, Fault, Faults, Kind, ToolLibrary, load_example, load_task};
use pushplan::outcome::warning_lines;
use pushplan::solve::{Effort, Planner};
use pushplan::task::Task;
use pushplan_act::act::{ActError, Trace};

use pushplan_report::Document;
use serde_json::{Value as Json, json};

use super::{
    action::LibraryArgs, error::CliError, exit_code, progress::TerminalProgress, schema,
    session::Session, solve::solve_error, task_argument,
};

/// Check files and list every error with its location, or print a JSON schema for editors
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  pushplan check tools/*.yaml tasks/*.yaml
  pushplan check --why my-task.yaml
  pushplan check --example pull-back --json
  pushplan check --schema task > task.schema.json
  pushplan check --schema solution
  # then begin the task file with this line:
  # yaml-language-server: $schema=task.schema.json")]
pub struct CheckArgs {
    /// Tool, task, plan, trajectory, recording, world or run files; the content determines the kind
    #[arg(required_unless_present_any = ["schema", "example"], value_name = "FILE")]
    files: Vec<PathBuf>,
    #[arg(long, value_name = "NAME", help = task_argument::HELP, conflicts_with = "files",
          hide_possible_values = true, value_parser = task_argument::example())]
    example: Option<String>,
    /// Print the JSON schema of this kind of file, or of the document that a command prints with
    /// `--json`
    #[arg(long, value_name = "KIND", conflicts_with_all = ["files", "example", "json"],
          value_parser = schema::kinds())]
    schema: Option<String>,
    /// Also explain why a pushing task has no plan, as `solve` would, but without verifying plans
    #[arg(long, conflicts_with = "schema")]
    why: bool,
    /// Print JSON instead of text: for each file its kind, and each fault with place and remedy
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    library: LibraryArgs,
}

/// File or shipped task to be checked.
enum Subject<'a> {
    File(&'a Path),
    Example(&'a str),
}

impl Subject<'_> {
    fn name(&self) -> String {
        match self {
            Self::File(path) => path.display().to_string(),
            Self::Example(name) => (*name).to_owned(),
        }
    }

    /// Reads it and returns its kind, or all its faults.
    fn check(&self, library: &ToolLibrary) -> Result<Kind, Faults> {
        let Self::File(path) = self else { return self.task(library).map(|_| Kind::Task) };
        let kind = asset::check(path, Some(library))?;
        if kind == Kind::Run {
            Trace::load(path).map_err(|error| damaged(path, &error))?;
        }
        Ok(kind)
    }

    fn task(&self, library: &ToolLibrary) -> Result<Task, Faults> {
        match self {
            Self::File(path) => load_task(path, library),
            Self::Example(name) => load_example(name, library),
        }
    }
}

fn damaged(file: &Path, error: &ActError) -> Faults {
    let advice = "the file is damaged or from another version; create it again";
    Fault::of_file(&file.display().to_string(), error.to_string(), advice).into()
}

pub fn run(args: &CheckArgs, session: &Session) -> Result<u8, CliError> {
    if let Some(kind) = &args.schema {
        session.print(&format!("{:#}\n", schema::of(kind)))?;
        return Ok(exit_code::DONE);
    }
    let library = args.library.load()?;
    let (mut files, mut faults, mut code) = (Vec::new(), Vec::new(), exit_code::DONE);
    let print = |text: String| if args.json { Ok(()) } else { session.print(&text) };
    let named = args.files.iter().map(|file| Subject::File(file));
    for subject in named.chain(args.example.as_deref().map(Subject::Example)) {
        let name = subject.name();
        match subject.check(&library) {
            Ok(kind) => {
                print(format!("{name}: {kind}, valid\n"))?;
                let warnings = match kind {
                    Kind::Task => warnings(&subject, &library)?,
                    _ => Vec::new(),
                };
                session.warn_each(&warnings);
                let mut reason = None;
                if args.why && kind == Kind::Task {
                    let (own, words) = why(&subject, &library, session)?;
                    print(format!("  {words}\n"))?;
                    (code, reason) = (code.max(own), Some(words));
                }
                files.push(row(&name, Ok((kind, warnings)), reason));
            }
            Err(found) => {
                files.push(row(&name, Err(&found.0), None));
                faults.extend(found.0);
            }
        }
    }
    match (args.json, faults.is_empty()) {
        (false, false) => Err(Faults(faults).into()),
        (false, true) => Ok(code),
        (true, sound) => {
            let document = Document { json: json!({ "files": files }), ..Document::default() };
            session.print(&document.to_json())?;
            Ok(if sound { code } else { exit_code::INVALID_FILE })
        }
    }
}

/// Returns the warnings that a solution of a task will carry with every tool.
fn warnings(subject: &Subject, library: &ToolLibrary) -> Result<Vec<String>, CliError> {
    let planner = Planner::for_effort(Effort::default())?.build();
    let found = planner.doubts(&subject.task(library)?, library).map_err(solve_error)?;
    Ok(warning_lines(&found))
}

/// Returns the JSON object of a checked file: its kind and warnings, or its faults.
fn row(name: &str, found: Result<(Kind, Vec<String>), &[Fault]>, why: Option<String>) -> Json {
    let (kind, warnings, faults) = match found {
        Ok((kind, warnings)) => (Some(kind), warnings, &[][..]),
        Err(faults) => (None, Vec::new(), faults),
    };
    let fault = |fault: &Fault| {
        json!({
            "file": fault.file,
            "line": fault.place.map(|place| place.line),
            "column": fault.place.map(|place| place.column),
            "message": fault.message,
            "remedy": fault.advice,
        })
    };
    let faults: Vec<Json> = faults.iter().map(fault).collect();
    json!({
        "file": name, "kind": kind.map(|kind| kind.to_string()), "valid": faults.is_empty(),
        "faults": faults, "warnings": warnings, "why": why,
    })
}

/// Returns the exit code and the reason why a task has no plan, or that the search finds one.
fn why(
    subject: &Subject,
    library: &ToolLibrary,
    session: &Session,
) -> Result<(u8, String), CliError> {
    let task = subject.task(library)?;
    if task.levers.is_some() {
        let words = "--why does not support levering tasks; use `pushplan solve`";
        return Ok((exit_code::DONE, words.to_owned()));
    }
    let planner = Planner::for_effort(Effort::default())?.build();
    let following = TerminalProgress::spinner(session, "searching for a plan");
    let found = session.compute(|| planner.why(&task, library, &following));
    following.finish()?;
    Ok(match found.map_err(solve_error)? {
        Some(cause) => (exit_code::NO_PLAN, format!("no plan: {cause}")),
        None => {
            let words = "search predicts success; `pushplan solve` verifies the plan";
            (exit_code::DONE, words.to_owned())
        }
    })
}
