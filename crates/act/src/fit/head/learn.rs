//! From recordings to what is known of a table.

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

/// Deviations of a head's numbers that are tried. Hidden rows are about 1 long and an output is
/// 10 mm, so the widest changes a frame by about a millimetre.
const PRIORS: [f64; 5] = [0.005, 0.01, 0.02, 0.04, 0.08];

/// Times that pushes are rolled out anew around the last mean.
const ROUNDS: usize = 2;

/// Parts of the recordings that are left out in turn, to choose a prior by rollouts of them.
const FOLDS: usize = 5;

/// A head must be better than none by so many standard errors. With one, a draw of 20 pushes in three
/// learnt a head, and those were worse on new pushes.
const SURE: f64 = 2.0;

/// Directions that are kept of a posterior: a file of some 60 KB. The others count as unknown, which
/// makes the stated spread wider, never narrower.
const DIRECTIONS: usize = 16;

/// Fewer pushes than this teach no head, whatever they say.
const FEWEST: usize = 10;

/// How a head is learnt.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadSettings {
    /// The law of the noise.
    pub law: NoiseLaw,
    /// Deviations of the prior to choose from; no head at all is always a choice.
    pub priors: Vec<f64>,
}

impl Default for HeadSettings {
    fn default() -> Self {
        Self { law: NoiseLaw::Student, priors: PRIORS.to_vec() }
    }
}

/// What is known of a table besides the pushes that teach a head.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis {
    /// Width of the noise, metres.
    pub noise: f64,
    /// How far objects move in a push on average, metres.
    pub motion: f64,
    /// Coefficient of friction of tool and objects, where recordings tell it.
    pub friction: Option<f64>,
    /// Share of the corners' distance at which the objects rest, where recordings tell it.
    pub support: Option<f64>,
    /// What was learnt of the table before; it stays as it is.
    pub before: Option<TableFit>,
}

impl From<&Fit> for Basis {
    fn from(found: &Fit) -> Self {
        Self {
            noise: found.noise,
            motion: found.motion,
            friction: found.friction.told.then_some(found.told_friction()),
            support: found.told_spread(),
            before: None,
        }
    }
}

impl Basis {
    /// Where nothing is fitted: objects are seen with errors of `noise` metres, and the rest is as
    /// it was learnt before.
    pub fn seen(trials: &[Trial], noise: f64, before: Option<&TableFit>) -> Self {
        let motions: Vec<f64> = trials.iter().flat_map(Trial::motions).collect();
        let before = before.cloned();
        let told = |of: fn(&TableFit) -> Option<f64>| before.as_ref().and_then(of);
        let (friction, support) = (told(|fit| fit.friction), told(|fit| fit.support));
        Self { noise, motion: mean(&motions), friction, support, before }
    }

    /// The fit before a push has told anything.
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

/// What `trials` say of a table beyond the numbers in `basis`: the change of the last layer of
/// `network`, its spread and the noise that is left. With too few pushes, or where those that are left
/// out are not predicted better, that change is none, or as it was learnt before.
///
/// # Errors
/// If the checksum of the weights cannot be made.
pub fn learn(
    network: &Network,
    trials: &[Trial],
    basis: &Basis,
    settings: &HeadSettings,
) -> Result<TableFit, pushplan::network::WeightsError> {
    let half = network.effect_width();
    let mut fit = basis.fit(network, trials)?;
    let before = basis.before.as_ref().filter(|before| before.spread.prior > 0.0);
    let told: Vec<Trial> = trials.iter().map(|trial| told(&fit, trial)).collect();
    let moves: Vec<Vec<bool>> = told.iter().map(|trial| moving(network, trial)).collect();
    // A few pushes do not tell how far off pushes are.
    let least = (DISAGREEMENT * basis.motion).max(before.map_or(0.0, |before| before.noise));
    let look = |head: &Head| -> Vec<Vec<Observed>> {
        let network = network.clone().adapted(head);
        let pairs = told.par_iter().zip(&moves);
        pairs.map(|(trial, moves)| observed(&network, trial, moves)).collect()
    };
    let Some(mut head) = Head::new(fit.head.clone(), half) else { return Ok(fit) };
    let mut seen = look(&head);
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
    let prior = match before {
        Some(before) => before.spread.prior,
        None => choose(network, &told, &moves, &seen, settings, least).unwrap_or(0.0),
    };
    for _ in 0..ROUNDS {
        let regression = regression(&seen, &head);
        let Some(solved) = regression.solve(prior) else { break };
        let Some(next) = Head::new(solved.mean.clone(), half) else { break };
        let ends = look(&next);
        // A step that the rollouts do not confirm is not taken.
        if loss(&ends, solved.noise) > loss(&seen, solved.noise) {
            break;
        }
        let directions = regression.directions(&solved, DIRECTIONS);
        let narrowed = directions.into_iter().map(|(left, direction)| Narrowed {
            left,
            direction: direction.into_iter().map(|value| value as f32).collect(),
        });
        fit.spread = HeadSpread { prior: solved.prior, directions: narrowed.collect() };
        fit.noise = solved.noise;
        fit.head = solved.mean;
        if next.is_none() {
            break;
        }
        (head, seen) = (next, ends);
    }
    Ok(fit)
}

/// The trial, told what the fit says of the physics.
fn told(fit: &TableFit, trial: &Trial) -> Trial {
    let mut trial = trial.clone();
    fit.state(&mut trial.scene);
    trial
}

/// The prior whose heads predict best what they were not told, by rollouts; `None` unless that is
/// better than no head by more than [`SURE`] standard errors.
fn choose(
    network: &Network,
    trials: &[Trial],
    moves: &[Vec<bool>],
    seen: &[Vec<Observed>],
    settings: &HeadSettings,
    least: f64,
) -> Option<f64> {
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
    (gain > SURE * (square / (count - 1.0) / count).sqrt()).then_some(prior)
}

/// How far `network` ends from what was recorded, over the objects that move: position and turn at
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

/// Minus the logarithm of Student's density at this width, up to a constant.
fn loss(ends: &[Vec<Observed>], width: f64) -> f64 {
    let one = |end: &Observed| {
        let square: f64 = end.residual.iter().map(|value| value * value).sum();
        (square / width.powi(2) / crate::fit::likelihood::FREEDOM).ln_1p()
    };
    ends.iter().flatten().map(one).sum()
}

/// These objects and those of all trials, each once.
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
