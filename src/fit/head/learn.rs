//! From recordings to what is known of a table.

use rayon::prelude::*;

use crate::effect::Network;
use crate::judge::{Trial, mean};
use crate::network::Head;
use crate::scene::{FittedObject, HeadSpread, Narrowed, TableFit};

use crate::fit::likelihood::DISAGREEMENT;
use crate::fit::run::moving;
use crate::fit::{Fit, NoiseLaw};

use super::observed::{Observed, observed};
use super::regression::{Regression, Solved};

/// Deviations of a head's numbers that are tried. Hidden rows are about 1 long and an output is
/// 10 mm, so the widest changes a frame by some millimetres.
const PRIORS: [f64; 7] = [0.01, 0.02, 0.04, 0.08, 0.16, 0.32, 0.64];

/// Times that pushes are rolled out anew around the last mean.
const ROUNDS: usize = 3;

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
    let look = |head: &Head| -> Vec<Observed> {
        let network = network.clone().adapted(head);
        let pairs = told.par_iter().zip(&moves);
        pairs.flat_map_iter(|(trial, moves)| observed(&network, trial, moves)).collect()
    };
    let mut head = Head::none(half);
    let mut seen = look(&head);
    if seen.len() < FEWEST {
        return Ok(fit);
    }
    for _ in 0..ROUNDS {
        let regression = Regression::new(&seen, head.values(), settings.law, least);
        let Some(solved) = choose(&regression, &settings.priors) else { break };
        let Some(next) = Head::new(solved.mean.clone(), half) else { break };
        let ends = look(&next);
        // A step that the rollouts do not confirm is not taken.
        if ends.len() < seen.len() || loss(&ends, solved.noise) > loss(&seen, solved.noise) {
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

/// The posterior that predicts best what it is not told, and none unless that is better by more
/// than its standard error.
fn choose(regression: &Regression, priors: &[f64]) -> Option<Solved> {
    let none = regression.solve(0.0)?;
    let solved: Vec<Option<Solved>> =
        priors.par_iter().map(|prior| regression.solve(*prior)).collect();
    let gains = |solved: &Solved| -> Vec<f64> {
        solved.left_out.iter().zip(&none.left_out).map(|(with, without)| with - without).collect()
    };
    let best =
        solved.into_iter().flatten().max_by(|a, b| mean(&gains(a)).total_cmp(&mean(&gains(b))))?;
    let gains = gains(&best);
    let (count, gain) = (gains.len() as f64, mean(&gains));
    let square: f64 = gains.iter().map(|one| (one - gain).powi(2)).sum();
    let sure = gain > (square / (count - 1.0) / count).sqrt();
    Some(if sure { best } else { none })
}

/// Minus the logarithm of Student's density at this width, up to a constant.
fn loss(ends: &[Observed], width: f64) -> f64 {
    let one = |end: &Observed| {
        let square: f64 = end.residual.iter().map(|value| value * value).sum();
        (square / width.powi(2) / crate::fit::likelihood::FREEDOM).ln_1p()
    };
    ends.iter().map(one).sum()
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
