//! Requirements of a shipped network, in addition to small errors on the suites of pushes.

use pushplan::asset::ToolLibrary;
use pushplan::effect::{EffectModel, EffectModels, Fallback, Job, Prior};
use pushplan::sim::Simulator;
use pushplan::{
    outcome::Record,
    scene::{Engine, ModelKind, Rate},
};
use pushplan_act::judge::{MOVED, mean};
use pushplan_lab::bench::{Suite, SuiteKind};

use crate::recorded_pushes::{SUPPORTS, errors, pushes};

fn network() -> Fallback {
    EffectModels::build(&ModelKind::NETWORK.into()).unwrap()
}

/// Returns the mean distance of cuboids' final positions from the 3-D engine, metres, for network
/// and analytic model. The tool rotates by `turn` (radians) during its push.
fn errors_in_a_turn(turn: f64) -> [f64; 2] {
    let models: [&dyn EffectModel; 2] = [&network(), &Prior::default()];
    let truth = Simulator::new(Engine::Spatial, Rate::DEFAULT);
    let mut apart = [vec![], vec![]];
    let suite = Suite::draw(SuiteKind::Single, &ToolLibrary::embedded().unwrap(), 7, 400);
    for case in suite.cases.iter().filter(|case| !case.scene.objects[0].shape.is_cylinder()) {
        let mut motion = case.motion.clone();
        motion.strokes[0].to.heading += turn;
        let job = Job::stated(&case.scene, motion);
        let end = truth.run(&case.scene, &job, Record::Outcome).outcome().poses[0].position;
        if (end - case.scene.objects[0].pose.position).norm() < MOVED {
            continue;
        }
        for (model, apart) in models.iter().zip(&mut apart) {
            let found = model.rollout(&case.scene, std::slice::from_ref(&job), Record::Outcome);
            apart.push((found[0].outcome().poses[0].position - end).norm());
        }
    }
    apart.map(|apart| mean(&apart))
}

#[test]
fn cuboids_under_a_turning_tool_are_predicted_about_as_by_the_prior() {
    for turn in [20_f64, -20.0] {
        let [network, prior] = errors_in_a_turn(turn.to_radians());
        println!("{turn} degrees: {:.2} mm, prior {:.2} mm", 1e3 * network, 1e3 * prior);
        // Training contains no rotating tools.
        assert!(network < 1.05 * prior, "{turn} degrees: {network} m, prior {prior} m");
    }
}

/// Accuracy on engines must not cost accuracy on a table.
#[test]
fn real_pushes_are_predicted_no_worse_than_by_the_prior_on_any_support() {
    let mut sums = [0.0; 2];
    for name in SUPPORTS {
        let pushes = pushes(name);
        let truth = &pushes[0].scene.objects[0].support;
        let [network, prior] = [&network() as &dyn EffectModel, &Prior::default()]
            .map(|model| errors(model, &pushes, truth).0);
        println!("{name}: {:.2} mm, prior {:.2} mm", 1e3 * network, 1e3 * prior);
        // Ten pushes with each support, so that chance is large.
        assert!(network < 1.1 * prior, "{name}: {network} m, prior {prior} m");
        sums = [sums[0] + network, sums[1] + prior];
    }
    assert!(sums[0] < sums[1], "{sums:?}");
}
