//! Positions that lifted tools reach from home.

use std::sync::OnceLock;

use crate::geometry::Vector;
use crate::scene::State;
use crate::task::ReachablePositions;

use super::Workspace;

/// Positions that lifted tools reach from home, by grip, computed when a grip is first asked for.
pub(super) struct Reached<'a> {
    workspace: Workspace<'a>,
    start: State,
    grips: Vec<Grip<'a>>,
}

/// Positions for the first push, and for later ones, before which objects may have moved away.
struct Grip<'a> {
    grip: (usize, f64),
    first: OnceLock<Option<ReachablePositions<'a>>>,
    later: OnceLock<Option<ReachablePositions<'a>>>,
}

impl<'a> Reached<'a> {
    /// Creates the positions of these grips, with the objects in `start`.
    pub fn new(workspace: Workspace<'a>, start: &State, grips: &[(usize, f64)]) -> Self {
        let empty = |grip: &(usize, f64)| Grip {
            grip: *grip,
            first: OnceLock::new(),
            later: OnceLock::new(),
        };
        let grips = grips.iter().map(empty).collect();
        Self { workspace, start: start.clone(), grips }
    }

    /// Returns `false` if a lifted tool certainly cannot travel from home to a position of the end
    /// effector, before the first push or a later one.
    pub fn reach(&self, grip: (usize, f64), position: Vector, first: bool) -> bool {
        let Some(own) = self.grips.iter().find(|own| own.grip == grip) else { return true };
        let (task, tool) = (self.workspace.task, &self.workspace.tools[grip.0]);
        let (known, state) =
            if first { (&own.first, Some(&self.start)) } else { (&own.later, None) };
        let places = known.get_or_init(|| task.places(&task.scene, state, (tool, grip.1)));
        places.as_ref().is_none_or(|places| places.reach(position))
    }
}
