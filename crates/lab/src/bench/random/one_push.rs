//! Tasks of one object and one push. The goal is the final pose after a random allowed push of a
//! shipped tool in the 2-D engine.

use std::f64::consts::{FRAC_PI_8, TAU};
use std::sync::Arc;

use pushplan::internals::asset::ToolLibrary;
use pushplan::internals::effect::Simulated;
use pushplan::internals::geometry::{Pose, Vector};
use pushplan::internals::plan::{Candidate, CandidatePush, Rollouts, Start, Workspace, evaluate};
use pushplan::internals::seeded::generator;
use pushplan::internals::sim::Simulator;
use pushplan::internals::{
    scene::{Ranges, Robot, Scene, Situation, Span, Tool},
    task::{Directions, Goal, PushRules, Task},
};
use pushplan_learn::dataset::{Crowd, Preset, Solids, random_scene};
use rand::Rng;
use rand_pcg::Pcg64;

/// Distance of the object from the robot's base, metres.
const PLACES: Span = Span::new(0.35, 0.80);

/// Smallest distance of the goal from the object's start, metres; otherwise doing nothing would
/// nearly solve the task.
const FARTHEST_TRIVIAL: f64 = 0.05;

/// Tolerance of the goal, metres.
const TOLERANCE: f64 = 0.03;

/// Travel of the pushes that define goals, metres. Refinement may extend it to 0.30.
pub(super) const TRAVEL: Span = Span::new(0.08, 0.28);

/// Number of directions in the search. Refinement rotates them by more than half their spacing, so
/// every direction is reachable.
pub(super) const WAYS: usize = 8;

/// Returns the `index`-th random one-object, one-push task under `seed`, for the tools of
/// `library`, which must hold at least one.
pub fn random_task(library: &ToolLibrary, seed: u64, index: usize) -> Task {
    let mut rng = generator(seed ^ 0x7A5C, index as u64);
    let ranges = moderate();
    let tools: Vec<Arc<Tool>> = library.iter().cloned().collect();
    let planar = Simulated::new(Simulator::planar());
    // Drawn again until the push is feasible and moves the object; a few draws on average.
    loop {
        let mut task = open_task(&mut rng, &ranges, index);
        let candidate = random_candidate(&mut rng, &task, &tools);
        let workspace = Workspace { task: &task, tools: &tools };
        let scene = task.scene.clone();
        let mut rollouts = Rollouts::new(&planar, Situation::stated(&scene));
        let Some(Ok(made)) = evaluate(&workspace, &mut rollouts, &[candidate]).pop() else {
            continue;
        };
        let (start, end) = (task.scene.objects[0].pose, made.outcome.poses[0]);
        let moved = (end.position - start.position).norm();
        if made.is_feasible() && made.is_sound() && moved > FARTHEST_TRIVIAL {
            task.goals[0].set_position(end.position);
            return task;
        }
    }
}

/// Returns the push rules of random tasks, with up to `max_count` pushes.
pub(super) fn pushes(max_count: usize) -> PushRules {
    PushRules { directions: Directions::Count(WAYS), max_count, ..PushRules::default() }
}

/// Returns ranges of objects that a hand can push: the middle of the training ranges.
pub(super) fn moderate() -> Ranges {
    Ranges {
        mass: Span::new(0.1, 2.0),
        friction: Span::new(0.2, 0.8),
        radius: Span::new(0.025, 0.06),
        side: Span::new(0.04, 0.15),
        aspect: 3.0,
        ..Preset::Tools.ranges()
    }
}

/// Draws a task with its goal at the object's start.
fn open_task(rng: &mut Pcg64, ranges: &Ranges, index: usize) -> Task {
    let solids = if index.is_multiple_of(2) { Solids::Cylinders } else { Solids::Cuboids };
    let mut scene: Scene =
        random_scene(rng, ranges, Crowd { count: 1, solids, touching: 0.0, polygons: 0.0 });
    let (distance, angle) =
        (rng.random_range(PLACES.low..PLACES.high), rng.random_range(-1.2..1.2f64));
    let position = distance * Vector::new(angle.cos(), angle.sin());
    for object in &mut scene.objects {
        object.pose = Pose { position, heading: object.pose.heading };
    }
    let robot = Robot { home: Vector::zeros(), ..Robot::reaching(0.1, 0.9) };
    let goal = Goal::new(0, position.into(), TOLERANCE);
    Task::new(format!("random-{index}"), scene, robot, goal).pushing(pushes(1))
}

/// Draws a push that the planner could find, with continuous parameters.
fn random_candidate(rng: &mut Pcg64, task: &Task, tools: &[Arc<Tool>]) -> Candidate {
    let tool = rng.random_range(0..tools.len());
    let yaws = &task.pushes.grip_yaws;
    let grip_yaw = yaws[rng.random_range(0..yaws.len())];
    let part = rng.random_range(0..tools[tool].parts().len());
    let way = TAU / WAYS as f64 * f64::from(rng.random_range(0..WAYS as u32));
    let direction = way + rng.random_range(-FRAC_PI_8..FRAC_PI_8);
    let workspace = Workspace { task, tools };
    let (start, object) = (task.scene.start(), task.goals[0].object);
    let span = workspace.offset_span((tool, grip_yaw), (&start, object), part, direction);
    let offset = rng.random_range(-span..=span);
    let length = rng.random_range(TRAVEL.low..TRAVEL.high);
    let start = Start::Placed { part, offset };
    let push = CandidatePush { tool, grip_yaw, object, start, direction, length, room: 0.0 };
    Candidate { pushes: vec![push] }
}
