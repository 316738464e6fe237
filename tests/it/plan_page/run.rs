//! The page of a run: true motion, predictions and beliefs under one clock.

use pushplan::asset::ToolLibrary;
use pushplan::geometry::Pose;
use pushplan::progress::NoProgress;
use pushplan::{Effort, Planner};
use pushplan::{outcome::Trajectory, scene::State, task::Goal};
use pushplan_act::act::{
    RunSettings, Runner, SimulatedWorld, Step, TRACE_VERSION, Trace, hidden, really,
};
use pushplan_report::{PageView, Recipe, run_page};
use serde_json::json;
use tempfile::TempDir;

use super::browser::Browser;
use super::{LARGEST, SHOWN, data, error_at, exit_code, follow, number};

#[test]
fn a_run_is_played_with_what_was_predicted_and_believed() {
    let trace = run("everything-hidden", 2);
    assert!(trace.steps.len() >= 3, "too few pushes to play");
    let real = really(&trace);
    let folder = TempDir::new().expect("a folder");
    let recipe = Recipe { command: "pushplan run".to_owned(), python: String::new() };
    let page = run_page(&trace, &real, recipe, PageView::Above);
    assert!(page.len() <= LARGEST, "{} bytes", page.len());
    let file = folder.path().join("run.html");
    std::fs::write(&file, page).expect("a file");
    let made = &data(&file)["run"];
    let starts: Vec<f64> =
        made["times"].as_array().expect("times").iter().map(|time| 1e-4 * number(time)).collect();
    assert_eq!(starts.len(), trace.steps.len() + 1);

    let Some(mut browser) = Browser::start() else { return };
    browser.open(&file, "t=0");
    let goal = &trace.task.goals[0];
    for (k, step) in trace.steps.iter().enumerate() {
        let predicted = Trajectory { frames: step.predicted.clone(), ..real[k].clone() };
        for share in [0.05, 0.3, 0.6, 0.95] {
            let time = starts[k] + share * (starts[k + 1] - starts[k]);
            follow(&mut browser, &format!("t={time}"));
            for (layer, trajectory) in [("real", &real[k]), ("predicted", &predicted)] {
                let shown = browser.text(&format!("#error-{layer}"));
                let shown: f64 = shown.trim_end_matches(" mm").parse().expect("millimetres");
                let own = 1e3 * error_at(goal, trajectory, time - starts[k]);
                let digit = if own < 99.9 { SHOWN } else { 10.0 * SHOWN };
                assert!((shown - own).abs() <= digit, "{layer} of push {k}: {shown}, {own}");
            }
        }
    }
    // The belief shown is the belief at that time.
    let beliefs = |browser: &mut Browser| browser.text("#belief figure output");
    let shares = std::iter::once(&trace.prior[0])
        .chain(trace.steps.iter().map(|step| &step.probabilities[0]));
    for (k, shares) in shares.enumerate() {
        let time = (starts[k] + 1e-3).min(starts[starts.len() - 1]);
        follow(&mut browser, &format!("t={time}"));
        let text = beliefs(&mut browser);
        // Rounded to a tenth of a per cent through thousandths.
        let none = format!("none {:.1} %", (1e3 * shares[0]).round() / 10.0);
        assert!(text.contains(&none), "after {k} pushes: {text}, {none}");
        assert!(text.contains("true: "), "{text}");
    }
    let numbers = trace.task.scene.objects.len() * 2 + 1;
    let figures = number(&browser.value("document.querySelectorAll('#belief figure').length"));
    assert_eq!(figures as usize, trace.pairs.len() + numbers);

    // Every push opens its time, and keys skip the boundary, where two frames share a time.
    for (k, start) in starts.iter().take(trace.steps.len()).enumerate() {
        browser.click(&format!("#run tr:nth-child({}) .open", k + 2));
        let shown = |browser: &mut Browser| number(&browser.value("view.time"));
        assert!((shown(&mut browser) - start).abs() < 1e-4);
        browser.press("ArrowLeft");
        assert!(k == 0 || shown(&mut browser) < start - 1e-3, "no way back from push {k}");
        browser.press("ArrowRight");
        browser.press("ArrowRight");
        assert!(shown(&mut browser) > start + 1e-3, "no way on to push {k}");
    }
    assert_eq!(browser.complaints(), Vec::<String>::new());
    assert_eq!(browser.requests().len(), 1);
}

#[test]
fn the_true_run_is_simulated_again_to_the_bit() {
    let trace = run("coupled-or-not", 2);
    let real = really(&trace);
    assert_eq!(real.len(), trace.steps.len());
    for (step, real) in trace.steps.iter().zip(&real) {
        let world: &State = &step.world.as_ref().expect("simulated").state;
        assert_eq!(real.outcome().poses, world.poses);
        // The expected pose of the goal's object is the end of its prediction.
        let expected: Pose =
            step.predicted.last().expect("frames").state.poses[goal(&trace).object];
        assert_eq!(expected, step.expected);
        assert!(step.predicted.len() > 2);
    }
    // Without ground truth, the observations are played.
    let unknown = Trace { truth: None, ..trace };
    assert!(really(&unknown).is_empty());
    let page = run_page(&unknown, &[], Recipe::default(), PageView::Above);
    let folder = TempDir::new().expect("a folder");
    let file = folder.path().join("run.html");
    std::fs::write(&file, page).expect("a file");
    let replays = &data(&file)["plans"][0]["replays"];
    assert_eq!(replays[0]["layer"], "predicted");
    assert_eq!(replays[1]["layer"], "seen");
    assert_eq!(data(&file)["run"]["joints"][0]["really"], json!(null));
}

#[test]
fn the_command_writes_the_page_and_the_command_to_write_it_again() {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    let task = "tasks/coupled-or-not.yaml";
    let run = ["run", task, "--world", "2", "--seed", "1", "--page", "3d", "--out", out];
    assert_eq!(exit_code(&run), 0);
    let file = folder.path().join("coupled-or-not.run.html");
    assert!(std::fs::read_to_string(&file).expect("a page").contains("id=\"three\""));
    let plan = &data(&file)["plans"][0];
    assert_eq!(plan["command"], format!("pushplan run {task} --world 2 --seed 1"));
    let script = plan["python"].as_str().expect("a script");
    assert!(script.ends_with("print(pushplan.run(task, 2, seed=1))"), "{script}");
    // A trace of another version is not resumed.
    let path = folder.path().join("coupled-or-not.run.json");
    let text = std::fs::read_to_string(&path).expect("a trace");
    let version = format!("\"schema_version\":{TRACE_VERSION}");
    assert!(text.contains(&version));
    std::fs::write(&path, text.replace(&version, "\"schema_version\":1")).expect("a file");
    let again = [&run[..], &["--resume"]].concat();
    assert_eq!(exit_code(&again), 3);
}

fn goal(trace: &Trace) -> &Goal {
    &trace.task.goals[0]
}

/// Runs a shipped task in a drawn world.
fn run(name: &str, seed: u64) -> Trace {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let path = std::path::Path::new(crate::ROOT).join(format!("tasks/{name}.yaml"));
    let task = pushplan::asset::load_task(&path, &library).unwrap_or_else(|e| panic!("{e}"));
    let truth = hidden(&task, &library, seed).expect("its tools are there");
    let planner = Planner::for_effort(Effort::Draft).expect("a model").build();
    let settings = RunSettings { noise: truth.noise, ..RunSettings::default() };
    let mut trace = Trace::new(task, settings, "draft".into(), Some(truth.clone()));
    let mut world = SimulatedWorld::new(truth);
    let runner = Runner::new(&planner, &library);
    runner.run_with(&mut trace, &mut world, &mut |_| Ok(()), &NoProgress).expect("a run");
    assert!(trace.steps.iter().all(|step: &Step| step.pushes > 0));
    trace
}
