//! Which measured level each effort stands for.

use std::collections::BTreeMap;

use pushplan::internals::scene::ModelKind;
use pushplan::internals::solve::Effort;

use super::PlanLevel;
use super::measured::PlanRow;

/// How much more often than the best level each effort may fail, as a share of disturbed replays:
/// three times less from one to the next.
const LOSSES: [(Effort, f64); 3] =
    [(Effort::Draft, 0.10), (Effort::Standard, 0.032), (Effort::Thorough, 0.01)];

/// The efforts among the levels on the front whose models are part of the library: each is the
/// cheapest that fails no more often than it may. Where a cheap level is as robust as any, efforts
/// are the same.
pub fn choose_efforts(plans: &[PlanRow]) -> BTreeMap<Effort, PlanLevel> {
    let front = || plans.iter().filter(|row| row.on_front && is_shipped(&row.level));
    let best = front().map(|row| row.robustness).fold(0.0, f64::max);
    LOSSES
        .into_iter()
        .filter_map(|(effort, loss)| {
            // The small part is rounding.
            let good = front().filter(|row| row.robustness >= best - loss - 1e-9);
            let cheapest = good.min_by(|a, b| a.seconds.total_cmp(&b.seconds))?;
            Some((effort, cheapest.level.clone()))
        })
        .collect()
}

/// Whether its model is part of the library.
fn is_shipped(level: &PlanLevel) -> bool {
    let foreign = |kind: &ModelKind| matches!(kind, ModelKind::Network { weights: Some(_), .. });
    !level.model.parts().any(|part| foreign(&part.kind))
}
