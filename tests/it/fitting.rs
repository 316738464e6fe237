//! Parameters of simulated pushes are recovered, slow pushes do not depend on their speed, and pair
//! frictions apply in every model.

use std::f64::consts::TAU;

use pushplan::effect::{EffectModel, Job, Prior, Simulated};
use pushplan::geometry::{Pose, Shape, Vector};
use pushplan::progress::NoProgress;
use pushplan::recording::Recording;
use pushplan::sim::Simulator;
use pushplan::{
    outcome::Record,
    scene::{Object, Part, Scene, Support, Surface, Tool},
    task::{Push, ToolMotion},
};
use pushplan_act::fit::{Fit, FitSettings, fit};
use pushplan_act::judge::Trial;

/// Returns a push by a finger of 4 mm radius from `start` at `speed`, m/s, by `length` metres.
fn finger_push(start: Vector, direction: f64, length: f64, speed: f64) -> ToolMotion {
    let finger =
        Part::new("finger", Shape::Cylinder { radius: 0.004, height: 0.05 }, Pose::default());
    let tool = Tool::new("finger", [finger]).expect("one piece").friction(0.9);
    let push = Push { start, direction, length, speed };
    ToolMotion::pushes(std::sync::Arc::new(tool), 0.0, 0.0, &[push], false)
}

/// Returns slow pushes against all sides of a box with support `spread`, recorded in `simulator`.
fn recorded(simulator: &Simulator, spread: f64, friction: f64, count: usize) -> Vec<Trial> {
    (0..count)
        .map(|k| {
            let size = [0.12, 0.09, 0.03];
            let object = Object::cuboid("box", size)
                .friction(0.3)
                .mass(0.5)
                .standing_on(Support::Spread(spread));
            let scene =
                Scene::new([object]).on_table(0.3).with_friction(0, Surface::Tool, friction);
            let direction = TAU / 4.0 * (k % 4) as f64;
            let (ahead, aside) = match k % 2 {
                0 => (size[0] / 2.0, size[1] / 2.0),
                _ => (size[1] / 2.0, size[0] / 2.0),
            };
            // From 0.2 to 0.8 of the half side, on either side, at an angle to either side.
            let share = 0.2 + 0.6 * ((k / 4) as f64 * 0.37).fract();
            let sign = if k % 3 == 0 { -1.0 } else { 1.0 };
            let along = Pose::new(0.0, 0.0, direction);
            let start = along.point(Vector::new(-ahead - 0.006, sign * share * aside));
            let slant = 0.4 * ((k as f64 * 0.618).fract() - 0.5);
            let motion = finger_push(start, direction + slant, 0.03, 0.01);
            let job = Job::stated(&scene, motion.clone());
            let frames = simulator.run(&scene, &job, Record::Frames).frames;
            Trial::of_recording(&Recording::of_frames("push", &scene, &motion, &frames))
        })
        .collect()
}

fn fitted(model: &dyn EffectModel, trials: &[Trial]) -> Fit {
    let settings = FitSettings { values: 13, ..FitSettings::default() };
    fit(model, trials, &settings, &NoProgress).expect("something moves")
}

/// Asserts that the ground truth is within the posterior's width plus the error of the analytic
/// model. Support points that are free to tilt act as if they were 0.05 farther out.
fn holds(fit: &Fit, spread: f64, friction: f64) {
    for (found, truth) in [(&fit.spread, spread), (&fit.friction, friction)] {
        let off = (found.mean - truth).abs();
        assert!(off < 2.0 * found.deviation + 0.045, "{truth}: {found:?}, noise {}", fit.noise);
        assert!(found.identified && found.deviation < 0.1, "{found:?}");
    }
    // Medians are compared, because a push near a bifurcation may have a large error even with the
    // true parameters.
    let others = fit.even.median.min(fit.corners.median);
    assert!(fit.best.median < 0.7 * others, "{:?} {:?} {:?}", fit.best, fit.even, fit.corners);
}

#[test]
fn the_planar_engine_gives_its_own_spread_and_friction_back() {
    for (spread, friction) in [(0.6, 0.2), (0.9, 0.35)] {
        let trials = recorded(&Simulator::planar(), spread, friction, 24);
        holds(&fitted(&Prior::default(), &trials), spread, friction);
    }
    let trials = recorded(&Simulator::planar(), 0.6, 0.2, 8);
    let by_itself = fitted(&Simulated::new(Simulator::planar()), &trials);
    assert!((by_itself.spread.best - 0.6).abs() < 0.03, "{:?}", by_itself.spread);
    assert!((by_itself.friction.best - 0.2).abs() < 0.05, "{:?}", by_itself.friction);
}

#[test]
fn the_spatial_engine_gives_its_own_spread_and_friction_back() {
    for (spread, friction) in [(0.6, 0.2), (0.9, 0.35)] {
        let trials = recorded(&Simulator::spatial(), spread, friction, 24);
        holds(&fitted(&Prior::default(), &trials), spread, friction);
    }
}

#[test]
fn pushes_that_move_nothing_are_no_ground_for_a_fit() {
    let mut trials = recorded(&Simulator::planar(), 0.6, 0.2, 1);
    let start = trials[0].scene.objects[0].pose;
    for stroke in &mut trials[0].motion.strokes {
        stroke.from.position += Vector::new(1.0, 0.0);
        stroke.to.position += Vector::new(1.0, 0.0);
    }
    trials[0].truth.iter_mut().for_each(|moment| moment.poses = vec![start]);
    assert!(fit(&Prior::default(), &trials, &FitSettings::default(), &NoProgress).is_none());
}

/// Returns the end of a push of 5 cm against a box, off-centre.
fn slow_end(model: &dyn EffectModel, speed: f64, support: Support) -> Pose {
    let object = Object::cuboid("box", [0.1, 0.1, 0.05]).friction(0.3).standing_on(support);
    let scene = Scene::new([object]).on_table(0.3).with_friction(0, Surface::Tool, 0.25);
    let motion = finger_push(Vector::new(-0.0545, 0.03), 0.0, 0.05, speed);
    let rolled = model.rollout(&scene, &[Job::stated(&scene, motion)], Record::Outcome);
    rolled[0].outcome().poses[0]
}

#[test]
fn slow_pushes_end_where_they_end_however_slow() {
    for support in [Support::Even, Support::Corners] {
        let planar = Simulated::new(Simulator::planar());
        let prior = slow_end(&Prior::default(), 0.0025, support.clone());
        let first = slow_end(&planar, 0.03, support.clone());
        for speed in [0.01, 0.0025] {
            let end = slow_end(&planar, speed, support.clone());
            let apart = |other: &Pose| (end.position - other.position).norm();
            assert!(apart(&first) < 5e-4, "{support:?} {speed} {end:?} {first:?}");
            assert!((end.heading - first.heading).abs() < 5e-3, "{support:?} {end:?} {first:?}");
            assert!(apart(&prior) < 1.5e-3, "{support:?} {speed} {end:?} {prior:?}");
            assert!((end.heading - prior.heading).abs() < 0.04, "{support:?} {end:?} {prior:?}");
        }
    }
}

#[test]
fn a_friction_stated_of_a_pair_is_that_of_the_pair_in_every_model() {
    let scene = |own: f64| {
        Scene::new([
            Object::cuboid("box", [0.1, 0.08, 0.05]).friction(own).at(0.0, 0.0, 0.3),
            Object::cylinder("can", 0.03, 0.05).friction(own).at(0.1, 0.02, 0.0),
        ])
        .on_table(own)
    };
    let motion = |own: f64| {
        let mut motion = finger_push(Vector::new(-0.09, 0.015), 0.0, 0.12, 0.1);
        std::sync::Arc::make_mut(&mut motion.tool).friction = own;
        motion
    };
    let by_values = (scene(0.4), motion(0.4));
    let stated = scene(0.9)
        .with_friction(0, Surface::Tool, 0.4)
        .with_friction(1, Surface::Tool, 0.4)
        .with_friction(1, Surface::Object(0), 0.4)
        .with_friction(0, Surface::Table, 0.4)
        .with_friction(1, Surface::Table, 0.4);
    let by_pairs = (stated, motion(0.9));
    let without = (scene(0.9), motion(0.9));
    let models: [Box<dyn EffectModel>; 3] = [
        Box::new(Prior::default()),
        Box::new(Simulated::new(Simulator::planar())),
        Box::new(Simulated::new(Simulator::spatial())),
    ];
    for model in models {
        let end = |(scene, motion): &(Scene, ToolMotion)| {
            let job = Job::stated(scene, motion.clone());
            model.rollout(scene, &[job], Record::Outcome)[0].outcome().poses.clone()
        };
        let (expected, found) = (end(&by_values), end(&by_pairs));
        for (a, b) in expected.iter().zip(&found) {
            let off = (a.position - b.position).norm();
            assert!(off < 1e-6, "{}: {off}", model.spec());
        }
        let moved = (end(&without)[1].position - expected[1].position).norm();
        assert!(moved > 1e-4, "{}: the test would not see a difference", model.spec());
    }
}
