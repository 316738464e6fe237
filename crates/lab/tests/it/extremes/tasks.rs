//! Whole tasks with extreme numbers, solved by the planner.

use std::sync::Arc;

use pushplan::{
    asset::ToolLibrary,
    effect::EffectModel,
    geometry::{Pose, Vector},
    scene::Obstacle,
    solve::{Effort, PlanStatus, Planner, Solution},
    task::Task,
};
use pushplan_lab::bench::random_task;

/// Expected result of a task.
#[derive(Clone, Copy)]
enum Expected {
    /// A plan that works, with at most this many pushes.
    Solved(usize),
    /// No plan that works.
    Unsolved,
    /// No claim that is not finite.
    Anything,
    /// A refusal.
    Refused,
}

/// A change that makes a task extreme.
type Change = fn(&mut Task);

/// Result of a task.
#[derive(Clone, Debug, PartialEq)]
pub struct TaskCell {
    pub name: &'static str,
    /// Final status; `None` if the task was refused.
    pub status: Option<PlanStatus>,
    /// Number of pushes of the first plan.
    pub pushes: Option<usize>,
    /// Its predicted error, metres.
    pub error: Option<f64>,
    pub rollouts: usize,
    /// Whether the result is the expected one.
    pub sound: bool,
}

const TASKS: [(&str, Expected, Change); 20] = [
    ("ordinary task", Expected::Solved(1), |_| {}),
    ("goal at the start", Expected::Solved(0), |task| {
        let at = task.scene.objects[0].pose.position;
        task.goals[0].set_position(at);
    }),
    ("goal and heading at the start, 1000 turns on", Expected::Solved(0), |task| {
        let pose = task.scene.objects[0].pose;
        task.goals[0].set_position(pose.position);
        let turned = pose.heading + 1000.0 * std::f64::consts::TAU;
        task.goals[0] = task.goals[0].clone().facing(turned, 0.1);
    }),
    ("goal 1e6 m away", Expected::Unsolved, |task| {
        task.goals[0].set_position(Vector::new(1e6, 0.0))
    }),
    ("goal 1e6 m away, tolerance 1e7 m", Expected::Solved(0), |task| {
        task.goals[0].set_position(Vector::new(1e6, 0.0));
        task.goals[0].set_tolerance(1e7);
    }),
    ("goal 1e150 m away", Expected::Unsolved, |task| {
        task.goals[0].set_position(Vector::new(1e150, 0.0))
    }),
    ("tolerance 1e-9 m", Expected::Unsolved, |task| task.goals[0].set_tolerance(1e-9)),
    ("tolerance 1e-300 m", Expected::Unsolved, |task| task.goals[0].set_tolerance(1e-300)),
    ("reach of 1 mm", Expected::Unsolved, |task| {
        task.robot.reach_min = 0.0;
        task.robot.reach_max = 0.001;
    }),
    ("everything 1 km from the base", Expected::Unsolved, |task| {
        let far = Vector::new(1000.0, 0.0);
        task.scene.objects[0].pose.position += far;
        let place = task.goals[0].position().unwrap();
        task.goals[0].set_position(place + far);
    }),
    ("walled in", Expected::Unsolved, |task| {
        let at = task.scene.objects[0].pose.position;
        task.goals[0].set_position(at + Vector::new(0.3, 0.0));
        for (k, (x, y)) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)].iter().enumerate() {
            let size = [0.02 + 0.3 * f64::abs(*y), 0.02 + 0.3 * f64::abs(*x), 0.2];
            let pose = Pose { position: at + 0.13 * Vector::new(*x, *y), heading: 0.0 };
            task.scene.obstacles.push(Obstacle {
                name: format!("wall-{k}"),
                size,
                pose,
                z: 0.0,
                friction: 0.5,
            });
        }
    }),
    ("pushes of 1 mm", Expected::Unsolved, |task| task.pushes.length = 0.001),
    ("pushes of 100 m within a reach of 0.9 m", Expected::Anything, |task| {
        task.pushes.length = 100.0;
    }),
    ("64 directions, 9 grip yaws", Expected::Solved(1), |task| {
        task.pushes.directions = pushplan::task::Directions::Count(64);
        task.pushes.grip_yaws = (0..9).map(f64::from).collect();
    }),
    ("friction 0", Expected::Anything, |task| {
        task.scene.objects[0].friction = 0.0;
        task.scene.table_friction = 0.0;
    }),
    ("mass 1e-6 kg", Expected::Anything, |task| task.scene.objects[0].mass = 1e-6),
    ("goal that is not a number", Expected::Refused, |task| {
        task.goals[0].set_position(Vector::new(f64::NAN, 0.0))
    }),
    ("infinite tolerance", Expected::Refused, |task| task.goals[0].set_tolerance(f64::INFINITY)),
    ("friction that is not a number", Expected::Refused, |task| {
        task.scene.table_friction = f64::NAN
    }),
    ("negative mass", Expected::Refused, |task| task.scene.objects[0].mass = -1.0),
];

/// Solves all tasks with draft effort.
pub fn solved(model: &Arc<dyn EffectModel>, library: &ToolLibrary, seed: u64) -> Vec<TaskCell> {
    let planner = Planner::builder(Arc::clone(model)).effort(Effort::Draft).build();
    TASKS
        .into_iter()
        .map(|(name, expected, change)| {
            // A cuboid, because headings count.
            let mut task = random_task(library, seed, 1);
            change(&mut task);
            judged(name, expected, planner.solve(&task, library).ok())
        })
        .collect()
}

/// Judges a solution; `None` is a refused task.
fn judged(name: &'static str, expected: Expected, solution: Option<Solution>) -> TaskCell {
    let best = solution.as_ref().and_then(Solution::best);
    let status = solution.as_ref().map(|solution| solution.status);
    let pushes = best.map(|plan| plan.plan.pushes().len());
    let finite =
        best.is_none_or(|plan| plan.outcome.error().is_finite() && plan.outcome.state.is_finite());
    let sound = match (expected, status) {
        (Expected::Refused, status) => status.is_none(),
        (_, None) => false,
        (Expected::Solved(most), status) => {
            status == Some(PlanStatus::Solved) && pushes.is_some_and(|pushes| pushes <= most)
        }
        (Expected::Unsolved, status) => status != Some(PlanStatus::Solved),
        (Expected::Anything, _) => true,
    };
    TaskCell {
        name,
        status,
        pushes,
        error: best.map(|plan| plan.outcome.error()),
        rollouts: solution.as_ref().map_or(0, |solution| solution.statistics.rollouts),
        sound: sound && finite,
    }
}
