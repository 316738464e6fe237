//! What the efforts stand for: measured levels of planning.
//!
//! `pushplan tradeoff` measures success and cost of every level and writes a file; the one that
//! is part of the library says which of the levels on its front each effort is. A test fails
//! when another measured level is both cheaper and more successful.

use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock};

use serde::{Deserialize, Serialize};

use crate::brdpn::WeightsError;
use crate::effect::{EffectModel, EffectModels};

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
}

/// A test sees to it that the file can be read and has all efforts.
static LEVELS: LazyLock<BTreeMap<Effort, EffortLevel>> = LazyLock::new(|| {
    let measured: Measured = serde_json::from_str(MEASURED).unwrap_or_default();
    measured.efforts
});

impl Effort {
    /// The measured level that it stands for; nothing only in a library built around a damaged
    /// file.
    pub fn level(self) -> Option<&'static EffortLevel> {
        LEVELS.get(&self)
    }

    /// What it means in numbers: the budgets of its level, and the replays that tell how robust
    /// the plan is.
    pub fn settings(self) -> Settings {
        let settings = self.level().map_or(Settings::FIRST_LOOK, |level| level.settings);
        Settings { disturbed: self.disturbed(), ..settings }
    }

    /// The effect model of its level.
    ///
    /// # Errors
    /// [`WeightsError`] if the library was built around a damaged weights file.
    pub fn model(self) -> Result<Arc<dyn EffectModel>, WeightsError> {
        let named = match self.level() {
            Some(level) => EffectModels::named(&level.model)?,
            None => None,
        };
        named.map_or_else(EffectModels::shipped, Ok)
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
