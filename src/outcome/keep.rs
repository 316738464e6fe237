//! What a plan may not move.

use super::Warning;
use crate::scene::{Scene, State};

impl Scene {
    /// That an object was moved farther than it may be; the first that was.
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
