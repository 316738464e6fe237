//! Every benchmark in shards, as array jobs run them: merged, the bytes equal a single run.

use std::fs;

use tempfile::TempDir;

use crate::program::stderr;
use crate::sharding::{on, shards_make_the_same_bytes};

#[test]
fn of_random_tasks() {
    shards_make_the_same_bytes("random --count 3 --effort draft", 2);
}

#[test]
fn of_closed_loops() {
    shards_make_the_same_bytes("run --kind pull --count 2 --effort draft --max-pushes 4", 2);
    shards_make_the_same_bytes("run --kind pair --count 2 -q", 2);
}

#[test]
fn of_refinement() {
    shards_make_the_same_bytes("refinement --tasks 3 --effort draft", 2);
}

#[test]
fn of_joints_without_a_regulator() {
    let few = "--count 2 --on dense --seen exact --types-only --regulator none";
    shards_make_the_same_bytes(&format!("joints {few}"), 2);
}

#[test]
fn of_masses() {
    let few = "--count 2 --touching 2 --crowds 4 --controlled rows --seen fine";
    shards_make_the_same_bytes(&format!("masses {few}"), 2);
}

#[test]
fn of_probes() {
    shards_make_the_same_bytes("probes --count 1 --objects 4 --probe-rule information random", 2);
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
    shards_make_the_same_bytes("tradeoff --quick --pushes 2 --tasks 1 --rounds 1 --plans none", 3);
}

#[test]
fn measurements_without_shards_have_none() {
    let folder = TempDir::new().expect("a folder");
    let output = on("cost tasks/pull-back.yaml", folder.path(), Some((1, 2)));
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("unexpected argument '--shard'"), "{}", stderr(&output));
}

/// Runs the containers of the Kubernetes manifest with the indices of an Indexed Job. A loop
/// replaces the cluster.
#[cfg(unix)]
#[test]
fn the_kubernetes_jobs_end_like_one_run() {
    use serde::Deserialize;
    use serde_yaml::Value;

    use crate::{ROOT, sharding};

    let home = TempDir::new().expect("a folder");
    let runs = home.path().to_str().expect("UTF-8");
    let text = fs::read_to_string(format!("{ROOT}/cluster/kubernetes.yaml")).expect("jobs");
    let jobs: Vec<Value> = serde_yaml::Deserializer::from_str(&text)
        .map(|job| Value::deserialize(job).expect("YAML"))
        .collect();
    let [shards, merge] = &jobs[..] else { panic!("{} jobs", jobs.len()) };
    let container = |job: &Value| job["spec"]["template"]["spec"]["containers"][0].clone();
    let count = shards["spec"]["completions"].as_u64().expect("a number");
    assert_eq!(container(shards)["env"][0]["value"], count.to_string().as_str());
    let run = |job: &Value, index: u64| {
        let container = container(job);
        assert_eq!(container["command"][0], "sh");
        let script = container["args"][0].as_str().expect("a script").to_owned();
        let script = script.replace("/runs/", &format!("{runs}/")).replace("--count 1000", SMALL);
        let output = std::process::Command::new("sh")
            .args(["-c", &script])
            .env("PATH", sharding::path(home.path()))
            .env("SHARDS", count.to_string())
            .env("JOB_COMPLETION_INDEX", index.to_string())
            .current_dir(ROOT)
            .output();
        sharding::done(&output.expect("a shell"));
    };
    /// Size of this test.
    const SMALL: &str = "--count 4 --effort draft";

    (0..count).for_each(|index| run(shards, index));
    run(merge, 0);
    let whole = home.path().join("whole");
    sharding::done(&on(&format!("random {SMALL}"), &whole, None));
    for name in ["manifest.json", "records.jsonl"] {
        let [one, parts] = [whole.clone(), home.path().join("random")]
            .map(|folder| fs::read(folder.join(name)).expect("a file of the run"));
        assert!(one == parts, "{name} differs");
    }
}
