//! Beliefs inferred from recordings with noise.

use pushplan::effect::Prior;
use pushplan::geometry::Vector;
use pushplan::recording::Recording;
use pushplan::task::{Noise, Observation};
use pushplan_act::belief::{Belief, BeliefSettings};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

pub const EXACT: Noise = Noise { position: 0.0, heading: 0.0 };

/// Returns the belief after a whole recording with this noise.
pub fn believed(recording: &Recording, noise: Noise, seed: u64) -> Belief {
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut normal = |sd: f64| {
        // Sums of twelve uniform numbers are nearly normal.
        sd * ((0..12).map(|_| rng.random::<f64>()).sum::<f64>() - 6.0)
    };
    let mut scene = recording.scene.clone();
    for object in &mut scene.objects {
        object.pose.position += Vector::new(normal(noise.position), normal(noise.position));
        object.pose.heading += normal(noise.heading);
    }
    let settings = BeliefSettings::new(noise);
    let mut belief = Belief::new(&scene, recording.tool.clone(), recording.lift, settings);
    let model = Prior::default();
    for Observation { strokes, mut seen } in recording.observations() {
        for sight in seen.iter_mut().flatten() {
            sight.position += Vector::new(normal(noise.position), normal(noise.position));
            sight.heading = sight.heading.map(|heading| heading + normal(noise.heading));
        }
        belief.update(&model, Observation { strokes, seen });
    }
    belief.settle(&model);
    belief
}
