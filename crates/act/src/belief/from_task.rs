//! Beliefs about a task: its unknowns are estimated, all other values are taken as true.

use std::sync::Arc;

use pushplan::scene::{Physics, Scene, Span, Tool, Unknowns, Velocity};

use super::{
    filter::Belief,
    masses::{MassShares, Masses},
    particles::{Numbers, Particles},
    settings::BeliefSettings,
};

impl Belief {
    /// Returns the initial belief about `scene` with the given unknowns.
    ///
    /// The objects were observed at their stated poses. Particles are drawn from `seed`. The tool's
    /// underside is `lift` metres above the table.
    pub fn about(
        scene: &Scene,
        unknown: Unknowns,
        (tool, lift): (Arc<Tool>, f64),
        settings: BeliefSettings,
        seed: u64,
    ) -> Self {
        let mut belief = Self::new(scene, tool, lift, settings);
        if !unknown.joints {
            belief.pairs.clear();
            belief.known.clone_from(&scene.joints);
        }
        belief.particles = Particles::new(scene.objects.len(), unknown, seed);
        belief
    }

    /// Sets the initial velocities of the objects, in their order; by default they rest.
    pub fn moving(mut self, velocities: &[Velocity]) -> Self {
        for (own, stated) in self.track.state.velocities.iter_mut().zip(velocities) {
            *own = *stated;
        }
        self
    }

    /// Restricts every mass to one of `ranges`, kg, instead of the stated mass.
    ///
    /// The ranges are equally probable before any contact between objects; such contacts then
    /// discriminate between them. Without ranges the belief is unchanged.
    pub fn with_mass_ranges(mut self, ranges: &[Span]) -> Self {
        self.masses = (!ranges.is_empty()).then(|| Masses::new(self.scene.objects.len(), ranges));
        self
    }

    /// Returns the probabilities of the mass ranges; `None` without [`Self::with_mass_ranges`].
    pub fn mass_shares(&self) -> Option<MassShares> {
        self.masses.as_ref().map(Masses::shares)
    }

    /// Changes the tool for later observations; its underside is `lift` metres above the table.
    /// Earlier observations should be settled.
    pub fn take_tool(&mut self, tool: Arc<Tool>, lift: f64) {
        self.tool = tool;
        self.lift = lift;
        self.push = None;
    }

    /// Returns the standard deviations of every object's coordinates (metres) and heading
    /// (radians).
    pub fn doubt(&self) -> Vec<[f64; 2]> {
        self.track.variance.iter().map(|variance| variance.map(f64::sqrt)).collect()
    }

    /// Returns the belief about masses, frictions and supports, including known values.
    pub fn numbers(&self) -> Numbers {
        self.particles.numbers(&self.scene, &Physics::stated(&self.scene))
    }
}
