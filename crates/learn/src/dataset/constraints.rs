//! Properties that a test set fixes and training samples.

use pushplan::internals::scene::{Ranges, Span};
use serde::{Deserialize, Serialize};

use super::error::DatasetError;
use super::preset::Preset;
use super::tabletop::Solids;

/// Speed of the hand in the published test sets: 10.5 mm in a frame of 50 ms, m/s.
pub const TEST_SPEED: f64 = 0.21;

/// Rule for joints between near neighbours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JointRule {
    /// No joints.
    None,
    /// Fixed joints between some neighbours.
    Fixed,
    /// Fixed, revolute and prismatic joints between some neighbours, in equal shares.
    Mixed,
}

/// Constraints on the scenes of a crowd; open properties are sampled as for training.
///
/// ```
/// use pushplan_learn::dataset::{
///     Constraints, DatasetConfig, JointRule, Preset, Sampler, Solids, Truth,
/// };
///
/// let test_set = DatasetConfig {
///     seed: 7,
///     episodes: 200,
///     preset: Preset::Dense,
///     constraints: Constraints::test(9, JointRule::Mixed, Solids::Cylinders),
///     truth: Truth::default(),
/// };
/// assert!(test_set.check().is_ok());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Constraints {
    /// Number of objects.
    pub objects: Option<usize>,
    /// Joints between near neighbours.
    pub joints: Option<JointRule>,
    /// Kind of solids.
    pub solids: Option<Solids>,
    /// Speed of the hand, m/s.
    pub speed: Option<f64>,
}

impl Constraints {
    /// Returns the constraints of a published test set, with the hand at [`TEST_SPEED`].
    pub fn test(objects: usize, joints: JointRule, solids: Solids) -> Self {
        Self {
            objects: Some(objects),
            joints: Some(joints),
            solids: Some(solids),
            speed: Some(TEST_SPEED),
        }
    }

    /// Narrows the ranges of a family.
    pub(super) fn narrow(&self, mut ranges: Ranges) -> Ranges {
        if let Some(count) = self.objects {
            ranges.objects = Span::new(count as f64, count as f64);
        }
        if let Some(speed) = self.speed {
            ranges.speed = Span::new(speed, speed);
        }
        ranges
    }

    /// Checks that `preset` can satisfy the constraints.
    ///
    /// # Errors
    /// Returns [`DatasetError::Constraint`] for constraints on scenes that are no crowds, and for a
    /// number of objects or a speed that the family does not cover.
    pub(super) fn check(&self, preset: Preset) -> Result<(), DatasetError> {
        let refused = |why: String| Err(DatasetError::Constraint(why));
        if *self == Self::default() {
            return Ok(());
        }
        if !preset.is_crowd() {
            return refused(
                "--objects, --joints, --solids and --speed need the preset sparse, sparse-line or \
                 dense"
                    .to_owned(),
            );
        }
        let ranges = preset.ranges();
        let within = |what: &str, value: f64, span: Span| match span.contains(value) {
            true => Ok(()),
            false => refused(format!("{what} must be from {} to {}", span.low, span.high)),
        };
        self.objects.map_or(Ok(()), |n| within("objects", n as f64, ranges.objects))?;
        self.speed.map_or(Ok(()), |v| within("speed (m/s)", v, ranges.speed))
    }
}
