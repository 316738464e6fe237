//! Measured levels of the shipped efforts, and cheaper ones with the analytic model alone.

use std::collections::BTreeMap;

use pushplan::internals::scene::ModelKind;
use pushplan::internals::solve::{Effort, Settings};

use super::PlanLevel;
use super::front::Noise;
use super::measured::PlanRow;

/// Returns `true` if the model of a level is the shipped network, as of all efforts.
pub fn is_open(level: &PlanLevel) -> bool {
    level.model.first().kind == ModelKind::NETWORK
}

/// Returns the measured level of each effort as far as pushes go. It has the budgets of the effort,
/// and as many perturbed replays or the most below.
pub fn shipped_efforts(plans: &[PlanRow]) -> BTreeMap<Effort, PlanLevel> {
    let level = |effort: Effort| {
        let shipped = effort.settings();
        let ships = |row: &&PlanRow| {
            let Settings { replays, levers, .. } = row.level.settings;
            let same = row.level.settings == Settings { replays, levers, ..shipped };
            same && is_open(&row.level) && row.is_complete() && replays <= shipped.replays
        };
        let row = plans.iter().filter(ships).max_by_key(|row| row.level.settings.replays)?;
        Some((effort, row.level.clone()))
    };
    Effort::ALL.into_iter().filter_map(level).collect()
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
