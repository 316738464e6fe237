//! Data and every benchmark in shards, as array jobs run them: merged they are the same bytes as
//! one run, and what is missing or wrong is named.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use pushplan::dataset::Dataset;
use pushplan::store::FolderLock;
use pushplan::watch::Unwatched;
use tempfile::TempDir;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Runs a command whole on two threads and in shards on one, and compares.
fn shards_make_the_same_bytes(command: &str, shards: usize) -> TempDir {
    let home = TempDir::new().expect("a folder");
    let whole = home.path().join("whole");
    done(&on(command, &whole, None));
    let folders: Vec<PathBuf> =
        (1..=shards).map(|number| home.path().join(format!("part-{number}"))).collect();
    for (k, folder) in folders.iter().enumerate() {
        done(&on(&format!("{command} --threads 1"), folder, Some((k + 1, shards))));
    }
    let merged = home.path().join("merged");
    done(&merge(&merged, &folders));
    for name in ["manifest.json", "records.jsonl", "records.bin"] {
        let [one, parts] = [&whole, &merged].map(|folder| fs::read(folder.join(name)).ok());
        assert!(one == parts, "{command}: {name} differs");
    }
    // The same command finds nothing left to do.
    let before = fs::read(merged.join("manifest.json")).expect("a manifest");
    done(&on(command, &merged, None));
    assert_eq!(fs::read(merged.join("manifest.json")).expect("a manifest"), before);
    home
}

#[test]
fn of_training_data() {
    let home = shards_make_the_same_bytes("generate --preset mixed --episodes 9 --seed 3", 4);
    // A part is no data set.
    let error = Dataset::open(&home.path().join("part-2")).expect_err("a part");
    assert!(error.to_string().contains("is shard 2/4 of a data set"), "{error}");
}

#[test]
fn of_random_tasks() {
    shards_make_the_same_bytes("bench random --count 3 --effort draft", 2);
}

#[test]
fn of_task_files() {
    let tasks = "tasks/pull-back.yaml tasks/too-far.yaml tasks/diagonal.yaml";
    shards_make_the_same_bytes(&format!("bench tasks {tasks} --effort draft"), 2);
}

#[test]
fn of_closed_loops() {
    shards_make_the_same_bytes("bench run --kind pull --count 2 --effort draft --pushes 4", 2);
}

#[test]
fn of_refinement() {
    shards_make_the_same_bytes("bench refinement --tasks 3 --effort draft", 2);
}

#[test]
fn of_inferred_joints() {
    let few = "--count 2 --on dense --seen exact --types-only --regulator none";
    shards_make_the_same_bytes(&format!("bench joints {few}"), 2);
}

#[test]
fn of_masses() {
    shards_make_the_same_bytes(
        "bench masses --count 2 --touching 2 --crowds 4 --controlled rows --seen fine",
        2,
    );
}

#[test]
fn of_probes() {
    let few = "--count 1 --objects 4 --rule information random";
    shards_make_the_same_bytes(&format!("bench probes {few}"), 2);
}

#[test]
fn of_evaluations() {
    let on = "--on single sparse-line --objects 6 --joints mixed --no-baselines";
    let home = shards_make_the_same_bytes(&format!("evaluate prior {on} --pushes 6 --count 1"), 2);
    let [one, parts] = ["whole", "merged"]
        .map(|name| fs::read(home.path().join(name).join("evaluation.json")).expect("a file"));
    assert!(one == parts, "evaluation.json differs");
}

/// More shards than units of work.
#[test]
fn of_the_trade_off() {
    let few = "--quick --pushes 2 --tasks 1 --rounds 1 --plans none";
    shards_make_the_same_bytes(&format!("tradeoff {few}"), 3);
}

#[test]
fn empty_shards_are_shards_too() {
    shards_make_the_same_bytes("generate --episodes 1", 2);
    shards_make_the_same_bytes("bench tasks tasks/too-far.yaml --effort draft", 2);
}

#[test]
fn what_is_missing_is_named_as_array_jobs_take_it() {
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
    assert!(stderr(&output).contains("all 9 shards are needed; missing: 3,7-9"));
    assert!(!home.path().join("merged").exists());

    // One episode of two is torn.
    let records = folder(4).join("records.bin");
    let bytes = fs::read(&records).expect("records");
    fs::write(&records, &bytes[..bytes.len() - 5]).expect("records");
    assert_eq!(status(&all), "3-4,7-9\n");
    let arguments = ["bench", "status", folder(4).to_str().expect("UTF-8")].map(str::to_owned);
    let output = pushplan(&arguments.each_ref().map(String::as_str));
    assert!(stderr(&output).starts_with("shard 4/9: 1 of 2 tasks in "), "{}", stderr(&output));
    for number in [3, 4, 7, 8, 9] {
        done(&on(command, &folder(number), Some((number, 9))));
    }
    assert_eq!(status(&all), "");
    done(&merge(&home.path().join("merged"), &all));
    assert_eq!(status(&[home.path().join("merged")]), "");

    let output = pushplan(&["bench", "status", "tasks", "nowhere"]);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    assert!(stderr(&output).contains("none of these folders holds a run: tasks, nowhere"));
}

#[test]
fn wrong_shards_are_refused() {
    let home = TempDir::new().expect("a folder");
    let command = "generate --episodes 4";
    let folder = home.path().join("part");
    done(&on(command, &folder, Some((1, 2))));
    for (command, shard, words) in [
        (command, Some((2, 2)), "shard is 1/2 there, 2/2 was asked for"),
        (command, None, "shard is 1/2 there, nothing was asked for"),
        (command, Some((3, 2)), "`3/2` is none"),
        ("generate --episodes 5", Some((1, 2)), "tasks is 4 there, 5 was asked for"),
        ("bench cost tasks/pull-back.yaml", Some((1, 2)), "unexpected argument '--shard'"),
        ("evaluate --on tests/it/assets/push.recording.json", Some((1, 2)), "in one go"),
    ] {
        let output = on(command, &folder, shard);
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
    // Parts of different data, and the same part twice.
    let other = home.path().join("other");
    done(&on("generate --episodes 4 --seed 9", &other, Some((2, 2))));
    for (folders, words) in [
        ([&folder, &other], "seed is 9 there, 1 was asked for"),
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
    let lock = FolderLock::take(folder.path(), &Unwatched).expect("a free folder");
    let dir = folder.path().to_str().expect("UTF-8");
    for command in [
        &["generate", dir, "--episodes", "1"][..],
        &["bench", "tasks", "tasks/pull-back.yaml", "--out", dir],
    ] {
        let output = pushplan(command);
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
        let writer = format!("(process {} on ", std::process::id());
        let wanted = format!("error: another pushplan is writing to {dir} {writer}");
        assert!(stderr(&output).starts_with(&wanted), "{}", stderr(&output));
        assert!(stderr(&output).contains("); wait for it, or"), "{}", stderr(&output));
    }
    let files = || fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(files(), 1, "more than the lock is written");
    drop(lock);
    assert_eq!(files(), 0, "the lock is left behind");
    let output = pushplan(&["generate", dir, "--episodes", "1"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
}

/// What stands for Slurm: elements run at once, one after another. `cluster/test-slurm` has a real one.
#[cfg(unix)]
const SBATCH: &str = r#"#!/bin/sh
array=
while :; do
  case $1 in --array=*) array=${1#*=} ;; --*) ;; *) break ;; esac
  shift
done
echo 7
if [ -z "$array" ]; then "$@" >/dev/null; exit; fi
for range in $(echo "$array" | tr , ' '); do
  for number in $(seq "${range%-*}" "${range#*-}"); do
    SLURM_ARRAY_TASK_ID=$number "$@" >/dev/null || exit
  done
done
"#;

#[cfg(unix)]
#[test]
fn the_slurm_script_submits_what_is_missing_and_a_merge() {
    use std::os::unix::fs::PermissionsExt;

    let home = TempDir::new().expect("a folder");
    let sbatch = home.path().join("sbatch");
    fs::write(&sbatch, SBATCH).expect("a script");
    fs::set_permissions(&sbatch, fs::Permissions::from_mode(0o755)).expect("a script");
    let path = format!("{}:{}", home.path().display(), std::env::var("PATH").unwrap_or_default());
    let script = Path::new(ROOT).join("cluster/slurm.sh");
    let submit = |command: &str| {
        let output = Command::new(&script)
            .args(command.split(' '))
            .env("PATH", &path)
            .env("PUSHPLAN", env!("CARGO_BIN_EXE_pushplan"))
            .current_dir(home.path())
            .output()
            .expect("a shell");
        (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let data = "generate --episodes 5 --seed 4";
    let (code, told) = submit(&format!("3 data {data}"));
    assert_eq!((code, &*told), (Some(0), "array 7: shards 1-3\njob 7: merge into data\n"));
    let (whole, merged) = (home.path().join("whole"), home.path().join("data"));
    done(&on(data, &whole, None));
    let records = |folder: &Path| fs::read(folder.join("records.bin")).expect("records");
    assert!(records(&whole) == records(&merged));
    assert_eq!(submit(&format!("3 data {data}")).0, Some(2), "a run is there already");

    fs::remove_dir_all(&merged).expect("a run");
    fs::remove_dir_all(home.path().join("data.shards/2")).expect("a shard");
    assert!(submit(&format!("3 data {data}")).1.starts_with("array 7: shards 2\n"));
    fs::remove_dir_all(&merged).expect("a run");
    assert_eq!(submit(&format!("3 data {data}")).1, "job 7: merge into data\n");
    assert!(records(&whole) == records(&merged));

    let tasks = "bench tasks tasks/too-far.yaml --effort draft";
    let tasks = tasks.replace("tasks/", &format!("{ROOT}/tasks/"));
    assert_eq!(submit(&format!("2 runs/tasks {tasks}")).0, Some(0));
    assert!(home.path().join("runs/tasks/report.html").exists());
    assert_eq!(submit("2 nothing").0, Some(2));
}

/// The containers of the Kubernetes manifest run what it says with the indices that an Indexed Job
/// gives them: a loop stands for the cluster.
#[cfg(unix)]
#[test]
fn the_kubernetes_jobs_end_like_one_run() {
    use serde::Deserialize;
    use serde_yaml::Value;

    let home = TempDir::new().expect("a folder");
    let runs = home.path().to_str().expect("UTF-8");
    let text = fs::read_to_string(Path::new(ROOT).join("cluster/kubernetes.yaml")).expect("jobs");
    let jobs: Vec<Value> = serde_yaml::Deserializer::from_str(&text)
        .map(|job| Value::deserialize(job).expect("YAML"))
        .collect();
    let [shards, merge] = &jobs[..] else { panic!("{} jobs", jobs.len()) };
    let container = |job: &Value| job["spec"]["template"]["spec"]["containers"][0].clone();
    let script = |job: &Value| {
        let container = container(job);
        assert_eq!(container["command"][0], "sh");
        let script = container["args"][0].as_str().expect("a script").to_owned();
        script.replace("/runs/", &format!("{runs}/")).replace("--count 1000", SMALL)
    };
    /// What is measured here.
    const SMALL: &str = "--count 4 --effort draft";

    let count = shards["spec"]["completions"].as_u64().expect("a number");
    assert_eq!(container(shards)["env"][0]["value"], count.to_string().as_str());
    for index in 0..count {
        sh(&script(shards), &[("JOB_COMPLETION_INDEX", index.to_string())], count);
    }
    sh(&script(merge), &[], count);
    let whole = home.path().join("whole");
    done(&on(&format!("bench random {SMALL}"), &whole, None));
    for name in ["manifest.json", "records.jsonl"] {
        let [one, parts] = [whole.clone(), home.path().join("random")]
            .map(|folder| fs::read(folder.join(name)).expect("a file of the run"));
        assert!(one == parts, "{name} differs");
    }
}

/// Runs a script with the program on the path.
#[cfg(unix)]
fn sh(script: &str, variables: &[(&str, String)], shards: u64) {
    let program = Path::new(env!("CARGO_BIN_EXE_pushplan")).parent().expect("a folder");
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap_or_default());
    let output = Command::new("sh")
        .args(["-c", script])
        .env("PATH", path)
        .env("SHARDS", shards.to_string())
        .envs(variables.iter().map(|(name, value)| (name, value)))
        .current_dir(ROOT)
        .output()
        .expect("a shell");
    done(&output);
}

/// Runs a command with its results in `folder`.
fn on(command: &str, folder: &Path, shard: Option<(usize, usize)>) -> Output {
    let mut arguments: Vec<String> = command.split(' ').map(str::to_owned).collect();
    if arguments[0] != "generate" {
        arguments.push("--out".to_owned());
    }
    arguments.push(folder.to_str().expect("UTF-8").to_owned());
    if let Some((number, of)) = shard {
        arguments.extend(["--shard".to_owned(), format!("{number}/{of}")]);
    }
    pushplan(&arguments.iter().map(String::as_str).collect::<Vec<_>>())
}

fn merge(out: &Path, shards: &[PathBuf]) -> Output {
    let folders = std::iter::once(out).chain(shards.iter().map(PathBuf::as_path));
    let folders = folders.map(|folder| folder.to_str().expect("UTF-8"));
    pushplan(&["bench", "merge"].into_iter().chain(folders).collect::<Vec<_>>())
}

/// What `bench status` prints.
fn status(folders: &[PathBuf]) -> String {
    let folders = folders.iter().map(|folder| folder.to_str().expect("UTF-8"));
    let output = pushplan(&["bench", "status"].into_iter().chain(folders).collect::<Vec<_>>());
    done(&output);
    String::from_utf8(output.stdout).expect("UTF-8")
}

fn pushplan(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pushplan"))
        .args(arguments)
        .current_dir(ROOT)
        .output()
        .expect("the command runs")
}

fn done(output: &Output) {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(output));
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}
