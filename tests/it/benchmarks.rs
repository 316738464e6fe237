//! Benchmarks from the command line: stored, interrupted, split, merged and shown.

use std::fs;
use std::path::Path;
use std::process::Output;

use serde_json::Value as Json;
use tempfile::TempDir;

use crate::program::{run, stderr};

const TASKS: [&str; 4] = [
    "tasks/pull-back.yaml",
    "tasks/sideways-sweep.yaml",
    "tasks/too-far.yaml",
    "tasks/push-out-of-reach.yaml",
];

const BENCH: [&str; 6] = ["bench", "tasks", "--model", "planar", "--effort", "draft"];

#[test]
fn shards_of_a_benchmark_merge_to_the_bytes_of_one_run() {
    let folder = TempDir::new().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let (whole, first, second, merged) =
        (path("whole"), path("first"), path("second"), path("merged"));
    let printed = tasks(&["--out", &whole, "--json", "--threads", "1"]);
    tasks(&["--out", &second, "--shard", "2/2"]);
    let output = run(&["bench", "merge", &merged, &second]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("missing: 1"), "{}", stderr(&output));
    tasks(&["--out", &first, "--shard", "1/2"]);
    let output = run(&["bench", "merge", &merged, &second, &first, "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(compared(Path::new(&merged)), compared(Path::new(&whole)));
    assert_eq!(without_times(Path::new(&merged)), without_times(Path::new(&whole)));

    let timeless = |text: &[u8]| {
        let mut json: Json = serde_json::from_slice(text).expect("JSON alone");
        for task in json["tasks"].as_array_mut().expect("tasks") {
            assert!(task["seconds"]["total"].as_f64() > Some(0.0), "{task}");
            task["seconds"] = Json::Null;
        }
        json
    };
    let json = timeless(&printed);
    assert_eq!(json, timeless(&output.stdout));
    assert_eq!(json["schema_version"], 2);
    let status: Vec<&str> =
        (0..TASKS.len()).filter_map(|k| json["tasks"][k]["status"].as_str()).collect();
    assert_eq!(status, ["solved", "solved", "no_plan", "solved"]);

    let page = fs::read_to_string(Path::new(&merged).join("report.html")).expect("a page");
    assert!(page.contains("pull-back") && page.contains("</svg>"), "{page}");
    let rows = fs::read_to_string(Path::new(&merged).join("tasks.csv")).expect("rows");
    assert_eq!(rows.lines().count(), TASKS.len() + 1, "{rows}");

    let output = run(&["bench", "report", &merged]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("3 of 4 tasks solved with planar"), "{text}{}", stderr(&output));
}

#[test]
fn a_folder_with_another_run_is_refused() {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    tasks(&["--out", out]);
    let before = compared(folder.path());
    let output = bench_tasks(&["--out", out, "--seed", "3"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(
        stderr(&output).contains("seed is 0 in the folder, but 3 was requested"),
        "{}",
        stderr(&output)
    );
    assert_eq!(compared(folder.path()), before);

    let output = bench_tasks(&["--shard", "1/2"]);
    assert_eq!(output.status.code(), Some(2), "a shard that is kept nowhere");
    let empty = TempDir::new().expect("a folder");
    let output = run(&["bench", "report", empty.path().to_str().expect("UTF-8")]);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
}

#[cfg(unix)]
#[test]
fn an_interrupted_benchmark_keeps_its_tasks_and_goes_on_to_the_same_bytes() {
    let folder = TempDir::new().expect("a folder");
    let (whole, broken) = (folder.path().join("whole"), folder.path().join("broken"));
    tasks(&["--out", whole.to_str().expect("UTF-8")]);
    let out = broken.to_str().expect("UTF-8");
    let kept = || fs::read_to_string(broken.join("records.jsonl")).unwrap_or_default();
    let line = [&BENCH[..], &TASKS, &["--out", out]].concat().join(" ");
    let output = crate::interrupted::interrupted(&line, || !kept().is_empty());
    let goes_on = stderr(&output).contains("rerun the same command to resume");
    assert!(goes_on || output.status.success(), "{}", stderr(&output));
    let before = kept();
    assert!(!before.is_empty());
    tasks(&["--out", out]);
    assert!(kept().starts_with(&before), "finished work was lost");
    assert_eq!(compared(&broken), compared(&whole));
}

#[test]
fn tasks_that_ask_for_no_place_are_kept() {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    let task = "tasks/open-door.yaml";
    let output = run(&[&BENCH[..], &[task, "--out", out]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let kept = fs::read_to_string(folder.path().join("records.jsonl")).expect("a record");
    assert!(kept.contains("\"tolerance\":null"), "{kept}");
}

/// Returns the files that are identical for every way to the same run.
fn compared(dir: &Path) -> [String; 2] {
    ["manifest.json", "records.jsonl"]
        .map(|name| fs::read_to_string(dir.join(name)).expect("a file of the run"))
}

/// Returns the files that differ between runs, with their times blanked: the numbers of
/// `times.jsonl`, the columns of `tasks.csv` that end with `_s`, and these and the column `time`
/// in the tables of `report.html`.
fn without_times(dir: &Path) -> [String; 3] {
    let text = |name: &str| fs::read_to_string(dir.join(name)).expect("a file of the run");
    let times = text("times.jsonl");
    let times = times.lines().map(|line| {
        let mut line: Json = serde_json::from_str(line).expect("JSON");
        let seconds = line["seconds"].as_object_mut().expect("times");
        assert_eq!(seconds.len(), 4, "{seconds:?}");
        seconds.values_mut().for_each(|time| *time = Json::Null);
        format!("{line}\n")
    });
    let rows = text("tasks.csv");
    let header: Vec<&str> = rows.lines().next().expect("a header").split(',').collect();
    let timed: Vec<bool> = header.iter().map(|name| name.ends_with("_s")).collect();
    assert_eq!(timed.iter().filter(|timed| **timed).count(), 4, "{header:?}");
    let rows = rows.lines().skip(1).map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells.len(), header.len(), "{line}");
        let kept = cells.iter().zip(&timed).filter(|(_, timed)| !**timed);
        kept.map(|(cell, _)| format!("{cell},")).collect::<String>() + "\n"
    });
    let page = text("report.html");
    let page = page.split("<table>").map(|part| match part.split_once("</table>") {
        Some((table, rest)) => table_without_times(table) + rest,
        None => part.to_owned(),
    });
    [times.collect(), header.join(",") + &rows.collect::<String>(), page.collect()]
}

/// Returns a table of a page without the cells of its columns of times.
fn table_without_times(table: &str) -> String {
    let mut timed = Vec::new();
    let row = |row: &str| {
        if row.contains("</th>") {
            let name = |cell: &str| cell.rsplit('>').next().unwrap_or_default().to_owned();
            let names: Vec<String> = row.split("</th>").map(name).collect();
            timed = names.iter().map(|name| name == "time" || name.ends_with("_s")).collect();
            assert!(timed.contains(&true), "{row}");
            return row.to_owned();
        }
        let cells = row.split("</td>").enumerate();
        cells
            .filter(|(column, _)| timed.get(*column) != Some(&true))
            .map(|(_, cell)| cell)
            .collect()
    };
    table.split("<tr>").map(row).collect()
}

/// Returns the output of the benchmark of some tasks, without the network.
fn tasks(options: &[&str]) -> Vec<u8> {
    let output = bench_tasks(options);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    output.stdout
}

fn bench_tasks(options: &[&str]) -> Output {
    run(&[&BENCH[..], &TASKS, options].concat())
}
