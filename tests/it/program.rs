//! The program of the crate under test, run in the repository.

use std::path::Path;
use std::process::{Command, Output};

use crate::{PROGRAM, ROOT};

/// Returns the program's name, as typed by users.
pub fn name() -> &'static str {
    Path::new(PROGRAM).file_stem().and_then(|name| name.to_str()).expect("a name")
}

/// Returns a command that runs the program in the repository.
pub fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(PROGRAM);
    command.args(arguments).current_dir(ROOT);
    command
}

/// Runs the program to its end.
pub fn run(arguments: &[&str]) -> Output {
    command(arguments).output().expect("the command runs")
}

/// Runs a command line, which must succeed.
pub fn succeed(line: &str) -> Output {
    let output = run(&line.split_whitespace().collect::<Vec<_>>());
    assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
    output
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}
