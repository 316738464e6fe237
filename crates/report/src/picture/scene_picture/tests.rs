//! Tests of `scene_picture`.

use super::*;
use pushplan::geometry::Shape;
use pushplan::scene::{Joint, JointKind, ModelKind, Object};

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
        robot: None,
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
