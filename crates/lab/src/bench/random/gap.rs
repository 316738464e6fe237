//! Unsolvable tasks: an object in front of a gap that is too narrow for it, with the goal behind.
//!
//! The planner's answers show whether rigid bodies stay rigid in its verdict.

use pushplan::internals::geometry::{Pose, Shape};
use pushplan::internals::{
    scene::{Object, Obstacle, Robot, Scene, Span, Unknowns},
    task::{Goal, Task, ToolChoice},
};
use rand::Rng;
use rand_pcg::Pcg64;

use super::kind::TaskKind;
use super::layout::round;
use super::one_push::pushes;

/// Diameter of a can, or narrower side of a box, metres.
const WIDTH: Span = Span::new(0.04, 0.20);

/// Width of the gap as a share of the object's width.
const SHARE: Span = Span::new(0.50, 0.97);

/// Height of all bodies, metres.
const HEIGHT: f64 = 0.1;

/// Length of the wall on each side of the gap, metres, too long for pushes to lead around it.
const SIDE: f64 = 0.7;

/// Tolerance of the goal, metres, as in the other kinds.
const TOLERANCE: f64 = 0.02;

/// Draws task number `ordinal`: cans and boxes in turn.
pub(super) fn gap_task(rng: &mut Pcg64, ordinal: usize) -> Task {
    let width = round(rng.random_range(WIDTH.low..WIDTH.high), 1e3);
    let gap = round(width * rng.random_range(SHARE.low..SHARE.high), 1e4);
    let (shape, turn) = match ordinal.is_multiple_of(2) {
        true => (Shape::Cylinder { radius: width / 2.0, height: HEIGHT }, 0.0),
        false => {
            let longer = round(width * rng.random_range(1.0..1.6), 1e3);
            let turn =
                if rng.random_bool(0.5) { 0.0 } else { rng.random_range(-30f64..30.0).round() };
            (Shape::Cuboid { size: [longer, width, HEIGHT] }, turn.to_radians())
        }
    };
    let thickness = round(rng.random_range(0.02..0.06), 1e3);
    let radius = shape.footprint().bounding_radius();
    // Everything along x, then rotated about the robot's base.
    let outwards = Pose::new(0.0, 0.0, round(rng.random_range(-1.0..1.0), 1e2));
    let near = round(rng.random_range(0.30..0.45), 1e3);
    let wall = near + radius + rng.random_range(0.01..0.08) + thickness / 2.0;
    let behind = wall + thickness / 2.0 + radius + rng.random_range(0.01..0.06);
    let place = |along: f64, aside: f64, turn: f64| {
        let pose = outwards * Pose::new(along, aside, turn);
        Pose { position: pose.position.map(|x| round(x, 1e4)), ..pose }
    };
    let side = |name: &str, sign: f64| Obstacle {
        name: name.to_owned(),
        size: [thickness, SIDE, HEIGHT],
        pose: outwards * Pose::new(wall, sign * 0.5 * (gap + SIDE), 0.0),
        z: 0.0,
        friction: 0.5,
    };
    let object = Object {
        mass: round(rng.random_range(0.1..2.0), 1e2),
        friction: round(rng.random_range(0.2..0.8), 1e2),
        pose: place(near, rng.random_range(-0.02..0.02), turn),
        ..Object::new("object", shape)
    };
    Task {
        name: format!("gap-{ordinal:04}"),
        description: TaskKind::Gap.title().to_owned(),
        scene: Scene {
            table_friction: round(rng.random_range(0.2..0.8), 1e2),
            objects: vec![object],
            obstacles: vec![side("left", 1.0), side("right", -1.0)],
            ..Scene::default()
        },
        unknown: Unknowns::NONE,
        robot: Robot::reaching(0.1, 0.9),
        arm: None,
        tools: ToolChoice::All,
        tool_costs: Default::default(),
        pushes: pushes(2),
        levers: None,
        goals: vec![Goal::new(0, place(behind, 0.0, 0.0).position.into(), TOLERANCE)],
        robustness: Task::ROBUSTNESS,
    }
}
