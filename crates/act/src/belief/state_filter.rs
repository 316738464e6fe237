//! Estimated poses of all objects, from rollouts and observations.

use nalgebra::{Matrix2, Vector2};

use pushplan::{
    geometry::{Pose, Vector, contact_points, wrap_angle},
    scene::{ObservedPose, Scene, State},
    task::{Noise, Observation},
};

use super::{
    distributions::{generator, normal},
    rolled::Rolled,
    window::UNEVEN,
};

/// Displacement in a window below which an object counts as resting, metres.
const STILL: f64 = 2e-4;

/// Standard deviation of a rollout over a window for a single object: metres, and share of its
/// motion.
const ASTRAY: [f64; 2] = [2e-4, 0.05];

/// Number of samples among which the one with the least overlap is chosen.
const TRIES: usize = 16;

/// Lever arm that converts headings to lengths, metres.
pub(super) const ARM: f64 = 0.04;

/// Estimated poses and velocities of all objects.
#[derive(Clone, Debug)]
pub(super) struct StateFilter {
    noise: Noise,
    pub state: State,
    /// Variance of every object's position (per coordinate) and heading.
    pub variance: Vec<[f64; 2]>,
}

impl StateFilter {
    /// Creates the estimate for objects observed at rest in `state`.
    pub fn new(state: State, noise: Noise) -> Self {
        let variance = [noise.position.powi(2), noise.heading.powi(2)];
        Self { variance: vec![variance; state.poses.len()], state, noise }
    }

    /// Returns the observed or predicted displacement of an object in a window, metres; zero if it
    /// may be noise.
    pub fn motion(&self, object: usize, rolled: &Rolled, window: &[Observation]) -> f64 {
        let start = &self.state.poses[object];
        let far = |pose: &Pose| {
            let turn = wrap_angle(pose.heading - start.heading).abs() * ARM;
            (pose.position - start.position).norm().max(turn)
        };
        let rolled = rolled.states.last().map_or(0.0, |state| far(&state.poses[object]));
        let seen = window.last().and_then(|last| last.seen[object]).map_or(0.0, |sight| {
            let heading = sight.heading.unwrap_or(start.heading);
            let seen = far(&Pose { position: sight.position, heading });
            let by_chance = 4.0 * self.noise.position.max(self.noise.heading * ARM);
            if seen > by_chance { seen } else { 0.0 }
        });
        let most = rolled.max(seen);
        if most > STILL { most } else { 0.0 }
    }

    /// Returns the observed pose of an object and its variances; `None` if not observed.
    ///
    /// The heading is unwrapped to be near the rolled-out one. An unobserved heading is the
    /// rolled-out one, without variance.
    pub fn sight(&self, sight: Option<ObservedPose>, rolled: &Pose) -> Option<(Pose, [f64; 2])> {
        let sight = sight?;
        let (heading, variance) = match sight.heading {
            Some(heading) => {
                (rolled.heading + wrap_angle(heading - rolled.heading), self.noise.heading.powi(2))
            }
            None => (rolled.heading, 0.0),
        };
        let pose = Pose { position: sight.position, heading };
        Some((pose, [self.noise.position.powi(2), variance]))
    }

    /// Returns the rolled-out heading of an object at the end of a window; `None` if it was
    /// observed then.
    pub fn unseen_end(object: usize, rolled: &Rolled, window: &[Observation]) -> Option<f64> {
        let sight = window.last().and_then(|now| now.seen[object]);
        let seen = sight.is_some_and(|sight| sight.heading.is_some());
        let end = rolled.states.last().filter(|_| !seen)?;
        Some(end.poses[object].heading)
    }

    /// Returns the log-density of the last observed poses of all objects that `moved`, metres.
    pub fn places(&self, rolled: &Rolled, window: &[Observation], moved: &[f64]) -> f64 {
        let (Some(now), Some(state)) = (window.last(), rolled.states.last()) else { return 0.0 };
        let mut log = 0.0;
        for (k, motion) in moved.iter().enumerate().filter(|(_, motion)| **motion > 0.0) {
            let rolled = &state.poses[k];
            let Some((pose, variance)) = self.sight(now.seen[k], rolled) else { continue };
            let model = (2.0 * ASTRAY[0] + ASTRAY[1] * motion).powi(2);
            let off = (pose.position - rolled.position).norm_squared()
                / (model + variance[0] + self.variance[k][0]);
            let turn = (pose.heading - rolled.heading).powi(2)
                / (model / (ARM * ARM) + variance[1] + self.variance[k][1]);
            // Student's t distribution in three dimensions with four degrees of freedom.
            log -= 3.5 * ((off + turn) / 4.0).ln_1p();
        }
        log
    }

    /// Returns `count` possible states, the most probable first. Each other state is the one with
    /// the least overlap of a few samples, because real objects do not overlap.
    pub fn starts(&self, scene: &Scene, count: usize) -> Vec<State> {
        let mut rng = generator(scene.objects.len() as u64, count as u64);
        let mut draw = || {
            let mut state = self.state.clone();
            for (pose, [place, turn]) in state.poses.iter_mut().zip(&self.variance) {
                let off = Vector::new(normal(&mut rng), normal(&mut rng));
                pose.position += place.sqrt() * off;
                pose.heading += turn.sqrt() * normal(&mut rng);
            }
            (overlap(scene, &state), state)
        };
        let mut drawn = || {
            let mut best = draw();
            for _ in 1..TRIES {
                let other = draw();
                if other.0 < best.0 {
                    best = other;
                }
            }
            best.1
        };
        let others = (1..count).map(|_| drawn());
        std::iter::once(self.state.clone()).chain(others).collect()
    }

    /// Advances to the end of a window: the rollout, corrected by all observations according to
    /// their precision.
    pub fn follow(&mut self, rolled: &Rolled, window: &[Observation]) {
        let Some(end) = rolled.states.last() else { return };
        for k in 0..self.state.poses.len() {
            let (before, last) = (self.state.poses[k], end.poses[k]);
            let motion = (last.position - before.position).norm();
            let turn = (last.heading - before.heading).abs();
            let astray = |far: f64| if far > 0.0 { ASTRAY[0] + ASTRAY[1] * far } else { 0.0 };
            let mut places = [Error::new(self.variance[k][0], astray(motion)); 2];
            let mut heading = Error::new(self.variance[k][1], astray(ARM * turn.max(motion)) / ARM);
            for (at, (now, state)) in window.iter().zip(&rolled.states).enumerate() {
                let rolled = &state.poses[k];
                let Some((seen, noise)) = self.sight(now.seen[k], rolled) else { continue };
                let share = (at + 1) as f64 / window.len() as f64;
                let off = seen.position - rolled.position;
                for (axis, place) in places.iter_mut().enumerate() {
                    place.see(share, off[axis], off.norm(), noise[0]);
                }
                if now.seen[k].is_some_and(|sight| sight.heading.is_some()) {
                    let turned = seen.heading - rolled.heading;
                    heading.see(share, turned, turned, noise[1]);
                }
            }
            let [x, y] = places.map(|place| place.end());
            let turned = heading.end();
            self.state.poses[k] = Pose {
                position: last.position + Vector::new(x.0, y.0),
                heading: last.heading + turned.0,
            };
            self.state.velocities[k] = end.velocities[k];
            // Both coordinates have equal observations and differ only in their residuals.
            self.variance[k] = [x.1.max(y.1), turned.1];
        }
    }
}

/// Returns the sum of the overlap depths of all pairs of objects, metres.
fn overlap(scene: &Scene, state: &State) -> f64 {
    let prints: Vec<_> = scene.objects.iter().map(|object| object.shape.footprint()).collect();
    let mut sum = 0.0;
    for (a, first) in prints.iter().enumerate() {
        for (b, second) in prints.iter().enumerate().take(a) {
            let (points, _) =
                contact_points((first, &state.poses[a]), (second, &state.poses[b]), 0.0);
            sum -= points[0].map_or(0.0, |point| point.gap);
        }
    }
    sum
}

/// Estimated error of a rollout in one coordinate over a window: an initial error, linear growth,
/// and independent deviations at each instant.
#[derive(Clone, Copy, Debug)]
struct Error {
    /// Error at the start and its growth to the end.
    mean: Vector2<f64>,
    covariance: Matrix2<f64>,
    /// Prior standard deviation of the growth.
    astray: f64,
    /// Error at the end with its variance, if observed.
    end: Option<(f64, f64)>,
}

impl Error {
    /// Creates an error with this variance at the start and standard deviation of its growth.
    fn new(variance: f64, astray: f64) -> Self {
        let covariance = Matrix2::from_diagonal(&Vector2::new(variance, astray * astray));
        Self { mean: Vector2::zeros(), covariance, astray, end: None }
    }

    /// Updates the error with an observation after a `share` of the window.
    ///
    /// The residual is `off` in this coordinate and `far` over all coordinates; `noise` is the
    /// variance.
    fn see(&mut self, share: f64, off: f64, far: f64, noise: f64) {
        // A large residual increases the model's uncertainty, so that the observation is not
        // rejected.
        let known = self.covariance[(0, 0)] + (share * self.astray).powi(2);
        let more = (far * far / 9.0 - noise - known).max(0.0) / (share * share);
        self.covariance[(1, 1)] += more;
        self.astray = (self.astray * self.astray + more).sqrt();
        let by = Vector2::new(1.0, share);
        let across = self.covariance * by;
        let variance = by.dot(&across) + (UNEVEN * self.astray).powi(2);
        let left = off - by.dot(&self.mean);
        if share == 1.0 {
            let gain = gain(variance, noise);
            self.end = Some((off - (1.0 - gain) * left, (1.0 - gain) * variance));
        } else if variance + noise > 0.0 {
            self.mean += across * (left / (variance + noise));
            self.covariance -= across * across.transpose() / (variance + noise);
        }
    }

    /// Returns the error at the end with its variance.
    fn end(&self) -> (f64, f64) {
        self.end.unwrap_or_else(|| {
            let by = Vector2::new(1.0, 1.0);
            let uneven = (UNEVEN * self.astray).powi(2);
            (by.dot(&self.mean), by.dot(&(self.covariance * by)) + uneven)
        })
    }
}

/// Returns the Kalman gain for an estimate of this variance.
fn gain(variance: f64, noise: f64) -> f64 {
    if variance + noise > 0.0 { variance / (variance + noise) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Estimates the final error from residuals after each fifth of a window, with this variance.
    fn seen(mut error: Error, off: [f64; 5], noise: f64) -> (f64, f64) {
        for (k, off) in off.into_iter().enumerate() {
            error.see((k + 1) as f64 / 5.0, off, off, noise);
        }
        error.end()
    }

    #[test]
    fn a_resting_object_is_at_its_mean_observed_pose() {
        let (mean, variance) = seen(Error::new(4.0, 0.0), [1.0, -1.0, 2.0, 0.0, 1.0], 1.0);
        // For Gaussians the precisions add up: 1/4 of the prior and 1 of each observation.
        assert!((mean - 3.0 / 5.25).abs() < 1e-12, "{mean}");
        assert!((variance - 1.0 / 5.25).abs() < 1e-12, "{variance}");
    }

    #[test]
    fn true_poses_are_believed_to_the_bit() {
        assert_eq!(seen(Error::new(0.0, 1e-3), [0.1, 0.2, 0.3, 0.4, 0.7], 0.0), (0.7, 0.0));
    }

    #[test]
    fn a_rollout_that_goes_astray_evenly_is_corrected_by_more_than_the_last_observation() {
        let off = |share: f64| 4.0 * share;
        let line = [0.2, 0.4, 0.6, 0.8, 1.0].map(off);
        let (mean, variance) = seen(Error::new(0.01, 4.0), line, 1.0);
        assert!((mean - 4.0).abs() < 0.2, "{mean}");
        // The last observation alone would leave a variance of 0.94.
        assert!(variance < 0.7, "{variance}");
    }
}
