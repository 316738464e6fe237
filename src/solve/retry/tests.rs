//! Tests of `retry`.

use super::*;
use crate::geometry::{Pose, wrap_angle};
use crate::outcome::{Evidence, Outcome, Perturbation};
use crate::scene::State;
use crate::task::Facing;

#[test]
fn the_next_aim_lies_as_far_on_the_other_side_as_the_last_replay_ended() {
    let goal = Goal::new(0, [0.5, 0.1], 0.02).facing(3.0, 0.1);
    let ended = |x: f64, y: f64, heading: f64| {
        let state = State::at_rest(vec![Pose::new(x, y, heading)]);
        let outcome = Outcome { goals: Vec::new(), reached: false, state };
        let evidence = Evidence {
            engine: Engine::Spatial,
            perturbation: Perturbation::Nominal,
            outcome,
            warnings: Vec::new(),
            force: None,
            trajectory: None,
        };
        Verdict::judge(Vec::new(), vec![evidence], 0.75)
    };
    let first = aim(&goal, &goal, &ended(0.53, 0.09, -3.2)).expect("an aim");
    assert!((first.position().unwrap() - Vector::new(0.47, 0.11)).norm() < 1e-12, "{first:?}");
    let Facing { heading, tolerance, .. } = *first.heading().expect("a heading");
    let turned = wrap_angle(-3.2 - 3.0);
    assert!((heading - (3.0 - turned)).abs() < 1e-12 && tolerance == 0.1, "{heading}");
    // The remaining error is added to the correction.
    let second = aim(&goal, &first, &ended(0.51, 0.1, 3.0)).expect("an aim");
    assert!((second.position().unwrap() - Vector::new(0.46, 0.11)).norm() < 1e-12, "{second:?}");
    assert_eq!(second.heading(), first.heading());
}
