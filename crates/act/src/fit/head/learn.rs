//! Fitting of a linear head to recordings of a table.

use rayon::prelude::*;

use crate::judge::{Comparison, ObjectError, Trial, mean};
use pushplan::effect::Network;
use pushplan::network::Head;
use pushplan::scene::{FittedObject, HeadSpread, Narrowed, Object, TableFit};

use crate::fit::likelihood::DISAGREEMENT;
use crate::fit::run::moving;
use crate::fit::{Fit, NoiseLaw};

use super::observed::{Observed, observed};
use super::regression::Regression;

/// Candidate prior standard deviations of the head parameters.
///
/// Rows have a norm of about 10 and outputs are relative to the motion, so that the widest prior
/// changes a motion by about its length.
const PRIORS: [f64; 5] = [0.005, 0.01, 0.02, 0.04, 0.08];

/// Number of folds of the cross-validation that chooses the prior.
const FOLDS: usize = 5;

/// Number of posterior directions kept: a file of about 60 KB. The other directions count as
/// unknown, which never makes the stated spread narrower.
const DIRECTIONS: usize = 16;

/// Minimum number of pushes for fitting a head.
const FEWEST: usize = 10;

/// Settings of the head fit.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadSettings {
    /// Noise law.
    pub law: NoiseLaw,
    /// Candidate standard deviations of the prior; no head is always a candidate.
    pub priors: Vec<f64>,
}

impl Default for HeadSettings {
    fn default() -> Self {
        Self { law: NoiseLaw::Student, priors: PRIORS.to_vec() }
    }
}

/// Knowledge about a table other than the pushes that the head is fitted to.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis {
    /// Width of the noise, metres.
    pub noise: f64,
    /// Mean displacement of the objects in a push, metres.
    pub motion: f64,
    /// Friction coefficient of tool and objects, if the recordings identify it.
    pub friction: Option<f64>,
    /// Support radius as a share of the corners' distance, if the recordings identify it.
    pub support: Option<f64>,
    /// Earlier fit of the table, which stays unchanged.
    pub before: Option<TableFit>,
}

impl From<&Fit> for Basis {
    fn from(found: &Fit) -> Self {
        Self {
            noise: found.noise,
            motion: found.motion,
            friction: found.friction.identified.then_some(found.identified_friction()),
            support: found.identified_spread(),
            before: None,
        }
    }
}

impl Basis {
    /// Returns a basis without fitted parameters: observation noise of `noise` metres, all else
    /// from an earlier fit.
    pub fn seen(trials: &[Trial], noise: f64, before: Option<&TableFit>) -> Self {
        let motions: Vec<f64> = trials.iter().flat_map(Trial::motions).collect();
        let before = before.cloned();
        let earlier = |of: fn(&TableFit) -> Option<f64>| before.as_ref().and_then(of);
        let (friction, support) = (earlier(|fit| fit.friction), earlier(|fit| fit.support));
        Self { noise, motion: mean(&motions), friction, support, before }
    }

    /// Returns the fit before any push is used.
    fn fit(
        &self,
        network: &Network,
        trials: &[Trial],
    ) -> Result<TableFit, pushplan::network::WeightsError> {
        let none = || TableFit {
            weights: String::new(),
            head: Head::none(network.effect_width()).values().to_vec(),
            noise: self.noise,
            table_friction: trials.first().map_or(0.0, |trial| trial.scene.table_friction),
            ..TableFit::default()
        };
        let before = self.before.clone().unwrap_or_else(none);
        Ok(TableFit {
            weights: network.weights().checksum()?,
            friction: self.friction,
            support: self.support,
            objects: objects(&before.objects, trials),
            pushes: before.pushes + trials.len(),
            ..before
        })
    }
}

/// Fits a head of `network` to `trials`, in addition to the parameters in `basis`.
///
/// The result contains the change, its spread and the remaining noise. A change is shrunk by the
/// uncertainty of its gain on held-out pushes. With too few pushes, or if
/// held-out pushes are not predicted better, it is zero or the earlier one.
///
/// # Errors
/// Returns an error if the checksum of the weights cannot be computed.
pub fn learn(
    network: &Network,
    trials: &[Trial],
    basis: &Basis,
    settings: &HeadSettings,
) -> Result<TableFit, pushplan::network::WeightsError> {
    let half = network.effect_width();
    let mut fit = basis.fit(network, trials)?;
    let before = basis.before.as_ref().filter(|before| before.spread.prior > 0.0);
    let fitted: Vec<Trial> = trials.iter().map(|trial| with_fit(&fit, trial)).collect();
    let moves: Vec<Vec<bool>> = fitted.iter().map(|trial| moving(network, trial)).collect();
    // The noise width is bounded below because a few pushes do not determine it.
    let least = (DISAGREEMENT * basis.motion).max(before.map_or(0.0, |before| before.noise));
    let look = |head: &Head| -> Vec<Vec<Observed>> {
        let network = network.clone().adapted(head);
        let pairs = fitted.par_iter().zip(&moves);
        pairs.map(|(trial, moves)| observed(&network, trial, moves)).collect()
    };
    let Some(head) = Head::new(fit.head.clone(), half) else { return Ok(fit) };
    let seen = look(&head);
    let fewest = if before.is_some() { 1 } else { FEWEST };
    if seen.iter().flatten().count() < fewest {
        return Ok(fit);
    }
    let regression = |seen: &[Vec<Observed>], head: &Head| {
        let new = Regression::new(seen.iter().flatten(), head.values(), settings.law, least);
        match before {
            Some(before) => new.after(before),
            None => new,
        }
    };
    let chosen = match before {
        Some(before) => Some(Chosen { prior: before.spread.prior, share: 1.0 }),
        None => choose(network, &fitted, &moves, &seen, settings, least),
    };
    let Chosen { prior, share } = chosen.unwrap_or_default();
    let regression = regression(&seen, &head);
    if let Some(solved) = regression.solve(prior)
        && let Some(next) = Head::new(solved.mean.clone(), half).map(|head| head.scaled(share))
        // A change that the rollouts do not confirm is rejected.
        && loss(&look(&next), solved.noise) <= loss(&seen, solved.noise)
    {
        let directions = regression.directions(&solved, DIRECTIONS);
        let narrowed = directions.into_iter().map(|(left, direction)| Narrowed {
            left,
            direction: direction.into_iter().map(|value| value as f32).collect(),
        });
        fit.spread = HeadSpread { prior: solved.prior, directions: narrowed.collect() };
        fit.noise = solved.noise;
        fit.head = next.values().to_vec();
    }
    Ok(fit)
}

/// Returns the trial with the fitted physics.
fn with_fit(fit: &TableFit, trial: &Trial) -> Trial {
    let mut trial = trial.clone();
    fit.state(&mut trial.scene);
    trial
}

/// A prior, and the share of the change that is kept.
#[derive(Clone, Copy, Debug, Default)]
struct Chosen {
    /// Standard deviation of the prior.
    prior: f64,
    /// Share of the change: g^2 / (g^2 + e^2) for a gain g with the standard error e, the share of
    /// an uncertain effect with the least square error.
    share: f64,
}

/// Returns the prior with the best predictions of held-out pushes; `None` if none is better than no
/// head.
fn choose(
    network: &Network,
    trials: &[Trial],
    moves: &[Vec<bool>],
    seen: &[Vec<Observed>],
    settings: &HeadSettings,
    least: f64,
) -> Option<Chosen> {
    let half = network.effect_width();
    let left_out = |fold: usize, k: usize| k % FOLDS == fold;
    let folds: Vec<Regression> = (0..FOLDS)
        .map(|fold| {
            let shown = seen.iter().enumerate().filter(|(k, _)| !left_out(fold, *k));
            let zeros = vec![0.0; Head::len_of(half)];
            Regression::new(shown.flat_map(|(_, seen)| seen), &zeros, settings.law, least)
        })
        .collect();
    let off = |network: &Network, k: usize| off(network, &trials[k], &moves[k]);
    let without: Vec<f64> = (0..trials.len()).into_par_iter().map(|k| off(network, k)).collect();
    let gains = |prior: f64| -> Option<Vec<f64>> {
        let heads = folds.iter().map(|fold| Head::new(fold.solve(prior)?.mean, half));
        let heads = heads.collect::<Option<Vec<Head>>>()?;
        let adapted: Vec<Network> =
            heads.iter().map(|head| network.clone().adapted(head)).collect();
        let gain = |(k, without): (usize, &f64)| without - off(&adapted[k % FOLDS], k);
        Some(without.iter().enumerate().map(gain).collect())
    };
    let tried: Vec<(f64, Vec<f64>)> =
        settings.priors.par_iter().filter_map(|&prior| Some((prior, gains(prior)?))).collect();
    let (prior, gains) = tried.into_iter().max_by(|a, b| mean(&a.1).total_cmp(&mean(&b.1)))?;
    let (count, gain) = (gains.len() as f64, mean(&gains));
    let square: f64 = gains.iter().map(|one| (one - gain).powi(2)).sum();
    let share = gain * gain / (gain * gain + square / (count - 1.0) / count);
    (gain > 0.0).then_some(Chosen { prior, share })
}

/// Returns the summed final error of `network` over the objects that move: position and rotation at
/// the radius of gyration, metres.
fn off(network: &Network, trial: &Trial, moves: &[bool]) -> f64 {
    let ends = Comparison::of(network, trial).end();
    let pairs = ends.iter().zip(&trial.scene.objects).zip(moves);
    let one = |((end, object), _): ((&ObjectError, &Object), &bool)| {
        let arm = object.shape.footprint().gyration_radius();
        end.position.hypot(arm * end.heading.unwrap_or(0.0))
    };
    pairs.filter(|(_, moves)| **moves).map(one).sum()
}

/// Returns the negative logarithm of Student's density at this width, up to a constant.
fn loss(ends: &[Vec<Observed>], width: f64) -> f64 {
    let one = |end: &Observed| {
        let square: f64 = end.residual.iter().map(|value| value * value).sum();
        (square / width.powi(2) / crate::fit::likelihood::FREEDOM).ln_1p()
    };
    ends.iter().flatten().map(one).sum()
}

/// Returns the given objects and the objects of all trials, without duplicates.
fn objects(before: &[FittedObject], trials: &[Trial]) -> Vec<FittedObject> {
    let mut objects = before.to_vec();
    for object in trials.iter().flat_map(|trial| &trial.scene.objects) {
        let one =
            FittedObject { name: object.name.clone(), shape: object.shape, mass: object.mass };
        if !objects.contains(&one) {
            objects.push(one);
        }
    }
    objects
}
