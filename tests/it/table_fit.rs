//! Table fits of a network: no change without data, bit for bit; a known change of the last layer
//! is recovered; and results are independent of the number of threads.

use std::f64::consts::TAU;
use std::sync::Arc;

use pushplan::effect::{EffectModel, EffectModels, Job, ModelError, Network, Prior};
use pushplan::geometry::{Pose, Shape, Vector};
use pushplan::network::Head;
use pushplan::progress::NoProgress;
use pushplan::{
    outcome::Record,
    scene::{Object, Part, Scene, Support, Surface, TableFit, Tool},
    task::{Push, ToolMotion},
};
use pushplan_act::fit::{Basis, FitSettings, HeadSettings, fit, learn};
use pushplan_act::judge::{Comparison, Trial, mean};

use crate::random_network::weights;

/// Returns slow pushes by a finger against all sides of a box, with ends predicted by `model`.
fn pushes(model: &dyn EffectModel, count: usize) -> Vec<Trial> {
    (0..count)
        .map(|k| {
            let size = [0.12, 0.09, 0.03];
            let object = Object::cuboid("box", size)
                .friction(0.3)
                .mass(0.5)
                .standing_on(Support::Spread(0.7));
            let scene = Scene::new([object]).on_table(0.3).with_friction(0, Surface::Tool, 0.4);
            let finger = Part::new(
                "finger",
                Shape::Cylinder { radius: 0.004, height: 0.05 },
                Pose::default(),
            );
            let tool = Arc::new(Tool::new("finger", [finger]).expect("one piece"));
            let turn = TAU / 4.0 * (k % 4) as f64;
            let (ahead, aside) = if k % 2 == 0 { (0.06, 0.045) } else { (0.045, 0.06) };
            let share = 1.6 * ((k as f64 * 0.37).fract() - 0.5);
            let start = Pose::new(0.0, 0.0, turn).point(Vector::new(-ahead - 0.006, share * aside));
            let direction = turn + 0.4 * ((k as f64 * 0.618).fract() - 0.5);
            let push = Push { start, direction, length: 0.03, speed: 0.01 };
            let motion = ToolMotion::pushes(tool, 0.0, 0.0, &[push], false);
            let job = Job::stated(&scene, motion.clone());
            let ends = model.rollout(&scene, &[job], Record::Outcome);
            Trial::to_rest(scene, motion, ends[0].outcome().poses.clone())
        })
        .collect()
}

/// Returns a change of some tenths of a millimetre per frame.
fn change(half: usize) -> Head {
    let values = (0..Head::len_of(half)).map(|k| 0.06 * (1.7 * k as f64).sin()).collect();
    Head::new(values, half).expect("as many as it has")
}

fn learnt(network: &Network, trials: &[Trial]) -> TableFit {
    let settings = FitSettings { values: 5, ..FitSettings::default() };
    let found = fit(&Prior::default(), trials, &settings, &NoProgress).expect("something moves");
    // The true support and friction are given.
    let found = pushplan_act::fit::Fit {
        friction: pushplan_act::fit::Estimate { identified: false, ..found.friction },
        stated: pushplan_act::fit::AsStated { likelier: true, ..found.stated },
        ..found
    };
    learn(network, trials, &Basis::from(&found), &HeadSettings::default())
        .expect("the weights have a name")
}

fn off(model: &dyn EffectModel, trials: &[Trial]) -> f64 {
    let ends = |trial| Comparison::of(model, trial).end()[0].position;
    mean(&trials.iter().map(ends).collect::<Vec<f64>>())
}

#[test]
fn a_head_of_zeros_changes_no_bit() {
    let network = Network::new(weights(32));
    let trials = pushes(&network, 4);
    let none = network.clone().adapted(&Head::none(network.effect_width()));
    for (a, b) in pushes(&none, 4).iter().zip(&trials) {
        assert_eq!(a.truth, b.truth);
    }
    // Too few pushes have no effect.
    let fit = learnt(&network, &trials);
    assert!(fit.head.iter().all(|value| *value == 0.0) && fit.spread.directions.is_empty());
    let fitted = network.fitted(&fit).expect("its own weights");
    assert_eq!(pushes(&fitted, 4)[3].truth, trials[3].truth);
}

#[test]
fn final_poses_follow_a_small_change_of_the_last_layer_as_predicted() {
    let network = Network::new(EffectModels::weights().expect("the shipped weights"));
    let change = change(network.effect_width());
    // Larger changes are limited where the box would enter the tool.
    const SHARE: f64 = 5e-3;
    let (mut followed, mut all) = (0, 0);
    for trial in pushes(&network, 12) {
        let sensitivity = pushplan_act::fit::Sensitivity::of(&network, &trial.scene, &trial.job());
        let end = |share: f64| {
            let model = network.clone().adapted(&change.scaled(share));
            model.rollout(&trial.scene, &[trial.job()], Record::Outcome)[0].outcome().poses[0]
        };
        let (plus, minus) = (end(SHARE), end(-SHARE));
        let moved = (plus.position - minus.position) / (2.0 * SHARE);
        let follows = |k: usize| -> f64 {
            sensitivity.rows[k].iter().zip(change.values()).map(|(a, b)| a * b).sum()
        };
        let predicted = Vector::new(follows(0), follows(1));
        let apart = (predicted - moved).norm();
        let turned = (plus.heading - minus.heading) / (2.0 * SHARE);
        assert!((turned - follows(2)).abs() < 1e-6 * follows(2).abs(), "{turned}");
        all += 1;
        followed += usize::from(apart < 0.1 * moved.norm());
    }
    assert_eq!((followed, all), (12, 12));
}

#[test]
fn the_change_that_made_the_pushes_is_learnt_from_them() {
    let network = Network::new(weights(32));
    let truth = network.clone().adapted(&change(network.effect_width()));
    let all = pushes(&truth, 120);
    let (shown, new) = all.split_at(80);
    let fit = learnt(&network, shown);
    let (before, after) =
        (off(&network, new), off(&network.clone().fitted(&fit).expect("its own weights"), new));
    assert!(after < 0.5 * before, "{before} to {after}");

    let pool =
        |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    let again = pool(1).install(|| learnt(&network, shown));
    assert_eq!(pool(3).install(|| learnt(&network, shown)), again);
    assert_eq!(again, fit);

    // For an object other than the pushed one, the effect is halved.
    let mut strange = new[0].clone();
    strange.scene.objects[0].mass = 5.0;
    assert_eq!(fit.strange(&strange.scene), ["box"]);
    assert!(fit.strange(&new[0].scene).is_empty());
}

#[test]
fn fits_of_another_network_are_refused() {
    let network = Network::new(weights(32));
    let fit = learnt(&network, &pushes(&network, 4));
    let other = Network::new(weights(16)).fitted(&fit);
    assert!(matches!(other, Err(ModelError::Fit { .. })));
    let renamed = TableFit { weights: "0".into(), ..fit };
    let message = network.fitted(&renamed).err().expect("refused").to_string();
    assert!(message.contains("other weights (0)"), "{message}");
}
