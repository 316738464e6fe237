//! Searches that begin again from the same start for other kinds of plans.

use crate::plan::SweptRegion;
use crate::plan::enumerate::Grips;
use crate::task::Offsets;

use super::{Search, SearchSettings};

impl Search<'_> {
    /// Returns a new search for plans that may change the tool and grip before every push. Returns
    /// `None` if this makes no difference.
    pub fn changing(&self) -> Option<Self> {
        let grips = self.grips.changing(&self.workspace)?;
        let kept = (self.field.clone(), self.spread.clone());
        Some(Self::from_start(self.workspace, &self.situation, self.settings, kept, grips))
    }

    /// Returns a new search in which offsets between infeasible ones are tried as well. Returns
    /// `None` if it already does so, or if the task lists its offsets.
    pub fn with_fine_offsets(&self) -> Option<Self> {
        let adapts = self.workspace.task.pushes.offsets == Offsets::Effort;
        let any = adapts && self.workspace.is_placed() && !self.settings.fine_offsets;
        let settings = SearchSettings { fine_offsets: true, ..self.settings };
        let kept = (self.field.clone(), self.spread.clone());
        let grips = self.grips.clone();
        any.then(|| Self::from_start(self.workspace, &self.situation, settings, kept, grips))
    }

    /// Returns a new search for plans that first clear the swept region `corridor` of another plan,
    /// with that plan's tool and grip yaw (radians).
    pub fn clearing(&self, corridor: SweptRegion, grip: (usize, f64)) -> Self {
        let field = self.field.clone().clearing(corridor);
        let kept = (field, self.spread.clone());
        let grips = Grips { all: vec![grip], changes: None };
        Self::from_start(self.workspace, &self.situation, self.settings, kept, grips)
    }

    /// Sets the position uncertainty for the first push, metres, if earlier pushes lead to the
    /// start.
    pub(in crate::plan) fn with_first_room(mut self, room: f64) -> Self {
        self.nodes.iter_mut().for_each(|node| node.room = room);
        self
    }
}
