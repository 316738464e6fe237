//! The program of the crate whose tests these are, run in the repository.

use std::path::Path;
use std::process::{Command, Output};

use crate::{PROGRAM, ROOT};

/// Its name, as people type it.
pub fn name() -> &'static str {
    Path::new(PROGRAM).file_stem().and_then(|name| name.to_str()).expect("a name")
}

/// What runs it there.
pub fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(PROGRAM);
    command.args(arguments).current_dir(ROOT);
    command
}

/// Runs it to its end.
pub fn run(arguments: &[&str]) -> Output {
    command(arguments).output().expect("the command runs")
}

/// The same, which must succeed, of one line.
pub fn succeed(line: &str) -> Output {
    let output = run(&line.split_whitespace().collect::<Vec<_>>());
    assert_eq!(output.status.code(), Some(0), "{line}: {}", stderr(&output));
    output
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}
