//! Contacts found again in the substeps of a frame.

use super::*;
use crate::{
    contact::free_sliding::coast,
    geometry::Pose,
    scene::{Object, Obstacle, Part, Physics, Scene, Tool},
};
use pushplan_kernel::Motion;

/// Eleven boxes and cans, a wall and a bar, all slightly moved since contacts were found.
#[test]
fn pairs_that_cannot_have_come_near_are_left_out_for_the_same_contacts() {
    let objects = (0..11).map(|k| {
        let (x, y) = (0.075 * f64::from(k % 4), 0.07 * f64::from(k / 4));
        let name = format!("{k}");
        let object = match k % 3 {
            0 => Object::cylinder(name, 0.03, 0.1),
            _ => Object::cuboid(name, [0.06, 0.05, 0.1]),
        };
        object.mass(0.5).friction(0.5).at(x, y, 0.3 * f64::from(k))
    });
    let wall = Obstacle {
        name: "wall".into(),
        size: [0.02, 0.4, 0.1],
        pose: Pose::new(0.3, 0.07, 0.1),
        z: 0.0,
        friction: 0.5,
    };
    let scene = Scene { obstacles: vec![wall], ..Scene::new(objects) };
    let bar = Part::cuboid("bar", [0.02, 0.1, 0.1], Pose::new(-0.05, 0.0, 0.2));
    let tool = Tool::new("bar", [bar]).expect("one piece");
    let bodies = Bodies::new(&scene, &tool, 0.002, &Physics::stated(&scene));
    let step = FrameStep { from: Pose::default(), to: Pose::new(2e-3, 0.0, 0.0), duration: 0.01 };
    let found = |state: &State, margin: f64, known: Option<(&[Contact], &[f64])>| {
        let velocities = bodies.objects.iter().zip(&state.velocities);
        let coasts: Vec<Motion> =
            velocities.map(|(body, velocity)| coast(body, velocity, step.duration)).collect();
        let turns: Vec<Turn> = state.poses.iter().map(Pose::turn).collect();
        let scenery =
            Scenery { bodies: &bodies, state, step: &step, coasts: &coasts, turns: &turns, margin };
        let mut contacts = Vec::new();
        match known {
            Some((known, moved)) => find_again(scenery, known, moved, &mut contacts),
            None => find_contacts(scenery, &mut contacts),
        }
        contacts
    };
    let mut state = scene.start();
    let known = found(&state, 0.02, None);
    let mut moved = Vec::new();
    for (k, pose) in state.poses.iter_mut().enumerate() {
        let (shift, turn) = (2e-3 * (k as f64).sin(), 0.03 * (k as f64).cos());
        *pose = Pose::new(pose.position.x + shift, pose.position.y, pose.heading + turn);
        moved.push(shift.abs() + turn.abs() * bodies.objects[k].radius);
    }
    let far = vec![f64::INFINITY; moved.len()];
    let [some, all] = [&moved, &far].map(|moved| found(&state, 6e-3, Some((&known, moved))));
    assert_eq!(format!("{some:?}"), format!("{all:?}"));
    let pairs = |contacts: &[Contact]| contacts.chunk_by(|p, q| p.pair == q.pair).count();
    assert!(
        pairs(&some) >= 3 && pairs(&known) >= 2 * pairs(&some),
        "{} {}",
        pairs(&known),
        pairs(&some)
    );
}
