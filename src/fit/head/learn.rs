//! From recordings to what is known of a table.

use rayon::prelude::*;

use crate::effect::Network;
use crate::judge::{Comparison, ObjectError, Trial, mean};
use crate::network::Head;
use crate::scene::{FittedObject, HeadSpread, Narrowed, Object, TableFit};

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

/// What `trials` say of a table beyond `found`, the numbers that were fitted to them: the change of
/// the last layer of `network`, its spread and the noise that is left. With too few pushes, or where
/// those that are left out are not predicted better, that change is none.
///
/// # Errors
/// If the checksum of the weights cannot be made.
pub fn learn(
    network: &Network,
    trials: &[Trial],
    found: &Fit,
    settings: &HeadSettings,
) -> Result<TableFit, crate::network::WeightsError> {
    let half = network.effect_width();
    let mut fit = TableFit {
        weights: network.weights().checksum()?,
        head: Head::none(half).values().to_vec(),
        spread: HeadSpread::default(),
        noise: found.noise,
        friction: found.friction.told.then_some(found.told_friction()),
        support: found.told_spread(),
        table_friction: trials.first().map_or(0.0, |trial| trial.scene.table_friction),
        objects: objects(trials),
        pushes: trials.len(),
    };
    let told: Vec<Trial> = trials.iter().map(|trial| told(&fit, trial)).collect();
    let moves: Vec<Vec<bool>> = told.iter().map(|trial| moving(network, trial)).collect();
    let least = DISAGREEMENT * found.motion;
    let look = |head: &Head| -> Vec<Vec<Observed>> {
        let network = network.clone().adapted(head);
        let pairs = told.par_iter().zip(&moves);
        pairs.map(|(trial, moves)| observed(&network, trial, moves)).collect()
    };
    let none = Head::none(half);
    let mut seen = look(&none);
    if seen.iter().flatten().count() < FEWEST {
        return Ok(fit);
    }
    let regression = |seen: &[Vec<Observed>], head: &Head| {
        Regression::new(seen.iter().flatten(), head.values(), settings.law, least)
    };
    let prior = choose(network, &told, &moves, &seen, settings, least).unwrap_or(0.0);
    let mut head = none;
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

/// The objects of all trials, each once.
fn objects(trials: &[Trial]) -> Vec<FittedObject> {
    let mut objects: Vec<FittedObject> = Vec::new();
    for object in trials.iter().flat_map(|trial| &trial.scene.objects) {
        let one =
            FittedObject { name: object.name.clone(), shape: object.shape, mass: object.mass };
        if !objects.contains(&one) {
            objects.push(one);
        }
    }
    objects
}
