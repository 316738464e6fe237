//! Prediction errors of models on recordings, from the command line.

use std::fs;
use std::path::Path;

use serde_json::Value as Json;
use tempfile::TempDir;

use crate::ROOT;
use crate::program::{self, stderr};

const PUSH: &str = "tests/it/assets/push.recording.json";

#[test]
fn files_and_folders_are_judged_by_themselves_and_together() {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().join("out");
    let run = |arguments: &[&str]| {
        let out = ["--out", out.to_str().expect("UTF-8")];
        program::run(&[&["predict"], arguments, &out].concat())
    };
    let recorded = run(&["--model", "prior", PUSH, PUSH]);
    assert_eq!(recorded.status.code(), Some(0), "{}", stderr(&recorded));
    let text = String::from_utf8(recorded.stdout).expect("UTF-8");
    assert!(text.contains("push: 1 trajectories") && text.contains("2 recordings: 2 trajectories"));
    assert!(text.lines().any(|line| line.starts_with("planar  ")), "{text}");

    let set = folder.path().join("set");
    fs::create_dir_all(set.join("more")).expect("folders");
    for file in ["b.recording.json", "a.recording.json", "more/c.recording.json"] {
        fs::copy(Path::new(ROOT).join(PUSH), set.join(file)).expect("a file");
    }
    fs::write(set.join("README.md"), "Not a recording.").expect("a file");
    assert!(out.join("errors.json").exists());
    let poses = folder.path().join("poses.csv");
    let [set_name, poses_name] = [&set, &poses].map(|path| path.to_str().expect("UTF-8"));
    let measured = run(&["--model", "prior", set_name, "--export", poses_name, "--json"]);
    assert_eq!(measured.status.code(), Some(0), "{}", stderr(&measured));
    let json: Json = serde_json::from_slice(&measured.stdout).expect("JSON alone");
    let counts: Vec<u64> =
        (0..3).filter_map(|k| json["recordings"][k]["trajectories"].as_u64()).collect();
    assert_eq!(counts, [2, 1, 3], "each folder, then all");
    assert_eq!(json["recordings"][0]["models"][0]["each"].as_array().map(Vec::len), Some(2));
    let own = json["recordings"][2]["own_spread"].as_f64().expect("a length");
    assert!((0.0..1e-3).contains(&own), "{own}: starts are off by 0.1 mm");
    let csv = String::from_utf8(fs::read(&poses).expect("a file")).expect("UTF-8");
    assert!(csv.starts_with("name,by,object,time,x,y,heading\na,recorded,can,"));
    assert!(csv.contains("\nb,prior,can,") && csv.contains("\nc,planar,can,"));
    fs::write(set.join("c.yaml"), "kind: recording\n").expect("a file");
    let refused = run(&["--model", "prior", set_name]);
    assert_eq!(refused.status.code(), Some(3));
    assert!(stderr(&refused).contains("c.yaml:1:1: error:"), "{}", stderr(&refused));

    let bad = folder.path().join("bad.recording.json");
    let spoiled =
        fs::read_to_string(Path::new(ROOT).join(PUSH)).expect("a file").replace("0.05", "5.0");
    fs::write(&bad, spoiled).expect("a file");
    let refused = run(&[bad.to_str().expect("UTF-8")]);
    assert_eq!(refused.status.code(), Some(3));
    assert!(stderr(&refused).contains("is this in centimetres?"), "{}", stderr(&refused));
}

#[test]
fn many_files_with_one_doubt_get_one_warning() {
    let folder = TempDir::new().expect("a folder");
    let text = include_str!("assets/push.recording.json");
    let heavy = text.replace("\"name\": \"can\",", "\"name\": \"can\", \"mass\": 80.0,");
    assert_ne!(heavy, text);
    let mut arguments = vec!["predict".to_owned(), "--alone".into()];
    for (k, text) in [text, &heavy, &heavy, &heavy].into_iter().enumerate() {
        let path = folder.path().join(format!("push-{k}.recording.json"));
        fs::write(&path, text).expect("a recording");
        arguments.push(path.to_str().expect("UTF-8").to_owned());
    }
    let output = program::run(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let warnings = stderr(&output);
    let of_mass: Vec<&str> = warnings.lines().filter(|line| line.contains("mass")).collect();
    assert_eq!(of_mass.len(), 1, "{warnings}");
    assert!(of_mass[0].starts_with("warning: push-1: "), "{warnings}");
    assert!(of_mass[0].ends_with("(and similar in 2 more of 4 recordings)"), "{warnings}");
}
