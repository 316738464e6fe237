//! How finely the prior computes.

/// Step and iterations of [`LeverPrior`](super::LeverPrior).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PriorSettings {
    /// Longest step while the blade moves and the plate with it, seconds.
    pub step: f64,
    /// Farthest that a point of the plate may move in a step, metres, before steps get shorter: a
    /// plate that falls is as fast as ten blades.
    pub travel: f64,
    /// Shortest step, seconds.
    pub shortest: f64,
    /// Sweeps over the contacts in a step.
    pub sweeps: usize,
    /// Whether the plate keeps its speed. Without it every step begins at rest.
    pub inertia: bool,
}

impl PriorSettings {
    /// Every step from rest: what a plate would do that has no inertia.
    pub const FROM_REST: Self =
        Self { step: 1.0 / 15.0, travel: 0.01, shortest: 1.0 / 15.0, sweeps: 10, inertia: false };
    /// For search.
    pub const USUAL: Self =
        Self { step: 1.0 / 30.0, travel: 0.01, shortest: 1.0 / 120.0, sweeps: 40, inertia: true };
    /// Below a network, which makes up for what fewer sweeps leave: about a sixth faster.
    pub const CORRECTED: Self = Self { sweeps: 20, ..Self::USUAL };
    /// Steps beyond which finer ones bring nothing.
    pub const FINE: Self =
        Self { step: 1.0 / 240.0, travel: 0.002, shortest: 1.0 / 480.0, sweeps: 40, inertia: true };

    /// The same among blocks, where gaps are of millimetres: steps that are short enough.
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
