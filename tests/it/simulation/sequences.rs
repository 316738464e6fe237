//! Several strokes: placed strokes settle and jump, chained strokes continue.

use std::f64::consts::FRAC_PI_3;

use pushplan::geometry::{Pose, Vector};
use pushplan::{
    outcome::{Record, Warning},
    scene::{Scene, State},
    task::{Job, Push, ToolMotion},
};

use crate::fixtures::{bar, brick, can, engines};

fn two_pushes() -> [Push; 2] {
    [
        Push { start: Vector::new(-0.06, 0.0), direction: 0.0, length: 0.15, speed: 0.1 },
        Push { start: Vector::new(-0.10, 0.13), direction: 0.0, length: 0.1, speed: 0.2 },
    ]
}

#[test]
fn a_placed_sequence_is_its_pushes_one_after_another_to_the_bit() {
    let mut second = brick();
    second.pose = Pose::new(0.02, 0.16, 0.3);
    let scene = Scene::new([can(), second]);
    let pushes = two_pushes();
    let motion = |pushes: &[Push]| ToolMotion::pushes(bar(), 0.002, 0.0, pushes, true);
    for simulator in engines() {
        let run = |start: &State, pushes: &[Push]| {
            let job = Job { start: start.clone(), ..Job::stated(&scene, motion(pushes)) };
            simulator.run(&scene, &job, Record::Frames)
        };
        let whole = run(&scene.start(), &pushes);
        let first = run(&scene.start(), &pushes[..1]);
        let then = run(first.outcome(), &pushes[1..]);
        assert_eq!(whole.outcome(), then.outcome(), "{:?}", simulator.engine());
        assert_eq!(whole.frames.len(), first.frames.len() + then.frames.len() - 1);
        // The first push settles before the second begins.
        let last_of_first = &whole.frames[first.frames.len() - 1];
        assert_eq!(last_of_first.stroke, 0);
        assert!(scene.is_resting(&last_of_first.state));
        assert!(whole.outcome().poses[1].position.x > 0.04, "the second push moves the brick");
        // The jump to the next start moves no object.
        let moved = whole.frames[first.frames.len()].state.poses[0].position
            - last_of_first.state.poses[0].position;
        assert!(moved.norm() < 1e-5, "{moved}");
    }
}

#[test]
fn a_chained_sequence_goes_on_without_waiting() {
    let scene = Scene::new([can()]);
    let mut start = Vector::new(-0.06, -0.02);
    let pushes = [(0.0, 0.1), (FRAC_PI_3, 0.05), (0.0, 0.1)].map(|(direction, length)| {
        let push = Push { start, direction, length, speed: 0.1 };
        start = push.end();
        push
    });
    let motion = ToolMotion::pushes(bar(), 0.002, 0.0, &pushes, false);
    for simulator in engines() {
        let trajectory =
            simulator.run(&scene, &Job::stated(&scene, motion.clone()), Record::Frames);
        let strokes: Vec<usize> = trajectory.frames[..26].iter().map(|f| f.stroke).collect();
        let expected: Vec<usize> =
            (0..26).map(|k| usize::from(k > 10) + usize::from(k > 15)).collect();
        assert_eq!(strokes, expected);
        let end = trajectory.outcome().poses[0].position;
        // The face ends at x = 0.165; the can leads it by its radius and a slide of 1.1 mm.
        assert!((end.x - 0.2161).abs() < 1e-3, "{:?}: {end}", simulator.engine());
        // Friction along the bar drags the can sideways by part of the motion.
        assert!(end.y > 1e-3 && end.y < 0.05, "{:?}: {end}", simulator.engine());
    }
}

#[test]
fn coming_down_on_an_object_is_reported() {
    let scene = Scene::new([can()]);
    let mut pushes = two_pushes();
    pushes[1].start = Vector::new(0.12, 0.02);
    let motion = ToolMotion::pushes(bar(), 0.002, 0.0, &pushes, true);
    for simulator in engines() {
        let trajectory =
            simulator.run(&scene, &Job::stated(&scene, motion.clone()), Record::Outcome);
        let expected = Warning::SetDownOn { object: "can".into(), stroke: 1 };
        assert_eq!(trajectory.warnings, vec![expected]);
    }
}
