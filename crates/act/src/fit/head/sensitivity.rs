//! Sensitivity of the end of a rollout to the head of a network.
//!
//! Corrections are not fed back into contacts, and a head acts linearly. With the row z and
//! the length l of the object's motion in each frame, the final poses e change exactly by
//!
//! ```text
//! de/dθ = Σ_t  l_t R(axis_t) z_t
//! ```
//!
//! unless bodies have to be moved out of each other.

use pushplan::{
    effect::{EffectModel, Network, without_guesses},
    graph::Corrections,
    network::{Buffers, HEAD_OUTPUTS, Head},
    outcome::{Record, Trajectory},
    rollout::Roller,
    scene::Scene,
    task::Job,
};

/// Rollout with the sensitivity of its end to a head.
#[derive(Clone, Debug)]
pub struct Sensitivity {
    /// Corrected rollout, frame by frame.
    pub trajectory: Trajectory,
    /// Jacobian of x, y and heading of all objects at the end, [3 N, 6 h]: metres and radians per
    /// parameter of a [`Head`].
    pub rows: Vec<Vec<f64>>,
}

impl Sensitivity {
    /// Computes the sensitivity of the end of `job` to a head of `network`.
    pub fn of(network: &Network, scene: &Scene, job: &Job) -> Self {
        let job = without_guesses(job);
        let half = network.effect_width();
        let mut rows = vec![vec![0.0; Head::len_of(half)]; 3 * scene.objects.len()];
        let jobs = std::slice::from_ref(&job);
        let rolled = network.rollout(scene, jobs, Record::Frames).into_iter().next();
        let trajectory = rolled.unwrap_or_else(|| Trajectory::new(network.spec().clone()));
        let mut roller = Roller::new(network.spec().clone(), network.settings());
        let (readings, batch) = roller.read(scene, jobs, Record::Outcome);
        let mut buffers = Buffers::default();
        network.forward().run(batch, &mut buffers, &mut Corrections::default());
        let (even, odd) = buffers.rows().split_at(buffers.rows().len() / 2);
        for read in readings.iter().flat_map(|reading| &reading.reads) {
            let from = read.node as usize * half;
            let states = even[from..from + half].iter().chain(&odd[from..from + half]);
            let states: Vec<f64> = states.map(|value| f64::from(*value)).collect();
            for output in 0..HEAD_OUTPUTS {
                let mut unit = [0.0; HEAD_OUTPUTS];
                unit[output] = 1.0;
                let first = 3 * read.object as usize;
                for (row, change) in rows[first..first + 3].iter_mut().zip(read.change(unit)) {
                    let part = &mut row[output * 2 * half..(output + 1) * 2 * half];
                    for (value, state) in part.iter_mut().zip(&states) {
                        *value += change * state;
                    }
                }
            }
        }
        Self { trajectory, rows }
    }
}
