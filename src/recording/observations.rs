//! A recording as observations, one after another.

use crate::{scene::Sight, task::Observation};

use super::{
    observed::Recording,
    replay::{Instant, Replay},
};

impl Recording {
    /// What was seen at the instants of [`Self::replay`]; where the pusher is lifted, at rest.
    pub fn observations(&self) -> Vec<Observation> {
        let replay = self.replay();
        let mut observations = Vec::new();
        let mut done = 0;
        for Instant { frame, stroke, .. } in observed(&replay) {
            let poses = self.frames[frame].poses.iter().zip(&self.headings);
            observations.push(Observation {
                strokes: replay.motion.strokes[done..=stroke].to_vec(),
                seen: poses.map(|(pose, heading)| Some(Sight::new(pose, *heading))).collect(),
            });
            done = stroke + 1;
        }
        observations
    }

    /// Indices of the frames that [`Self::observations`] are of.
    pub fn observed_frames(&self) -> Vec<usize> {
        observed(&self.replay()).map(|instant| instant.frame).collect()
    }
}

/// The instants of a replay; of the end of a stroke and the rest after it only the rest.
fn observed(replay: &Replay) -> impl Iterator<Item = Instant> {
    let rests = |k: usize| replay.instants.get(k + 1).is_some_and(|next| next.settled);
    let instants = replay.instants.iter().copied().enumerate();
    instants.filter(move |(k, instant)| instant.settled || !rests(*k)).map(|(_, instant)| instant)
}
