//! The benchmark of inferred joints, and recordings with what is told of their joints.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn pushplan(arguments: &[&str]) -> Output {
    let output = Command::new(env!("CARGO_BIN_EXE_pushplan")).arg("-q").args(arguments).output();
    output.expect("the command starts")
}

fn json(output: &Output) -> serde_json::Value {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn records(folder: &Path) -> String {
    fs::read_to_string(folder.join("records.jsonl")).expect("records")
}

const BENCH: [&str; 12] = [
    "bench",
    "joints",
    "--on",
    "dense",
    "--objects",
    "6",
    "--seen",
    "exact",
    "fine",
    "--count",
    "2",
    "--json",
];

#[test]
fn shards_on_any_number_of_threads_merge_to_the_bytes_of_one_run() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let run = |more: &[&str]| json(&pushplan(&[&BENCH[..], more].concat()));
    let whole = run(&["--threads", "1", "--out", &path("whole")]);
    for (name, shard) in [("one", "1/2"), ("two", "2/2")] {
        run(&["--threads", "3", "--out", &path(name), "--shard", shard]);
    }
    json(&pushplan(&["bench", "merge", &path("merged"), &path("one"), &path("two"), "--json"]));
    assert!(records(&folder.path().join("whole")) == records(&folder.path().join("merged")));

    let cases = whole["beliefs"].as_array().expect("cases");
    assert_eq!(cases.len(), 2);
    for case in cases {
        assert_eq!(case["trajectories"], 2);
        let steps = case["steps"].as_array().expect("steps");
        let end = steps.last().expect("an end");
        assert_eq!(end["when"], "end");
        assert!(end["pairs"].as_u64() > Some(5), "{end}");
        let rest = steps[0]["rest"].as_array().expect("the rest of the way");
        let error = |by: &str| {
            let of = rest.iter().find(|rest| rest["by"] == by).expect("a method");
            of["mean"].as_f64().expect("an error")
        };
        // Whoever knows the joints predicts better than who takes them all for none.
        assert!(error("true") < error("none"), "{rest:?}");
    }
}

#[test]
fn recordings_are_predicted_on_with_what_is_told_of_their_joints() {
    let folder = tempfile::tempdir().expect("a folder");
    let dir = folder.path().to_str().expect("UTF-8");
    let push = "start=0.44,0.06 direction_deg=0 length=0.15";
    let simulated = pushplan(&[
        "simulate",
        "tasks/jointed-pair.yaml",
        "--tool",
        "finger",
        "--push",
        push,
        "--out",
        dir,
    ]);
    assert!(simulated.status.success(), "{}", String::from_utf8_lossy(&simulated.stderr));
    let mut files =
        fs::read_dir(dir).expect("the folder").map(|entry| entry.expect("a file").path());
    let file = files.find(|path| path.to_string_lossy().ends_with(".trajectory.json"));
    let file = file.expect("a trajectory");
    let evaluate = |joints: &[&str]| {
        let fixed = ["evaluate", "prior", "--no-baselines", "--on", file.to_str().expect("UTF-8")];
        let exact = ["--noise", "0", "--heading-noise", "0", "--joints"];
        pushplan(&[&fixed[..], &exact, joints].concat())
    };
    let output = evaluate(&["given", "none", "believed", "one-step"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8_lossy(&output.stdout);
    for word in ["true joints", "none", "regulator", "last window", "contact + 0", "contact + 3"] {
        assert!(text.contains(word), "{word}: {text}");
    }
    assert_eq!(evaluate(&["guessed"]).status.code(), Some(2));
}
