//! Tests of `trial`.

use std::sync::Arc;

use super::*;
use pushplan::{
    geometry::Shape,
    scene::{ModelKind, Object, Part, Tool},
    task::Stroke,
};

/// Returns a frame of stroke `stroke` with its single object at `x`.
fn frame(stroke: usize, x: f64) -> Frame {
    let state = State::at_rest(vec![Pose::new(x, 0.0, 0.0)]);
    Frame { time: 0.0, stroke, tool: Pose::default(), state, blade: None }
}

fn trajectory(frames: &[(usize, f64)]) -> Trajectory {
    let frames = frames.iter().map(|(stroke, x)| frame(*stroke, *x)).collect();
    Trajectory { frames, ..Trajectory::new(ModelKind::Still.into()) }
}

#[test]
fn frames_are_aligned_by_stroke_and_rest_goes_on() {
    let solid = Shape::Cylinder { radius: 0.05, height: 0.1 };
    let can = Object::new("can", solid);
    let hand = Part::new("hand", solid, Pose::default());
    let tool = Tool::new("hand", [hand]);
    let from = Pose::new(1.0, 0.0, 0.0);
    let to = Pose::new(1.02, 0.0, 0.0);
    let strokes = vec![Stroke { from, to, duration: 0.2, settle: true }; 2];
    let tool = Arc::new(tool.expect("one piece"));
    let scene = Scene { objects: vec![can], ..Scene::default() };
    let motion = ToolMotion { tool, lift: 0.0, strokes };
    // Two moving frames per stroke; the ground truth then comes to rest in two frames and in one.
    let truth = [(0, 0.0), (0, 1.0), (0, 2.0), (0, 3.0), (0, 4.0), (1, 5.0), (1, 6.0), (1, 7.0)];
    let frames = trajectory(&truth).frames;
    let mut trial = Trial::of_frames(scene, motion, &frames);
    assert_eq!(trial.truth.len(), 7);
    // The prediction comes to rest in one frame and in three, and stops early in the last case.
    let predicted = trajectory(&[
        (0, 0.0),
        (0, 10.0),
        (0, 20.0),
        (0, 30.0),
        (1, 50.0),
        (1, 60.0),
        (1, 70.0),
        (1, 80.0),
        (1, 90.0),
    ]);
    let at = |trial: &Trial, predicted: &Trajectory| -> Vec<f64> {
        trial.aligned(predicted).iter().map(|state| state.poses[0].position.x).collect()
    };
    assert_eq!(at(&trial, &predicted), [10.0, 20.0, 30.0, 30.0, 50.0, 60.0, 70.0]);
    assert_eq!(at(&trial, &trajectory(&truth)), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
    let stopped = trajectory(&[(0, 0.0), (0, 10.0)]);
    assert_eq!(at(&trial, &stopped), [10.0; 7]);
    trial.truth.iter_mut().for_each(|moment| moment.when = When::Rest);
    assert_eq!(at(&trial, &predicted)[..4], [30.0; 4]);
    assert_eq!(at(&trial, &predicted)[4..], [90.0; 3]);
}
