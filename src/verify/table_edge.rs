//! Ends near the edge of the table.

use crate::outcome::Warning;
use crate::scene::{Scene, State};
use crate::task::Task;

/// Uncertainty of a final position relative to the edge of the table, metres: the sum for the edge
/// and the object's pose. In MuJoCo, objects that end 4 to 5 mm inside the edge fall.
const UNCERTAIN: f64 = 0.006;

/// Displacement from which an object counts as moved, metres: more than a perturbation.
const MOVED: f64 = 0.003;

/// Returns a warning about the first moved object that may not fall and whose centre ends within
/// the uncertainty of the table's edge. Objects that already stand there are not moved by a plan
/// that leaves them.
pub(super) fn near_edge(task: &Task, scene: &Scene, end: &State) -> Option<Warning> {
    let top = task.scene.table_top?;
    scene.things().filter(|(_, object)| !object.may_fall).find_map(|(k, object)| {
        let moved = (end.poses[k].position - object.pose.position).norm() > MOVED;
        let off = scene.centre(k, end) - top.middle;
        let inside = (0.5 * top.size[0] - off.x.abs()).min(0.5 * top.size[1] - off.y.abs());
        let near = moved && (0.0..UNCERTAIN).contains(&inside);
        near.then(|| Warning::NearEdge { object: object.name.clone(), inside })
    })
}
