//! Positions that lifted tools reach from home.

use std::sync::OnceLock;

use crate::geometry::Vector;
use crate::scene::State;
use crate::task::Places;

use super::Workspace;

/// Positions that lifted tools reach from home, by grip, computed when a grip is first asked for.
pub(super) struct Reached<'a> {
    workspace: Workspace<'a>,
    start: State,
    grips: Vec<((usize, f64), OnceLock<Option<Places<'a>>>)>,
}

impl<'a> Reached<'a> {
    /// Creates the positions of these grips, with the objects in `start`.
    pub fn new(workspace: Workspace<'a>, start: &State, grips: &[(usize, f64)]) -> Self {
        let grips = grips.iter().map(|grip| (*grip, OnceLock::new())).collect();
        Self { workspace, start: start.clone(), grips }
    }

    /// Returns `true` if a lifted tool can travel from home to a position of the end effector.
    pub fn reach(&self, grip: (usize, f64), position: Vector) -> bool {
        let Some((_, places)) = self.grips.iter().find(|(own, _)| *own == grip) else {
            return true;
        };
        let (task, tools) = (self.workspace.task, self.workspace.tools);
        let places =
            places.get_or_init(|| task.places(&task.scene, &self.start, (&tools[grip.0], grip.1)));
        places.as_ref().is_none_or(|places| places.reach(position))
    }
}
