//! Particle belief about masses, frictions and supports.
//!
//! Each particle is a complete set of unknown parameters. Every parameter has a coordinate with a
//! standard normal prior. For masses and frictions it is the logarithm of the ratio to the stated
//! value. For supports it is the logit of the position between uniform pressure and corner support.
//!
//! Particles are weighed by the likelihood of the observations in a rollout. When few have
//! significant weight, they are resampled with equal mean and variance (Liu and West 2001,
//! doi:10.1007/978-1-4757-3437-9_10).

use rand::Rng;
use serde::{Deserialize, Serialize};

use pushplan::scene::{Physics, Scene, Support, Unknowns};

use super::density::log_sum;
use super::distributions::{LOGISTIC, generator, normal};

/// Number of particles; the sampling error of means is then below the error of the effect model.
const COUNT: usize = 48;

/// Share of a new particle's variance that is sampled instead of inherited.
const JITTER: f64 = 0.1;

/// Number of standard deviations that contain 90 % of normal numbers.
const NINE_IN_TEN: f64 = 1.645;

/// Range of friction values in files.
const FRICTIONS: [f64; 2] = [0.05, 2.0];

/// Means and standard deviations of the parameters.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Numbers {
    /// Mass of every object, kg.
    pub masses: Vec<[f64; 2]>,
    /// Friction value of every object.
    pub frictions: Vec<[f64; 2]>,
    /// Friction value of the table.
    pub table_friction: [f64; 2],
    /// Support radius of every object relative to its corners' distance.
    pub spreads: Vec<[f64; 2]>,
}

#[derive(Clone, Debug, PartialEq)]
struct Particle {
    /// Logarithm of the weight.
    log: f64,
    /// Coordinates of masses, friction values and supports of all objects, then of the table's
    /// friction.
    place: Vec<f64>,
}

/// Belief about masses, frictions and supports.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Particles {
    unknown: Unknowns,
    seed: u64,
    objects: usize,
    /// Number of updates.
    weighed: u64,
    all: Vec<Particle>,
}

impl Particles {
    /// Samples the prior; without unknown parameters there are no particles.
    pub fn new(objects: usize, unknown: Unknowns, seed: u64) -> Self {
        let mut rng = generator(seed, 0);
        let count = if unknown.numbers() { COUNT } else { 0 };
        let mut all: Vec<Particle> = Vec::with_capacity(count);
        for k in 0..count {
            let place = match k % 2 {
                // Antithetic pairs keep the mean at the stated values.
                1 => all[k - 1].place.iter().map(|x| -x).collect(),
                _ => (0..=3 * objects).map(|_| normal(&mut rng)).collect(),
            };
            all.push(Particle { log: 0.0, place });
        }
        Self { unknown, seed, objects, weighed: 0, all }
    }

    /// Returns `true` if there are no particles.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Returns `true` if supports are sampled.
    pub fn draws_support(&self) -> bool {
        self.unknown.support
    }

    /// Returns `physics` under every particle; unknown parameters must be at the values of `scene`.
    pub fn each(&self, scene: &Scene, physics: &Physics) -> Vec<Physics> {
        let of = |particle: &Particle| self.put(scene, physics.clone(), &particle.place, true);
        self.all.iter().map(of).collect()
    }

    /// Returns `physics` with the mean parameters.
    pub fn mean(&self, scene: &Scene, physics: Physics) -> Physics {
        if self.is_empty() {
            return physics;
        }
        // Supports stay as stated until the first update.
        self.put(scene, physics, &self.moments().0, self.weighed > 0)
    }

    /// Returns `physics` with the parameters of a sampled particle.
    pub fn sample(&self, scene: &Scene, physics: Physics, rng: &mut impl Rng) -> Physics {
        match self.all.get(super::distributions::weighted(rng, &self.weights())) {
            Some(particle) => self.put(scene, physics, &particle.place, true),
            None => physics,
        }
    }

    /// Updates the weights with the log-likelihood of the observations under every particle.
    pub fn weigh(&mut self, logs: &[f64]) {
        self.weighed += 1;
        for (particle, log) in self.all.iter_mut().zip(logs) {
            // A failed rollout has zero likelihood.
            particle.log += if log.is_nan() { f64::NEG_INFINITY } else { *log };
        }
        let all = log_sum(self.all.iter().map(|particle| particle.log));
        if !all.is_finite() {
            self.all.iter_mut().for_each(|particle| particle.log = 0.0);
            return;
        }
        self.all.iter_mut().for_each(|particle| particle.log -= all);
        let counting: f64 = self.weights().iter().map(|weight| weight * weight).sum();
        if counting * COUNT as f64 > 2.0 {
            self.draw_anew();
        }
    }

    /// Returns means and standard deviations; the mass of a compound object includes all its parts.
    pub fn numbers(&self, scene: &Scene, stated: &Physics) -> Numbers {
        let physics = match self.is_empty() {
            true => vec![stated.clone()],
            false => self.each(scene, stated),
        };
        let weights = if self.is_empty() { vec![1.0] } else { self.weights() };
        let moments = |value: &dyn Fn(&Physics) -> f64| {
            let of = |power: i32, from: f64| -> f64 {
                let each = physics.iter().zip(&weights);
                each.map(|(physics, weight)| weight * (value(physics) - from).powi(power)).sum()
            };
            let mean = of(1, 0.0);
            [mean, of(2, mean).sqrt()]
        };
        let far = |k: usize| {
            let corners = Support::Corners.feet(&scene.objects[k].shape.footprint());
            move |physics: &Physics| physics.feet[k].mean_radius / corners.mean_radius
        };
        let objects = 0..self.objects;
        Numbers {
            masses: objects
                .clone()
                .map(|k| moments(&|physics| scene.mass_in(physics, k)))
                .collect(),
            frictions: objects.clone().map(|k| moments(&|physics| physics.frictions[k])).collect(),
            table_friction: moments(&|physics| physics.table_friction),
            spreads: objects.map(|k| moments(&far(k))).collect(),
        }
    }

    fn weights(&self) -> Vec<f64> {
        let all = log_sum(self.all.iter().map(|particle| particle.log));
        self.all.iter().map(|particle| (particle.log - all).exp()).collect()
    }

    /// Returns mean and variance of all coordinates.
    fn moments(&self) -> (Vec<f64>, Vec<f64>) {
        let weights = self.weights();
        let over = |value: &dyn Fn(&Particle, usize) -> f64| -> Vec<f64> {
            let sum = |k: usize| {
                let each = self.all.iter().zip(&weights);
                each.map(|(particle, weight)| weight * value(particle, k)).sum()
            };
            (0..=3 * self.objects).map(sum).collect()
        };
        let mean = over(&|particle, k| particle.place[k]);
        let variance = over(&|particle, k| (particle.place[k] - mean[k]).powi(2));
        (mean, variance)
    }

    /// Resamples equally weighted particles from the current ones.
    fn draw_anew(&mut self) {
        let mut rng = generator(self.seed, self.weighed);
        let ((mean, variance), weights) = (self.moments(), self.weights());
        // Systematic resampling: evenly spaced positions in the cumulative weights.
        let (first, step) = (rng.random::<f64>(), 1.0 / COUNT as f64);
        let (mut at, mut below) = (0, weights[0]);
        let (kept, sd) = ((1.0 - JITTER).sqrt(), JITTER.sqrt());
        let mut all = Vec::with_capacity(COUNT);
        for k in 0..COUNT {
            let arrow = (k as f64 + first) * step;
            while below < arrow && at + 1 < COUNT {
                at += 1;
                below += weights[at];
            }
            let places = self.all[at].place.iter().zip(&mean).zip(&variance);
            let place = places
                .map(|((place, mean), variance)| {
                    mean + kept * (place - mean) + sd * variance.sqrt() * normal(&mut rng)
                })
                .collect();
            all.push(Particle { log: 0.0, place });
        }
        self.all = all;
    }

    /// Returns `physics` with the unknown parameters at the coordinates `place`.
    fn put(&self, scene: &Scene, mut physics: Physics, place: &[f64], support: bool) -> Physics {
        let factor = |most: f64, place: f64| (most.ln() / NINE_IN_TEN * place).exp();
        let friction = |value: f64, place: f64| {
            (value * factor(Unknowns::FRICTION_FACTOR, place)).clamp(FRICTIONS[0], FRICTIONS[1])
        };
        for k in 0..scene.objects.len() {
            // All parts of a compound object share their parameters.
            let thing = scene.thing(k);
            let [mass, rubs, rests] = [0, 1, 2].map(|which| place[which * self.objects + thing]);
            if self.unknown.masses {
                physics.masses[k] *= factor(Unknowns::MASS_FACTOR, mass);
            }
            if self.unknown.frictions {
                physics.frictions[k] = friction(physics.frictions[k], rubs);
                for pair in physics.pairs.iter_mut().filter(|pair| pair.object == k) {
                    pair.coefficient = friction(pair.coefficient, rubs);
                }
            }
            if self.unknown.support && support {
                let share = 1.0 / (1.0 + (-LOGISTIC * rests).exp());
                let spread = Unknowns::SPREADS.low
                    + share * (Unknowns::SPREADS.high - Unknowns::SPREADS.low);
                physics.support(scene, k, &Support::Spread(spread));
            }
        }
        physics.supports_known &= !self.unknown.support;
        if self.unknown.frictions {
            physics.table_friction = friction(physics.table_friction, place[3 * self.objects]);
        }
        physics
    }
}

#[cfg(test)]
mod tests;
