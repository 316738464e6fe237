//! Check that objects stay within the distance that they may be moved.

use super::Warning;
use crate::scene::{Scene, State};

impl Scene {
    /// Returns a warning about the first object that was moved farther than its `keep` distance.
    pub fn not_kept(&self, state: &State) -> Option<Warning> {
        self.objects.iter().zip(&state.poses).find_map(|(object, pose)| {
            let within = object.keep?;
            let moved = (pose.position - object.pose.position).norm();
            (moved > within).then(|| Warning::NotKept {
                object: object.name.clone(),
                moved,
                within,
            })
        })
    }
}
