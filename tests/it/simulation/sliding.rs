//! An object that slides freely goes as far as its support law says.

use pushplan::geometry::{Pose, Vector};
use pushplan::scene::{GRAVITY, Object, Record, State, Velocity};
use pushplan::sim::Simulator;

use super::fixtures::{brick, can, engines, push, table};

/// How an object that starts at the origin with `velocity` ends when nothing touches it.
fn slide(simulator: &Simulator, object: Object, velocity: Velocity) -> (Pose, f64) {
    let scene = table(vec![object]);
    let start = State { velocities: vec![velocity], ..scene.start() };
    // The tool must move somewhere; far behind it meets nothing.
    let motion = push(Vector::new(-2.0, 0.0), 0.0, 0.05, 0.05);
    let trajectory = simulator.run(&scene, &start, None, &motion, Record::Frames);
    assert!(trajectory.warnings.is_empty(), "{:?}", trajectory.warnings);
    let time = trajectory.frames.last().map_or(0.0, |frame| frame.time);
    (trajectory.outcome().poses[0], time)
}

#[test]
fn without_spin_it_slides_v_squared_over_two_mu_g() {
    let speed = 0.5;
    // Friction 0.4 on a table of 0.5.
    let expected = speed * speed / (2.0 * 0.45 * GRAVITY);
    for simulator in engines() {
        for object in [can(), brick()] {
            for k in 0..8 {
                let heading = 0.3 + k as f64 * std::f64::consts::FRAC_PI_4;
                let along = Vector::new(heading.cos(), heading.sin());
                let velocity = Velocity { linear: along * speed, angular: 0.0 };
                let (end, _) = slide(&simulator, object.clone(), velocity);
                let error = (end.position - along * expected).norm();
                assert!(error < 1.2e-3, "{:?} {heading}: {error}", simulator.engine());
                assert!(end.heading.abs() < 1e-3, "{:?}: {end:?}", simulator.engine());
            }
        }
    }
}
