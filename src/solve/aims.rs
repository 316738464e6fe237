//! First aims of refinement: the goals of the task, farther from the edge of the table where their
//! tolerance allows.

use crate::geometry::Vector;
use crate::scene::TableTop;
use crate::task::{Demand, Goal, Task};

/// Distance from the edge of the table at which objects end safely, metres: the uncertainty that
/// the verifier assumes, and the error of a plan.
const SAFE: f64 = 0.01;

/// Maximum share of the tolerance by which an aim moves away from the edge.
const MOST: f64 = 0.6;

/// Returns the goals of a task, with positions near the edge of the table moved inside.
pub(super) fn first_aims(task: &Task) -> Vec<Goal> {
    let Some(top) = task.scene.table_top else { return task.goals.clone() };
    let aim = |goal: &Goal| {
        let absolute = !goal.falls() && goal.is_pose() && !goal.is_relation();
        let inside = goal.position().filter(|_| absolute).map(|at| inwards(&top, at));
        let most = MOST * goal.tolerance();
        match inside.filter(|inside| *inside != Vector::zeros() && most.is_finite()) {
            None => goal.clone(),
            Some(inside) => {
                let shift = inside * (most / inside.norm()).min(1.0);
                let shifted = |demand: &Demand| demand.kind().shifted(shift);
                Goal { demands: goal.demands.iter().map(shifted).collect(), ..*goal }
            }
        }
    };
    task.goals.iter().map(aim).collect()
}

/// Returns the shift from a point to the nearest one that is [`SAFE`] from the edge of the table.
fn inwards(top: &TableTop, at: Vector) -> Vector {
    let off = at - top.middle;
    let axis = |k: usize| {
        let half = (0.5 * top.size[k] - SAFE).max(0.0);
        off[k].clamp(-half, half) - off[k]
    };
    Vector::new(axis(0), axis(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn aims_keep_away_from_the_edge_within_the_tolerance() {
        let aim = |x: f64, tolerance: f64| {
            let text = format!(
                "scene:\n  table: {{size: [0.8, 0.8], position: [0.55, 0.0], friction: 0.4}}\n  \
                 objects: [{{name: can, shape: {{cylinder: {{radius: 0.04, height: 0.1}}}}, mass: \
                 0.4, friction: 0.4, position: [0.7, 0.1]}}]\nrobot: {{reach: {{min: 0.2, max: \
                 1.1}}}}\ntools: [stick]\ngoal: {{object: can, position: [{x}, 0.1], tolerance: \
                 {tolerance}}}\n"
            );
            let task = Task::parse(&text, "edge.yaml").expect("a sound task");
            first_aims(&task)[0].position().expect("a position")
        };
        // The far edge is at 0.95 m.
        assert!((aim(0.945, 0.02) - Vector::new(0.94, 0.1)).norm() < 1e-9);
        assert!((aim(0.945, 0.005) - Vector::new(0.942, 0.1)).norm() < 1e-9);
        assert!((aim(0.9, 0.02) - Vector::new(0.9, 0.1)).norm() < 1e-9);
    }
}
