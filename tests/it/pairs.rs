//! A pair of bodies keeps its id through a whole rollout, regardless of which pairs are listed,
//! awake or in contact.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use pushplan::{
    contact::{PairId, Pairs},
    geometry::{Pose, Vector},
    graph::{Batch, GIVEN},
    outcome::Record,
    rollout::{RollSettings, Roller},
    scene::{Body, JointKind, ModelKind, Object, Obstacle, Part, Scene, Tool},
    task::{Job, Push, ToolMotion},
};

/// Returns rows of discs with different radii, so that a node's support identifies its object, with
/// a jointed pair and a wall behind.
fn scene() -> Scene {
    let object = |k: usize| {
        let (x, y) = (0.1 + 0.075 * (k / 3) as f64, 0.08 * ((k % 3) as f64 - 1.0));
        let disc = Object::cylinder(format!("{k}"), 0.02 + 0.001 * k as f64, 0.1);
        disc.mass(0.3).at(x, y, 0.0)
    };
    let pin = JointKind::Revolute { at: Vector::new(0.14, 0.0), limits: None };
    let wall = Obstacle::cuboid("wall", [0.02, 0.4, 0.1]).at(0.42, 0.0, 0.0).friction(0.4);
    Scene::new((0..12).map(object)).with_joint([4, 1], pin).with_obstacle(wall)
}

fn motion() -> ToolMotion {
    let part = Part::cuboid("bar", [0.02, 0.1, 0.05], Pose::default());
    let tool = Tool::new("bar", [part]);
    let tool = Arc::new(tool.expect("one piece"));
    let push = |y| Push { start: Vector::new(0.04, y), direction: 0.0, length: 0.25, speed: 0.1 };
    ToolMotion::pushes(tool, 0.002, 0.0, &[push(-0.05), push(0.05)], true)
}

#[test]
fn every_relation_carries_the_lasting_id_of_its_pair() {
    let scene = scene();
    let pairs = Pairs::new(scene.objects.len(), scene.obstacles.len(), 1);
    let supports: Vec<f64> = scene.objects.iter().map(|object| object.feet().mean_radius).collect();
    let which = |support: f64| supports.iter().position(|own| *own == support).expect("an object");
    // Relations of every pair over all frames; a pair has at most four in one.
    let mut relations: HashMap<PairId, usize> = HashMap::new();
    let mut look = |batch: &Batch| {
        for (relation, &pair) in batch.pairs.iter().enumerate() {
            let object = |node: u32| which(batch.nodes[node as usize].support);
            let (first, with) = pairs.bodies(pair);
            let receiver = object(batch.receivers[relation]);
            match (with, batch.senders[relation]) {
                (Body::Object(second), sender) => {
                    let mut found = [receiver, object(sender)];
                    found.sort_unstable();
                    assert_eq!(found, [first.0, second]);
                }
                (_, sender) => {
                    assert_eq!(receiver, first.0);
                    assert!((sender - GIVEN) < batch.given_count() as u32);
                }
            }
            *relations.entry(pair).or_default() += 1;
        }
    };
    let job = Job::stated(&scene, motion());
    let mut roller = Roller::new(ModelKind::PRIOR.into(), RollSettings::default());
    let (readings, batch) = roller.read(&scene, &[job], Record::Outcome);
    look(batch);
    // Several objects must have moved, and pairs of every kind must have lasted.
    let objects: HashSet<u32> = readings[0].reads.iter().map(|read| read.object).collect();
    assert!(objects.len() > 3, "{objects:?}");
    let lasted = |wanted: &dyn Fn(Body) -> bool| {
        relations.iter().any(|(pair, count)| *count > 8 && wanted(pairs.bodies(*pair).1))
    };
    assert!(lasted(&|body| matches!(body, Body::Object(_))));
    assert!(lasted(&|body| matches!(body, Body::Part(_))));
    assert!(lasted(&|body| matches!(body, Body::Obstacle(_))));
}
