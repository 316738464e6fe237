//! Whole tasks with extreme numbers: what the planner makes of them.

use std::sync::Arc;

use crate::{
    asset::ToolLibrary,
    bench::random_task,
    effect::EffectModel,
    geometry::{Pose, Vector},
    scene::{Obstacle, Task},
    solve::{Effort, PlanStatus, Planner},
};

use super::report::TaskCell;

/// What should come of a task.
#[derive(Clone, Copy)]
enum Expected {
    /// A plan that works, of at most this many pushes.
    Solved(usize),
    /// No plan that works.
    Unsolved,
    /// No claim that is not finite.
    Anything,
    /// A refusal.
    Refused,
}

/// Something that makes a task extreme.
type Change = fn(&mut Task);

/// Numbers of [`tasks`].
pub(super) const COUNT: usize = TASKS.len();

const TASKS: [(&str, Expected, Change); 20] = [
    ("an ordinary one", Expected::Solved(1), |_| {}),
    ("goal at the start", Expected::Solved(0), |task| {
        task.goal.position = task.scene.objects[0].pose.position;
    }),
    ("goal and heading at the start, 1000 turns on", Expected::Solved(0), |task| {
        let pose = task.scene.objects[0].pose;
        task.goal.position = pose.position;
        task.goal.heading = Some((pose.heading + 1000.0 * std::f64::consts::TAU, 0.1));
    }),
    ("goal 1e6 m away", Expected::Unsolved, |task| task.goal.position = Vector::new(1e6, 0.0)),
    ("goal 1e6 m away, tolerance 1e7 m", Expected::Solved(0), |task| {
        task.goal.position = Vector::new(1e6, 0.0);
        task.goal.tolerance = 1e7;
    }),
    ("goal 1e150 m away", Expected::Unsolved, |task| task.goal.position = Vector::new(1e150, 0.0)),
    ("tolerance 1e-9 m", Expected::Unsolved, |task| task.goal.tolerance = 1e-9),
    ("tolerance 1e-300 m", Expected::Unsolved, |task| task.goal.tolerance = 1e-300),
    ("reach of 1 mm", Expected::Unsolved, |task| {
        task.robot.reach_min = 0.0;
        task.robot.reach_max = 0.001;
    }),
    ("everything 1 km from the base", Expected::Unsolved, |task| {
        let far = Vector::new(1000.0, 0.0);
        task.scene.objects[0].pose.position += far;
        task.goal.position += far;
    }),
    ("walled in", Expected::Unsolved, |task| {
        let at = task.scene.objects[0].pose.position;
        task.goal.position = at + Vector::new(0.3, 0.0);
        for (k, (x, y)) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)].iter().enumerate() {
            let size = [0.02 + 0.3 * f64::abs(*y), 0.02 + 0.3 * f64::abs(*x), 0.2];
            let pose = Pose { position: at + 0.13 * Vector::new(*x, *y), heading: 0.0 };
            task.scene.obstacles.push(Obstacle {
                name: format!("wall-{k}"),
                size,
                pose,
                friction: 0.5,
            });
        }
    }),
    ("pushes of 1 mm", Expected::Unsolved, |task| task.pushes.length = 0.001),
    ("pushes of 100 m within a reach of 0.9 m", Expected::Anything, |task| {
        task.pushes.length = 100.0;
    }),
    ("64 directions, 9 grip yaws", Expected::Solved(1), |task| {
        task.pushes.directions = crate::scene::Directions::Count(64);
        task.pushes.grip_yaws = (0..9).map(f64::from).collect();
    }),
    ("friction 0", Expected::Anything, |task| {
        task.scene.objects[0].friction = 0.0;
        task.scene.table_friction = 0.0;
    }),
    ("mass 1e-6 kg", Expected::Anything, |task| task.scene.objects[0].mass = 1e-6),
    ("goal that is no number", Expected::Refused, |task| task.goal.position.x = f64::NAN),
    ("infinite tolerance", Expected::Refused, |task| task.goal.tolerance = f64::INFINITY),
    ("friction that is no number", Expected::Refused, |task| task.scene.table_friction = f64::NAN),
    ("negative mass", Expected::Refused, |task| task.scene.objects[0].mass = -1.0),
];

/// Solves task `index` with a first look's effort.
pub(super) fn solve(
    model: &Arc<dyn EffectModel>,
    library: &ToolLibrary,
    seed: u64,
    index: usize,
) -> TaskCell {
    let (name, expected, change) = TASKS[index];
    // A cuboid: headings count.
    let mut task = random_task(library, seed, 1);
    change(&mut task);
    let planner = Planner::builder(Arc::clone(model)).effort(Effort::Draft).build();
    let mut cell = TaskCell {
        name: name.into(),
        status: None,
        refused: None,
        pushes: None,
        error: None,
        rollouts: 0,
        sound: false,
    };
    match planner.solve(&task, library) {
        Err(refused) => {
            cell.refused = Some(refused.to_string());
            cell.sound = matches!(expected, Expected::Refused);
        }
        Ok(solution) => {
            let best = solution.best();
            let finite = best.is_none_or(|plan| {
                plan.outcome.error.is_finite() && plan.outcome.state.is_finite()
            });
            cell.status = Some(solution.status);
            cell.pushes = best.map(|plan| plan.plan.pushes.len());
            cell.error = best.map(|plan| plan.outcome.error);
            cell.rollouts = solution.statistics.rollouts;
            let solved = solution.status == PlanStatus::Solved;
            cell.sound = finite
                && match expected {
                    Expected::Solved(most) => solved && cell.pushes.is_some_and(|n| n <= most),
                    Expected::Unsolved => !solved,
                    Expected::Anything => true,
                    Expected::Refused => false,
                };
        }
    }
    cell
}
