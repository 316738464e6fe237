//! Lever-ups specified by a user, without a search.

use std::sync::Arc;

use thiserror::Error;

use crate::plan::lever::LeverRoom;
use crate::{
    outcome::LeverFault,
    scene::Tool,
    task::{LeverUp, Pivot, Place, Plan, Task},
};

/// Lever-up specified by a user.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ManualLever {
    /// Lever point of the blade.
    pub place: ManualPlace,
    /// Depth of the tip behind the edge, metres.
    pub depth: f64,
    /// Angle of the rotation, radians.
    pub angle: f64,
    /// Place of the axis.
    pub pivot: Pivot,
    /// Speed of the tip, m/s; `None` for the task's speed.
    pub speed: Option<f64>,
}

/// Place on the outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ManualPlace {
    /// Edge and fraction along it, 0 to 1.
    Edge(usize, f64),
    /// Distance along the outline from the first corner, metres.
    Along(f64),
}

/// Error of a lever-up that cannot be made.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum LeverActionError {
    /// The outline does not have the edge.
    #[error("the object has {edges} edges, counted from 0; there is no edge {edge}")]
    NoEdge {
        /// Index of the edge.
        edge: usize,
        /// Number of edges.
        edges: usize,
    },
    /// No axis follows from the plate.
    #[error("this lever point defines no support line; give the pivot as a number")]
    NoSupport,
}

/// Returns the plan of the specified lever-up, and a rule that it violates. Such plans are allowed,
/// because their outcome may be of interest.
///
/// # Errors
/// Returns [`LeverActionError`] if the lever-up does not exist.
pub fn manual_lever(
    task: &Task,
    tool: &Arc<Tool>,
    asked: &ManualLever,
) -> Result<(Plan, Option<LeverFault>), LeverActionError> {
    let plate = task.plate();
    let corners = plate.corners();
    let edges = corners.len();
    let side = |edge: usize| (corners[(edge + 1) % edges] - corners[edge]).norm();
    let place = match asked.place {
        ManualPlace::Edge(edge, _) if edge >= edges => {
            return Err(LeverActionError::NoEdge { edge, edges });
        }
        ManualPlace::Edge(edge, fraction) => Place { edge, fraction },
        ManualPlace::Along(way) => {
            let around: f64 = (0..edges).map(side).sum();
            let mut left = way.rem_euclid(around);
            let mut edge = 0;
            while edge + 1 < edges && left > side(edge) {
                left -= side(edge);
                edge += 1;
            }
            Place { edge, fraction: (left / side(edge)).clamp(0.0, 1.0) }
        }
    };
    let pivot = match asked.pivot {
        Pivot::Auto => plate.auto_pivot(place).ok_or(LeverActionError::NoSupport)?,
        Pivot::At(distance) => distance,
    };
    let rules = &task.lever_rules();
    let lever = LeverUp {
        plate: task.levered().object,
        place,
        depth: asked.depth,
        pivot,
        angle: asked.angle,
        speed: asked.speed.unwrap_or(rules.speed),
        hold: rules.hold,
        retreat: rules.retreat,
    };
    let violation = LeverRoom::new(task, tool).fault(&lever);
    Ok((Plan::levering(&tool.name, lever), violation))
}
