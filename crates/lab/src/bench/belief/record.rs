//! Results of a trajectory.

use pushplan_act::belief::JointType;
use serde::{Deserialize, Serialize};

/// Methods of joint estimation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JointMethod {
    /// True joints.
    True,
    /// No joints.
    None,
    /// Fixed joints at all contacts.
    ContactsFixed,
    /// Geometric residual tests on all observations so far.
    Residuals,
    /// Likelihood of the last window alone.
    LastWindow,
    /// Hypothesis filter.
    Filter,
    /// Filter with the regulator network.
    Regulator,
}

impl JointMethod {
    /// Every method.
    pub const ALL: [Self; 7] = [
        Self::True,
        Self::None,
        Self::ContactsFixed,
        Self::Residuals,
        Self::LastWindow,
        Self::Filter,
        Self::Regulator,
    ];

    /// Returns a name for tables.
    pub fn title(self) -> &'static str {
        match self {
            Self::True => "true joints",
            Self::None => "none",
            Self::ContactsFixed => "contacts fixed",
            Self::Residuals => "residuals",
            Self::LastWindow => "last window",
            Self::Filter => "filter",
            Self::Regulator => "regulator",
        }
    }
}

/// Result of a trajectory.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeliefRecord {
    /// The case, an index into [`super::BeliefSuite::cases`].
    pub case: usize,
    /// Number of observations.
    pub observations: usize,
    /// Number of objects.
    pub objects: usize,
    /// True types of the near pairs.
    pub types: Vec<JointType>,
    /// Checkpoints in order of time, the end last.
    pub checkpoints: Vec<Checkpoint>,
    /// Errors of anchors at the end, metres, of identified revolute pairs that rotated by 15
    /// degrees or more. They are the errors of the regulated belief, if any, otherwise of the
    /// filter.
    pub anchors: Vec<f64>,
    /// Errors of axes at the end, radians, of identified prismatic pairs that slid by 2 cm or more.
    pub axes: Vec<f64>,
}

/// Time at which beliefs are evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum When {
    /// After a number of observations of a single stroke.
    Observations(usize),
    /// After a number of several strokes.
    Strokes(usize),
    /// A number of observations after the first one with motion.
    AfterContact(usize),
    /// After everything.
    End,
}

/// Beliefs at some point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Time of the checkpoint.
    pub when: When,
    /// Whether either object of a pair has moved by more than 1 cm so far.
    pub moved: Vec<bool>,
    /// Types by method.
    pub types: Vec<(JointMethod, Vec<JointType>)>,
    /// Probabilities by method, if it has them.
    pub probabilities: Vec<(JointMethod, Vec<[f64; 4]>)>,
    /// Predictions of the remaining motion by method; empty at the end.
    pub rest: Vec<Rest>,
}

/// A prediction of the remaining motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rest {
    /// Method that estimates the joints.
    pub by: JointMethod,
    /// Distance of predicted from true final positions, mean over all objects, metres.
    pub error: f64,
}
