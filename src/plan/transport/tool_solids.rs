//! Solids of a tool and of the hand that holds it.

use crate::geometry::{Pose, Vector};
use crate::plan::Workspace;
use crate::plan::workspace::{HAND_CLEARANCE, OBSTACLE_CLEARANCE};
use crate::scene::Mover;

use super::lattice::Solid;

/// Returns the solids of the tool and of the hand at the height of objects, relative to the end
/// effector.
pub(super) fn tool_solids(
    workspace: &Workspace,
    (tool, yaw): (usize, f64),
) -> impl Iterator<Item = (Solid, Mover)> {
    let (task, tool) = (workspace.task, &*workspace.tools[tool]);
    let frame = tool.pose(Pose { position: Vector::zeros(), heading: yaw });
    let lift = task.pushes.lift;
    let parts = tool.parts().iter().map(move |part| {
        let solid = Solid {
            footprint: part.footprint(),
            pose: frame * part.pose,
            span: [lift, lift + part.shape.height()],
            apart: OBSTACLE_CLEARANCE,
        };
        (solid, Mover::Tool)
    });
    let carried = task.robot.carried(tool, lift).into_iter().flatten().map(move |one| {
        let solid = Solid {
            footprint: one.footprint,
            pose: frame * one.pose,
            span: one.span,
            apart: HAND_CLEARANCE,
        };
        let mover = if solid.span[0] <= lift { Mover::Tool } else { Mover::Hand };
        (solid, mover)
    });
    parts.chain(carried)
}
