//! The command as a user sees it: words, exit codes, files.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value as Json;
use tempfile::TempDir;

/// The transcripts in `tests/cmd`, with what was printed and the exit codes.
#[test]
fn transcripts() {
    trycmd::TestCases::new().case("tests/cmd/*.md").default_bin_name("pushplan");
}

#[test]
fn results_are_the_same_for_any_number_of_threads_and_progress_stays_off_stdout() {
    let run = |threads: &str| {
        let arguments =
            ["predict", "tasks/pull-back.yaml", "--tool", "l-hook", "--push", "can:180", "--json"];
        let output = pushplan(&[&arguments[..], &["--threads", threads]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let mut json: Json = serde_json::from_slice(&output.stdout).expect("JSON alone");
        for effect in json["effects"].as_array_mut().expect("effects") {
            effect.as_object_mut().map(|effect| effect.remove("seconds"));
        }
        json
    };
    let one = run("1");
    assert_eq!(one["schema_version"], 1);
    assert_eq!(one, run("3"));
}

#[test]
fn a_simulation_leaves_files_that_check_finds_fine() {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    let push = "start=0.62,-0.02 direction_deg=180 length=0.17";
    let output = pushplan(&[
        "simulate",
        "tasks/pull-back.yaml",
        "--tool",
        "l-hook",
        "--push",
        push,
        "--out",
        out,
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let trajectory = folder.path().join("pull-back.planar.trajectory.json");
    let output = pushplan(&["check", trajectory.to_str().expect("UTF-8")]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let names = files(folder.path());
    assert_eq!(names, ["pull-back.planar.svg", "pull-back.planar.trajectory.json"]);
}

#[test]
fn a_folder_that_cannot_be_written_is_said_before_anything_is_computed() {
    // A file where the folder should be: refused to everybody, root as well.
    let folder = TempDir::new().expect("a folder");
    let taken = folder.path().join("taken");
    std::fs::write(&taken, "").expect("a file");
    for out in [taken.join("plans"), taken] {
        let output = pushplan(&[
            "simulate",
            "tasks/pull-back.yaml",
            "--tool",
            "stick",
            "--push",
            "can:0",
            "--out",
            out.to_str().expect("UTF-8"),
        ]);
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
        assert!(
            stderr(&output).contains("error: cannot write to the folder"),
            "{}",
            stderr(&output)
        );
    }
    assert_eq!(files(folder.path()), ["taken"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error_and_not_a_panic() {
    let full = std::fs::File::create("/dev/full").expect("the device of full disks");
    let output = Command::new(env!("CARGO_BIN_EXE_pushplan"))
        .args(["schema", "task"])
        .stdout(full)
        .output()
        .expect("the command runs");
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(stderr(&output).starts_with("error: cannot write the results"), "{}", stderr(&output));
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_pushplan"))
        .args(["completions", "zsh"])
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("the command starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("the command ends");
    assert_eq!((output.status.code(), stderr(&output)), (Some(0), String::new()));
}

#[test]
fn schemas_fit_the_shipped_files() {
    for kind in ["tool", "task"] {
        let output = pushplan(&["schema", kind]);
        let schema: Json = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(schema["title"], format!("pushplan {kind}"));
        assert_eq!(schema["additionalProperties"], false);
    }
}

fn pushplan(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pushplan"))
        .args(arguments)
        .current_dir(root())
        .output()
        .expect("the command runs")
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Names of the files in a folder, sorted.
fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> = entries
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}
