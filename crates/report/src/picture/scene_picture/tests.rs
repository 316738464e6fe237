//! Tests of `scene_picture`.

use super::*;
use pushplan::geometry::Shape;
use pushplan::scene::{Joint, JointKind, ModelKind, Object};
use pushplan::task::Task;

fn picture_of(ends: Vec<Pose>) -> String {
    jointed_picture_of(ends, Vec::new())
}

fn jointed_picture_of(ends: Vec<Pose>, joints: Vec<Joint>) -> String {
    let shape = Shape::Cuboid { size: [0.1, 0.06, 0.1] };
    let object = |name: &str, x: f64| Object::new(name, shape).at(x, 0.0, 0.0);
    let scene = Scene { joints, ..Scene::new([object("box", 0.4), object("other", 0.7)]) };
    let end = pushplan::scene::State::at_rest(ends);
    let by = ModelKind::Still.into();
    let trajectory = Trajectory::standing(by, Pose::default(), end);
    ScenePicture {
        title: "a test".to_owned(),
        notes: Vec::new(),
        scene: &scene,
        goals: Vec::new(),
        reach: None,
        motions: &[],
        tracks: vec![Track { source: Source::Predicted, trajectory: &trajectory }],
    }
    .to_svg()
}

#[test]
fn only_what_moved_is_drawn_twice() {
    let svg = picture_of(vec![Pose::new(0.5, 0.0, 0.0), Pose::new(0.7, 0.0, 0.0)]);
    assert_eq!(svg.matches("<polygon").count(), 3);
}

#[test]
fn joints_are_drawn_where_they_were_and_where_they_went() {
    let at = Vector::new(0.55, 0.0);
    let kind = JointKind::Revolute { at, limits: None };
    let joint = Joint::new([0, 1], kind);
    let still = vec![Pose::new(0.4, 0.0, 0.0), Pose::new(0.7, 0.0, 0.0)];
    let moved = vec![Pose::new(0.4, 0.1, 0.0), Pose::new(0.7, 0.1, 0.0)];
    let words = "<title>box and other: revolute</title>";
    let drawn = |ends| jointed_picture_of(ends, vec![joint.clone()]).matches(words).count();
    assert_eq!((drawn(still.clone()), drawn(moved)), (1, 2));
    let legend = "revolute joint";
    assert!(jointed_picture_of(still.clone(), vec![joint.clone()]).contains(legend));
    assert!(!picture_of(still).contains(legend));
}

#[test]
fn a_wild_prediction_leaves_a_readable_picture() {
    let calm = picture_of(vec![Pose::new(0.4, 0.0, 0.0), Pose::new(0.7, 0.0, 0.0)]);
    let wild = picture_of(vec![Pose::new(1e9, 0.0, 0.0), Pose::new(f64::NAN, 0.0, 0.0)]);
    let size = |svg: &str| svg.split('>').next().map(str::to_owned);
    assert_eq!(size(&calm), size(&wild));
    assert!(!wild.contains("NaN"));
}

/// Returns the picture of a shipped task without a plan.
fn picture(name: &str) -> String {
    let task = Task::example(name).expect("a shipped task");
    ScenePicture {
        title: name.to_owned(),
        notes: Vec::new(),
        scene: &task.scene,
        goals: task.shown_goals(),
        reach: None,
        motions: &[],
        tracks: Vec::new(),
    }
    .to_svg()
}

#[test]
fn every_kind_of_goal_has_its_own_mark() {
    // A cross marks a wanted position: two lines of 14 pixels.
    let crosses = |svg: &str| {
        let goal = format!("stroke=\"{}\"", palette::GOAL);
        svg.lines().filter(|line| line.starts_with("<line") && line.contains(&goal)).count()
    };
    let place = picture("pull-back");
    assert!(place.contains("goal, tolerance 20 mm") && crosses(&place) == 2);
    // The band about the fence is drawn instead of a position.
    let gap = picture("fence-flush");
    assert!(gap.contains("gap of at most 3 mm") && gap.contains("opacity=\"0.25\""), "{gap}");
    assert_eq!(crosses(&gap), 2, "the nearest distance, and an arrow of the heading");
    assert_eq!(crosses(&picture("open-door")), 1, "an arrow of the heading");
    let edge = picture("cork-over-the-edge");
    assert_eq!(crosses(&edge), 1, "the edge alone");
    // The outline of a T has two pieces, each with an area and a rim.
    let coverage = picture("cover-the-mark");
    let filled = format!("fill=\"{}\"", palette::GOAL);
    let pieces = coverage.lines().filter(|line| line.starts_with("<polygon"));
    assert!(pieces.filter(|line| line.contains(&filled)).count() >= 2, "{coverage}");
    assert!(picture("turn-the-box").contains("\u{00b1}12\u{00b0}"));
}

#[test]
fn a_compound_object_is_one_thing() {
    let bracket = picture("bracket");
    assert!(!bracket.contains("fixed joint") && !bracket.contains("other object"), "{bracket}");
}
