//! One split of recordings: learn on some, predict the others.

use std::ops::Range;

use pushplan::internals::effect::{EffectModel, Network, Prior};
use pushplan::internals::geometry::wrap_angle;
use pushplan::internals::network::WeightsError;
use pushplan::internals::scene::TableFit;
use pushplan::internals::seeded::generator;
use pushplan::watch::Unwatched;
use pushplan_act::fit::{Basis, FitSettings, HeadSettings, Sensitivity, fit, learn};
use pushplan_act::judge::{Comparison, Trial};
use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};

/// Values on an axis of the grid of friction and support: half of what `pushplan fit` takes, so that
/// dozens of splits take minutes.
const VALUES: usize = 9;

/// Which recordings are learnt from and which are predicted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Split {
    /// What the predicted ones are: `new pushes`, or the set that is left out.
    pub title: String,
    /// Number of pushes asked for.
    pub asked: usize,
    /// Indices of those learnt from.
    pub learnt: Vec<usize>,
    /// Indices of those predicted.
    pub predicted: Vec<usize>,
}

/// One predicted push: final errors of position, metres, and of the turn, radians, by each model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AdaptedPush {
    /// Of which recording, so that repeated predictions of one can be told.
    pub recording: usize,
    /// The prior as shipped.
    pub shipped: [f64; 2],
    /// The prior after fit.
    pub prior: [f64; 2],
    /// The network after the same fit, without a head.
    pub network: [f64; 2],
    /// The network with its head.
    pub adapted: [f64; 2],
    /// How many of x, y and the turn lie within the stated 90 %, and of how many.
    pub inside: [usize; 2],
}

/// `draws` random splits for each number of pushes to learn from, and each set left out in turn,
/// learning from at most the largest number of the others.
pub fn splits(
    sets: &[(String, Range<usize>)],
    counts: &[usize],
    draws: u32,
    seed: u64,
) -> Vec<Split> {
    let all: Vec<usize> = sets.iter().flat_map(|(_, range)| range.clone()).collect();
    let mut splits = Vec::new();
    for &asked in counts.iter().filter(|&&asked| asked < all.len()) {
        for draw in 0..draws {
            let mut order = all.clone();
            order.shuffle(&mut generator(seed, u64::from(draw)));
            let predicted = order.split_off(asked);
            let title = "new pushes".to_owned();
            splits.push(Split { title, asked, learnt: order, predicted });
        }
    }
    let Some(&most) = counts.iter().filter(|&&asked| asked < all.len()).max() else {
        return splits;
    };
    for (title, range) in sets.iter().filter(|_| sets.len() > 1) {
        let mut others: Vec<usize> = all.iter().copied().filter(|k| !range.contains(k)).collect();
        others.shuffle(&mut generator(seed, range.start as u64));
        others.truncate(most);
        let (title, predicted) = (format!("left out: {title}"), range.clone().collect());
        splits.push(Split { title, asked: most, learnt: others, predicted });
    }
    splits
}

/// What the models make of a split; `None` where nothing moves in what is learnt from.
///
/// # Errors
/// If the checksum of the weights cannot be made.
pub fn measure_split(
    network: &Network,
    trials: &[Trial],
    split: &Split,
) -> Result<Option<(TableFit, Vec<AdaptedPush>)>, WeightsError> {
    let prior = Prior::default();
    let learnt: Vec<Trial> = split.learnt.iter().map(|&k| trials[k].clone()).collect();
    let settings = FitSettings { values: VALUES, ..FitSettings::default() };
    let Some(found) = fit(&prior, &learnt, &settings, &Unwatched) else { return Ok(None) };
    let table = learn(network, &learnt, &Basis::from(&found), &HeadSettings::default())?;
    let Ok(adapted) = network.clone().fitted(&table) else { return Ok(None) };
    let push = |&recording: &usize| {
        let stated = &trials[recording];
        let mut told = stated.clone();
        table.state(&mut told.scene);
        AdaptedPush {
            recording,
            shipped: error(&prior, stated),
            prior: error(&prior, &told),
            network: error(network, &told),
            adapted: error(&adapted, &told),
            inside: inside(&adapted, &told, &table),
        }
    };
    let pushes = split.predicted.iter().map(push).collect();
    Ok(Some((table, pushes)))
}

/// Mean errors over the objects at the end.
fn error(model: &dyn EffectModel, trial: &Trial) -> [f64; 2] {
    let ends = Comparison::of(model, trial).end();
    let count = ends.len() as f64;
    let position: f64 = ends.iter().map(|end| end.position).sum();
    let turn: f64 = ends.iter().filter_map(|end| end.heading).sum();
    [position / count, turn / count]
}

fn inside(network: &Network, trial: &Trial, table: &TableFit) -> [usize; 2] {
    let Some(truth) = trial.truth.last() else { return [0; 2] };
    let found = Sensitivity::of(network, &trial.scene, &trial.job());
    let Some(end) = found.trajectory.frames.last() else { return [0; 2] };
    let mut inside = [0; 2];
    for (k, object) in trial.scene.objects.iter().enumerate() {
        let (seen, said) = (truth.poses[k], end.state.poses[k]);
        let away = seen.position - said.position;
        let arm = object.shape.footprint().gyration_radius();
        let turn = arm * wrap_angle(seen.heading - said.heading);
        for (axis, away) in [away.x, away.y, turn].into_iter().enumerate() {
            let scale = if axis < 2 { 1.0 } else { arm };
            let row: Vec<f64> = found.rows[3 * k + axis].iter().map(|x| scale * x).collect();
            inside[0] += usize::from(away.abs() <= table.half_width(&row));
            inside[1] += 1;
        }
    }
    inside
}
