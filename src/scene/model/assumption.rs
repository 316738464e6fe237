//! What an effect model is told about a scene instead of what its job says.

/// What a model is told about the joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum JointBelief {
    /// That there are none.
    None,
    /// The type of every joint, its geometry guessed from the poses that the scene states.
    Guessed,
    /// That whatever touches or nearly touches is fixed together, and nothing else.
    Fixed,
}

/// What a model is told that its job does not say, to measure what knowing it is worth. Nothing by
/// default.
///
/// Whole numbers, so that the text form is exact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Assumptions {
    /// Other joints.
    pub joints: Option<JointBelief>,
    /// Every friction value, the table's and the tool's included, times this many percent.
    pub friction: Option<u16>,
    /// Every object's start shifted by this many micrometres in a random direction; objects that
    /// joints connect move together, so that the joints still hold.
    pub start: Option<u16>,
}

impl Assumptions {
    /// Whether nothing is assumed.
    pub fn are_none(&self) -> bool {
        *self == Self::default()
    }
}
