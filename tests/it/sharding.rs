//! Commands in shards, as in array jobs: merged shards give the same bytes as one run.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

use crate::program::{name, run, stderr};
use crate::{PROGRAM, ROOT};

/// Runs a command unsharded on two threads and in shards on one thread, and compares the results.
pub fn shards_make_the_same_bytes(command: &str, shards: usize) -> TempDir {
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
    // Repeated, the command finds nothing left to do.
    let before = fs::read(merged.join("manifest.json")).expect("a manifest");
    done(&on(command, &merged, None));
    assert_eq!(fs::read(merged.join("manifest.json")).expect("a manifest"), before);
    home
}

/// Runs a command with its results in `folder`.
pub fn on(command: &str, folder: &Path, shard: Option<(usize, usize)>) -> Output {
    let mut arguments: Vec<&str> = command.split(' ').collect();
    if arguments[0] != "generate" {
        arguments.push("--out");
    }
    arguments.push(folder.to_str().expect("UTF-8"));
    let shard = shard.map(|(number, of)| format!("{number}/{of}"));
    arguments.extend(shard.iter().flat_map(|shard| ["--shard", shard]));
    run(&arguments)
}

pub fn merge(out: &Path, shards: &[PathBuf]) -> Output {
    of_runs("merge", &[&[out.to_owned()], shards].concat())
}

/// Returns the output of `status`.
pub fn status(folders: &[PathBuf]) -> String {
    let output = of_runs("status", folders);
    done(&output);
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// Runs `merge` or `status`, which the product has below `bench`.
pub fn of_runs(word: &str, folders: &[PathBuf]) -> Output {
    let words = if name() == "pushplan" { &["bench", word][..] } else { &[word] };
    let folders = folders.iter().map(|folder| folder.to_str().expect("UTF-8"));
    run(&words.iter().copied().chain(folders).collect::<Vec<_>>())
}

pub fn done(output: &Output) {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(output));
}

/// Substitute for Slurm that runs elements at once, one after another; `cluster/test-slurm` uses a
/// real one.
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

/// Runs a command in three shards with `cluster/slurm.sh`, with some shards lost in between; its
/// records are in the file `records`.
#[cfg(unix)]
pub fn slurm_submits_what_is_missing(command: &str, records: &str) {
    use std::os::unix::fs::PermissionsExt;

    let home = TempDir::new().expect("a folder");
    let sbatch = home.path().join("sbatch");
    fs::write(&sbatch, SBATCH).expect("a script");
    fs::set_permissions(&sbatch, fs::Permissions::from_mode(0o755)).expect("a script");
    let submit = |words: &str| {
        let output = Command::new(Path::new(ROOT).join("cluster/slurm.sh"))
            .args(words.split(' '))
            .env("PATH", path(home.path()))
            .current_dir(home.path())
            .output()
            .expect("a shell");
        (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let asked = format!("3 runs/all {} {command}", name());
    let (code, text) = submit(&asked);
    assert_eq!((code, &*text), (Some(0), "array 7: shards 1-3\njob 7: merge into runs/all\n"));
    let (whole, merged) = (home.path().join("whole"), home.path().join("runs/all"));
    done(&on(command, &whole, None));
    let same = || {
        let [one, parts] = [&whole, &merged].map(|folder| fs::read(folder.join(records)));
        assert!(one.expect("records") == parts.expect("records"));
    };
    same();
    assert_eq!(submit(&asked).0, Some(2), "a run is there already");

    fs::remove_dir_all(&merged).expect("a run");
    fs::remove_dir_all(home.path().join("runs/all.shards/2")).expect("a shard");
    assert!(submit(&asked).1.starts_with("array 7: shards 2\n"));
    fs::remove_dir_all(&merged).expect("a run");
    assert_eq!(submit(&asked).1, "job 7: merge into runs/all\n");
    same();
    for wrong in [format!("2 nothing {}", name()), format!("2 nothing {command}")] {
        assert_eq!(submit(&wrong).0, Some(2), "{wrong}");
    }
}

/// Returns the search path for programs: `first`, and the folder of the program under test.
#[cfg(unix)]
pub fn path(first: &Path) -> String {
    let own = Path::new(PROGRAM).parent().expect("a folder");
    let others = std::env::var("PATH").unwrap_or_default();
    format!("{}:{}:{others}", first.display(), own.display())
}
