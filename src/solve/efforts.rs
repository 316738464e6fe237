//! What the efforts stand for: measured levels of planning.
//!
//! `pushplan tradeoff` measures success and cost of every level and writes a file; the one that
//! is part of the library says which of the levels on its front each effort is. A test fails
//! when another measured level is both cheaper and more successful.

use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock};

use serde::{Deserialize, Serialize};

use crate::effect::{Crowded, EffectModel, EffectModels, Simulated};
use crate::network::WeightsError;
use crate::sim::Simulator;

use super::{Effort, Settings};

/// The measured file.
const MEASURED: &str = include_str!("../../models/tradeoff.json");

/// A level of planning: an effect model and budgets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EffortLevel {
    /// Its name in the measured file.
    pub level: String,
    /// Name of the effect model.
    pub model: String,
    /// The budgets; disturbed replays are none, as they change nothing in the choice of a plan.
    pub settings: Settings,
}

#[derive(Default, Deserialize)]
struct Measured {
    efforts: BTreeMap<Effort, EffortLevel>,
    objects: Vec<CostRow>,
}

/// Processor time of a push by the number of objects that it reaches.
#[derive(Clone, Debug, Deserialize)]
struct CostRow {
    objects: usize,
    model: String,
    seconds: f64,
}

/// Step of the planar engine that pushes into crowds are left to, seconds: among touching objects
/// it errs less than the prior, and costs half of what the engine does at its finest step.
const CROWD_STEP: f64 = 1.0 / 120.0;

/// Share of the engine's cost below which a model is preferred: nearer to it the engine's smaller
/// error among touching objects decides, not the noise of the measurement.
const WORTH: f64 = 0.9;

/// A test sees to it that the file can be read and has all efforts.
static TRADE: LazyLock<Measured> =
    LazyLock::new(|| serde_json::from_str(MEASURED).unwrap_or_default());

impl Effort {
    /// The measured level that it stands for; nothing only in a library built around a damaged
    /// file.
    pub fn level(self) -> Option<&'static EffortLevel> {
        TRADE.efforts.get(&self)
    }

    /// What it means in numbers: the budgets of its level, and the replays that tell how robust
    /// the plan is.
    pub fn settings(self) -> Settings {
        let settings = self.level().map_or(Settings::FIRST_LOOK, |level| level.settings);
        Settings { disturbed: self.disturbed(), ..settings }
    }

    /// The effect model of its level, and the planar engine for pushes that reach so many objects
    /// that the model is no longer clearly cheaper.
    ///
    /// # Errors
    /// [`WeightsError`] if the library was built around a damaged weights file.
    pub fn model(self) -> Result<Arc<dyn EffectModel>, WeightsError> {
        let named = match self.level() {
            Some(level) => EffectModels::named(&level.model)?,
            None => None,
        };
        let model = named.map_or_else(EffectModels::shipped, Ok)?;
        let planar = Simulator::planar_with_step(CROWD_STEP);
        let most =
            cheaper_up_to(&TRADE.objects, model.name(), Simulated::new(planar.clone()).name());
        Ok(Arc::new(Crowded::new(model, planar, most)))
    }

    /// Disturbed replays of the winning plan in each engine: what a look, a usual answer, a
    /// careful one and a thorough study are worth.
    fn disturbed(self) -> usize {
        match self {
            Effort::Draft => 0,
            Effort::Standard => 8,
            Effort::Thorough => 16,
            Effort::Exhaustive => 64,
        }
    }
}

/// The most objects for which `model` costs less than [`WORTH`] of what `rival` does, between
/// measured numbers of them by straight lines in logarithms; no limit if it is never seen to cost
/// more.
fn cheaper_up_to(rows: &[CostRow], model: &str, rival: &str) -> usize {
    let mut last: Option<(f64, f64)> = None;
    for row in rows.iter().filter(|row| row.model == model) {
        let other = rows.iter().find(|o| o.objects == row.objects && o.model == rival);
        let Some(other) = other else { continue };
        let count = (row.objects as f64).ln();
        let dearer = (row.seconds / (WORTH * other.seconds)).ln();
        if dearer >= 0.0 {
            let crossing = last.map_or(0.0, |(before, was)| {
                (before + (count - before) * was / (was - dearer)).exp()
            });
            return crossing.floor() as usize;
        }
        last = Some((count, dearer));
    }
    usize::MAX
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_planar_engine_takes_over_where_the_measured_costs_cross() {
        let row = |objects, model: &str, seconds| CostRow { objects, model: model.into(), seconds };
        let rows = |costs: [f64; 3]| {
            let counts = [1, 3, 9].into_iter().zip(costs);
            let own = counts.map(|(n, cost)| row(n, "own", cost));
            own.chain([1, 3, 9].map(|n| row(n, "planar", 1.0))).collect::<Vec<_>>()
        };
        // Cost 0.05 n^2 passes the worth at the square root of 18.
        assert_eq!(cheaper_up_to(&rows([0.05, 0.45, 4.05]), "own", "planar"), 4);
        assert_eq!(cheaper_up_to(&rows([0.01, 0.09, 0.81]), "own", "planar"), usize::MAX);
        assert_eq!(cheaper_up_to(&rows([2.0, 3.0, 4.0]), "own", "planar"), 0);
    }

    #[test]
    fn the_measured_file_is_read() {
        assert_eq!(TRADE.efforts.len(), 4);
        // The README says that pushes that can reach three objects are simulated.
        for model in ["quasi-static", "brdpn-128"] {
            assert_eq!(cheaper_up_to(&TRADE.objects, model, "planar, 1/120 s"), 2);
        }
    }
}
