//! Tests of `masses`.

use super::*;
use pushplan::{
    outcome::Contact,
    scene::{ModelKind, Object, Scene},
};

const RANGES: [Span; 3] = [Span::new(0.2, 0.5), Span::new(1.0, 2.0), Span::new(8.0, 10.0)];

/// Returns a trajectory with these contacts.
fn touching(pairs: &[[usize; 2]]) -> Trajectory {
    let contact = |[object, other]: &[usize; 2]| Contact {
        frame: 1,
        object: *object,
        with: Body::Object(*other),
    };
    let contacts = pairs.iter().map(contact).collect();
    Trajectory { contacts, ..Trajectory::new(ModelKind::PRIOR.into()) }
}

/// Returns the belief about three objects after a push with these contacts; `score` is the
/// log-likelihood of the logarithmic ratio of the first two masses.
fn observed(pairs: &'static [[usize; 2]], score: fn(f64) -> f64) -> Masses {
    let object = |name: &str, x| Object::cylinder(name, 0.05, 0.1).at(x, 0.0, 0.0);
    let scene = Scene::new([object("a", 0.0), object("b", 0.11), object("c", 0.5)]);
    let mut masses = Masses::new(3, &RANGES);
    let ratio = |physics: &Physics| (physics.masses[0] / physics.masses[1]).ln();
    let replay = Replay {
        starts: 1,
        play: &|_| vec![touching(pairs)],
        score: &|each| each.iter().map(|physics| score(ratio(&physics[0]))).collect(),
    };
    masses.weigh(&Physics::stated(&scene), &replay);
    masses
}

#[test]
fn a_push_determines_the_mass_ratio_before_either_mass() {
    // With a ratio of 1/2 to 1/4, only light and medium or medium and heavy fit.
    let shares = observed(&[[0, 1]], |log| -4.0 * (log + 1.6).powi(2)).shares();
    let [first, second] = [0, 1].map(|k| shares.objects[k].clone().expect("they touched"));
    assert!(first[0] > 0.3 && first[1] > 0.3 && first[2] < 0.01, "{first:?}");
    assert!(second[1] > 0.3 && second[2] > 0.3 && second[0] < 0.01, "{second:?}");
    assert_eq!(shares.objects[2], None, "nothing has touched it");
    let [MassRatio { between: [0, 1], log: [mean, sd] }] = shares.ratios[..] else { panic!() };
    assert!((mean + 1.6).abs() < 0.3 && sd < 0.5, "{mean} {sd}");
}

#[test]
fn motion_that_fits_only_one_pair_of_ranges_determines_both_masses() {
    let shares = observed(&[[1, 0]], |log| -4.0 * (log + 3.3).powi(2)).shares();
    assert!(shares.objects[0].as_ref().is_some_and(|of| of[0] > 0.99), "{shares:?}");
    assert!(shares.objects[1].as_ref().is_some_and(|of| of[2] > 0.99), "{shares:?}");
}

#[test]
fn where_not_all_assignments_are_kept_no_mass_is_certain() {
    let names = ["a", "b", "c", "d", "e"];
    let object = |k: usize| Object::cylinder(names[k], 0.05, 0.1).at(0.11 * k as f64, 0.0, 0.0);
    for (objects, surest) in [(4, 1.0), (5, 1.0 - LOST * 2.0 / 3.0)] {
        let scene = Scene::new((0..objects).map(object));
        let mut masses = Masses::new(objects, &RANGES);
        let pairs: Vec<[usize; 2]> = (1..objects).map(|k| [k - 1, k]).collect();
        let light = |physics: &Vec<Physics>| -1e3 * physics[0].masses.iter().sum::<f64>();
        let replay = Replay {
            starts: 1,
            play: &|_| vec![touching(&pairs)],
            score: &|each| each.iter().map(light).collect(),
        };
        masses.weigh(&Physics::stated(&scene), &replay);
        for of in masses.shares().objects.into_iter().flatten() {
            assert!((of[0] - surest).abs() < 1e-6, "{objects} objects: {of:?}");
            assert!((of.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn samples_are_as_frequent_as_believed_if_objects_may_be_lost() {
    let objects = 5;
    let mut masses = Masses::new(objects, &RANGES);
    masses.objects = (0..objects).collect();
    let one = |ranges: &[usize], share: f64| Assignment {
        ranges: ranges.to_vec(),
        before: share.ln(),
        now: share.ln(),
    };
    masses.all = vec![one(&[0, 1, 2, 0, 1], 0.7), one(&[1, 1, 2, 2, 0], 0.3)];
    let names = ["a", "b", "c", "d", "e"];
    let object = |k: usize| Object::cylinder(names[k], 0.05, 0.1).at(0.11 * k as f64, 0.0, 0.0);
    let stated = Physics::stated(&Scene::new((0..objects).map(object)));
    let (mut rng, draws) = (generator(7, 0), 20_000);
    let mut drawn = vec![[0.0; RANGES.len()]; objects];
    for _ in 0..draws {
        let physics = masses.sample(stated.clone(), &mut rng);
        for (drawn, mass) in drawn.iter_mut().zip(&physics.masses) {
            let range = masses.middles.iter().position(|middle| middle == mass);
            drawn[range.expect("the middle of a range")] += 1.0 / draws as f64;
        }
    }
    for (drawn, believed) in drawn.iter().zip(masses.shares().objects) {
        for (drawn, believed) in drawn.iter().zip(believed.expect("all have touched")) {
            // At most five standard deviations.
            assert!((drawn - believed).abs() < 0.018, "{drawn} {believed}");
        }
    }
}

#[test]
fn pushes_without_contact_and_aborted_pushes_give_no_information() {
    assert_eq!(observed(&[], |_| 0.0), Masses::new(3, &RANGES));
    let shares = observed(&[[0, 1]], |_| f64::NAN).shares();
    let even = |of: &Vec<f64>| of.iter().all(|share| (share - 1.0 / 3.0).abs() < 1e-12);
    assert!(shares.objects[0].as_ref().is_some_and(even), "{shares:?}");
}
