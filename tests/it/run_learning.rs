//! What pushes of a run teach the network that plans them.

use pushplan::act::{ActError, Runner, Trace};
use pushplan::asset::Faults;
use pushplan::effect::{EffectModels, Network};
use pushplan::network::Head;
use pushplan::scene::{HeadSpread, TableFit, Unknowns};
use pushplan::solve::{Effort, Planner};
use pushplan::watch::Unwatched;

use crate::closed_loop::{After, drawn, library, shipped};

/// A fit of the shipped network that has changed it a little, as twenty pushes do.
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
    let models = Effort::Draft.models();
    let planner = Planner::fitted(&models, Some(&given)).expect("its own network");
    let planner = planner.effort(Effort::Draft).build();
    let runner = Runner::new(&planner, &library).learning(Some(given.clone())).expect("a network");
    let json = |trace: &Trace| serde_json::to_string(trace).expect("JSON");
    let (mut trace, mut world) = drawn(&task, 1);
    runner.run(&mut trace, &mut world, &mut |_| Ok(()), &Unwatched).expect("a run");
    let learnt = trace.learnt.as_ref().expect("something");
    assert_eq!(learnt.pushes, given.pushes + trace.steps.len());
    assert!(trace.steps.len() >= 2 && learnt.head != given.head);
    assert!(learnt.spread.directions.len() >= 2, "nothing is narrower");
    assert_eq!(learnt.objects[0].name, task.scene.objects[0].name);

    let mut kept = String::new();
    let (mut stopped, mut world) = drawn(&task, 1);
    let mut keep = |trace: &Trace| -> Result<(), Faults> {
        kept = json(trace);
        Ok(())
    };
    let ended = runner.run(&mut stopped, &mut world, &mut keep, &After(1, Default::default()));
    assert!(matches!(ended, Err(ActError::Stopped { pushes: 1 })), "{ended:?}");
    let mut again: Trace = serde_json::from_str(&kept).expect("a trace");
    let (_, mut world) = drawn(&task, 1);
    runner.run(&mut again, &mut world, &mut |_| Ok(()), &Unwatched).expect("the rest");
    assert_eq!(json(&again), json(&trace));

    // What is not known of the scene is told first.
    let open = task.guessing(Unknowns { frictions: true, ..Unknowns::NONE });
    let (mut trace, mut world) = drawn(&open, 1);
    runner.run(&mut trace, &mut world, &mut |_| Ok(()), &Unwatched).expect("a run");
    assert_eq!(trace.learnt, None);
}
