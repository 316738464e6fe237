//! Learning of the planning network from the pushes of a run.

use pushplan::effect::{EffectModels, Network};
use pushplan::network::Head;
use pushplan::progress::NoProgress;
use pushplan::solve::{Effort, Planner};
use pushplan::{
    scene::{HeadSpread, TableFit, Unknowns},
    task::Truth,
};
use pushplan_act::act::{RunSettings, Runner, SimulatedWorld, Trace};

use crate::closed_loop::{drawn, interrupted, library, shipped};

/// Returns a fit of the shipped network with small changes, as from twenty pushes.
fn some_fit() -> TableFit {
    let weights = EffectModels::weights().expect("the shipped weights");
    let network = Network::new(weights.clone());
    let length = Head::len_of(network.effect_width());
    TableFit {
        weights: weights.checksum().expect("a name"),
        head: (0..length).map(|k| 0.004 * (1.7 * k as f64).sin()).collect(),
        spread: HeadSpread { prior: 0.08, directions: Vec::new() },
        noise: 1e-3,
        pushes: 20,
        ..TableFit::default()
    }
}

#[test]
fn pushes_of_a_run_teach_the_network_to_the_same_bits_after_an_interruption() {
    let (task, library, given) = (shipped("pull-back-twice"), library(), some_fit());
    let model = Effort::Draft.model();
    let planner = Planner::fitted(&model, Some(&given)).expect("its own network");
    let planner = planner.effort(Effort::Draft).build();
    let runner = Runner::new(&planner, &library).learning(Some(given.clone())).expect("a network");
    let json = |trace: &Trace| serde_json::to_string(trace).expect("JSON");
    let (mut trace, mut world) = drawn(&task, 1);
    runner.run_with(&mut trace, &mut world, &mut |_| Ok(()), &NoProgress).expect("a run");
    let learnt = trace.learnt.as_ref().expect("something");
    assert_eq!(learnt.pushes, given.pushes + trace.steps.len());
    assert!(trace.steps.len() >= 2 && learnt.head != given.head);
    assert!(learnt.spread.prior > 0.0 && learnt.noise > 0.0, "{learnt:?}");
    assert_eq!(learnt.objects[0].name, task.scene.objects[0].name);

    let again = interrupted(&runner, &task);
    assert_eq!(json(&again), json(&trace));

    // Unknown properties of the scene are inferred first.
    let open = task.with_unknowns(Unknowns { frictions: true, ..Unknowns::NONE });
    let (mut trace, mut world) = drawn(&open, 1);
    runner.run_with(&mut trace, &mut world, &mut |_| Ok(()), &NoProgress).expect("a run");
    assert_eq!(trace.learnt, None);
}

#[test]
fn pushes_that_the_arm_cannot_begin_teach_nothing() {
    let (task, library, given) = (shipped("pull-back"), library(), some_fit());
    let planner = Planner::fitted(&Effort::Draft.model(), Some(&given)).expect("its network");
    let planner = planner.effort(Effort::Draft).build();
    let runner = Runner::new(&planner, &library).learning(Some(given.clone())).expect("a network");
    let mut truth = Truth::stated(&task.scene, 1);
    truth.scene.objects[0].mass = 500.0;
    let mut world = SimulatedWorld::new(truth).pushed_with(Some(1.0));
    let settings = RunSettings { max_pushes: 2, samples: 2, ..RunSettings::default() };
    let mut trace = Trace::new(task, settings, "draft".into(), None);
    runner.run_with(&mut trace, &mut world, &mut |_| Ok(()), &NoProgress).expect("a run");
    assert!(!trace.steps.is_empty() && trace.steps.iter().all(|step| step.stop.is_some()));
    let learnt = trace.learnt.expect("learned parameters");
    let begun = trace.steps.iter().filter(|step| !step.motion().strokes.is_empty()).count();
    assert_eq!(learnt.pushes, given.pushes + begun);
}
