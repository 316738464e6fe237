//! Resolution of the analytic model of lever-ups.

/// Step and iterations of [`LeverPrior`](super::LeverPrior).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PriorSettings {
    /// Maximum step while the blade moves and the plate with it, seconds.
    pub step: f64,
    /// Maximum travel of a point of the plate in a step, metres; faster motions get shorter steps.
    /// A falling plate is as fast as ten blades.
    pub travel: f64,
    /// Minimum step, seconds.
    pub shortest: f64,
    /// Number of sweeps over the contacts in a step.
    pub sweeps: usize,
    /// Whether the plate has inertia. Otherwise every step begins at rest.
    pub inertia: bool,
}

impl PriorSettings {
    /// Quasi-static settings: every step begins at rest.
    pub const FROM_REST: Self =
        Self { step: 1.0 / 15.0, travel: 0.01, shortest: 1.0 / 15.0, sweeps: 10, inertia: false };
    /// Settings for search.
    pub const USUAL: Self =
        Self { step: 1.0 / 30.0, travel: 0.01, shortest: 1.0 / 120.0, sweeps: 40, inertia: true };
    /// Settings below a network, which compensates for fewer sweeps: about a sixth faster.
    pub const CORRECTED: Self = Self { sweeps: 20, ..Self::USUAL };
    /// Settings beyond which finer steps change nothing.
    pub const FINE: Self =
        Self { step: 1.0 / 240.0, travel: 0.002, shortest: 1.0 / 480.0, sweeps: 40, inertia: true };

    /// Returns the settings with the shorter steps needed among blocks, where gaps are of
    /// millimetres.
    #[must_use]
    pub fn among_blocks(self) -> Self {
        if !self.inertia {
            return self;
        }
        Self { step: self.step.min(1.0 / 60.0), travel: self.travel.min(0.004), ..self }
    }
}

impl Default for PriorSettings {
    fn default() -> Self {
        Self::USUAL
    }
}
