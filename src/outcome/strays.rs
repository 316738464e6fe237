//! Objects that leave the table or enter regions that they must keep out of.

use crate::scene::{Region, Scene, State};

use super::Warning;

impl Scene {
    /// The first object that is where objects keep out, or nearer to it than `margin` metres.
    pub fn kept_out(&self, state: &State, margin: f64) -> Option<Warning> {
        let regions = || self.keep_out.iter().filter(|region| region.objects);
        // Most scenes have none.
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
            // What stands nearer at first may go on standing there.
            let margin = |region: &Region| {
                if region.holds(&footprint, &object.pose, margin) { 0.0 } else { margin }
            };
            let region = regions().find(|region| region.holds(&footprint, pose, margin(region)))?;
            let (object, region) = (object.name.clone(), region.name.clone());
            Some(Warning::KeptOut { object, region })
        })
    }

    /// The first object that left the table and may not, or is where objects keep out.
    pub fn strays(&self, state: &State, margin: f64) -> Option<Warning> {
        let name = |object: usize| self.objects[object].name.clone();
        let off = self.off_table(state).map(|object| Warning::OffTable { object: name(object) });
        off.or_else(|| self.kept_out(state, margin))
    }

    /// What toppled or left the table by the end, though it may.
    pub fn fallen(&self, state: &State, toppled: &[usize]) -> Vec<Warning> {
        let may = self.things().filter(|(_, object)| object.may_fall).map(|(k, _)| k);
        let fell = may.filter(|k| toppled.contains(k) || self.has_left(*k, state));
        fell.map(|k| Warning::Fell { object: self.objects[k].name.clone() }).collect()
    }
}
