//! Task files in shards, as in array jobs.

use std::fs;

use pushplan::progress::NoProgress;
use pushplan_bench::store::FolderLock;
use tempfile::TempDir;

use crate::ROOT;
use crate::program::{run, stderr};
use crate::sharding::{of_runs, shards_make_the_same_bytes};

#[test]
fn of_task_files() {
    let tasks = "tasks/pull-back.yaml tasks/too-far.yaml tasks/diagonal.yaml";
    let home = shards_make_the_same_bytes(&format!("bench tasks {tasks} --effort draft"), 2);
    // One record of two is truncated.
    let part = home.path().join("part-1");
    let records = part.join("records.jsonl");
    let bytes = fs::read(&records).expect("records");
    fs::write(&records, &bytes[..bytes.len() - 5]).expect("records");
    let output = of_runs("status", &[part]);
    assert!(stderr(&output).starts_with("shard 1/2: 1 of 2 tasks in "), "{}", stderr(&output));
    // Empty shards are valid shards.
    shards_make_the_same_bytes("bench tasks tasks/too-far.yaml --effort draft", 2);
}

#[test]
fn two_commands_never_write_to_one_folder() {
    let folder = TempDir::new().expect("a folder");
    let lock = FolderLock::take(folder.path(), &NoProgress).expect("a free folder");
    let dir = folder.path().to_str().expect("UTF-8");
    let bench =
        || run(&["bench", "tasks", "tasks/too-far.yaml", "--effort", "draft", "--out", dir]);
    let output = bench();
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let writer = format!("(process {} on ", std::process::id());
    let wanted = format!("error: another pushplan is writing to {dir} {writer}");
    assert!(stderr(&output).starts_with(&wanted), "{}", stderr(&output));
    assert!(stderr(&output).contains("); wait for it, or"), "{}", stderr(&output));
    let files = || fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(files(), 1, "more than the lock is written");
    drop(lock);
    assert_eq!(files(), 0, "the lock is left behind");
    assert_eq!(bench().status.code(), Some(0));
}

#[cfg(unix)]
#[test]
fn the_slurm_script_does_them() {
    let tasks = format!("bench tasks {ROOT}/tasks/too-far.yaml --effort draft");
    crate::sharding::slurm_submits_what_is_missing(&tasks, "records.jsonl");
}
