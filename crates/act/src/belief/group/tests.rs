//! Tests of `group`.

use std::sync::Arc;

use super::*;
use crate::belief::{BeliefSettings, Step};
use pushplan::{
    geometry::{Pose, Shape},
    scene::{Object, Part, Scene, Tool},
    task::Noise,
};

#[test]
fn of_what_was_played_the_likeliest_is_found_for_all_and_for_each_type_of_a_pair() {
    use JointType::{Fixed, None, Revolute};
    let played = Played(vec![
        (vec![None, Fixed], 1.0),
        (vec![Revolute, Fixed], 3.0),
        (vec![Revolute, None], 2.0),
        (vec![None, None], GIVEN_UP),
    ]);
    assert_eq!(played.best(), Some(&(vec![Revolute, Fixed], 3.0)));
    let before = [[0.2, 0.1, 0.4, 0.3], [0.25; 4]];
    let [first, second] = played.found(&before)[..] else { panic!("two pairs") };
    let close = |found: [f64; 4], right: [f64; 4]| {
        found.into_iter().zip(right).all(|(a, b)| (a - b).abs() < 1e-12)
    };
    assert!(close(first.best, [-2.0, 0.25_f64.ln(), 0.0, 0.75_f64.ln()]), "{first:?}");
    assert!(close(second.best, [-1.0, 0.0, 0.0, 0.0]), "{second:?}");
}

#[test]
fn pairs_are_informative_only_in_the_windows_of_a_push() {
    let mut belief = four_cans();
    for informative in [[true, false, false, true], [false, true, false, true], [false; 4]] {
        let evidence = informative.map(|informative| informative.then_some([0.0; 4])).to_vec();
        belief.history.push(Step { observations: 5, probabilities: Vec::new(), evidence });
    }
    assert_eq!(belief.informative(1), [0; 0]);
    assert_eq!(belief.informative(2), [1, 3]);
    assert_eq!(belief.informative(3), [0, 1, 3]);
    assert_eq!(belief.informative(9), [0, 1, 3]);
}

#[test]
fn a_joint_that_closes_a_loop_makes_each_other_one_in_it_give_way() {
    use JointType::{Fixed, None, Revolute};
    let belief = four_cans();
    assert_eq!(belief.pairs().collect::<Vec<_>>(), [[0, 1], [0, 2], [1, 2], [1, 3]]);
    let types = [Fixed, Revolute, None, Fixed];
    assert_eq!(
        belief.changed(&types, 2, Fixed),
        [[None, Revolute, Fixed, Fixed], [Fixed, None, Fixed, Fixed]]
    );
    assert_eq!(belief.changed(&types, 3, None), [[Fixed, Revolute, None, None]]);
    assert_eq!(belief.changed(&types, 1, Fixed), [[Fixed, Fixed, None, Fixed]]);
}

/// Three mutually touching objects, and a fourth next to the second.
fn four_cans() -> Belief {
    let can = |name: &str, x, y| Object::cylinder(name, 0.05, 0.1).at(x, y, 0.0);
    let scene = Scene::new([
        can("a", 0.0, 0.0),
        can("b", 0.11, 0.0),
        can("c", 0.055, 0.095),
        can("d", 0.22, 0.0),
    ]);
    let finger = Shape::Cylinder { radius: 0.01, height: 0.05 };
    let tool = Tool::new("finger", [Part::new("finger", finger, Pose::default())]);
    let settings = BeliefSettings::new(Noise { position: 0.0, heading: 0.0 });
    Belief::new(&scene, Arc::new(tool.expect("one piece")), 0.0, settings)
}
