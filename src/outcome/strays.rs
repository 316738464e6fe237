//! Detection of objects that leave the table or enter keep-out regions.

use crate::scene::{Region, Scene, State};

use super::Warning;

impl Scene {
    /// Returns a warning about the first object inside a keep-out region or nearer to one than
    /// `margin`, metres.
    pub fn kept_out(&self, state: &State, margin: f64) -> Option<Warning> {
        let regions = || self.keep_out.iter().filter(|region| region.objects);
        // Most scenes have no keep-out regions.
        regions().next()?;
        if let Some(space) = &state.space {
            let mut all = self.plates().zip(space);
            return all.find_map(|(plate, pose)| {
                let solids = plate.solids_at(pose);
                let region = regions().find(|region| region.holds_in_space(&solids))?;
                Some(Warning::KeptOut { object: plate.name, region: region.name.clone() })
            });
        }
        self.objects.iter().zip(&state.poses).find_map(|(object, pose)| {
            let footprint = object.shape.footprint();
            // An object that starts within the margin may stay there.
            let margin = |region: &Region| {
                if region.holds(&footprint, &object.pose, margin) { 0.0 } else { margin }
            };
            let region = regions().find(|region| region.holds(&footprint, pose, margin(region)))?;
            let (object, region) = (object.name.clone(), region.name.clone());
            Some(Warning::KeptOut { object, region })
        })
    }

    /// Returns a warning about the first object that left the table without permission or entered a
    /// keep-out region.
    pub fn strays(&self, state: &State, margin: f64) -> Option<Warning> {
        let name = |object: usize| self.objects[object].name.clone();
        let off = self.off_table(state).map(|object| Warning::OffTable { object: name(object) });
        off.or_else(|| self.kept_out(state, margin))
    }

    /// Returns warnings about objects that toppled or left the table by the end and are allowed to.
    pub fn fallen(&self, state: &State, toppled: &[usize]) -> Vec<Warning> {
        let may = self.things().filter(|(_, object)| object.may_fall).map(|(k, _)| k);
        let fell = may.filter(|k| toppled.contains(k) || self.has_left(*k, state));
        fell.map(|k| Warning::Fell { object: self.objects[k].name.clone() }).collect()
    }
}
