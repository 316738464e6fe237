//! Running the command behind a table.

use std::ffi::OsString;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Instant;
use std::{env, fs, io};

use thiserror::Error;

use super::fingerprint::Fingerprint;
use super::markdown::select;
use super::place::{Age, Place};
use super::table::Published;

/// Folder of unfinished runs. Each set of inputs has its own below it: a run on other weights
/// starts anew.
const RUNS: &str = "runs/";

/// Subcommands that keep finished tasks in the folder given with `--out`, and resume.
const RESUMABLE: [&str; 10] = [
    "pushplan-lab evaluate",
    "pushplan-lab random",
    "pushplan-lab run",
    "pushplan-lab refinement",
    "pushplan-lab joints",
    "pushplan-lab masses",
    "pushplan-lab probes",
    "pushplan-lab lever-tasks",
    "pushplan bench tools",
    "pushplan bench tasks",
];

/// A table that could not be measured.
#[derive(Debug, Error)]
pub enum RunError {
    /// No shell, or no folder for runs.
    #[error("cannot run the command: {0}")]
    Io(#[from] io::Error),
    /// The command failed.
    #[error("the command ended with {0}; its messages are above")]
    Failed(std::process::ExitStatus),
    /// The output lacks a published part.
    #[error("the output has {0}")]
    Output(String),
}

/// Measures a table in the repository `root`.
///
/// # Errors
/// A command that fails, or prints something else than is published.
pub fn run(table: &Published, root: &Path, now: &Fingerprint) -> Result<Place, RunError> {
    let runs = format!("{RUNS}{}/", now.key(table.inputs));
    fs::create_dir_all(root.join(&runs))?;
    let began = Instant::now();
    let output = shell(&expanded(table, &runs), root)?;
    if !output.status.success() {
        return Err(RunError::Failed(output.status));
    }
    let minutes = format!("{:.1}", began.elapsed().as_secs_f64() / 60.0);
    let text = String::from_utf8_lossy(&output.stdout);
    let body = select(&text, table.picks).map_err(RunError::Output)?;
    let age = Age { commit: commit(root)?, date: date()?, minutes, machine: machine() };
    Ok(Place::fresh(table, body, &age, now))
}

/// Returns the command with options that its page leaves out.
fn expanded(table: &Published, runs: &str) -> String {
    let command = table.command.replace(RUNS, runs);
    let plain = command.starts_with("pushplan") && !command.contains("&&");
    let resumable = RESUMABLE.iter().any(|name| command.starts_with(name)) && plain;
    let out = if resumable { format!(" --out {runs}{}", table.name) } else { String::new() };
    format!("{command}{out}{}", if plain { " --markdown" } else { "" })
}

/// Runs a line of shell with the programs beside this one first.
fn shell(line: &str, root: &Path) -> io::Result<Output> {
    let own = env::current_exe()?;
    let folders = own.parent().map(Path::to_owned).into_iter();
    let path = env::var_os("PATH").unwrap_or_default();
    let path: OsString =
        env::join_paths(folders.chain(env::split_paths(&path))).unwrap_or(path.clone());
    Command::new("bash")
        .args(["-c", line])
        .current_dir(root)
        .env("PATH", path)
        .stderr(Stdio::inherit())
        .output()
}

/// Short name of the commit, and whether files differ from it.
fn commit(root: &Path) -> io::Result<String> {
    let line =
        "git rev-parse --short=8 HEAD; git status --porcelain -uno -- src crates tasks tools";
    let output = shell(line, root)?;
    let text = String::from_utf8_lossy(&output.stdout);
    let mut lines = text.lines();
    let commit = lines.next().unwrap_or("an unknown commit").to_owned();
    // Pages that are measured meanwhile change no number.
    let changed = lines.any(|line| !line.contains("crates/lab/results/"));
    Ok(if changed { format!("{commit} with changes") } else { commit })
}

fn date() -> io::Result<String> {
    let output = Command::new("date").args(["-u", "+%F"]).output()?;
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// Name of the processor and number of its cores.
fn machine() -> String {
    let text = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = text.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    format!("{}, {cores} cores", name.map_or("unknown processor", |(_, name)| name))
}
