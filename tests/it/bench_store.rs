//! Benchmark runs on disk: resumed, split and merged runs give identical bytes, and damaged files
//! are detected.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use pushplan::progress::{NoProgress, Progress};
use pushplan_bench::store::{Form, Measured, RunManifest, Seconds, Store, StoreError, line_index};
use serde_json::json;
use tempfile::TempDir;

/// Result with numbers that survive only if they are written in full.
type Record = (String, f64, Option<f64>);

const TASKS: usize = 11;

#[test]
fn a_run_that_was_interrupted_again_and_again_leaves_the_same_bytes() {
    let folder = TempDir::new().expect("a folder");
    let (whole, broken) = (folder.path().join("whole"), folder.path().join("broken"));
    let measured = measure(&whole, manifest(), &NoProgress).expect("a run");
    assert_eq!(measured.len(), TASKS);

    let mut all = Vec::new();
    for round in 0..3 {
        let progress = Stopping::after(4);
        match measure_counting(&broken, manifest(), &progress, &mut all) {
            Err(StoreError::Cancelled { done, total }) => {
                assert_eq!((done, total), (4 * (round + 1), TASKS));
            }
            result => assert!(round == 2 && result.is_ok(), "round {round}: {result:?}"),
        }
    }
    assert_eq!(all, (0..TASKS).collect::<Vec<_>>(), "a finished task was measured again");
    assert_eq!(compared(&broken), compared(&whole));
    let store = Store::<Record>::load(&broken).expect("a run");
    assert!(store.is_complete());
    assert_eq!(store.finished(), measured, "the saved measurement differs");
    assert!(store.finished().iter().all(|task| task.seconds["total"] == task.index as f64));
}

#[test]
fn merged_shards_are_the_same_bytes_as_one_run() {
    let folder = TempDir::new().expect("a folder");
    let whole = folder.path().join("whole");
    measure(&whole, manifest(), &NoProgress).expect("a run");
    let mut shards = shards(folder.path(), 3);
    shards.reverse();
    let merged = folder.path().join("merged");
    assert_eq!(merge_runs(&merged, &shards).expect("a merge"), manifest());
    assert_eq!(compared(&merged), compared(&whole));
    assert_eq!(read(&merged, "times.jsonl"), read(&whole, "times.jsonl"));
    // A merged run is complete and can be used like any other.
    assert_eq!(measure(&merged, manifest(), &Stopping::after(0)).expect("a run").len(), TASKS);
    let error = merge_runs(&merged, &shards).expect_err("a run is there");
    assert!(matches!(error, StoreError::Occupied { .. }), "{error}");
}

#[test]
fn one_shard_of_one_is_the_whole_run() {
    let one = manifest().with_shard("1/1".parse().expect("a shard"));
    assert_eq!(one, manifest());
}

#[test]
fn shards_that_do_not_make_one_run_are_not_merged() {
    let folder = TempDir::new().expect("a folder");
    let shards = shards(folder.path(), 3);
    let out = folder.path().join("merged");
    let refused = |list: &[&PathBuf]| {
        let list: Vec<PathBuf> = list.iter().map(|path| (*path).clone()).collect();
        let error = merge_runs(&out, &list).expect_err("no run");
        assert!(!out.exists(), "something was written: {error}");
        error
    };
    let [first, second, third] = [&shards[0], &shards[1], &shards[2]];

    assert!(matches!(refused(&[]), StoreError::NothingToMerge));
    match refused(&[third, first]) {
        StoreError::MissingShards { of: 3, missing } => assert_eq!(missing, [2]),
        error => panic!("{error}"),
    }
    match refused(&[first, second, third, second]) {
        StoreError::DuplicateShard { shard, .. } => assert_eq!(shard.to_string(), "2/3"),
        error => panic!("{error}"),
    }
    let absent = folder.path().join("absent");
    assert!(matches!(refused(&[first, &absent, third]), StoreError::Missing { .. }));

    let other = folder.path().join("other-seed");
    let mut seeded = manifest();
    seeded.seed = 8;
    measure(&other, seeded.with_shard("2/3".parse().expect("a shard")), &NoProgress)
        .expect("a shard");
    let error = refused(&[first, &other, third]).to_string();
    assert!(error.contains("seed is 8 in the folder, but 7 was requested"), "{error}");

    let halves = folder.path().join("halves");
    let half = manifest().with_shard("2/2".parse().expect("a shard"));
    measure(&halves, half, &NoProgress).expect("a shard");
    let error = refused(&[first, &halves]).to_string();
    assert!(error.contains("split into 2 shards, but the first folder into 3"), "{error}");

    // A shard with a truncated last record lacks one task.
    shorten(&second.join("records.jsonl"), 3);
    match refused(&[first, second, third]) {
        StoreError::Unfinished { path, done, total } => {
            assert_eq!((&path, done, total), (second, 3, 4));
        }
        error => panic!("{error}"),
    }
}

#[test]
fn a_torn_last_line_is_measured_again_however_much_of_it_is_there() {
    let folder = TempDir::new().expect("a folder");
    let whole = folder.path().join("whole");
    measure(&whole, manifest(), &NoProgress).expect("a run");
    let records = read(&whole, "records.jsonl");
    let last = records.trim_end().rfind('\n').expect("several lines") + 1;
    for kept in (last + 1..records.len()).step_by(7).chain([records.len() - 1]) {
        let torn = folder.path().join(format!("torn-{kept}"));
        fs::create_dir(&torn).expect("a folder");
        for name in ["manifest.json", "times.jsonl", "records.jsonl"] {
            fs::copy(whole.join(name), torn.join(name)).expect("a copy");
        }
        shorten(&torn.join("records.jsonl"), records.len() - kept);
        let loaded = Store::<Record>::load(&torn).expect("a run");
        assert_eq!(loaded.finished().len(), TASKS - 1, "{kept} bytes");

        let (progress, mut again) = (Stopping::after(usize::MAX), Vec::new());
        measure_counting(&torn, manifest(), &progress, &mut again).expect("a run");
        assert_eq!(again, [TASKS - 1]);
        assert_eq!(progress.notes.lock().expect("notes").len(), 1);
        assert_eq!(compared(&torn), compared(&whole), "{kept} bytes");
        assert_eq!(read(&torn, "times.jsonl"), read(&whole, "times.jsonl"), "{kept} bytes");
    }
    // Blocks that never reached the disk are read as zeros.
    let mut zeros = records.as_bytes()[..last].to_vec();
    zeros.extend([0; 20]);
    zeros.push(b'\n');
    fs::write(whole.join("records.jsonl"), zeros).expect("a file");
    measure(&whole, manifest(), &NoProgress).expect("a run");
    assert_eq!(read(&whole, "records.jsonl"), records);
}

#[test]
fn damage_before_the_last_line_is_named_and_never_mended_in_silence() {
    let folder = TempDir::new().expect("a folder");
    let run = folder.path().join("run");
    measure(&run, manifest(), &NoProgress).expect("a run");
    let records = read(&run, "records.jsonl");
    let swapped = records.replacen("\"index\":2", "\"index\":3", 1);
    let broken = records.replacen("\"index\":2", "\"index\":", 1);
    let doubled = format!("{records}{}", records.lines().last().expect("a line").to_owned() + "\n");
    for (text, line, words) in [
        (swapped, 3, "record 3 instead of record 2"),
        (broken, 3, "expected value"),
        (doubled, TASKS + 1, "record 10 instead of the end"),
    ] {
        fs::write(run.join("records.jsonl"), &text).expect("a file");
        let error = measure(&run, manifest(), &NoProgress).expect_err("damaged").to_string();
        let place = format!("records.jsonl:{line}: ");
        assert!(error.contains(&place) && error.contains(words), "{error}");
        assert_eq!(read(&run, "records.jsonl"), text, "a damaged file was changed");
    }
}

#[test]
fn another_run_in_the_folder_is_refused_with_what_differs() {
    let folder = TempDir::new().expect("a folder");
    measure_counting(folder.path(), manifest(), &Stopping::after(2), &mut Vec::new())
        .expect_err("stopped");
    let before = compared(folder.path());
    let mut other = manifest().with_weights(Some("00ff".into()));
    other.settings["effort"]["beam"] = 64.into();
    let error = measure(folder.path(), other, &NoProgress).expect_err("another run");
    match &error {
        StoreError::OtherRun { differences, .. } => assert_eq!(
            differences[..],
            [
                "settings.effort.beam is 24 in the folder, but 64 was requested",
                "weights is unset in the folder, but \"00ff\" was requested",
            ]
        ),
        error => panic!("{error}"),
    }
    assert_eq!(compared(folder.path()), before, "the run there was touched");

    fs::remove_file(folder.path().join("manifest.json")).expect("a file");
    let error = measure(folder.path(), manifest(), &NoProgress).expect_err("no manifest");
    assert!(matches!(error, StoreError::Stray { .. }), "{error}");
    assert!(matches!(Store::<Record>::load(folder.path()), Err(StoreError::Missing { .. })));
}

#[test]
fn two_processes_never_write_to_one_run() {
    let folder = TempDir::new().expect("a folder");
    let open = || Store::<Record>::open(folder.path(), manifest(), &NoProgress);
    let first = open().expect("a run");
    assert!(matches!(open(), Err(StoreError::Busy { .. })));
    drop(first);
    open().expect("the folder is free again");
}

#[test]
fn a_record_that_would_be_read_otherwise_is_refused() {
    let folder = TempDir::new().expect("a folder");
    let mut store = Store::open(folder.path(), manifest(), &NoProgress).expect("a run");
    let result = store.run(&NoProgress, |index| -> Result<Measured<Record>, StoreError> {
        let value = if index == 1 { f64::NAN } else { 0.5 };
        Ok(Measured { record: (String::new(), value, None), seconds: Seconds::new() })
    });
    assert!(matches!(result, Err(StoreError::Record { index: 1, .. })), "{result:?}");
    drop(store);
    assert_eq!(Store::<Record>::load(folder.path()).expect("a run").finished().len(), 1);
}

#[test]
fn a_run_in_memory_gives_the_same_records() {
    let folder = TempDir::new().expect("a folder");
    let kept = measure(folder.path(), manifest(), &NoProgress).expect("a run");
    let mut store = Store::in_memory(manifest());
    store.run(&NoProgress, task).expect("a run");
    assert_eq!(store.finished(), kept);
}

#[test]
fn tasks_side_by_side_leave_the_same_bytes_whatever_comes_first() {
    let folder = TempDir::new().expect("a folder");
    let whole = folder.path().join("whole");
    measure(&whole, manifest(), &NoProgress).expect("a run");
    for threads in [1, 2, 5] {
        let dir = folder.path().join(format!("with {threads}"));
        let begun = Mutex::new(Vec::new());
        let done = AtomicUsize::new(0);
        let mut interrupted = 0;
        loop {
            let progress = Stopping::after(4);
            // Every other task ends after its successor, if the successor has begun.
            let out_of_order = |index: usize| {
                begun.lock().expect("a list").push(index);
                let waits = threads > 1 && index.is_multiple_of(2) && index + 1 < TASKS;
                while waits && !progress.cancelled() && done.load(Ordering::SeqCst) <= index / 2 {
                    std::thread::yield_now();
                }
                done.fetch_add(index % 2, Ordering::SeqCst);
                progress.measured.fetch_add(1, Ordering::SeqCst);
                task(index).expect("a result")
            };
            let mut store = Store::open(&dir, manifest(), &NoProgress).expect("a store");
            match store.run_side_by_side(&progress, threads, out_of_order) {
                Ok(()) => break,
                Err(StoreError::Cancelled { done, total }) => {
                    assert_eq!((done, total), (store.finished().len(), TASKS));
                    interrupted += 1;
                }
                Err(error) => panic!("{error}"),
            }
        }
        assert!(interrupted > 0, "nothing was interrupted");
        assert_eq!(compared(&dir), compared(&whole), "{threads} threads");
        let mut begun = begun.into_inner().expect("a list");
        begun.sort_unstable();
        assert_eq!(begun, (0..TASKS).collect::<Vec<_>>(), "{threads} threads");
    }
}

fn manifest() -> RunManifest {
    RunManifest::new("test", TASKS, 7, "still").with_settings(json!({"effort": {"beam": 24}}))
}

fn merge_runs(out: &Path, shards: &[PathBuf]) -> Result<RunManifest, StoreError> {
    pushplan_bench::store::merge_runs(out, shards, Form::Lines, &mut line_index)
}

/// Returns a result that depends only on the index.
fn task(index: usize) -> Result<Measured<Record>, StoreError> {
    let value = index as f64;
    let record =
        (format!("task <{index}>\n"), (value + 0.1).sqrt(), (index % 2 == 1).then_some(value));
    Ok(Measured { record, seconds: Seconds::from([("total".to_owned(), value)]) })
}

type Tasks = Vec<pushplan_bench::store::Finished<Record>>;

fn measure(
    dir: &Path,
    manifest: RunManifest,
    progress: &dyn Progress,
) -> Result<Tasks, StoreError> {
    let mut store = Store::open(dir, manifest, progress)?;
    store.run(progress, task)?;
    Ok(store.finished().to_vec())
}

/// Runs until `progress` cancels, and adds the measured indices to `all`.
fn measure_counting(
    dir: &Path,
    manifest: RunManifest,
    progress: &Stopping,
    all: &mut Vec<usize>,
) -> Result<(), StoreError> {
    let mut store = Store::open(dir, manifest, progress)?;
    store.run(progress, |index| {
        progress.measured.fetch_add(1, Ordering::Relaxed);
        all.push(index);
        task(index)
    })
}

/// Creates folders with every shard of the run.
fn shards(folder: &Path, of: usize) -> Vec<PathBuf> {
    (1..=of)
        .map(|number| {
            let dir = folder.join(format!("shard-{number}"));
            let shard = format!("{number}/{of}").parse().expect("a shard");
            measure(&dir, manifest().with_shard(shard), &NoProgress).expect("a run");
            dir
        })
        .collect()
}

/// Returns the files that are identical for every way to the same run.
fn compared(dir: &Path) -> [String; 2] {
    ["manifest.json", "records.jsonl"].map(|name| read(dir, name))
}

fn read(dir: &Path, name: &str) -> String {
    fs::read_to_string(dir.join(name)).expect("a file of the run")
}

fn shorten(path: &Path, by: usize) {
    let bytes = fs::read(path).expect("a file");
    fs::write(path, &bytes[..bytes.len() - by]).expect("a file");
}

/// Observer that cancels after a number of tasks and collects notes.
struct Stopping {
    limit: usize,
    measured: AtomicUsize,
    notes: Mutex<Vec<String>>,
}

impl Stopping {
    fn after(limit: usize) -> Self {
        Self { limit, measured: AtomicUsize::new(0), notes: Mutex::default() }
    }
}

impl Progress for Stopping {
    fn note(&self, message: &str) {
        self.notes.lock().expect("notes").push(message.to_owned());
    }

    fn cancelled(&self) -> bool {
        self.measured.load(Ordering::Relaxed) >= self.limit
    }
}
