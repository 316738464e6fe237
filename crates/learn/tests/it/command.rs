//! `pushplan-learn train` as a user sees it.

use std::process::Command;

#[cfg(unix)]
use crate::interrupted::goes_on_after_an_interruption;
use crate::pages;
use pushplan::watch::Unwatched;

#[cfg(unix)]
#[test]
fn an_interrupted_training_saves_and_goes_on_to_the_same_bytes() {
    let run = "--episodes 40 --held-out 6 --steps 60 --evaluate-every 5 --width 8 --batch 32";
    goes_on_after_an_interruption("train", run);
}

#[test]
fn the_commands_of_all_pages_are_taken() {
    let commands = pages::commands();
    let commands: Vec<&String> = commands.iter().filter(|command| pages::trains(command)).collect();
    for command in &commands {
        let help = Command::new(env!("CARGO_BIN_EXE_pushplan"))
            .args(command.split_whitespace())
            .arg("--help")
            .output()
            .expect("the command runs");
        assert!(help.status.success(), "{command}: {}", String::from_utf8_lossy(&help.stderr));
    }
    assert!(commands.len() > 4, "{commands:?}");
}

#[test]
fn a_training_never_writes_to_a_folder_that_another_command_writes_to() {
    let folder = tempfile::tempdir().expect("a folder");
    let _lock =
        pushplan::store::FolderLock::take(folder.path(), &Unwatched).expect("a free folder");
    let output = Command::new(env!("CARGO_BIN_EXE_pushplan"))
        .arg("train")
        .arg(folder.path())
        .args(["--episodes", "1", "--held-out", "1", "--steps", "1"])
        .output()
        .expect("the command runs");
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.starts_with("error: another pushplan is writing to"), "{said}");
}

#[test]
fn what_does_not_fit_together_in_training_of_lever_ups_is_refused() {
    let wrong = [
        ("--held-out b --feedback", "--no-prior"),
        ("--held-out b --random-split", "cannot be used with"),
        ("--held-out b --features picture", "image-code"),
        ("--no-prior", "--held-out"),
        ("--held-out b --model parts --features corners", "parts know no features"),
        ("--held-out b --model parts --width 7", "odd widths"),
        ("--held-out b --model gears", "parts"),
    ];
    for (arguments, part) in wrong {
        let output = Command::new(env!("CARGO_BIN_EXE_pushplan"))
            .args(["train-lever", "runs/none", "--data", "a"])
            .args(arguments.split_whitespace())
            .output()
            .expect("the command runs");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(2) && said.contains(part), "{arguments}: {said}");
    }
}
