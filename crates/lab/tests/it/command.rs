//! The command `pushplan-lab` from a user's perspective.

use pushplan::asset::{ToolLibrary, load_task};
use serde_json::Value as Json;
use tempfile::TempDir;

use crate::pages;
use crate::program::{run, stderr};

/// Replays the transcripts in `tests/cmd`, with outputs and exit codes.
#[test]
fn transcripts() {
    trycmd::TestCases::new().case("tests/cmd/*.md").default_bin_name("pushplan-lab");
}

#[test]
fn the_commands_of_all_pages_are_taken() {
    pages::are_taken(20);
}

#[test]
fn random_tasks_are_measured_saved_and_compared() {
    let folder = TempDir::new().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let random = |options: &[&str]| {
        let fixed = ["random", "--effort", "draft", "--count", "4"];
        let kinds = ["--kind", "heading", "--kind", "reach"];
        let output = run(&[&fixed[..], &kinds, options].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    };
    let (planar, still, other) = (path("planar"), path("still"), path("other"));
    random(&["--model", "planar", "--out", &planar, "--save-tasks", &path("tasks")]);
    random(&["--model", "still", "--out", &still]);
    random(&["--model", "still", "--out", &other, "--seed", "8"]);

    let output = run(&["report", &planar, &still, "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let json: Json = serde_json::from_slice(&output.stdout).expect("JSON alone");
    let kind = |k: usize| json["runs"][0]["tasks"][k]["kind"].as_str().expect("a kind");
    assert_eq!([0, 1, 2, 3].map(kind), ["reach", "heading", "heading", "reach"]);
    let solved = |run: usize| {
        let tasks = json["runs"][run]["tasks"].as_array().expect("tasks");
        tasks.iter().filter(|task| task["solved"]["status"] == "solved").count()
    };
    assert!(solved(0) >= 3 && solved(1) == 0, "{} and {}", solved(0), solved(1));

    let output = run(&["report", &planar, &still, "--markdown"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    for method in ["planar, draft", "still, draft", "random push", "do nothing"] {
        assert!(text.contains(&format!("| {method} ")), "{text}");
    }
    let output = run(&["report", &planar, &other]);
    assert_eq!(output.status.code(), Some(2), "other tasks side by side");
    assert!(stderr(&output).contains("seed 7, 4 tasks and seed 8"), "{}", stderr(&output));

    let saved = [0, 1].map(|k| ["reach", "heading"].map(|kind| format!("{kind}-000{k}.yaml")));
    let library = ToolLibrary::embedded().expect("the shipped tools");
    for name in saved.as_flattened() {
        let path = folder.path().join("tasks").join(name);
        load_task(path, &library).unwrap_or_else(|faults| panic!("{faults}"));
    }
}
