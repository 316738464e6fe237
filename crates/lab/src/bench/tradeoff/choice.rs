//! Which measured level each effort stands for.

use std::collections::BTreeMap;

use pushplan::internals::scene::ModelKind;
use pushplan::internals::solve::Effort;

use super::front::{Noise, on_front};
use super::measured::PlanRow;
use super::{PlanLevel, Point};

/// How much more often than the best level each effort may fail, as a share of disturbed replays:
/// three times less from one to the next.
const LOSSES: [(Effort, f64); 3] =
    [(Effort::Draft, 0.10), (Effort::Standard, 0.032), (Effort::Thorough, 0.01)];

/// Whether a level is one that `effort` can stand for: in all of them the shipped network decides, in
/// the thorough one no other model screens for it.
pub fn is_open_to(effort: Effort, level: &PlanLevel) -> bool {
    let decides = level.model.first().kind == ModelKind::NETWORK;
    decides && (effort != Effort::Thorough || level.screen.is_none())
}

/// The level of each effort: of those that are open to it and on their front, the cheapest that fails
/// no more often than it may. Where a cheap level is as robust as any, efforts are the same.
pub fn choose_efforts(plans: &[PlanRow], noise: Noise) -> BTreeMap<Effort, PlanLevel> {
    let choose = |(effort, loss)| {
        let open = |row: &&PlanRow| row.is_complete() && is_open_to(effort, &row.level);
        let rows: Vec<&PlanRow> = plans.iter().filter(open).collect();
        let points: Vec<Point> = rows.iter().map(|row| row.point()).collect();
        let front = on_front(&points, noise);
        let front = || rows.iter().zip(&front).filter(|(_, front)| **front).map(|(row, _)| *row);
        let best = front().map(|row| row.robustness).fold(0.0, f64::max);
        // The small part is rounding.
        let good = front().filter(|row| row.robustness >= best - loss - 1e-9);
        let cheapest = good.min_by(|a, b| a.seconds.total_cmp(&b.seconds))?;
        Some((effort, cheapest.level.clone()))
    };
    LOSSES.into_iter().filter_map(choose).collect()
}

/// The cheapest level with the prior alone that is cheaper than `row` and as robust, beyond the noise
/// of costs and within that of robustness.
pub fn prior_instead<'a>(plans: &'a [PlanRow], row: &PlanRow, noise: Noise) -> Option<&'a PlanRow> {
    let alone =
        |level: &PlanLevel| level.model == ModelKind::PRIOR.into() && level.screen.is_none();
    plans
        .iter()
        .filter(|other| other.is_complete() && alone(&other.level))
        .filter(|other| other.seconds < row.seconds * (1.0 - noise.cost))
        .filter(|other| other.robustness >= row.robustness - noise.error)
        .min_by(|a, b| a.seconds.total_cmp(&b.seconds))
}
