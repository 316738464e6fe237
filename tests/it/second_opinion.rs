//! `verify --engine mujoco`: MuJoCo's verdict on plans, its exit codes and its place in reports.

use std::path::Path;
use std::process::Output;

use serde_json::Value as Json;
use tempfile::TempDir;

use crate::mujoco_python::python;
use crate::program::{command, run, stderr};

/// Writes a plan of a shipped task, and a copy whose pushes are half as long; returns their paths.
fn plans(folder: &Path) -> [String; 2] {
    let out = folder.to_str().expect("UTF-8");
    let solved = run(&["solve", "tasks/pull-back.yaml", "--effort", "draft", "--out", out]);
    assert_eq!(solved.status.code(), Some(0), "{}", stderr(&solved));
    let [sound, short] =
        ["pull-back", "short"].map(|name| folder.join(format!("{name}.plan.json")));
    let text = std::fs::read_to_string(&sound).expect("a plan");
    let mut json: Json = serde_json::from_str(&text).expect("JSON");
    let length = json["plan"]["steps"][0]["push"]["length"].as_f64().expect("a length");
    json["plan"]["steps"][0]["push"]["length"] = (0.5 * length).into();
    json["task"]["name"] = "short".into();
    std::fs::write(&short, json.to_string()).expect("written");
    [sound, short].map(|path| path.to_str().expect("UTF-8").to_owned())
}

/// Asks MuJoCo about plans; our own engines make the nominal replays only.
fn asked(arguments: &[&str]) -> Output {
    run(&[&["verify", "--engine", "mujoco", "--replays", "0"], arguments].concat())
}

#[test]
fn mujoco_judges_several_plans_beside_our_engines() {
    if python().is_none() {
        return;
    }
    let folder = TempDir::new().expect("a folder");
    let [sound, short] = plans(folder.path());
    let pages = folder.path().join("pages");
    let out = pages.to_str().expect("UTF-8");
    let output = asked(&[&sound, "--json", "--out", out]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let report: Json = serde_json::from_slice(&output.stdout).expect("JSON alone");
    let second = &report["second_opinion"];
    assert_eq!(second["passed"], true, "{second:#}");
    assert!(second["engine"].as_str().is_some_and(|name| name.starts_with("MuJoCo ")));
    assert_eq!(second["runs"].as_array().map(Vec::len), Some(1), "{second:#}");
    assert!(second["difference"].as_f64().is_some_and(|apart| apart < 5e-3), "{second:#}");
    assert_eq!(report["verdict"]["passed"], true);
    let page = std::fs::read_to_string(pages.join("pull-back.verify.html")).expect("a page");
    assert!(page.contains(" passed: reaches the goal") && page.contains("MuJoCo"));

    let output = asked(&[&sound, &short]);
    assert_eq!(output.status.code(), Some(5), "{}", stderr(&output));
    let text = String::from_utf8_lossy(&output.stdout);
    let lines: Vec<&str> =
        text.lines().filter(|line| line.starts_with("second opinion: MuJoCo")).collect();
    let [first, second] = lines[..] else { panic!("{text}") };
    assert!(first.contains(" passed: ") && second.contains(" failed: "), "{text}");

    let output = asked(&[&sound, &short, "--json"]);
    let report: Json = serde_json::from_slice(&output.stdout).expect("JSON alone");
    let passed = |k: usize| report["plans"][k]["second_opinion"]["passed"].as_bool();
    assert_eq!([passed(0), passed(1)], [Some(true), Some(false)], "{report:#}");
    // Only an unstable replay is repeated.
    let runs = &report["plans"][1]["second_opinion"]["runs"];
    assert_eq!(runs.as_array().map(Vec::len), Some(1), "{report:#}");
}

#[test]
fn our_engines_verify_several_plans_as_well() {
    let folder = TempDir::new().expect("a folder");
    let [sound, short] = plans(folder.path());
    let output = run(&["verify", &sound, &short, "--replays", "0", "--json"]);
    assert_eq!(output.status.code(), Some(5), "{}", stderr(&output));
    let report: Json = serde_json::from_slice(&output.stdout).expect("JSON alone");
    let passed = |k: usize| report["plans"][k]["verdict"]["passed"].as_bool();
    assert_eq!([passed(0), passed(1)], [Some(true), Some(false)], "{report:#}");
    assert_eq!(report["plans"][0]["second_opinion"], Json::Null);
    // Pages of one task have the same name.
    let out = folder.path().to_str().expect("UTF-8");
    let output = run(&["verify", &sound, &sound, "--out", out]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("pull-back.verify.html"), "{}", stderr(&output));
    let missing = folder.path().join("missing.plan.json");
    let output = run(&["verify", &sound, missing.to_str().expect("UTF-8")]);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
}

#[cfg(unix)]
#[test]
fn a_python_without_mujoco_is_an_error_with_a_remedy() {
    let folder = TempDir::new().expect("a folder");
    let [sound, _] = plans(folder.path());
    for (python, words) in [("/no/such/python", "cannot start"), ("false", "cannot import mujoco")]
    {
        let mut asked = command(&["verify", &sound, "--engine", "mujoco"]);
        let output = asked.env("PUSHPLAN_PYTHON", python).output().expect("it runs");
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(&format!("`{python}`")) && message.contains(words), "{message}");
        assert!(message.contains("pip install mujoco"), "{message}");
        assert!(message.contains("PUSHPLAN_PYTHON") && output.stdout.is_empty(), "{message}");
    }
}
