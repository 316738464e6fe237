//! Documents that commands print with `--json` satisfy the schemas that `check --schema` prints.

mod validator;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use pushplan_report::DocumentKind;
use serde_json::Value as Json;
use tempfile::TempDir;

use crate::interrupted::interrupt;
use crate::program::{run, stderr};
use crate::{PROGRAM, ROOT};

/// Returns the document of a command line, which must end with one of these exit codes.
fn document(line: &str, codes: &[i32]) -> Json {
    let output = run(&line.split_whitespace().collect::<Vec<_>>());
    let code = output.status.code().expect("an exit code");
    assert!(codes.contains(&code), "{line}: {code}: {}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{line}: {error}"))
}

fn schema(word: &str) -> Json {
    let output = run(&["check", "--schema", word]);
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn satisfies(word: &str, document: &Json) {
    let faults = validator::faults(&schema(word), document);
    assert!(faults.is_empty(), "{word}:\n{}", faults.join("\n"));
}

/// Returns a folder with the plan of a shipped task.
fn solved(name: &str) -> (TempDir, String, Json) {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().display().to_string();
    let solution =
        document(&format!("solve --example {name} --effort draft --json --out {out}"), &[0]);
    let plan = folder.path().join(format!("{name}.plan.json")).display().to_string();
    (folder, plan, solution)
}

#[test]
fn solutions_verdicts_predictions_and_exports_satisfy_their_schemas() {
    let (folder, plan, solution) = solved("pull-back");
    satisfies("solution", &solution);
    assert_eq!(solution["best"], 0);
    let out = folder.path().display();
    let verdict = document(&format!("verify {plan} --replays 2 --json --out {out}"), &[0]);
    satisfies("verdict", &verdict);
    let twice = document(&format!("verify {plan} {plan} --replays 0 --json"), &[0]);
    satisfies("verdict", &twice);
    assert_eq!(twice["plans"].as_array().map(Vec::len), Some(2));
    let poses = folder.path().join("poses.json");
    let line = format!("predict {plan} --json --export {}", poses.display());
    satisfies("prediction", &document(&line, &[0]));
    let poses = std::fs::read(&poses).expect("poses");
    satisfies("poses", &serde_json::from_slice(&poses).expect("JSON"));
    satisfies("export", &document(&format!("export {plan} --json --out {out}"), &[0]));
    let file = std::fs::read(&plan).expect("a plan");
    satisfies("plan", &serde_json::from_slice(&file).expect("JSON"));
    // The schema is closed: a key that it does not describe is a fault.
    let mut more = solution;
    more["plans"][0]["colour"] = "red".into();
    assert_eq!(validator::faults(&schema("solution"), &more).len(), 1);
}

#[test]
fn solutions_without_a_plan_and_with_lever_ups_satisfy_the_schema() {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().display();
    let options = format!("--effort draft --json --out {out}");
    let none = document(&format!("solve --example too-far {options}"), &[4]);
    satisfies("solution", &none);
    assert!(none["cause"].is_string());
    satisfies("solution", &document(&format!("solve --example raise-plate {options}"), &[0]));
    satisfies("solution", &document(&format!("solve --example two-places {options}"), &[0, 8]));
    satisfies("design", &document(&format!("design --example too-far {options}"), &[0]));
}

#[test]
fn runs_fits_beliefs_and_errors_satisfy_their_schemas() {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().display();
    let line = format!("run --example hidden-hinge --world 1 --max-pushes 1 --json --out {out}");
    satisfies("run", &document(&line, &[0, 4, 5]));
    let real = "tests/it/assets/real-pushes/flat";
    let fit = document(&format!("fit {real} --json"), &[0]);
    satisfies("fit", &fit);
    assert!(fit["friction"].as_f64().is_some_and(|value| (0.4..0.6).contains(&value)), "{fit}");
    let line =
        format!("predict {real}/push-00.recording.json {real}/push-05.recording.json --json");
    satisfies("errors", &document(&line, &[0]));
    let one = document("infer tests/it/assets/push.recording.json --json", &[0]);
    satisfies("belief", &one);
    let note = one["note"].as_str().expect("a reason");
    assert!(note.contains("the recording has a single object"), "{note}");
    let line = "predict --example jointed-pair --tool stick --push left:0 --alone --json \
                --trajectories --out";
    document(&format!("{line} {out}"), &[0]);
    let trajectory = std::fs::read_dir(folder.path())
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .find(|path| path.display().to_string().ends_with(".trajectory.json"))
        .expect("a trajectory");
    let file = std::fs::read(&trajectory).expect("a trajectory");
    satisfies("trajectory", &serde_json::from_slice(&file).expect("JSON"));
    let line = format!("infer {} --json --mass-ranges 0.1-0.3 0.5-1", trajectory.display());
    let pair = document(&line, &[0]);
    satisfies("belief", &pair);
    assert!(pair["note"].is_null() && pair["pairs"].as_array().is_some_and(|p| !p.is_empty()));
}

#[test]
fn checks_and_benchmarks_satisfy_their_schemas() {
    satisfies("check", &document("check --example pull-back --json", &[0]));
    let line = "check tasks/pull-back.yaml tests/cmd/bad-input.in/typo.yaml --json";
    let mixed = document(line, &[3]);
    satisfies("check", &mixed);
    assert_eq!([&mixed["files"][0]["valid"], &mixed["files"][1]["valid"]], [true, false]);
    satisfies("bench-tasks", &document("bench tasks tasks/pull-back.yaml --json", &[0]));
    let line = "bench tools --form single --tasks 1 --json";
    satisfies("bench-tools", &document(line, &[0]));
    let folder = TempDir::new().expect("a folder");
    let heavy = folder.path().join("heavy.yaml");
    let text =
        std::fs::read_to_string(Path::new(ROOT).join("tasks/pull-back.yaml")).expect("a task");
    std::fs::write(&heavy, text.replace("mass: 0.4", "mass: 80")).expect("a file");
    let warned = document(&format!("check {} --json", heavy.display()), &[0]);
    satisfies("check", &warned);
    let warning = warned["files"][0]["warnings"][0].as_str().expect("a warning");
    assert!(warning.contains("mass"), "{warning}");
}

#[test]
fn every_schema_is_printed_and_describes_its_keys() {
    for (kind, word) in DocumentKind::ALL {
        let printed = schema(word);
        assert_eq!(printed, kind.schema());
        let mut keys = 0;
        described(&printed, word, &mut keys);
        assert!(keys >= 2, "{word}: {keys} keys");
    }
}

/// Counts the keys of a schema, each of which must have a description.
fn described(schema: &Json, path: &str, keys: &mut usize) {
    for (key, value) in schema["properties"].as_object().into_iter().flatten() {
        *keys += 1;
        assert!(value["description"].as_str().is_some_and(|text| text.len() > 5), "{path}.{key}");
        described(value, &format!("{path}.{key}"), keys);
    }
    for inner in schema["anyOf"].as_array().into_iter().flatten().chain([&schema["items"]]) {
        if inner.is_object() {
            described(inner, path, keys);
        }
    }
}

/// A reader of the document learns about the work done, whenever the signal arrives.
#[test]
fn an_interrupted_solve_prints_its_document() {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().display().to_string();
    // Half a minute of search without a plan, so that no machine ends before the signal.
    let boxed = fs::read_to_string(format!("{ROOT}/tasks/boxed-in.yaml")).expect("a task");
    let long = boxed.replace("max_count: 2", "max_count: 12");
    assert_ne!(long, boxed);
    let file = folder.path().join("long.yaml");
    fs::write(&file, long).expect("a file");
    let file = file.display().to_string();
    let line = ["solve", &file, "--effort", "thorough", "--json", "--out", &out];
    let mut child = Command::new(PROGRAM)
        .args(line)
        .current_dir(ROOT)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("the command starts");
    // Long enough for the handlers, and far shorter than the solve.
    let begun = Instant::now();
    std::thread::sleep(Duration::from_millis(700));
    assert!(child.try_wait().expect("a child").is_none(), "solved in {:?}", begun.elapsed());
    let id = child.id().to_string();
    interrupt(&id);
    let output = child.wait_with_output().expect("the command ends");
    assert_eq!(output.status.code(), Some(130));
    let solution: Json = serde_json::from_slice(&output.stdout).expect("a document");
    satisfies("solution", &solution);
    assert_eq!(solution["stopped"], true);
}
