//! Tests of `particles`.

use super::*;
use pushplan::scene::Object;

fn scene() -> Scene {
    let object = |name: &str, mass| Object::cylinder(name, 0.05, 0.1).mass(mass);
    Scene::new([object("a", 0.4), object("b", 1.0).at(0.2, 0.0, 0.0)])
}

#[test]
fn known_values_stay_and_unknown_values_spread_around_the_stated_ones() {
    let scene = scene();
    let stated = Physics::stated(&scene);
    let unknown = Unknowns { masses: true, ..Unknowns::NONE };
    let particles = Particles::new(2, unknown, 1);
    let each = particles.each(&scene, &stated);
    assert!(each.iter().all(|physics| physics.frictions == stated.frictions));
    assert!(each.iter().all(|physics| physics.feet == stated.feet));
    let within = |physics: &&Physics| (0.2..=0.8).contains(&physics.masses[0]);
    let share = each.iter().filter(within).count() as f64 / each.len() as f64;
    assert!((0.75..=1.0).contains(&share), "{share}");
    let mean = particles.mean(&scene, stated.clone());
    assert!((mean.masses[1] - 1.0).abs() < 1e-12, "the middle is the stated value");
    assert!(Particles::new(2, Unknowns { joints: true, ..Unknowns::NONE }, 1).is_empty());
}

#[test]
fn weighing_moves_the_mean_to_what_is_likely_and_narrows_it() {
    let scene = scene();
    let stated = Physics::stated(&scene);
    let mut particles = Particles::new(2, Unknowns::ALL, 7);
    let before = particles.numbers(&scene, &stated);
    for _ in 0..4 {
        let each = particles.each(&scene, &stated);
        let off = |physics: &Physics| ((physics.masses[0] - 0.6) / 0.05).powi(2);
        particles.weigh(&each.iter().map(|physics| -0.5 * off(physics)).collect::<Vec<_>>());
    }
    let after = particles.numbers(&scene, &stated);
    let [mean, sd] = after.masses[0];
    assert!((mean - 0.6).abs() < 0.05 && sd < 0.5 * before.masses[0][1], "{mean} {sd}");
    assert!(after.masses[1][1] > 0.4 * before.masses[1][1], "the other mass is not identified");
    let same = particles.numbers(&scene, &stated);
    particles.weigh(&[f64::NAN; COUNT]);
    assert_eq!(particles.numbers(&scene, &stated).masses.len(), same.masses.len());
    assert!(particles.numbers(&scene, &stated).masses[0][0].is_finite());
}
