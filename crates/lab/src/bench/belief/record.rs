//! What is measured on one trajectory.

use pushplan_act::belief::JointType;
use serde::{Deserialize, Serialize};

/// Ways to tell how objects are joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JointMethod {
    /// As it is.
    True,
    /// Nothing is joined.
    None,
    /// What touches is fixed.
    ContactsFixed,
    /// Geometric residual tests on everything seen so far.
    Residuals,
    /// What the last window says alone.
    LastWindow,
    /// The hypothesis filter.
    Filter,
    /// The filter with the regulator network.
    Regulator,
}

impl JointMethod {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::True,
        Self::None,
        Self::ContactsFixed,
        Self::Residuals,
        Self::LastWindow,
        Self::Filter,
        Self::Regulator,
    ];

    /// A name for tables.
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

/// What became of one trajectory.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeliefRecord {
    /// The case, an index into [`super::BeliefSuite::cases`].
    pub case: usize,
    /// Number of observations.
    pub observations: usize,
    /// Number of objects.
    pub objects: usize,
    /// True types of the pairs that stood near each other.
    pub types: Vec<JointType>,
    /// In order of time, the end last.
    pub checkpoints: Vec<Checkpoint>,
    /// Errors of anchors at the end, of revolute pairs found that turned by 15 degrees and more,
    /// metres: of the filter, or of the regulated belief where there is one.
    pub anchors: Vec<f64>,
    /// Errors of axes at the end, of prismatic pairs found that slid by 2 cm and more, radians.
    pub axes: Vec<f64>,
}

/// When beliefs are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum When {
    /// After a number of observations of a single stroke.
    Observations(usize),
    /// After a number of strokes of several.
    Strokes(usize),
    /// A number of observations after the first that shows motion.
    AfterContact(usize),
    /// After everything.
    End,
}

/// What is believed at some point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// When.
    pub when: When,
    /// Whether either object of a pair has moved by more than 1 cm by now.
    pub moved: Vec<bool>,
    /// Types by method.
    pub types: Vec<(JointMethod, Vec<JointType>)>,
    /// Probabilities by method, of those that have them.
    pub probabilities: Vec<(JointMethod, Vec<[f64; 4]>)>,
    /// The rest of the way by method; none at the end.
    pub rest: Vec<Rest>,
}

/// A prediction of the rest of the way.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rest {
    /// With the joints by this method.
    pub by: JointMethod,
    /// Distance of predicted from true final positions, mean over all objects, metres.
    pub error: f64,
}
