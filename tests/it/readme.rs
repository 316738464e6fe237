//! The README is consistent with the program: its commands run, its task is solved, and its example
//! compiles.

use std::path::Path;

use pushplan::asset::load_task;
use pushplan::{Effort, PlanStatus, Planner, Task, Tool, ToolLibrary};
use tempfile::TempDir;

use crate::ROOT;
use crate::pages::{are_taken, blocks};
use crate::program::succeed;

const README: &str = include_str!("../../README.md");

/// Prefix of commands in the README.
const RUN: &str = "pushplan ";

/// Prefix of the commands that build from a checkout.
const BUILD: &str = "cargo ";

/// Only the command has a program, so `cargo run` in the root starts it.
#[test]
fn the_root_has_one_program() {
    let root = std::fs::read_to_string(Path::new(ROOT).join("Cargo.toml")).expect("a manifest");
    let list = root.split("default-members = [").nth(1).and_then(|rest| rest.split(']').next());
    let members = list.expect("members").split('"').skip(1).step_by(2);
    let of = |member: &&str| {
        let folder = Path::new(ROOT).join(member).join("src");
        folder.join("main.rs").exists() || folder.join("bin").exists()
    };
    assert_eq!(members.filter(of).collect::<Vec<_>>(), ["crates/command"]);
}

#[test]
fn its_commands_run() {
    let out = TempDir::new().expect("a folder");
    let folder = out.path().to_str().expect("UTF-8");
    let blocks = blocks(README, "sh");
    let lines = blocks.iter().flat_map(|block| block.lines()).filter_map(|l| l.strip_prefix(RUN));
    let lines: Vec<&str> = lines.collect();
    let [solve, verify, act] = &lines[..] else { panic!("solve, verify, run: {lines:?}") };
    // Results are written elsewhere, so that the tests leave the checkout unchanged.
    succeed(&format!("{solve} --out {folder}"));
    succeed(&verify.replace("plans/", &format!("{folder}/")));
    for end in ["plan.json", "svg", "html", "animated.svg"] {
        assert!(out.path().join(format!("pull-back-behind-wall.{end}")).exists(), "{end}");
    }
    succeed(&format!("{act} --out {folder}"));
    // The shipped pictures of this task are the output of the command.
    for name in ["coupled-or-not.run.svg", "coupled-or-not.belief.svg"] {
        let shown = Path::new(ROOT).join("tasks").join(name);
        let [made, shown] = [out.path().join(name), shown].map(std::fs::read);
        let old = format!("tasks/{name} is old: {act} --out tasks, and remove the trace");
        assert!(made.unwrap() == shown.unwrap(), "{old}");
    }
    let built: Vec<&str> = blocks
        .iter()
        .flat_map(|block| block.lines())
        .filter_map(|l| l.strip_prefix(BUILD))
        .collect();
    let [run, "test --release --locked"] = built[..] else { panic!("run and test: {built:?}") };
    let solved =
        run.strip_prefix("run --release --locked -- ").expect("one command builds and runs");
    succeed(&format!("{solved} --out {folder}"));
    assert!(README.contains("`pushplan new my-task`"));
    succeed(&format!("new {folder}/my-task"));
    succeed(&format!("solve {folder}/my-task.yaml --out {folder}"));
}

#[test]
fn its_task_is_solved_and_its_tool_is_one() {
    let files = blocks(README, "yaml");
    let [task, tool] = &files[..] else { panic!("a task and a tool") };
    let task = Task::parse(task, "README.md").unwrap();
    let tool = Tool::parse(tool, "README.md").unwrap();
    let library = ToolLibrary::embedded().unwrap().with(tool).unwrap();
    let planner = Planner::for_effort(Effort::Standard).unwrap().build();
    assert_eq!(planner.solve(&task, &library).unwrap().status, PlanStatus::Solved);
}

#[test]
fn the_commands_of_all_pages_are_taken() {
    are_taken(15);
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
    let example = &blocks(README, "rust")[0];
    assert!(documented.contains(example.as_str()), "src/lib.rs shows another example:\n{example}");
}

#[test]
fn its_picture_is_of_a_shipped_task() {
    let path =
        README.split("](").nth(1).and_then(|rest| rest.split(')').next()).expect("a picture");
    let picture = Path::new(ROOT).join(path);
    assert!(picture.exists(), "{path} is missing");
    let task = picture.with_extension("").with_extension("yaml");
    let library = ToolLibrary::embedded().expect("the shipped tools");
    load_task(&task, &library).unwrap_or_else(|faults| panic!("{faults}"));
}
