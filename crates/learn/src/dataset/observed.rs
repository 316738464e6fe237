//! Simulated camera observations of a trajectory: with noise, and optionally without the headings
//! of cylinders.

use pushplan::internals::geometry::Vector;
use pushplan::internals::recording::Recording;
use pushplan::internals::{
    scene::{ObservedPose, Scene},
    task::{Noise, Observation},
};
use pushplan_act::belief::normal;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

/// Quality of the observations.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Seeing {
    /// Noise of positions and headings.
    pub noise: Noise,
    /// Whether the headings of cylinders are observed, as on marked cylinders.
    pub round_headings: bool,
}

impl Seeing {
    /// Returns the scene as observed at the start, and all observations of a recording. Joints,
    /// masses and frictions of the scene stay the true ones of the recording.
    pub fn observe(&self, recording: &Recording, rng: &mut Pcg64) -> (Scene, Vec<Observation>) {
        let Noise { position, heading } = self.noise;
        let mut error = |sd: f64| if sd > 0.0 { sd * normal(rng) } else { 0.0 };
        let mut scene = recording.scene.clone();
        for object in &mut scene.objects {
            object.pose.position += Vector::new(error(position), error(position));
            object.pose.heading += error(heading);
        }
        let round: Vec<bool> =
            scene.objects.iter().map(|object| object.shape.is_cylinder()).collect();
        let mut observations = recording.observations();
        for Observation { seen, .. } in &mut observations {
            for (sight, round) in seen.iter_mut().zip(&round) {
                let Some(ObservedPose { position: place, heading: turn }) = sight else { continue };
                *place += Vector::new(error(position), error(position));
                *turn = turn
                    .filter(|_| self.round_headings || !round)
                    .map(|turn| turn + error(heading));
            }
        }
        (scene, observations)
    }
}
