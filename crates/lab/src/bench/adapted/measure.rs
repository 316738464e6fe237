//! Fit and prediction for a split of recordings.

use std::ops::Range;

use pushplan::internals::effect::{EffectModel, Network, Prior};
use pushplan::internals::geometry::wrap_angle;
use pushplan::internals::network::WeightsError;
use pushplan::internals::scene::TableFit;
use pushplan::internals::seeded::generator;
use pushplan::progress::NoProgress;
use pushplan_act::fit::{Basis, FitSettings, HeadSettings, Sensitivity, fit, learn};
use pushplan_act::judge::{Comparison, Trial};
use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};

/// Number of values on an axis of the grid of friction and support: half as many as in `pushplan
/// fit`, so that dozens of splits take minutes.
const VALUES: usize = 9;

/// A split of recordings into a training set and a test set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Split {
    /// Name of the test set: `new pushes`, or the set that is left out.
    pub title: String,
    /// Requested number of training pushes.
    pub asked: usize,
    /// Indices of the training recordings.
    pub learnt: Vec<usize>,
    /// Indices of the predicted recordings.
    pub predicted: Vec<usize>,
}

/// A predicted push: final errors of position, metres, and rotation, radians, by each model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AdaptedPush {
    /// Index of the recording, which groups repeated predictions.
    pub recording: usize,
    /// Errors of the analytic model as shipped.
    pub shipped: [f64; 2],
    /// Errors of the analytic model after the fit.
    pub prior: [f64; 2],
    /// Errors of the network after the same fit, without a head.
    pub network: [f64; 2],
    /// Errors of the network with its head.
    pub adapted: [f64; 2],
    /// Number of values of x, y and rotation within the stated 90 %, and their total number.
    pub inside: [usize; 2],
}

/// Returns `draws` random splits for each number of training pushes, and a split for each set left
/// out, trained on at most the largest number of the other recordings.
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

/// Fits the models to a split and predicts its test set. Returns `None` if nothing moves in the
/// training recordings.
///
/// # Errors
/// Returns an error if the checksum of the weights cannot be computed.
pub fn measure_split(
    network: &Network,
    trials: &[Trial],
    split: &Split,
) -> Result<Option<(TableFit, Vec<AdaptedPush>)>, WeightsError> {
    let prior = Prior::default();
    let learnt: Vec<Trial> = split.learnt.iter().map(|&k| trials[k].clone()).collect();
    let settings = FitSettings { values: VALUES, ..FitSettings::default() };
    let Some(found) = fit(&prior, &learnt, &settings, &NoProgress) else { return Ok(None) };
    let table = learn(network, &learnt, &Basis::from(&found), &HeadSettings::default())?;
    let Ok(adapted) = network.clone().fitted(&table) else { return Ok(None) };
    let push = |&recording: &usize| {
        let stated = &trials[recording];
        let mut with_fit = stated.clone();
        table.state(&mut with_fit.scene);
        AdaptedPush {
            recording,
            shipped: error(&prior, stated),
            prior: error(&prior, &with_fit),
            network: error(network, &with_fit),
            adapted: error(&adapted, &with_fit),
            inside: inside(&adapted, &with_fit, &table),
        }
    };
    let pushes = split.predicted.iter().map(push).collect();
    Ok(Some((table, pushes)))
}

/// Returns the mean errors over the objects at the end.
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
        let (seen, predicted) = (truth.poses[k], end.state.poses[k]);
        let away = seen.position - predicted.position;
        let arm = object.shape.footprint().gyration_radius();
        let turn = arm * wrap_angle(seen.heading - predicted.heading);
        for (axis, away) in [away.x, away.y, turn].into_iter().enumerate() {
            let scale = if axis < 2 { 1.0 } else { arm };
            let row: Vec<f64> = found.rows[3 * k + axis].iter().map(|x| scale * x).collect();
            inside[0] += usize::from(away.abs() <= table.half_width(&row));
            inside[1] += 1;
        }
    }
    inside
}
