//! What the README says is true: its commands run, its files load, its example compiles.

use std::process::Command;

use pushplan::asset::{ToolLibrary, load_task};
use pushplan::scene::{Task, Tool};
use tempfile::TempDir;

const README: &str = include_str!("../../README.md");

/// How the README starts the program from a checkout.
const RUN: &str = "cargo run --release -- ";

#[test]
fn its_commands_run() {
    let mut ran = 0;
    for line in blocks("sh").iter().flat_map(|block| block.lines()) {
        let Some(arguments) = line.strip_prefix(RUN) else { continue };
        let out = TempDir::new().expect("a folder");
        // Results go elsewhere, so that the tests leave the checkout as it is.
        let output = Command::new(env!("CARGO_BIN_EXE_pushplan"))
            .args(arguments.split_whitespace())
            .arg("--out")
            .arg(out.path())
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .output()
            .expect("the command runs");
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{line}: {error}");
        for name in ["pull-back.plan.json", "pull-back.svg"] {
            assert!(README.contains(&format!("plans/{name}")), "{name} is not announced");
            assert!(out.path().join(name).exists(), "{line} writes no {name}");
        }
        ran += 1;
    }
    assert_eq!(ran, 1, "the README's one command that solves a task");
    assert!(blocks("sh").iter().any(|block| block.trim() == "cargo test --release"));
}

#[test]
fn its_files_load() {
    let files = blocks("yaml");
    let [tool, task] = &files[..] else { panic!("a tool and a task") };
    Tool::parse(tool, "README.md").unwrap_or_else(|faults| panic!("{faults}"));
    Task::parse(task, "README.md").unwrap_or_else(|faults| panic!("{faults}"));
}

#[test]
fn its_example_is_the_one_that_runs_as_a_documentation_test() {
    let documented: String = include_str!("../../src/lib.rs")
        .lines()
        .filter_map(|line| line.strip_prefix("//!"))
        .map(|line| line.strip_prefix(' ').unwrap_or(line))
        // Hidden lines, and headings around the example.
        .filter(|line| !line.starts_with("# "))
        .flat_map(|line| [line, "\n"])
        .collect();
    let example = &blocks("rust")[0];
    assert!(documented.contains(example.as_str()), "src/lib.rs shows another example:\n{example}");
}

#[test]
fn it_names_every_command_and_exit_code() {
    let help = Command::new(env!("CARGO_BIN_EXE_pushplan")).arg("--help").output().expect("help");
    let help = String::from_utf8_lossy(&help.stdout).into_owned();
    let commands = help
        .split("Commands:\n")
        .nth(1)
        .and_then(|rest| rest.split("\n\n").next())
        .expect("a list of commands");
    for command in commands.lines().filter_map(first_column) {
        let named = README.contains(&format!("| `{command}")) || command == "help";
        assert!(named, "the README does not name `{command}`");
    }
    for code in [0, 1, 2, 3, 4, 5, 6, 130] {
        assert!(README.contains(&format!("\n| {code} | ")), "no exit code {code}");
    }
}

#[test]
fn its_picture_is_of_a_shipped_task() {
    let path =
        README.split("](").nth(1).and_then(|rest| rest.split(')').next()).expect("a picture");
    let task = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path).with_extension("yaml");
    assert!(task.with_extension("svg").exists(), "{path} is missing");
    let library = ToolLibrary::embedded().expect("the shipped tools");
    load_task(&task, &library).unwrap_or_else(|faults| panic!("{faults}"));
}

/// The name at the start of a line of help; none for a line that goes on with the one above.
fn first_column(line: &str) -> Option<&str> {
    let line = line.strip_prefix("  ").filter(|line| !line.starts_with(' '))?;
    line.split_whitespace().next()
}

/// The contents of the README's code blocks in `language`.
fn blocks(language: &str) -> Vec<String> {
    let fence = format!("```{language}\n");
    README
        .split(&fence)
        .skip(1)
        .filter_map(|rest| rest.split("```").next())
        .map(str::to_owned)
        .collect()
}
