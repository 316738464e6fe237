//! Plans that take another tool, or hold it otherwise, between pushes.

use crate::plan::Search;

use super::solving::Solving;

impl<'a> Solving<'a> {
    /// Looks at plans that take another tool or hold it otherwise between pushes, where none with one grip is
    /// even predicted to reach the goal: `usual` has looked at those.
    pub(super) fn change_grips(&mut self, usual: &Search<'a>) {
        if self.tried.iter().any(|tried| tried.verdict.is_some()) {
            return;
        }
        let Some(mut search) = usual.changing() else { return };
        while self.goes_on(search.depth()) && search.can_deepen() {
            self.attempt(&mut search);
        }
    }
}
