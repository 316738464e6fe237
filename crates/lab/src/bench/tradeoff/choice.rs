//! Choice of a measured level for each effort.

use std::collections::BTreeMap;

use pushplan::internals::scene::ModelKind;
use pushplan::internals::solve::Effort;

use super::front::{Noise, on_front};
use super::measured::PlanRow;
use super::{PlanLevel, Point};

/// Largest excess of each effort's failures over the best level, in shares of perturbed replays:
/// three times less from one effort to the next.
const LOSSES: [(Effort, f64); 3] =
    [(Effort::Draft, 0.10), (Effort::Standard, 0.032), (Effort::Thorough, 0.01)];

/// Returns `true` if a level is eligible for an effort: its model is the shipped network.
pub fn is_open(level: &PlanLevel) -> bool {
    level.model.first().kind == ModelKind::NETWORK
}

/// Returns the level of each effort: the cheapest on the front of the eligible levels whose
/// failures are within `LOSSES`. If a cheap level is as robust as any, efforts share it.
pub fn choose_efforts(plans: &[PlanRow], noise: Noise) -> BTreeMap<Effort, PlanLevel> {
    let choose = |(effort, loss)| {
        let open = |row: &&PlanRow| row.is_complete() && is_open(&row.level);
        let rows: Vec<&PlanRow> = plans.iter().filter(open).collect();
        let points: Vec<Point> = rows.iter().map(|row| row.point()).collect();
        let front = on_front(&points, noise);
        let front = || rows.iter().zip(&front).filter(|(_, front)| **front).map(|(row, _)| *row);
        let best = front().map(|row| row.robustness).fold(0.0, f64::max);
        // The small term absorbs rounding.
        let good = front().filter(|row| row.robustness >= best - loss - 1e-9);
        let cheapest = good.min_by(|a, b| a.seconds.total_cmp(&b.seconds))?;
        Some((effort, cheapest.level.clone()))
    };
    LOSSES.into_iter().filter_map(choose).collect()
}

/// Returns the cheapest level with the analytic model alone that is cheaper than `row` and as
/// robust. The costs must differ by more than the noise, the robustness by no more than the noise.
pub fn prior_instead<'a>(plans: &'a [PlanRow], row: &PlanRow, noise: Noise) -> Option<&'a PlanRow> {
    let alone = |level: &PlanLevel| level.model == ModelKind::PRIOR.into();
    plans
        .iter()
        .filter(|other| other.is_complete() && alone(&other.level))
        .filter(|other| other.seconds < row.seconds * (1.0 - noise.cost))
        .filter(|other| other.robustness >= row.robustness - noise.error)
        .min_by(|a, b| a.seconds.total_cmp(&b.seconds))
}
