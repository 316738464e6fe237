//! Tests of `sequences`.

use super::super::choose::rested;
use super::super::setup::{Layout, STEPS};
use super::*;
use pushplan::{
    effect::{EffectModels, Simulated},
    scene::ModelKind,
    sim::Simulator,
};

/// Index of a start with goals that need corners and edges.
const START: usize = 9;

fn setup() -> (ReferenceSetup, Task, Vec<usize>) {
    let setup = ReferenceSetup::new(Layout::Scattered);
    let start = setup.starts[START];
    let poses = setup.free_poses(start);
    let task = setup.task(start, Vector::new(0.5, 0.3));
    (setup, task, poses)
}

#[test]
fn shared_beginnings_change_no_bit_of_a_prediction() {
    let (setup, task, poses) = setup();
    let model = &EffectModels::build(&ModelKind::PRIOR.into()).expect("no weights");
    let poses = &poses[..2];
    let rolling = Rolling { setup: &setup, task: &task, model, poses, steps: STEPS };
    let (shared, whole) = (rolling.shared(), rolling.whole());
    assert_eq!(shared.branches.len(), 2 * (4 + 16 + 64));
    let moved = shared.ends().filter(|(_, end)| *end != setup.starts[START]).count();
    assert!(moved > 10, "only {moved} sequences move the cylinder at all");
    for ((a, at), (b, there)) in shared.ends().zip(whole.ends()) {
        assert_eq!((a, at), (b, there));
    }
    assert!(shared == whole, "the ends agree, but not every stop");
}

/// Corrections of a push begin to count in contacts once the push has ended, and chained pushes are
/// one motion.
#[test]
fn the_network_corrects_whole_sequences_nearly_as_it_corrects_their_pushes() {
    let (setup, task, poses) = setup();
    let model = &EffectModels::build(&ModelKind::NETWORK.into()).expect("the shipped weights");
    let rolling = Rolling { setup: &setup, task: &task, model, poses: &poses[..2], steps: STEPS };
    let apart = apart(&rolling.shared(), &rolling.whole());
    assert!(apart < 3e-4, "{apart} m on average");
}

/// Returns the mean distance of the ends of sequences, metres.
fn apart(a: &Sequences, b: &Sequences) -> f64 {
    let apart: Vec<f64> = a.ends().zip(b.ends()).map(|((_, a), (_, b))| (a - b).norm()).collect();
    apart.iter().sum::<f64>() / apart.len() as f64
}

#[test]
fn the_planar_engine_forgets_little_at_a_shared_beginning() {
    let (setup, task, poses) = setup();
    let (model, poses) = (&Simulated::new(Simulator::planar()), &poses[..2]);
    let rolling = Rolling { setup: &setup, task: &task, model, poses, steps: STEPS };
    let mean = apart(&rolling.shared(), &rolling.whole());
    assert!(mean < 1e-4, "{mean} m on average");
}

#[test]
fn the_best_stops_are_at_the_stated_positions() {
    let (setup, task, poses) = setup();
    let model = &Simulated::new(Simulator::planar());
    let rolling = Rolling { setup: &setup, task: &task, model, poses: &poses, steps: STEPS };
    let whole = rolling.whole();
    let (scores, actions): (Vec<f64>, Vec<Action>) =
        whole.best(&task.goals[0], 12, &poses).into_iter().unzip();
    assert_eq!(scores.len(), 12);
    assert!(scores.is_sorted());
    let early = |action: &Action| action.pushes.iter().any(|push| push.length < 0.199);
    assert!(actions.iter().any(early), "none of the best stops early");
    let made = rested(&setup, model, &task, actions);
    assert_eq!(made.len(), 12);
    for (score, made) in scores.iter().zip(made) {
        let (predicted_error, done) =
            (score * task.goals[0].tolerance(), made.predicted.unwrap_or(f64::NAN));
        // Sliding is estimated as free, and half a frame by linear interpolation.
        assert!((predicted_error - done).abs() < 1.5e-3, "{predicted_error} against {done}");
    }
    // Whole sequences are a coarse check that no other stop is better.
    let ends = whole.ends().map(|(_, end)| (end - task.goals[0].place(&task.scene.start())).norm());
    let nearest = ends.fold(f64::INFINITY, f64::min);
    assert!(scores[0] * task.goals[0].tolerance() <= nearest);
    let only = whole.best(&task.goals[0], usize::MAX, &poses[..1]);
    assert!(only.iter().all(|(_, action)| action.pose == poses[0]));
}
