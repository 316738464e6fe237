//! Data in shards, as array jobs make them: missing or wrong parts are reported.

use std::fs;
use std::path::PathBuf;

use pushplan::progress::NoProgress;
use pushplan_bench::store::FolderLock;
use pushplan_learn::dataset::Dataset;
use tempfile::TempDir;

use crate::program::{run, stderr};
use crate::sharding::{done, merge, of_runs, on, shards_make_the_same_bytes, status};

#[test]
fn of_training_data() {
    let home = shards_make_the_same_bytes("generate --preset tools --episodes 9 --seed 3", 4);
    // A shard alone is no data set.
    let error = Dataset::open(&home.path().join("part-2")).expect_err("a part");
    assert!(error.to_string().contains("is shard 2/4 of a data set"), "{error}");
    // Empty shards are valid.
    shards_make_the_same_bytes("generate --episodes 1", 2);
}

#[test]
fn missing_shards_are_listed_in_the_format_of_array_jobs() {
    let home = TempDir::new().expect("a folder");
    let command = "generate --episodes 18 --seed 5";
    let folder = |number: usize| home.path().join(format!("part-{number}"));
    let all: Vec<PathBuf> = (1..=9).map(folder).collect();
    for number in [1, 2, 4, 5, 6] {
        done(&on(command, &folder(number), Some((number, 9))));
    }
    assert_eq!(status(&all), "3,7-9\n");
    let output = merge(&home.path().join("merged"), &all[..6]);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    let there = [1, 2, 4, 5, 6].map(folder);
    let output = merge(&home.path().join("merged"), &there);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("needs all 9 shards; missing: 3,7-9"));
    assert!(!home.path().join("merged").exists());

    // One episode of two is truncated.
    let records = folder(4).join("records.bin");
    let bytes = fs::read(&records).expect("records");
    fs::write(&records, &bytes[..bytes.len() - 5]).expect("records");
    assert_eq!(status(&all), "3-4,7-9\n");
    let output = of_runs("status", &[folder(4)]);
    assert!(stderr(&output).starts_with("shard 4/9: 1 of 2 tasks in "), "{}", stderr(&output));
    for number in [3, 4, 7, 8, 9] {
        done(&on(command, &folder(number), Some((number, 9))));
    }
    assert_eq!(status(&all), "");
    done(&merge(&home.path().join("merged"), &all));
    assert_eq!(status(&[home.path().join("merged")]), "");

    assert_eq!(run(&["status", "tasks", "nowhere"]).status.code(), Some(3));
}

#[test]
fn wrong_shards_are_refused() {
    let home = TempDir::new().expect("a folder");
    let command = "generate --episodes 4";
    let folder = home.path().join("part");
    done(&on(command, &folder, Some((1, 2))));
    for (command, shard, words) in [
        (command, Some((2, 2)), "shard is 1/2 in the folder, but 2/2 was requested"),
        (command, None, "shard is 1/2 in the folder, but unset was requested"),
        (command, Some((3, 2)), "`3/2` is not a shard"),
        ("generate --episodes 5", Some((1, 2)), "tasks is 4 in the folder, but 5 was requested"),
    ] {
        let output = on(command, &folder, shard);
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
    // Shards of different data, and two equal shards.
    let other = home.path().join("other");
    done(&on("generate --episodes 4 --seed 9", &other, Some((2, 2))));
    for (folders, words) in [
        ([&folder, &other], "seed is 9 in the folder, but 1 was requested"),
        ([&folder, &folder], "are both shard 1/2"),
    ] {
        let output = merge(&home.path().join("merged"), &folders.map(Clone::clone));
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
}

#[test]
fn two_commands_never_write_to_one_folder() {
    let folder = TempDir::new().expect("a folder");
    let lock = FolderLock::take(folder.path(), &NoProgress).expect("a free folder");
    let dir = folder.path().to_str().expect("UTF-8");
    for command in [
        format!("generate {dir} --episodes 1"),
        format!("train predictor {dir} --without-mujoco --share 0.001 --steps 1"),
    ] {
        let output = run(&command.split(' ').collect::<Vec<_>>());
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
        assert!(stderr(&output).starts_with("error: another pushplan is writing to"));
    }
    drop(lock);
    done(&on("generate --episodes 1", folder.path(), None));
}

#[cfg(unix)]
#[test]
fn the_slurm_script_does_them() {
    crate::sharding::slurm_submits_what_is_missing("generate --episodes 5 --seed 4", "records.bin");
}
