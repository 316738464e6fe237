//! Assumptions of an effect model that replace values of its job.

/// An assumption about the joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum JointBelief {
    /// No joints.
    None,
    /// The type of every joint, its geometry guessed from the poses that the scene states.
    Guessed,
    /// A fixed joint at every contact or near contact, and no other joints.
    Fixed,
}

/// Assumptions of a model that replace values of its job, to measure the benefit of knowing these
/// values. Empty by default.
///
/// Values are whole numbers, so that the text form is exact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Assumptions {
    /// Assumed joints.
    pub joints: Option<JointBelief>,
    /// Factor of every friction value, including table and tool, in percent.
    pub friction: Option<u16>,
    /// Shift of every object's start in a random direction, micrometres. Objects that joints
    /// connect move together, so that the joints still hold.
    pub start: Option<u16>,
}

impl Assumptions {
    /// Returns `true` if nothing is assumed.
    pub fn are_none(&self) -> bool {
        *self == Self::default()
    }
}
