//! Beliefs about a task: what is unknown of its scene is to be found out, everything else is true.

use std::sync::Arc;

use pushplan::scene::{Physics, Scene, Span, Tool, Unknowns, Velocity};

use super::{
    filter::Belief,
    masses::{MassShares, Masses},
    particles::{Numbers, Particles},
    settings::BeliefSettings,
};

impl Belief {
    /// What is believed of `scene`, of which so much is `unknown`, before anything has moved; its
    /// objects were seen where it states them. Particles are drawn from `seed`. The tool's underside
    /// is `lift` metres above the table.
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

    /// The belief about objects that move like this where nothing has been seen yet, in their order;
    /// otherwise they rest.
    pub fn moving(mut self, velocities: &[Velocity]) -> Self {
        for (own, stated) in self.track.state.velocities.iter_mut().zip(velocities) {
            *own = *stated;
        }
        self
    }

    /// The belief where every mass is in one of these ranges, kg, as likely in each before anything has
    /// touched another, whatever the scene states; no ranges, and it is the belief as it was. Which
    /// range is then told by pushes in which objects touch each other.
    pub fn with_mass_ranges(mut self, ranges: &[Span]) -> Self {
        self.masses = (!ranges.is_empty()).then(|| Masses::new(self.scene.objects.len(), ranges));
        self
    }

    /// What is believed of masses that are in one of some ranges; `None` without
    /// [`Self::with_mass_ranges`].
    pub fn mass_shares(&self) -> Option<MassShares> {
        self.masses.as_ref().map(Masses::shares)
    }

    /// Takes another tool, its underside `lift` metres above the table, for what comes. Everything
    /// that was seen before should be settled.
    pub fn take_tool(&mut self, tool: Arc<Tool>, lift: f64) {
        self.tool = tool;
        self.lift = lift;
        self.push = None;
    }

    /// Standard deviations of where every object is thought to be: of either coordinate (metres) and
    /// of the heading (radians).
    pub fn doubt(&self) -> Vec<[f64; 2]> {
        self.track.variance.iter().map(|variance| variance.map(f64::sqrt)).collect()
    }

    /// What is believed of masses, frictions and supports, known ones among them.
    pub fn numbers(&self) -> Numbers {
        self.particles.numbers(&self.scene, &Physics::stated(&self.scene))
    }
}
