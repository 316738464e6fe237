//! The command from a user's view: output, exit codes, files.

use std::path::Path;
use std::process::Stdio;

use serde_json::Value as Json;
use tempfile::TempDir;

use pushplan::progress::NoProgress;
use pushplan_bench::store::FolderLock;

use crate::ROOT;
use crate::program::{command, run, stderr};

/// Transcripts in `tests/cmd`, with output and exit codes.
#[test]
fn transcripts() {
    trycmd::TestCases::new().case(format!("{ROOT}/tests/cmd/*.md")).default_bin_name("pushplan");
}

#[test]
fn the_help_explains_every_exit_code() {
    let output = run(&["--help"]);
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let codes = text.split("Exit codes:\n").nth(1).expect("a list of exit codes");
    let listed: Vec<u8> = codes
        .lines()
        .filter_map(|line| line.trim_start().split_once("  ")?.0.parse().ok())
        .collect();
    assert_eq!(listed, [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 130]);
}

#[test]
fn results_are_the_same_for_any_number_of_threads_and_progress_stays_off_stdout() {
    let run = |threads: &str| {
        let arguments =
            ["predict", "tasks/pull-back.yaml", "--tool", "l-hook", "--push", "can:180", "--json"];
        let output = run(&[&arguments[..], &["--threads", threads]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let mut json: Json = serde_json::from_slice(&output.stdout).expect("JSON alone");
        for effect in json["effects"].as_array_mut().expect("effects") {
            effect.as_object_mut().map(|effect| effect.remove("seconds"));
        }
        json
    };
    let one = run("1");
    assert_eq!(one["schema_version"], 2);
    assert_eq!(one, run("3"));
}

/// More commands would be hard to navigate.
#[test]
fn there_are_at_most_twelve_commands() {
    let command = pushplan_command::command();
    assert!(command.get_subcommands().filter(|one| !one.is_hide_set()).count() <= 12);
}

#[test]
fn a_new_task_is_a_file_and_overwrites_none() {
    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("my.task");
    let name = path.to_str().expect("UTF-8");
    let written = || std::fs::read_to_string(folder.path().join("my.task.yaml")).expect("a file");
    assert_eq!(run(&["new", name]).status.code(), Some(0));
    let first = written();
    let output = run(&["new", name, "--example", "narrow-gap"]);
    assert_eq!(output.status.code(), Some(2));
    let message = stderr(&output);
    assert!(message.contains("my.task.yaml already exists"), "{message}");
    assert_eq!(written(), first);
    let other = folder.path().join("gap.yml");
    let other = other.to_str().expect("UTF-8");
    assert_eq!(run(&["new", other, "--example", "narrow-gap"]).status.code(), Some(0));
    assert_eq!(files(folder.path()), ["gap.yml", "my.task.yaml"]);
    assert_eq!(run(&["check", other, &format!("{name}.yaml")]).status.code(), Some(0));
}

#[test]
fn an_example_is_the_file_of_its_name() {
    let message = |task: &[&str]| {
        let action = ["--tool", "l-hook", "--push", "can:180", "--alone", "--json"];
        let output = run(&[&["predict"], task, &action].concat());
        let mut json: Json = serde_json::from_slice(&output.stdout).expect("JSON alone");
        json["effects"][0].as_object_mut().expect("an effect").remove("seconds");
        json
    };
    assert_eq!(message(&["--example", "pull-back"]), message(&["tasks/pull-back.yaml"]));
    for command in ["solve", "run", "predict"] {
        let output = run(&[command, "--example", "pull-bakc"]);
        assert_eq!(output.status.code(), Some(2));
        let message = stderr(&output);
        assert!(message.contains("pull-back") && message.contains("drive-board"), "{message}");
    }
}

#[test]
fn a_simulation_leaves_files_that_check_finds_fine() {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    let push = "start=0.62,-0.02 direction_deg=180 length=0.17";
    let action = ["tasks/pull-back.yaml", "--tool", "l-hook", "--push", push];
    let alone = ["--model", "planar", "--alone", "--trajectories", "--out", out];
    let output = run(&[&["predict"], &action[..], &alone].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let trajectory = folder.path().join("pull-back.planar.trajectory.json");
    let output = run(&["check", trajectory.to_str().expect("UTF-8")]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let names =
        ["pull-back.planar.svg", "pull-back.planar.trajectory.json", "pull-back.predict.html"];
    assert_eq!(files(folder.path()), names);
}

#[test]
fn a_folder_that_cannot_be_written_is_reported_before_any_computation() {
    // A file in place of the folder causes a failure for every user, including root.
    let folder = TempDir::new().expect("a folder");
    let taken = folder.path().join("taken");
    std::fs::write(&taken, "").expect("a file");
    for out in [taken.join("plans"), taken] {
        let out = ["--out", out.to_str().expect("UTF-8")];
        let action = ["predict", "tasks/pull-back.yaml", "--tool", "stick", "--push", "can:0"];
        let output = run(&[&action[..], &out].concat());
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
        let message = stderr(&output);
        assert!(message.contains("error: cannot write to the folder"), "{message}");
    }
    assert_eq!(files(folder.path()), ["taken"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error_and_not_a_panic() {
    let full = std::fs::File::create("/dev/full").expect("the device of full disks");
    let output =
        command(&["check", "--schema", "task"]).stdout(full).output().expect("the command runs");
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(stderr(&output).starts_with("error: cannot write the results"), "{}", stderr(&output));
}

#[test]
fn a_plan_that_cannot_be_written_is_printed_all_the_same() {
    let folder = TempDir::new().expect("a folder");
    // A folder in place of the plan causes a failure for every user, including root.
    std::fs::create_dir(folder.path().join("pull-back.plan.json")).expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    let output = run(&["solve", "tasks/pull-back.yaml", "--effort", "draft", "--out", out]);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(stderr(&output).contains("pull-back.plan.json: error: cannot write the file"));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("solved") && !text.contains("wrote"), "{text}");

    let json = ["solve", "tasks/pull-back.yaml", "--effort", "draft", "--out", out, "--json"];
    let output = run(&json);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let report: Json = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(report["files"], serde_json::json!([]));
}

#[test]
fn control_characters_of_a_file_never_reach_the_terminal() {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    let path = folder.path().join("red\u{1b}[31m \u{9b}2J.yaml");
    std::fs::copy(format!("{ROOT}/tasks/pull-back.yaml"), &path).expect("a task");
    let path = path.to_str().expect("UTF-8");
    let bad = folder.path().join("a\u{1b}b.yaml");
    let text = std::fs::read_to_string(format!("{ROOT}/tasks/pull-back.yaml")).expect("a task");
    std::fs::write(&bad, text.replace("mass:", "\"\\e[2Jmass\":")).expect("a task");
    let bad = bad.to_str().expect("UTF-8");
    for (arguments, code) in [
        (&["solve", path, "--effort", "draft", "--out", out][..], 0),
        (&["solve", path, "--effort", "draft", "--out", out, "--json"], 0),
        (&["check", path, bad], 3),
        (&["solve", path, "--tools", bad], 3),
    ] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(code), "{}", stderr(&output));
        for text in [&output.stdout, &output.stderr] {
            let text = String::from_utf8_lossy(text);
            assert!(!text.chars().any(|c| c.is_control() && c != '\n'), "{text:?}");
        }
    }
    // Results are named after the file as far as valid names allow, and distinct from similar
    // names.
    let plan = |name: &String| name.starts_with("red--31m--2J-") && name.ends_with(".plan.json");
    assert!(files(folder.path()).iter().any(plan));
    let output = run(&["check", path, bad]);
    assert!(
        String::from_utf8_lossy(&output.stdout).contains("red\\u001b[31m \\u009b2J.yaml: task")
    );
    assert!(stderr(&output).contains("unknown key `\\u001b[2Jmass`"), "{}", stderr(&output));
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let mut child = command(&["completions", "zsh"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("the command ends");
    assert_eq!((output.status.code(), stderr(&output)), (Some(0), String::new()));
}

#[test]
fn schemas_fit_the_shipped_files() {
    for kind in ["tool", "task"] {
        let output = run(&["check", "--schema", kind]);
        let schema: Json = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(schema["title"], format!("pushplan {kind}"));
        assert_eq!(schema["additionalProperties"], false);
    }
}

#[test]
fn a_solved_task_leaves_a_plan_that_verifies_and_the_same_files_for_any_number_of_threads() {
    let solve = |threads: &str| {
        let folder = TempDir::new().expect("a folder");
        let out = folder.path().to_str().expect("UTF-8").to_owned();
        let task = "tasks/pull-back.yaml";
        let output = run(&["solve", task, "--out", &out, "--threads", threads]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let names = ["pull-back.html", "pull-back.plan.json", "pull-back.svg"];
        assert_eq!(files(folder.path()), names);
        let bytes = |name: &str| std::fs::read(folder.path().join(name)).expect("a file");
        let written = (bytes("pull-back.plan.json"), names.map(bytes));
        (folder, written)
    };
    let (folder, one) = solve("1");
    assert_eq!(one, solve("3").1, "files differ with the number of threads");

    let plan = folder.path().join("pull-back.plan.json");
    let plan = plan.to_str().expect("UTF-8");
    let page = folder.path().join("verified");
    let out = page.to_str().expect("UTF-8");
    let output = run(&["verify", plan, "--replays", "2", "--out", out]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(files(&page), ["pull-back.verify.html"]);

    // The same plan with shorter pushes misses the goal.
    let text = String::from_utf8(one.0).expect("UTF-8");
    let mut json: Json = serde_json::from_str(&text).expect("JSON");
    let length = json["plan"]["steps"][0]["push"]["length"].as_f64().expect("a length");
    json["plan"]["steps"][0]["push"]["length"] = (0.5 * length).into();
    let short = folder.path().join("short.plan.json");
    std::fs::write(&short, json.to_string()).expect("a file");
    let output = run(&["verify", short.to_str().expect("UTF-8"), "--json"]);
    assert_eq!(output.status.code(), Some(5), "{}", stderr(&output));
    let report: Json = serde_json::from_slice(&output.stdout).expect("JSON alone");
    assert_eq!(report["verdict"]["passed"], false);
}

#[test]
fn a_task_without_a_solution_ends_with_code_4_and_shows_the_nearest_plan() {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    let output = run(&["solve", "tasks/too-far.yaml", "--out", out, "--json"]);
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    let report: Json = serde_json::from_slice(&output.stdout).expect("JSON alone");
    assert_eq!(report["status"], "no_plan");
    let names = ["too-far.nearest.html", "too-far.nearest.plan.json", "too-far.nearest.svg"];
    assert_eq!(files(folder.path()), names);
}

#[test]
fn results_of_one_kind_or_task_do_not_write_over_those_of_another() {
    let folder = TempDir::new().expect("a folder");
    let within = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let out = within("out");
    let long = "a".repeat(80);
    for name in ["my task", "my-task", "my+task", &format!("{long}1"), &format!("{long}2")] {
        let file = within(&format!("{name}.yaml"));
        std::fs::copy(format!("{ROOT}/tasks/pull-back.yaml"), &file).expect("a task");
        let ran = run(&["run", &file, "--world", "1", "--out", &out]);
        assert_eq!(ran.status.code(), Some(0), "{}", stderr(&ran));
        let action = ["predict", &file, "--tool", "l-hook", "--push", "can:180", "--out", &out];
        let ran = run(&action);
        assert_eq!(ran.status.code(), Some(0), "{}", stderr(&ran));
    }
    let names = files(Path::new(&out));
    let count = |end: &str| names.iter().filter(|name| name.ends_with(end)).count();
    assert_eq!([count(".run.html"), count(".run.json"), count(".predict.html")], [5, 5, 5]);
    assert!(names.contains(&"my-task.run.html".to_owned()), "{names:?}");
    let trace = within("out/my-task.run.json");
    let checked = run(&["check", &trace]);
    assert_eq!(String::from_utf8_lossy(&checked.stdout), format!("{trace}: run, valid\n"));
    let text = std::fs::read_to_string(&trace).expect("a trace");
    std::fs::write(&trace, &text[..text.len() / 2]).expect("half of it");
    assert_eq!(run(&["check", &trace]).status.code(), Some(3));

    // Two simultaneous runs are also refused.
    let _lock = FolderLock::take(Path::new(&out), &NoProgress).expect("a free folder");
    let busy = run(&["run", "tasks/pull-back.yaml", "--world", "1", "--out", &out]);
    assert!(
        busy.status.code() == Some(1) && stderr(&busy).contains("process"),
        "{}",
        stderr(&busy)
    );
}

/// Returns the names of the files in a folder, sorted.
fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> = entries
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn check_reports_faults_to_programs() {
    let folder = TempDir::new().expect("a folder");
    let bad = folder.path().join("bad.yaml");
    let text = std::fs::read_to_string(format!("{ROOT}/tasks/pull-back.yaml")).expect("a task");
    std::fs::write(&bad, text.replace("mass:", "mas:")).expect("a task");
    let bad = bad.to_str().expect("UTF-8");
    let output = run(&["check", "--json", "tasks/pull-back.yaml", bad]);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    let report: Json = serde_json::from_slice(&output.stdout).expect("JSON");
    let [good, faulty] = &report["files"].as_array().expect("files")[..] else {
        panic!("two files")
    };
    assert_eq!((&good["kind"], &good["valid"]), (&"task".into(), &true.into()));
    assert_eq!((&faulty["file"], &faulty["valid"]), (&bad.into(), &false.into()));
    let fault = &faulty["faults"][0];
    assert!(fault["line"].as_u64() > Some(1) && fault["column"].as_u64() > Some(1), "{fault}");
    assert_eq!(fault["message"], "unknown key `mas`");
    assert_eq!(fault["remedy"], "did you mean `mass`?");
    let output = run(&["check", "--example", "pull-back"]);
    assert_eq!(String::from_utf8_lossy(&output.stdout), "pull-back: task, valid\n");
}

#[test]
fn help_of_solve_begins_with_its_options_and_completions_are_named() {
    let help = |arguments: &[&str]| String::from_utf8_lossy(&run(arguments).stdout).into_owned();
    let solve = help(&["solve", "--help"]);
    assert!(!solve.contains("pull-back-behind-wall") && solve.contains("`pushplan new --help`"));
    assert!(help(&["new", "--help"]).contains("pull-back-behind-wall"));
    assert!(help(&["--help"]).contains("completions"));
}

#[test]
fn the_command_without_python_names_the_package_with_the_server_for_agents() {
    let output = run(&["mcp", "--folder", "tables"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("pip install 'pushplan[mcp]'"), "{}", stderr(&output));
}

#[test]
fn check_explains_a_missing_plan_only_on_request() {
    let folder = TempDir::new().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let (far, near) = (path("far.yaml"), path("near.yaml"));
    let text = std::fs::read_to_string(format!("{ROOT}/tasks/pull-back.yaml")).expect("a task");
    std::fs::write(&near, &text).expect("a task");
    std::fs::write(&far, format!("{text}pushes: {{max_count: 1, length: 0.06}}\n"))
        .expect("a task");
    let message = |arguments: &[&str], code| {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(code), "{}", stderr(&output));
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    assert_eq!(message(&["check", &far], 0), format!("{far}: task, valid\n"));
    let text = message(&["check", "--why", &far, &near, "tasks/levers/raise-plate.yaml"], 4);
    assert!(
        text.contains("valid\n  no plan: one push reaches 0.09 m at most, but 0.17 m is needed"),
        "{text}"
    );
    assert!(
        text.contains("valid\n  search predicts success; `pushplan solve` verifies the plan"),
        "{text}"
    );
    assert!(
        text.ends_with("valid\n  --why does not support levering tasks; use `pushplan solve`\n"),
        "{text}"
    );
}
