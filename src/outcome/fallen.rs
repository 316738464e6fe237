//! Warnings about objects that fall and are allowed to.

use crate::scene::{Scene, State};

use super::Warning;

impl Scene {
    /// Returns warnings about objects that toppled or left the table by the end and are allowed to.
    pub fn fallen(&self, state: &State, toppled: &[usize]) -> Vec<Warning> {
        let may = self.things().filter(|(_, object)| object.may_fall).map(|(k, _)| k);
        let fell = may.filter(|k| toppled.contains(k) || self.has_left(*k, state));
        fell.map(|k| Warning::Fell { object: self.objects[k].name.clone() }).collect()
    }
}
