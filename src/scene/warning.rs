//! Typed warnings: what happened, what it means, which option helps.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Something that lowers the trust in a result without making it an error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Warning {
    /// A quantity lies outside the range that the weights were trained on.
    OutsideTraining {
        /// Which body, or `task`.
        of: String,
        /// Which quantity, with its unit.
        quantity: String,
        /// Its value.
        value: f64,
        /// Smallest trained value.
        low: f64,
        /// Largest trained value.
        high: f64,
    },
    /// Something still moved when waiting was given up.
    NotAtRest {
        /// How long was waited, seconds.
        waited: f64,
    },
    /// A number became infinite or undefined and the rollout stopped at the last good frame.
    NotFinite,
    /// An object fell over or leans, so that its planar pose no longer tells where it is.
    Toppled {
        /// Its name.
        object: String,
    },
    /// The tool came down on an object instead of beside it.
    SetDownOn {
        /// Name of the object.
        object: String,
        /// Index of the stroke that the tool came down for.
        stroke: usize,
    },
}

impl Warning {
    /// Whether an outcome with this warning cannot count as success.
    pub fn forbids_success(&self) -> bool {
        !matches!(self, Warning::OutsideTraining { .. })
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Warning::OutsideTraining { of, quantity, value, low, high } => write!(
                f,
                "{of}: {quantity} = {value:.4} is outside the trained range {low:.4} to {high:.4}; \
                 predictions may be wrong, `--model planar` simulates instead"
            ),
            Warning::NotAtRest { waited } => write!(
                f,
                "something still moved {waited:.1} s after the push ended; the outcome is not a \
                 rest, raise the friction"
            ),
            Warning::SetDownOn { object, stroke } => write!(
                f,
                "the tool came down on {object} for push {} instead of beside it, so the plan does \
                 not work as written",
                stroke + 1
            ),
            Warning::Toppled { object } => write!(
                f,
                "{object} toppled; its pose on the table means little, push lower or slower"
            ),
            Warning::NotFinite => write!(
                f,
                "the prediction left the finite numbers and was stopped; `--model planar` \
                 simulates instead"
            ),
        }
    }
}
