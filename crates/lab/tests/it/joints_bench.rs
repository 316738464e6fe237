//! The benchmark of inferred joints, and recordings under different assumptions about their joints.

use pushplan::asset::{ToolLibrary, load_task};
use pushplan::geometry::Vector;
use pushplan::recording::Recording;
use pushplan::sim::Simulator;
use pushplan::{
    outcome::Record,
    task::{Job, Push, ToolMotion},
};

use crate::ROOT;
use crate::program::{run, stderr, succeed};
use crate::sharding::shards_make_the_same_bytes;

#[test]
fn shards_on_any_number_of_threads_merge_to_the_bytes_of_one_run() {
    let bench = "joints --on dense --objects 6 --seen exact fine --count 2 -q";
    let home = shards_make_the_same_bytes(bench, 2);
    let report = succeed(&format!("report {} --json", home.path().join("merged").display()));
    let whole: serde_json::Value = serde_json::from_slice(&report.stdout).expect("JSON");
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
        // Predictions with true joints are better than predictions without joints.
        assert!(error("true") < error("none"), "{rest:?}");
    }
}

#[test]
fn recordings_are_predicted_further_with_the_stated_joints() {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let scene =
        load_task(format!("{ROOT}/tasks/jointed-pair.yaml"), &library).expect("a task").scene;
    let push = Push { start: Vector::new(0.44, 0.06), direction: 0.0, length: 0.15, speed: 0.1 };
    let finger = library.get("finger").expect("a shipped tool").clone();
    let motion = ToolMotion::pushes(finger, 0.002, 0.0, &[push], true);
    let job = Job::stated(&scene, motion.clone());
    let frames = Simulator::planar().run(&scene, &job, Record::Frames).frames;
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("pair.recording.json");
    Recording::of_frames("pair", &scene, &motion, &frames).write(&file).expect("a file");
    let predict = |joints: &str| {
        let exact = "--noise 0 --heading-noise 0 --joints";
        let line = format!("rest-of-way {} --model prior {exact} {joints}", file.display());
        run(&line.split(' ').collect::<Vec<_>>())
    };
    let output = predict("given none believed one-step");
    assert!(output.status.success(), "{}", stderr(&output));
    let text = String::from_utf8_lossy(&output.stdout);
    for word in ["true joints", "none", "regulator", "last window", "contact + 0", "contact + 3"] {
        assert!(text.contains(word), "{word}: {text}");
    }
    assert_eq!(predict("guessed").status.code(), Some(2));
}
