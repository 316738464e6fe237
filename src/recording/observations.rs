//! A recording as observations, one after another.

use crate::scene::{Observation, Sight};

use super::{observed::Recording, replay::Instant};

impl Recording {
    /// What was seen at the instants of [`Self::replay`]; where the pusher is lifted, at rest.
    pub fn observations(&self) -> Vec<Observation> {
        let replay = self.replay();
        let mut observations = Vec::new();
        let mut done = 0;
        for (k, Instant { frame, stroke, settled }) in replay.instants.iter().copied().enumerate() {
            let rests = replay.instants.get(k + 1).is_some_and(|next| next.settled);
            if rests && !settled {
                continue;
            }
            let poses = self.frames[frame].poses.iter().zip(&self.headings);
            observations.push(Observation {
                strokes: replay.motion.strokes[done..=stroke].to_vec(),
                seen: poses.map(|(pose, heading)| Some(Sight::new(pose, *heading))).collect(),
            });
            done = stroke + 1;
        }
        observations
    }
}
