//! The 3-D view of a page: objects are drawn at their computed poses, with the same clock and
//! layers, and a browser without support reports it.

use std::sync::Arc;

use pushplan::asset::PlanFile;
use pushplan::geometry::Pose;
use pushplan::sim::LeverSimulator;
use pushplan::{Solution, Task};
use pushplan::{
    outcome::Frame,
    scene::{Engine, LeverScene},
    task::LeverJob,
};
use pushplan_report::PageView;
use serde_json::Value as Json;
use tempfile::TempDir;

use super::browser::Browser;
use super::{LARGEST, PACKED, exit_code, follow, number, solved, written_with};

/// Options for software rendering, because servers have no graphics processor.
const DRAWN: [&str; 2] = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

#[test]
fn things_stand_in_3d_where_they_were_computed() {
    let Some(mut browser) = Browser::start_with(&DRAWN) else { return };
    let folder = TempDir::new().expect("a folder");
    let (task, solution) = solved("tasks/turn-the-box.yaml");
    let file = written_with(PageView::Solid, &folder, "turn-the-box", (&task, &solution));
    browser.open(&file, "t=0.5");
    let text = browser.value("solid.begun.then(() => byId('solid-words').textContent)");
    assert!(text.as_str().is_some_and(|text| text.starts_with("Drag")), "{text}");
    assert_eq!(
        browser.value("[byId('solid').hidden, byId('stage').hidden]").to_string(),
        "[false,true]"
    );

    let frames = &spatial(&solution).frames;
    let object = task.goals[0].object;
    for k in [0, frames.len() / 3, 2 * frames.len() / 3, frames.len() - 1] {
        follow(&mut browser, &format!("t={}", frames[k].time));
        let pose: Pose = frames[k].state.poses[object];
        let shown = place(&mut browser, "spatial", object).expect("it is drawn");
        let off = (shown[0] - pose.position.x).hypot(shown[1] - pose.position.y);
        assert!(off < 2e-5 && shown[2] == 0.0, "{shown:?} for {pose:?}");
    }
    // The clock is shared with the drawing from above.
    browser.press("Home");
    let start = place(&mut browser, "spatial", object).expect("it is drawn");
    browser.press("End");
    assert_ne!(place(&mut browser, "spatial", object).expect("it is drawn"), start);
    // Layers can be toggled.
    browser.press("2");
    assert_eq!(place(&mut browser, "planar", object), None);
    browser.press("2");
    assert!(place(&mut browser, "planar", object).is_some());
    // Other plans open in the view.
    browser.click("#plans tr:nth-child(3) .open");
    assert!(place(&mut browser, "predicted", object).is_some());
    browser.click("#plans tr:nth-child(2) .open");

    // Keys and mouse move the camera; a key resets it.
    let origin = |browser: &mut Browser| browser.value("solid.pixel([0, 0, 0])");
    browser.press("h");
    let home = origin(&mut browser);
    for key in ["a", "w", "+"] {
        let before = origin(&mut browser);
        browser.press(key);
        assert_ne!(origin(&mut browser), before, "{key}");
    }
    browser.press("h");
    assert!(near(&origin(&mut browser), &home));
    browser.value("byId('solid').scrollIntoView({ block: 'center' })");
    browser.drag("#solid canvas", [80.0, 30.0]);
    assert!(!near(&origin(&mut browser), &home));
    browser.press("h");

    browser.press("v");
    assert_eq!(
        browser.value("[byId('solid').hidden, byId('stage').hidden]").to_string(),
        "[true,false]"
    );
    browser.click("#show-solid");
    assert_eq!(browser.value("byId('solid').hidden"), false);
    assert_eq!(browser.complaints(), Vec::<String>::new());
    let requests = browser.requests();
    assert!(requests.len() == 1 && requests[0].starts_with("file://"), "{requests:?}");

    // The scene is really drawn: the top of the box is blue, and the table at its former position
    // is not.
    browser.press("Home");
    let [x, y] = [start[0], start[1]];
    let top = [x, y, task.scene.objects[object].shape.height()];
    let blue = |[red, _, blue]: [f64; 3]| blue > red + 20.0;
    assert!(blue(colour(&mut browser, top)));
    browser.press("End");
    assert!(!blue(colour(&mut browser, [x, y, 0.0])));
}

#[test]
fn a_browser_without_3d_shows_a_message() {
    let Some(mut browser) = Browser::start_with(&["--disable-gpu", "--disable-3d-apis"]) else {
        return;
    };
    let folder = TempDir::new().expect("a folder");
    let (task, solution): (Task, Solution) = solved("tasks/pull-back.yaml");
    let file = written_with(PageView::Solid, &folder, "pull-back", (&task, &solution));
    browser.open(&file, "t=0.5");
    let text = browser.value("solid.begun.then(() => byId('solid-words').textContent)");
    assert!(text.as_str().is_some_and(|text| text.contains("needs WebGL 2")), "{text}");
    assert_eq!(
        browser.value("[byId('solid').hidden, byId('stage').hidden]").to_string(),
        "[true,false]"
    );
    assert_eq!(browser.value("document.querySelectorAll('#stage .object').length > 0"), true);
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
fn commands_write_it_where_it_is_asked_for() {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    let task = "tasks/pull-back.yaml";
    let page = |name: &str| std::fs::read_to_string(folder.path().join(name)).expect("a page");
    let solve = ["solve", task, "--effort", "draft", "--out", out];
    assert_eq!(exit_code(&solve), 0);
    assert!(!page("pull-back.html").contains("id=\"three\""));
    let plan = format!("{out}/pull-back.plan.json");
    let predict = ["predict", task, "--tool", "l-hook", "--push", "can:180", "--out", out];
    let commands = [
        ("pull-back.html", &solve[..]),
        ("pull-back.verify.html", &["verify", &plan, "--out", out]),
        ("pull-back.predict.html", &predict),
    ];
    for (name, command) in commands {
        assert_eq!(exit_code(&[command, &["--page", "3d"]].concat()), 0, "{command:?}");
        assert!(page(name).contains("id=\"three\""), "{command:?}");
    }
    // Without a folder there is no page for the view.
    assert_eq!(exit_code(&["verify", &plan, "--page", "3d"]), 2);
}

fn spatial(solution: &Solution) -> pushplan::Trajectory {
    let verdict = solution.plans[0].verdict.as_ref().expect("verified");
    verdict.nominal(Engine::Spatial).and_then(|e| e.trajectory.clone()).expect("recorded")
}

/// Returns the position at which an object of a layer is drawn; `None` if it is hidden.
fn place(browser: &mut Browser, layer: &str, object: usize) -> Option<[f64; 3]> {
    let found = browser.value(&format!("solid.where('{layer}', {object}) ?? null"));
    found.is_array().then(|| [0, 1, 2].map(|k| number(&found[k])))
}

/// Returns red, green and blue of the pixel that shows a point of the world, 0 to 255.
fn colour(browser: &mut Browser, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let found = browser.value(&format!(
        "(() => {{ const drawn = document.querySelector('#solid canvas'); solid.render(); \
         const copy = Object.assign(document.createElement('canvas'), \
         {{ width: drawn.width, height: drawn.height }}); const flat = copy.getContext('2d'); \
         flat.drawImage(drawn, 0, 0); const [x, y] = solid.pixel([{x}, {y}, {z}]); \
         return [...flat.getImageData(Math.round(x), Math.round(y), 1, 1).data]; }})()"
    ));
    [0, 1, 2].map(|k| number(&found[k]))
}

fn near(one: &Json, other: &Json) -> bool {
    (0..2).all(|k| (number(&one[k]) - number(&other[k])).abs() < 0.5)
}

/// Blade and plates of a lever-up in 3-D, and the height of its edge.
#[test]
fn a_lever_up_is_seen_from_all_sides() {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    let task = "tasks/levers/raise-plate.yaml";
    let solve = ["solve", task, "--effort", "draft", "--page", "3d", "--out", out];
    assert_eq!(exit_code(&solve), 0);
    let file = folder.path().join("raise-plate.html");
    let size = std::fs::metadata(&file).expect("a page").len() as usize;
    assert!(size <= LARGEST + PACKED, "{size} bytes");
    let plan = folder.path().join("raise-plate.plan.json");
    let plan = PlanFile::load(&plan).expect("a plan");
    let scene = Arc::new(LeverScene::with(&plan.task.scene, &plan.tools[0]));
    let lever = plan.plan.lever_steps().next().expect("a lever-up").lever;
    let (_, motion) =
        LeverSimulator::FINE.record(&LeverJob { scene: Arc::clone(&scene), lever }, 0.02);
    let start = scene.plates[lever.plate].start();
    let edge = start.local_point(lever.frame(&scene).position);
    let place_of = |frame: &Frame| frame.state.space.as_ref().expect("in space")[lever.plate];
    let raised = |k: usize| {
        let point = place_of(&motion[k].0).point(edge);
        1e3 * (point.z - start.point(edge).z)
    };

    // From the end of the rotation on, the page shows the height that tables state and goals judge.
    let evidence = plan.verdict.as_ref().and_then(|verdict| verdict.nominal(Engine::Spatial));
    let judged = evidence.and_then(|evidence| evidence.outcome.goals[0].raised).expect("a height");
    let height = |k: usize| match motion[k].0.time < lever.turn_time() {
        true => raised(k),
        false => 1e3 * judged,
    };

    let Some(mut browser) = Browser::start_with(&DRAWN) else { return };
    browser.open(&file, "t=0.01");
    browser.value("solid.begun");
    assert_eq!(browser.value("byId('solid').hidden"), false);
    let last = motion.len() - 1;
    let highest = (0..=last).max_by(|a, b| raised(*a).total_cmp(&raised(*b))).expect("frames");
    assert!(raised(highest) > 5.0);
    for k in [0, highest / 2, highest, last] {
        follow(&mut browser, &format!("t={}", motion[k].0.time));
        let own = place_of(&motion[k].0).position;
        let shown = place(&mut browser, "spatial", lever.plate).expect("it is drawn");
        let off = (shown[0] - own.x).hypot(shown[1] - own.y).hypot(shown[2] - own.z);
        assert!(off < 3e-5, "{shown:?} for {own:?}");
        let text = browser.text("#error-spatial");
        let text: f64 = text.trim_end_matches(" mm").parse().expect("millimetres");
        assert!((text - height(k)).abs() < 0.1, "{text} for {}", height(k));
    }
    // A key shows the drawing: a picture that loads nothing.
    browser.press("v");
    assert_eq!(browser.value("byId('stage').querySelector('img').naturalWidth > 0"), true);
    assert_eq!(browser.complaints(), Vec::<String>::new());
    let asked = browser.requests();
    let own = |url: &&&str| !url.starts_with("data:") && !url.starts_with("file://");
    assert_eq!(asked.iter().find(own), None);
}
