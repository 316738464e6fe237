//! Constants of the equations of a frame, for one object and for many alike.

/// Instant of a frame at which contacts are evaluated for displacements, as a share of the frame.
pub const HALF: f64 = 0.5;

/// Instant of a frame at which contacts are evaluated for velocities.
pub const WHOLE: f64 = 1.0;

/// Length that turns angles into lengths, metres: about the radius of objects on a table.
pub const JOINT_ARM: f64 = 0.05;

/// Maximum number of updates of the weights A.
pub const UPDATES: usize = 8;

/// Change by an update below which it is the last, metres.
pub const SETTLED: f64 = 1e-5;

/// Share of its own effect, without joints, by which a force gives way; keeps forces finite where
/// nothing fits, and where the force of a contact acts through the axis of a joint.
pub const GIVE: f64 = 2e-3;

/// Smallest share of a sliding contact's own compliance along the normal that counts: below it
/// the contact wedges, which these equations cannot answer.
pub const MIN_COMPLIANCE: f64 = 0.2;

/// Displacement that does not count, metres: rounding must not decide anything.
pub const OPEN: f64 = 1e-9;

/// Smallest distance of two points whose line gives a normal, metres: that of nearer ones may
/// point anywhere a moment later.
pub const NEAR: f64 = 5e-3;

/// Most rounds in which all constraints may change what they do. After these, and as soon as a set
/// comes again, only the one that is farthest off may: all at once go in circles where objects jam.
pub const TOGETHER: usize = 6;

/// Most rounds. Of 100 drawn sets in a jam 74 are found with 12, 82 with 16 and 87 with 24; in
/// crowds with joints 24 do not find more than 12. A tenth of the time there went into looking,
/// before circles were noticed.
pub const ROUNDS: usize = 16;

/// Updates of the weights in which the load follows what presses; then it stays, as where it goes
/// and what then presses could otherwise alternate for ever. Of 400 held-out pushes of one object
/// the mean error against the planar engine is 2.85 mm with 1, 2.33 with 2, 1.70 with 4, 1.60 with
/// 5, 1.63 with 6 and 1.8 without end.
pub const FOLLOWING: usize = 5;

/// Smallest share of a frame for which an object moves that comes to rest within it, so that inertia
/// stays finite.
pub const LEAST: f64 = 1e-3;

/// Change of motion (metres, radians) and of pressing below which weights are kept.
pub const SAME: f64 = 1e-9;

/// The unknowns of a frame's equations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Quantity {
    /// Displacements in the frame.
    #[default]
    Displacement,
    /// Velocities at its end, times its duration.
    Velocity,
}

impl Quantity {
    /// Smallest length s, metres: smaller motions of a frame count as stuck. Velocities need a
    /// finer one, because what is left of them must count as rest.
    #[inline(always)]
    pub fn stuck(self) -> f64 {
        match self {
            Self::Displacement => 1e-4,
            Self::Velocity => 1e-5,
        }
    }
}
