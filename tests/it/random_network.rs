//! Network with random weights, and a scene that uses all its features.

use std::sync::Arc;

use pushplan::contact::{Bodies, FrameProblem, FrameSolver};
use pushplan::effect::PRIOR_RANGES;
use pushplan::geometry::{Pose, Shape};
use pushplan::graph::Batch;
use pushplan::network::{
    Config, Normaliser, Parameters, PredictorCard, PredictorWeights, Source, Tables,
};
use pushplan::{
    scene::{Object, Obstacle, Part, Physics, Scene, State, Tool},
    task::Stroke,
};

/// Returns random weights with a small last layer that is not zero. The network thus has an effect,
/// but rollouts stay near a push and do not amplify rounding.
pub fn weights(width: usize) -> PredictorWeights {
    let config = Config { width, steps: 2 };
    let mut parameters = Parameters::fresh(&config, 3);
    let like = parameters.values["motion.hidden"].clone();
    for name in ["motion.even", "motion.odd"] {
        if let Some(values) = parameters.values.get_mut(name) {
            let count = values.len();
            values.iter_mut().zip(&like[..count]).for_each(|(value, x)| *value = 0.02 * x);
        }
    }
    let batch = batch(&scene(), &scene().start(), &stroke());
    PredictorWeights {
        card: PredictorCard {
            config,
            normaliser: Normaliser::measure(&Tables::PUSHES, &batch),
            ranges: PRIOR_RANGES,
            sources: vec![Source {
                truth: "none".to_owned(),
                seed: 0,
                episodes: 0,
                digest: String::new(),
            }],
            steps: 0,
            errors: None,
            share: 1.0,
            row_scale: 1.0,
            doubt: None,
        },
        parameters,
    }
}

pub fn object(shape: Shape, x: f64, y: f64, heading: f64) -> Object {
    Object::new(format!("{x} {y}"), shape).friction(0.5).at(x, y, heading)
}

/// Returns a box against the tool, a cylinder against the box, a heavier box beside both, and an
/// obstacle.
pub fn scene() -> Scene {
    Scene::new([
        object(Shape::Cuboid { size: [0.08, 0.05, 0.1] }, 0.075, 0.012, 0.2),
        object(Shape::Cylinder { radius: 0.04, height: 0.1 }, 0.165, 0.02, 0.0),
        object(Shape::Cuboid { size: [0.05, 0.05, 0.1] }, 0.12, 0.09, 0.7).mass(1.1),
    ])
    .on_table(0.4)
    .with_obstacle(Obstacle::cuboid("wall", [0.02, 0.2, 0.1]).at(0.22, -0.05, 0.1).friction(0.3))
}

pub fn tool() -> Arc<Tool> {
    let part = |name: &str, size, pose| Part::cuboid(name, size, pose);
    let parts = vec![
        part("bar", [0.04, 0.16, 0.05], Pose::default()),
        part("side", [0.06, 0.03, 0.05], Pose::new(0.05, -0.065, 0.0)),
    ];
    let joints = [[0, 1]];
    Arc::new(Tool::joined("t", parts, &joints).expect("one piece").friction(0.6))
}

pub fn stroke() -> Stroke {
    let to = Pose::new(0.1, 0.02, 0.0);
    Stroke { from: Pose::default(), to, duration: 1.0, settle: true }
}

/// Returns half of the stroke, which ends before contact with the wall, because in a jam a random
/// network amplifies rounding errors to centimetres.
pub fn half_stroke() -> Stroke {
    Stroke { to: Pose::new(0.05, 0.01, 0.0), duration: 0.5, settle: false, ..stroke() }
}

pub fn batch(scene: &Scene, state: &State, stroke: &Stroke) -> Batch {
    let mut batch = Batch::default();
    let bodies = Bodies::new(scene, &tool(), 0.002, &Physics::stated(scene));
    let axis = (stroke.to.position - stroke.from.position).normalize();
    add_graph(&mut batch, 0, FrameProblem { bodies: &bodies, state, step: &stroke.frame(0), axis });
    batch
}

/// Adds the graph of a frame.
pub fn add_graph(batch: &mut Batch, graph: u32, problem: FrameProblem<'_>) {
    let mut solver = FrameSolver::default();
    let (frame, forces) = solver.solve_with_forces(problem);
    batch.add(graph, &frame, &forces);
}
