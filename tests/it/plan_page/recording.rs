//! The page of a recording: observations and beliefs under one clock.

use pushplan::effect::Prior;
use pushplan::geometry::Vector;
use pushplan::recording::Recording;
use pushplan::sim::Simulator;
use pushplan::{
    outcome::Record,
    scene::{Joint, JointKind, Object, Scene},
    task::{Job, Truth},
};
use pushplan_act::belief::{Belief, BeliefSettings};
use pushplan_report::{PageView, Recipe, belief_document, recording_page};
use tempfile::TempDir;

use super::browser::Browser;
use super::{LARGEST, data, exit_code, follow, number};
use crate::fixtures::hand_push;

#[test]
fn a_recording_is_played_with_what_is_believed_of_it() {
    // Two rows of three cans, nearly touching, two of which are joined.
    let can = |k: usize| {
        let at = [0.072 * (k / 3) as f64, 0.072 * (k % 3) as f64];
        Object::cylinder(format!("can {k}"), 0.035, 0.1).at(at[0], at[1], 0.0)
    };
    let mut scene = Scene::new((0..6).map(can));
    scene.joints.push(Joint::new([1, 4], JointKind::Fixed));
    let motion = hand_push(Vector::new(-0.1, 0.06), 0.1, 0.2, 0.1);
    let job = Job::stated(&scene, motion.clone());
    let frames = Simulator::planar().run(&scene, &job, Record::Frames).frames;
    let recording = Recording::of_frames("clump", &scene, &motion, &frames);
    let (tool, lift) = (recording.tool.clone(), recording.lift);
    let settings = BeliefSettings::new(Truth::NOISE);
    let mut belief = Belief::new(&recording.scene, tool, lift, settings);
    let before = belief.probabilities();
    let model = Prior::default();
    for observation in recording.observations() {
        belief.update(&model, observation);
    }
    belief.finish(&model);
    let names: Vec<&str> =
        recording.scene.objects.iter().map(|object| object.name.as_str()).collect();
    let document = belief_document("clump", &belief, &names, &[]);
    let recipe = Recipe { command: "pushplan infer".to_owned(), python: String::new() };
    let believed = (&before[..], &belief);
    for (view, name) in [(PageView::Above, "above"), (PageView::Solid, "solid")] {
        let page = recording_page(&recording, believed, &document, recipe.clone(), view);
        assert!(view == PageView::Solid || page.len() <= LARGEST, "{} bytes", page.len());
        let folder = TempDir::new().expect("a folder");
        let file = folder.path().join(format!("{name}.html"));
        std::fs::write(&file, page).expect("a file");
        assert!(data(&file)["stage"]["goals"].as_array().is_some_and(Vec::is_empty));

        let Some(mut browser) = Browser::start() else { return };
        browser.open(&file, "t=0");
        let pairs = belief.pairs().len();
        assert!(pairs > 4, "too few pairs to see anything");
        let count = |browser: &mut Browser, what: &str| {
            number(&browser.value(&format!("document.querySelectorAll('{what}').length"))) as usize
        };
        assert_eq!(count(&mut browser, "#belief figure"), pairs);
        assert_eq!(count(&mut browser, "#found tr"), pairs + 1);
        assert_eq!(count(&mut browser, "aside"), 0);
        // The belief shown at a time is the belief after the last observation before it.
        let observed = recording.observed_frames();
        for step in belief.history().iter().step_by(3) {
            let time = recording.frames[observed[step.observations - 1]].time;
            follow(&mut browser, &format!("t={time}"));
            let text = browser.text("#belief figure output");
            let none = format!("none {:.1} %", (1e3 * step.probabilities[0][0]).round() / 10.0);
            assert!(text.contains(&none), "after {}: {text}, {none}", step.observations);
        }
        browser.click("#play");
        assert_eq!(browser.complaints(), Vec::<String>::new());
        assert_eq!(browser.requests().len(), 1);
    }
}

#[test]
fn the_command_writes_the_page_and_the_command_to_infer_the_same() {
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    let file = "tests/it/assets/push.recording.json";
    let infer =
        ["infer", file, "--noise", "0.002", "--mass-ranges", "0.2-0.5", "1-2", "--out", out];
    assert_eq!(exit_code(&infer), 0);
    let page = folder.path().join("belief.html");
    let plan = &data(&page)["plans"][0];
    assert_eq!(
        plan["command"],
        format!("pushplan infer {file} --noise 0.002 --mass-ranges 0.2-0.5 1-2")
    );
    let script = plan["python"].as_str().expect("a script");
    let call = "print(pushplan.infer(recording, noise=0.002, mass_ranges=[(0.2, 0.5), (1, 2)]))";
    assert!(script.ends_with(call), "{script}");
    // A single object has no joints and is also shown.
    let Some(mut browser) = Browser::start() else { return };
    browser.open(&page, "t=0.5");
    assert_eq!(browser.complaints(), Vec::<String>::new());
}
