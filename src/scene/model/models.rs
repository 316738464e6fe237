//! The effect models of a planner: a screening model for many candidates, a final model for the
//! short list.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::text::split;
use super::{ModelSpec, SpecError};

/// Maximum number of moving objects in a frame that the network corrects. With more objects, the
/// correction costs more time than the analytic model and does not improve the prediction.
///
/// Measured with `pushplan-lab evaluate --on dense sparse` on 24 trajectories of each set. Relative
/// to the analytic model, the mean error is 1.11 (dense) and 0.98 (sparse) if every frame is
/// corrected. It is 1.00 and 0.95 with at most five objects, and 1.00 and 0.98 with three.
pub const CORRECTED: usize = 5;

/// The effect models of a planner.
///
/// ```text
/// models = [ spec ">" ] spec            screening model, if it is another, and final model
/// ```
///
/// ```
/// use pushplan::scene::{ModelKind, Models};
///
/// let models: Models = "prior>network".parse()?;
/// assert_eq!(models, Models::from(ModelKind::NETWORK).screened_by(ModelKind::PRIOR));
/// assert_eq!(models.to_string(), "prior>network");
/// assert_eq!("planar".parse::<Models>()?, ModelKind::PLANAR.into());
/// # Ok::<(), pushplan::scene::SpecError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Models {
    /// Screening model: the search, and the first rounds of refinement.
    pub screened: ModelSpec,
    /// Final model: the last rounds of refinement, the ranking, the trust in a prediction, and the
    /// reported prediction.
    pub decided: ModelSpec,
}

impl Models {
    /// Replaces the screening model.
    pub fn screened_by(self, screened: impl Into<ModelSpec>) -> Self {
        Self { screened: screened.into(), ..self }
    }

    /// Returns `true` if one model is both screening and final model.
    pub fn is_one(&self) -> bool {
        self.screened == self.decided
    }

    /// Returns the distinct models, the final model first.
    pub fn specs(&self) -> impl Iterator<Item = &ModelSpec> {
        std::iter::once(&self.decided).chain((!self.is_one()).then_some(&self.screened))
    }
}

impl<S: Into<ModelSpec>> From<S> for Models {
    fn from(spec: S) -> Self {
        let decided = spec.into();
        Self { screened: decided.clone(), decided }
    }
}

impl fmt::Display for Models {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.is_one() {
            true => write!(f, "{}", self.decided),
            false => write!(f, "{}>{}", self.screened, self.decided),
        }
    }
}

impl FromStr for Models {
    type Err = SpecError;

    fn from_str(text: &str) -> Result<Self, SpecError> {
        match split(text, '>')[..] {
            [screened, decided] => {
                Ok(Self { screened: screened.parse()?, decided: decided.parse()? })
            }
            _ => Ok(text.parse::<ModelSpec>()?.into()),
        }
    }
}
