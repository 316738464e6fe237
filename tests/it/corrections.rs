//! Corrections of whole pushes: they grow with the motion, stay bounded, and leave neither overlaps
//! nor open joints.

use std::sync::Arc;

use pushplan::effect::{EffectModel, Network, Prior};
use pushplan::geometry::{Footprint, Pose, Vector, contact_points};
use pushplan::network::MOST_CHANGE;
use pushplan::{
    outcome::{Record, Trajectory},
    scene::{JointKind, Object, Obstacle, Part, Scene, Tool},
    task::{Job, Push, ToolMotion},
};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::random_network::weights;

/// Returns a job that pushes the first of three objects, perhaps into the others and a wall.
fn job(random: &mut Pcg64, jointed: bool) -> (Scene, Job) {
    let mut draw = |low: f64, high: f64| random.random_range(low..high);
    let cuboid = |name: &str, x, y, heading| {
        Object::cuboid(name, [0.05, 0.07, 0.1]).at(x, y, heading).mass(0.4).friction(0.4)
    };
    let objects = [
        cuboid("pushed", 0.2, draw(-0.03, 0.03), draw(-3.0, 3.0)),
        cuboid("behind", draw(0.3, 0.35), draw(-0.05, 0.05), draw(-3.0, 3.0)),
        cuboid("far", 0.2, 0.6, 0.0),
    ];
    let wall = Obstacle::cuboid("wall", [0.05, 0.1, 0.1]);
    let wall = wall.at(draw(0.42, 0.5), draw(-0.1, 0.1), draw(-0.3, 0.3));
    let scene = Scene::new(objects).on_table(0.5).with_obstacle(wall);
    let scene = match jointed {
        true => {
            let at = Vector::new(0.25, 0.0);
            scene.with_joint([0, 1], JointKind::Revolute { at, limits: None })
        }
        false => scene,
    };
    let bar = Part::cuboid("bar", [0.02, 0.1, 0.05], Pose::default());
    let tool = Arc::new(Tool::new("bar", [bar]).expect("one piece").friction(0.3));
    let push = Push { start: Vector::new(0.13, 0.0), direction: 0.0, length: 0.15, speed: 0.1 };
    let job = Job::stated(&scene, ToolMotion::pushes(tool, 0.002, 0.0, &[push], true));
    (scene, job)
}

fn roll(model: &dyn EffectModel, scene: &Scene, job: &Job) -> Trajectory {
    model.rollout(scene, std::slice::from_ref(job), Record::Frames).remove(0)
}

#[test]
fn a_change_grows_with_the_path_and_is_bounded_by_it() {
    let network = Network::new(weights(64));
    let mut changed = 0;
    for seed in 0..100 {
        let (scene, job) = job(&mut Pcg64::seed_from_u64(seed), false);
        let [plain, corrected] =
            [&Prior::default() as &dyn EffectModel, &network].map(|m| roll(m, &scene, &job));
        assert_eq!(plain.frames.len(), corrected.frames.len());
        for k in 0..scene.objects.len() {
            let (mut path, mut last) = (0.0, plain.frames[0].state.poses[k]);
            let support = scene.objects[k].feet().mean_radius;
            for (plain, corrected) in plain.frames.iter().zip(&corrected.frames) {
                let (pose, other) = (plain.state.poses[k], corrected.state.poses[k]);
                let turned = (pose.heading - last.heading).abs();
                path += (pose.position - last.position).norm() + support * turned;
                last = pose;
                let change = (other.position - pose.position).norm();
                let turn = support * (other.heading - pose.heading).abs();
                // Separation adds at most the change itself, with its rotation at the corners.
                assert!(change <= 4.0 * MOST_CHANGE * path + 1e-9, "{seed} {change} {path}");
                assert!(turn <= MOST_CHANGE * path + 1e-9, "{seed} {turn} {path}");
                changed += usize::from(change > 1e-4);
            }
        }
        let far = |run: &Trajectory| run.outcome().poses[2];
        assert_eq!(far(&plain), far(&corrected), "an object that nothing moves");
        let alone = network.rollout(&scene, std::slice::from_ref(&job), Record::Outcome);
        assert_eq!(alone[0].outcome(), corrected.outcome(), "early stops and ends agree");
    }
    assert!(changed > 500, "{changed}");
}

#[test]
fn corrected_objects_stay_out_of_other_bodies_and_joints_stay_closed() {
    // Changes of millimetres, as learned ones.
    let mut weights = weights(64);
    for name in ["motion.even", "motion.odd"] {
        let values = weights.parameters.values.get_mut(name).expect("the last layer");
        values.iter_mut().for_each(|value| *value *= 0.2);
    }
    let network = Network::new(weights);
    let (mut deepest, mut pairs) = (Vec::new(), 0);
    for seed in 0..100 {
        let jointed = seed % 2 == 1;
        let (scene, job) = job(&mut Pcg64::seed_from_u64(seed), jointed);
        let run = roll(&network, &scene, &job);
        // Nothing separates what is squeezed between tool and wall.
        if !run.warnings.is_empty() {
            continue;
        }
        let end = run.outcome();
        if jointed {
            let anchor = |k: usize| {
                let local = scene.objects[k].pose.local_point(Vector::new(0.25, 0.0));
                end.poses[k].point(local)
            };
            assert!((anchor(0) - anchor(1)).norm() < 1e-6, "{seed}");
            continue;
        }
        let shape = |k: usize| scene.objects[k].shape.footprint();
        let wall = (&scene.obstacles[0].shape().footprint(), &scene.obstacles[0].pose);
        let depth = |first: (&Footprint, &Pose), second: (&Footprint, &Pose)| {
            contact_points(first, second, 0.0).0[0].map_or(0.0, |point| -point.gap)
        };
        let apart = depth((&shape(0), &end.poses[0]), (&shape(1), &end.poses[1]));
        let walled = (0..2).map(|k| depth((&shape(k), &end.poses[k]), wall));
        deepest.push(walled.fold(apart, f64::max));
        pairs += usize::from(apart > 0.0);
    }
    deepest.sort_by(f64::total_cmp);
    assert!(deepest[deepest.len() * 9 / 10] < 1e-3, "{deepest:?}");
    assert!(pairs > 5, "{pairs}");
}
