//! Which effect models a planner uses: one screens the many, one decides among the few.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::text::split;
use super::{ModelSpec, SpecError};

/// Most objects awake in a frame that the network corrects. Where more are, correcting costs more
/// than the prior and buys nothing: over 24 trajectories of each of the sets of `pushplan-lab evaluate
/// --on dense sparse` its mean error is 1.11 (dense) and 0.98 (sparse) times the prior's if it
/// corrects all, 1.00 and 0.95 with five at most, 1.00 and 0.98 with three.
pub const CORRECTED: usize = 5;

/// The effect models of a planner.
///
/// ```text
/// models = [ spec ">" ] spec            what screens, if it is another, and what decides
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
    /// Rolls out the many: the search, and the first rounds of refinement.
    pub screened: ModelSpec,
    /// Rolls out the short list: the last rounds of refinement, the ranking, how far a prediction
    /// is to be trusted, and what is predicted in the end.
    pub decided: ModelSpec,
}

impl Models {
    /// The same with another model that screens.
    pub fn screened_by(self, screened: impl Into<ModelSpec>) -> Self {
        Self { screened: screened.into(), ..self }
    }

    /// Whether one model does everything.
    pub fn is_one(&self) -> bool {
        self.screened == self.decided
    }

    /// Both, each once.
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
