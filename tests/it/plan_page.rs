//! The plan page in a real browser: it shows the computed values, its controls work, and it causes
//! neither console messages nor network requests.

mod browser;
mod recording;
mod run;
mod solid;

use std::path::{Path, PathBuf};
use std::process::Command;

use pushplan::asset::{PlanFile, load_task};
use pushplan::solve::RankedPlan;
use pushplan::{
    Effort, Goal, Object, Planner, PushRules, Robot, Scene, Solution, Task, ToolLibrary,
};
use pushplan::{
    outcome::Trajectory,
    scene::{Engine, Situation},
};
use pushplan_report::{Origin, PageView, TaskSource, solution_page};
use serde_json::{Value as Json, json};
use tempfile::TempDir;

use browser::Browser;

/// Maximum size of the page of a usual task, bytes.
const LARGEST: usize = 200_000;

/// Maximum size that the 3-D view adds to a page, bytes.
const PACKED: usize = 230_000;

/// Tolerance of displayed numbers, millimetres: half of the last digit, and as much again for the
/// rounding of positions.
const SHOWN: f64 = 0.06;

#[test]
fn the_error_shown_is_that_of_the_trajectory_at_any_time() {
    let Some(mut browser) = Browser::start() else { return };
    let folder = TempDir::new().expect("a folder");
    let mut compared = 0;
    // Two pushes with the tool lifted and set down again between them, and a box that must rotate.
    for (name, plans) in [("pull-back-twice", 2), ("turn-the-box", 3)] {
        let (task, solution) = solved(&format!("tasks/{name}.yaml"));
        let file = written(&folder, name, &task, &solution);
        let situation = Situation::stated(&task.scene);
        // Some of the displayed plans were not replayed.
        let replayed = solution.plans.iter().enumerate().filter(|(_, plan)| plan.verdict.is_some());
        for (k, ranked) in replayed.take(plans) {
            let replays = ranked.replays(&task, &situation);
            let recorded = |engine| {
                let nominal = replays.nominal(engine).expect("a replay");
                nominal.trajectory.as_ref().expect("recorded")
            };
            let layers = [
                ("predicted", &ranked.predicted),
                ("planar", recorded(Engine::Planar)),
                ("spatial", recorded(Engine::Spatial)),
            ];
            let last = |t: &Trajectory| t.frames.last().expect("frames").time;
            let end = layers.iter().map(|(_, t)| last(t)).fold(0.0, f64::max);
            for step in 0..20 {
                // The first times are opened directly, as from a link in a mail.
                let time = end * f64::from(step) / 19.0;
                let part = format!("t={time}&plan={}", k + 1);
                match step {
                    0..2 => browser.open(&file, &part),
                    _ => drop(follow(&mut browser, &part)),
                }
                for (layer, trajectory) in &layers {
                    let shown = browser.text(&format!("#error-{layer}"));
                    let shown: f64 = shown.trim_end_matches(" mm").parse().expect("millimetres");
                    let own = 1e3 * error_at(&task.goals[0], trajectory, time);
                    // Longer distances are shown in whole millimetres.
                    let digit = if own < 99.9 { SHOWN } else { 10.0 * SHOWN };
                    assert!(
                        (shown - own).abs() <= digit,
                        "{name}, {part}, {layer}: {shown}, {own}"
                    );
                    compared += 1;
                }
            }
        }
        assert_eq!(browser.complaints(), Vec::<String>::new());
    }
    assert!(compared >= 4 * 20 * 3, "{compared}");
}

#[test]
fn its_controls_work_and_nothing_leaves() {
    let Some(mut browser) = Browser::start() else { return };
    let folder = TempDir::new().expect("a folder");
    let (task, solution) = solved("tasks/turn-the-box.yaml");
    let file = written(&folder, "turn-the-box", &task, &solution);
    browser.open(&file, "t=0.5");
    let frames = |k: usize| &solution.plans[k].verdict.as_ref().expect("verified").evidence;
    let spatial = |k: usize| frames(k).iter().find(|e| e.engine == Engine::Spatial).expect("3-D");
    let first = spatial(0).trajectory.as_ref().expect("recorded").frames.clone();
    let end = number(&browser.value("duration()"));
    let shown = |browser: &mut Browser| number(&browser.value("view.time"));

    browser.press("Home");
    assert_eq!(shown(&mut browser), 0.0);
    browser.press("ArrowRight");
    browser.press("ArrowRight");
    assert!((shown(&mut browser) - first[2].time).abs() < 1e-4);
    browser.press("ArrowLeft");
    assert!((shown(&mut browser) - first[1].time).abs() < 1e-4);
    browser.press("End");
    assert_eq!(shown(&mut browser), end);
    browser.click("#back");
    assert!(shown(&mut browser) < end);
    browser.click("#forward");
    assert_eq!(shown(&mut browser), end);

    // Space plays from the start again, space pauses; the display changes meanwhile.
    browser.press(" ");
    assert_eq!(browser.value("view.playing"), true);
    assert_eq!(browser.value("document.querySelector('#play').ariaLabel"), "Pause");
    wait(&mut browser, "view.time > 0.05 && view.time < duration()");
    browser.press(" ");
    assert_eq!(browser.value("view.playing"), false);
    let paused = shown(&mut browser);
    assert_eq!(shown(&mut browser), paused);
    let link = browser.value("location.hash");
    assert_eq!(link, format!("#t={}&plan=1", (paused * 1e3).round() / 1e3));
    // Playback stops by itself at the end.
    browser.value("byId('speed').value = '4', byId('speed').dispatchEvent(new Event('change'))");
    browser.click("#play");
    wait(&mut browser, "!view.playing && view.time === duration()");

    // The middle of the slider is the middle of the time.
    browser.click("#scrub");
    assert!((shown(&mut browser) - 0.5 * end).abs() < 0.02 * end);
    browser.click("#chart svg");
    assert!((shown(&mut browser) - 0.5 * end).abs() < 0.05 * end);

    // Layers are toggled by key and by checkbox.
    let ghosts = "document.querySelectorAll('#stage .ghost.predicted').length";
    assert_eq!(browser.value(ghosts), 1);
    browser.press("1");
    assert_eq!(browser.value(ghosts), 0);
    browser.click("#show-predicted");
    assert_eq!(browser.value(ghosts), 1);

    // Every row opens its own replay, and a tool opens the replay of its best plan.
    let rows = number(&browser.value("document.querySelectorAll('#plans .open').length"));
    assert_eq!(rows as usize, solution.plans.len());
    for k in (0..solution.plans.len()).rev() {
        browser.click(&format!("#plans tr:nth-child({}) .open", k + 2));
        let shown: PlanFile = PlanFile::parse(&browser.text("#file"), "page").expect("a plan file");
        assert_eq!(shown.plan, solution.plans[k].plan);
        assert_eq!(shown.task, task);
    }
    let other =
        solution.plans.iter().position(|plan| plan.plan.tool() != solution.plans[0].plan.tool());
    browser.click("#tools tr:nth-child(3) .open");
    assert_eq!(browser.value("view.plan"), json!(other));

    // Every candidate push has its cell, which shows its score or the reason against it.
    let cells = "page.candidates.grids.flatMap((grid) => grid.cells).length";
    assert_eq!(browser.value(cells), json!(solution.candidates.len()));
    let chosen = "byId('candidates-tool').value";
    assert_eq!(browser.value(chosen), solution.plans[other.expect("another")].plan.tool());
    let counted = "document.querySelectorAll('#grids .cell').length";
    let wanted = "page.candidates.grids.filter((g) => g.tool === byId('candidates-tool').value)\
                  .flatMap((grid) => grid.cells).length";
    assert_eq!(browser.value(counted), browser.value(wanted));
    browser.click("#grids .cell");
    let text = browser.text("#cell");
    assert!(text.contains("score") || text.contains("would") || text.contains("meet"), "{text}");

    // The command that the page offers can be run.
    let command = browser.text("#command").replacen("pushplan", crate::PROGRAM, 1);
    let output = Command::new("sh")
        .args(["-c", &format!("{command} --json")])
        .current_dir(crate::ROOT)
        .output()
        .expect("a shell");
    let report: Json = serde_json::from_slice(&output.stdout).expect("JSON alone");
    let plan = &solution.plans[other.expect("another")];
    let again = number(&report["effects"][0]["goal_error"]);
    assert!((again - plan.outcome.error()).abs() < 1e-9, "{command}: {again}");

    assert_eq!(browser.complaints(), Vec::<String>::new());
    let requests = browser.requests();
    assert!(requests.len() == 1 && requests[0].starts_with("file://"), "{requests:?}");
}

#[test]
fn names_stay_text_and_the_browser_runs_nothing_else() {
    let Some(mut browser) = Browser::start() else { return };
    let evil = "</script><img src=x onerror=\"window.hacked=1\"><!--<script>";
    let scene = Scene::new([Object::cylinder(evil, 0.05, 0.10).at(0.55, 0.1, 0.0)]);
    let goal = Goal::new(0, [0.45, 0.1], 0.03);
    let mut task = Task::new(evil, scene, Robot::reaching(0.1, 0.7), goal);
    task.pushes = PushRules::default();
    let planner = Planner::for_effort(Effort::Draft).expect("a model").build();
    let solution = planner.solve(&task, &ToolLibrary::embedded().expect("tools")).expect("sound");
    let folder = TempDir::new().expect("a folder");
    let file = written(&folder, "evil", &task, &solution);
    browser.open(&file, "t=nonsense&plan=-7&hide=all");
    assert_eq!(browser.text("#task"), evil);
    assert_eq!(browser.value("document.images.length"), 0);
    assert_eq!(browser.value("window.hacked ?? 0"), 0);
    assert_eq!(browser.complaints(), Vec::<String>::new());
    // An injected script would not run, and could not contact any server.
    browser.value(
        "document.body.append(Object.assign(document.createElement('script'), \
         { textContent: 'window.hacked = 1' }))",
    );
    assert_eq!(browser.value("window.hacked ?? 0"), 0);
    let fetched = browser.value("fetch('http://127.0.0.1:9/').then(() => 'sent', (e) => `${e}`)");
    assert!(browser.complaints().iter().any(|line| line.contains("connect-src")), "{fetched}");
}

/// The page shows why each tool was rejected and the result of every candidate push.
#[test]
fn tools_and_pushes_state_why_they_were_rejected() {
    let folder = TempDir::new().expect("a folder");
    let (task, solution) = solved("tasks/pull-back-behind-wall.yaml");
    let data = data(&written(&folder, "pull-back-behind-wall", &task, &solution));
    let choice = data["choice"].as_array().expect("tools");
    assert_eq!(choice.len(), solution.tools.len());
    assert_eq!(choice[0]["why"], "chosen");
    assert_eq!(choice[0]["tool"], solution.plans[0].plan.tool());
    let sum = |key: &str| choice.iter().map(|tool| number(&tool[key]) as usize).sum::<usize>();
    // One push was enough, so all candidate pushes start from one state.
    assert_eq!(solution.statistics.depth, 1);
    let search = &solution.statistics.search;
    assert_eq!(sum("considered"), search.considered);
    assert_eq!(sum("refused"), search.infeasible.values().sum::<usize>());
    let cells = data["candidates"]["grids"].as_array().expect("grids").iter();
    let cells: Vec<i64> = cells
        .flat_map(|grid| grid["cells"].as_array().expect("cells"))
        .flat_map(Json::as_i64)
        .collect();
    assert_eq!(cells.iter().filter(|cell| **cell <= -10).count(), sum("refused"));
    let best = search.best.last().expect("a score").1;
    assert_eq!(
        cells.iter().filter(|cell| **cell >= 0).min(),
        Some(&((100.0 * best).round() as i64))
    );
    // For a tool that cannot do anything, the page shows the obstruction.
    let (task, solution) = solved("tasks/too-far.yaml");
    let data = self::data(&written(&folder, "too-far", &task, &solution));
    for tool in data["choice"].as_array().expect("tools") {
        let why = tool["why"].as_str().expect("words");
        assert!(why.starts_with("no push is feasible, mostly because "), "{why}");
    }
}

/// Without a solution, a page is made from other data: an action, or a benchmark's record.
#[test]
fn an_action_and_a_task_of_a_benchmark_have_pages() {
    let folder = TempDir::new().expect("a folder");
    let within = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let (task, run) = ("tasks/pull-back.yaml", within("run"));
    let replays = |page: &str| {
        let page = std::fs::read_to_string(page).expect("a page");
        assert!(page.len() <= LARGEST, "{} bytes", page.len());
        ["predicted", "planar", "spatial"]
            .map(|layer| page.matches(&format!("{{\"layer\":\"{layer}\",\"by\":")).count())
    };
    let out = within("predicted");
    let predict = ["predict", task, "--tool", "l-hook", "--push", "can:180", "--out", &out];
    assert_eq!(exit_code(&predict), 0);
    assert_eq!(replays(&format!("{out}/pull-back.predict.html")), [1, 1, 1]);

    assert_eq!(exit_code(&["bench", "tasks", task, "--out", &run]), 0);
    let out = within("pages");
    assert_eq!(exit_code(&["bench", "report", &run, "--page", task, "--out", &out]), 0);
    assert_eq!(replays(&format!("{out}/pull-back.verify.html")), [1, 1, 1]);
    // A task that was not measured, or that has changed since, is refused.
    let other = ["bench", "report", &run, "--page", "tasks/pull-back-twice.yaml", "--out", &out];
    assert_eq!(exit_code(&other), 2);
    let text = std::fs::read_to_string(Path::new(crate::ROOT).join(task)).expect("a task");
    let text = text.replace("friction: 0.4", "friction: 0.1");
    let changed = within("pull-back.yaml");
    std::fs::write(&changed, text).expect("a file");
    assert_eq!(exit_code(&["bench", "report", &run, "--page", &changed, "--out", &out]), 2);
}

/// Returns the exit code of the program, run in the checkout.
fn exit_code(arguments: &[&str]) -> i32 {
    crate::program::run(arguments).status.code().expect("no signal")
}

/// Returns a shipped task and its solution.
fn solved(path: &str) -> (Task, Solution) {
    let library = ToolLibrary::embedded().expect("the shipped tools");
    let path = Path::new(crate::ROOT).join(path);
    let task = load_task(&path, &library).unwrap_or_else(|faults| panic!("{faults}"));
    let planner = Planner::for_effort(Effort::Standard).expect("a model").build();
    let solution = planner.solve(&task, &library).expect("a sound task");
    (task, solution)
}

/// Returns the data of a page.
fn data(page: &Path) -> Json {
    let page = std::fs::read_to_string(page).expect("a page");
    let rest = page.split("id=\"data\">").nth(1).expect("data");
    serde_json::from_str(rest.split("</script>").next().expect("an end")).expect("JSON")
}

/// Writes the page of a solution to a file, as `solve` does.
fn written(folder: &TempDir, name: &str, task: &Task, solution: &Solution) -> PathBuf {
    written_with(PageView::Above, folder, name, (task, solution))
}

/// Writes the page of a solution with this view.
fn written_with(
    view: PageView,
    folder: &TempDir,
    name: &str,
    (task, solution): (&Task, &Solution),
) -> PathBuf {
    let situation = Situation::stated(&task.scene);
    let best = solution.best().expect("a plan");
    let replays = best.replays(task, &situation);
    let recipe = |ranked: &RankedPlan| {
        let model = Some(ranked.predicted.by.clone());
        let task = TaskSource::of(format!("tasks/{name}.yaml"));
        Origin { task, model, ..Origin::default() }.plan(&ranked.plan)
    };
    let page = solution_page(task, solution, &replays, &recipe, view);
    let largest = if view == PageView::Solid { LARGEST + PACKED } else { LARGEST };
    assert!(page.len() <= largest, "{name}: {} bytes", page.len());
    let path = folder.path().join(format!("{name}.html"));
    std::fs::write(&path, page).expect("a file");
    path
}

/// Navigates to another fragment of the open page.
fn follow(browser: &mut Browser, part: &str) -> Json {
    browser.value(&format!(
        "new Promise((done) => {{ addEventListener('hashchange', () => done(1), {{ once: true }}); \
         location.hash = {}; }})",
        json!(part)
    ))
}

/// Waits until an expression on the page is true.
fn wait(browser: &mut Browser, until: &str) {
    let waited = browser.value(&format!(
        "new Promise((done) => {{ const since = performance.now(); const look = () => {{ \
         if ({until}) return done(true); if (performance.now() - since > 20000) return done(false); \
         requestAnimationFrame(look); }}; look(); }})"
    ));
    assert_eq!(waited, true, "{until}");
}

/// Returns the distance of the goal's object from the goal at a time, interpolated linearly between
/// frames, metres.
fn error_at(goal: &Goal, trajectory: &Trajectory, time: f64) -> f64 {
    let at = |k: usize| trajectory.frames[k].state.poses[goal.object].position;
    let next = trajectory.frames.iter().position(|frame| frame.time > time);
    let position = match next {
        None => at(trajectory.frames.len() - 1),
        Some(0) => at(0),
        Some(next) => {
            let [a, b] = [next - 1, next].map(|k| trajectory.frames[k].time);
            at(next - 1) + (at(next) - at(next - 1)) * ((time - a) / (b - a))
        }
    };
    (position - goal.position().unwrap()).norm()
}

fn number(value: &Json) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}
