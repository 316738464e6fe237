//! A smaller time step has little effect.

use std::num::NonZeroU16;
use std::sync::Arc;

use pushplan::asset::ToolLibrary;
use pushplan::geometry::{Pose, Vector};
use pushplan::sim::Simulator;
use pushplan::{
    outcome::Record,
    scene::{Engine, Rate, Scene, Support},
    task::Job,
};
use pushplan_act::judge::mean;
use pushplan_lab::bench::{Suite, SuiteKind};

use crate::fixtures::{brick, can, push};

#[test]
fn a_quarter_of_the_step_moves_a_planar_outcome_by_less_than_half_a_millimetre() {
    for object in [can(), brick()] {
        for k in 0..6 {
            let mut object = object.clone();
            object.pose = Pose::new(0.0, 0.0, 0.5 * k as f64 + 0.2);
            let scene = Scene::new([object]);
            let motion = push(Vector::new(-0.07, -0.02 + 0.01 * k as f64), 0.0, 0.2, 0.1);
            let end = |rate: u16| {
                let rate = Rate(NonZeroU16::new(rate).unwrap());
                let simulator = Simulator::new(Engine::Planar, rate);
                let run =
                    simulator.run(&scene, &Job::stated(&scene, motion.clone()), Record::Outcome);
                run.outcome().poses[0]
            };
            let (coarse, fine) = (end(240), end(960));
            let error = (coarse.position - fine.position).norm();
            assert!(error < 0.5e-3, "{} {k}: {error}", scene.objects[0].name);
        }
    }
}

/// Friction in four points varies most from step to step.
#[test]
fn on_their_corners_objects_end_where_a_sixteenth_of_the_step_lets_them_end() {
    let library = ToolLibrary::embedded().unwrap();
    let apart = Suite::draw(SuiteKind::Single, &library, 7, 60).cases.into_iter().map(|case| {
        let mut job = Job::stated(&case.scene, case.motion.clone());
        Arc::make_mut(&mut job.physics).support_all(&case.scene, &Support::Corners);
        let [coarse, fine] = [240, 3840].map(|rate| {
            let simulator = Simulator::new(Engine::Planar, Rate(NonZeroU16::new(rate).unwrap()));
            simulator.run(&case.scene, &job, Record::Outcome).outcome().poses[0]
        });
        (coarse.position - fine.position).norm()
    });
    let apart: Vec<f64> = apart.collect();
    println!("1/240 against 1/3840 s on corners: {:.2} mm on average", 1e3 * mean(&apart));
    assert!(mean(&apart) < 1e-3, "{}", mean(&apart));
}
