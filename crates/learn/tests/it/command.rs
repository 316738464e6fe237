//! Command `pushplan-learn` from a user's point of view.

use std::fs;

use tempfile::TempDir;

#[cfg(unix)]
use crate::interrupted::goes_on_after_an_interruption;
use crate::pages;
use crate::program::{run, stderr, succeed};

/// Runs the transcripts in `tests/cmd`, which contain outputs and exit codes.
#[test]
fn transcripts() {
    trycmd::TestCases::new().case("tests/cmd/*.md").default_bin_name("pushplan-learn");
}

#[test]
fn the_commands_of_all_pages_are_taken() {
    pages::are_taken(11);
}

#[cfg(unix)]
#[test]
fn an_interrupted_training_saves_and_goes_on_to_the_same_bytes() {
    let run = "--without-mujoco --share 0.003 --steps 60 --evaluate-every 5 --width 8 --batch 32";
    goes_on_after_an_interruption("train predictor", run);
}

#[test]
fn a_test_set_follows_its_settings_and_states_them_in_its_manifest() {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    let crowd = "--objects 6 --joints mixed --solids cylinders --speed 0.21";
    succeed(&format!("generate {out} --episodes 3 --preset sparse-line {crowd}"));
    assert_eq!(fs::read_dir(out).expect("a folder").count(), 2);
    assert!(folder.path().join("records.bin").exists());
    let manifest = fs::read(folder.path().join("manifest.json")).expect("a manifest");
    let manifest: serde_json::Value = serde_json::from_slice(&manifest).expect("JSON");
    let settings = &manifest["settings"];
    assert_eq!(settings["preset"], "sparse_line");
    let wanted = r#"{"joints":"mixed","objects":6,"solids":"cylinders","speed":0.21}"#;
    assert_eq!(settings["constraints"].to_string(), wanted);
}

#[cfg(unix)]
#[test]
fn an_interrupted_generation_keeps_what_it_has_and_goes_on_to_the_same_bytes() {
    goes_on_after_an_interruption("generate", "--episodes 64");
}

#[test]
fn inconsistent_training_options_are_refused() {
    let wrong = [
        ("predictor runs/none --width 7", "--width must be even, not 7"),
        ("predictor runs/none --learning-rate 2", "--learning-rate must be above 0"),
        ("regulator runs/none --held-out-seed 1", "have the same seed"),
        ("lever runs/none --data a", "--held-out"),
        ("gears runs/none", "unrecognized subcommand"),
    ];
    for (arguments, part) in wrong {
        let output =
            run(&["train"].into_iter().chain(arguments.split_whitespace()).collect::<Vec<_>>());
        let message = stderr(&output);
        assert!(
            output.status.code() == Some(2) && message.contains(part),
            "{arguments}: {message}"
        );
    }
}
