//! Tests of `moving_picture`.

use std::sync::Arc;

use super::*;
use pushplan::{
    outcome::Warning,
    scene::{Engine, Part, Robot, Scene, State, Tool},
    task::{Goal, Push},
};

/// Draws two boxes of which the first follows `ways`, one position per frame.
fn picture_of(ways: &[[f64; 2]], placed: bool, warnings: Vec<Warning>) -> String {
    let object = |name: &str, x: f64| Object::cuboid(name, [0.1, 0.06, 0.1]).at(x, 0.0, 0.0);
    let scene =
        Scene { objects: vec![object("box", 0.4), object("other", 0.7)], ..Scene::default() };
    let part = Part::cuboid("bar", [0.02, 0.2, 0.05], Pose::default());
    let tool = Tool::new("bar", [part]).unwrap();
    let pushes = [0.2, 0.25].map(|x| Push {
        start: Vector::new(x, 0.0),
        direction: 0.0,
        length: 0.05,
        speed: 0.1,
    });
    let motion = ToolMotion::pushes(Arc::new(tool), 0.0, 0.0, &pushes, placed);
    let frames = ways.iter().enumerate().map(|(k, &[x, y])| Frame {
        blade: None,
        time: 0.5 * k as f64,
        stroke: k.saturating_sub(1),
        tool: Pose::default(),
        state: State::at_rest(vec![Pose::new(x, y, 0.0), Pose::new(0.7, 0.0, 0.0)]),
    });
    let trajectory = Trajectory {
        frames: frames.collect(),
        warnings,
        ..Trajectory::new(pushplan::scene::ModelKind::PLANAR.into())
    };
    let goal = Goal::new(0, [0.5, 0.0], 0.02);
    let robot = Robot { home: Vector::zeros(), ..Robot::reaching(0.1, 0.9).without_body() };
    MovingPicture {
        title: "a test".to_owned(),
        plan: "bar, 2 pushes".to_owned(),
        source: Source::Simulated(Engine::Spatial),
        task: &Task::new("test", scene, robot, goal),
        motions: &[motion],
        trajectory: &trajectory,
    }
    .to_svg()
}

const WAYS: [[f64; 2]; 3] = [[0.4, 0.0], [0.45, 0.0], [0.5, 0.0]];

#[test]
fn only_what_moves_is_animated_and_no_script_runs() {
    let svg = picture_of(&WAYS, true, Vec::new());
    for (class, moves) in [("o0", true), ("r0", false), ("o1", false), ("tool", true)] {
        assert_eq!(svg.contains(&format!("@keyframes {class}{{")), moves, "{class}");
    }
    assert!(svg.contains("bar, 2 pushes; simulated in 3-D, in real time"));
    assert!(!svg.contains("<script") && !svg.contains("href"), "{svg}");
}

#[test]
fn the_ending_shows_whether_the_goal_is_reached() {
    let reached = "reached: final error 0.0 mm";
    assert!(picture_of(&WAYS, true, Vec::new()).contains(reached));
    let toppled = vec![Warning::Toppled { object: "box".to_owned() }];
    assert!(!picture_of(&WAYS, true, toppled).contains(reached));
    let short = picture_of(&WAYS[..2], true, Vec::new());
    assert!(short.contains("missed: final error 50.0 mm, allowed 20.0 mm"));
}

#[test]
fn objects_stand_still_while_the_tool_is_lifted() {
    // With a pause of three seconds, the second push begins where the first left the box.
    let keys = |placed| {
        let svg = picture_of(&WAYS, placed, Vec::new());
        let rest = svg.split("@keyframes o0{").nth(1).expect("an animation").to_owned();
        rest.split('\n').next().expect("a line").matches("translate").count()
    };
    // Uniform motion without a pause needs fewer keyframes.
    assert!(keys(true) > keys(false), "{} {}", keys(true), keys(false));
}

#[test]
fn a_wild_replay_leaves_a_readable_picture() {
    let wild = picture_of(&[[0.4, 0.0], [f64::NAN, 0.0], [1e9, 0.0]], true, Vec::new());
    assert!(!wild.contains("NaN") && !wild.contains("inf,"), "{wild}");
    let size = |svg: &str| svg.split('>').next().map(str::to_owned);
    assert_eq!(size(&wild), size(&picture_of(&WAYS[..1], true, Vec::new())));
}
