//! Sampling of physics from a belief.

use nalgebra::Vector6;
use rand::Rng;

use pushplan::{
    geometry::Pose,
    scene::{DisjointSets, Joint, Physics, Scene, Support},
};

use super::{
    distributions::{normal, weighted},
    filter::Belief,
    fit::Fit,
    joints::carried,
    pair::{JointType, PairBelief},
};

impl Belief {
    /// Samples physics from the belief.
    ///
    /// Joint types are drawn with their probabilities, anchors and axes from their Gaussians, and
    /// masses, frictions and supports from the particles. Anchors and axes are at the poses of
    /// [`Self::situation`]. Joints close no loop; the more probable ones are kept, as in
    /// [`Self::map`].
    pub fn sample(&self, rng: &mut impl Rng) -> Physics {
        self.sample_of(&self.regulated_pairs(), rng)
    }

    /// Samples physics with the joints of these pairs.
    pub(super) fn sample_of(&self, pairs: &[PairBelief], rng: &mut impl Rng) -> Physics {
        let state = &self.track.state;
        let mut physics = Physics::stated(&self.scene);
        let mut order: Vec<&PairBelief> = pairs.iter().collect();
        order.sort_by(|a, b| b.rank().total_cmp(&a.rank()));
        let mut sets = DisjointSets::new(self.scene.objects.len());
        for pair in order {
            let drawn = draw(pair, pair.between.map(|k| &state.poses[k]), rng);
            if let Some(joint) = drawn
                && sets.join(pair.between)
            {
                physics.joints.push(joint);
            }
        }
        physics.joints.sort_by_key(|joint| joint.between);
        physics.joints.extend(carried(&self.known, &self.scene, state));
        let physics = self.particles.sample(&self.scene, physics, rng);
        match &self.masses {
            Some(masses) => masses.sample(physics, rng),
            None => physics,
        }
    }

    /// Returns a scene with physics from [`Self::sample`] and the objects at their estimated poses.
    pub fn sample_scene(&self, rng: &mut impl Rng) -> Scene {
        let physics = self.sample(rng);
        let mut scene = self.scene_at(&self.track.state);
        for (k, object) in scene.objects.iter_mut().enumerate() {
            object.mass = physics.masses[k];
            object.friction = physics.frictions[k];
            if self.particles.draws_support() {
                let corners = Support::Corners.feet(&object.shape.footprint());
                let spread = physics.feet[k].mean_radius / corners.mean_radius;
                object.support = Support::Spread(spread);
            }
        }
        Scene {
            table_friction: physics.table_friction,
            frictions: physics.pairs,
            joints: physics.joints,
            ..scene
        }
    }
}

/// Samples the joint of a pair at these poses; `None` for no joint.
fn draw(pair: &PairBelief, poses: [&Pose; 2], rng: &mut impl Rng) -> Option<Joint> {
    let kind = JointType::ALL[weighted(rng, &pair.probabilities(false))];
    let of: Vec<_> = pair.hypotheses.iter().filter(|one| one.fit.kind == kind).collect();
    let most = of.iter().map(|one| one.log).fold(f64::NEG_INFINITY, f64::max);
    let weights: Vec<f64> = of.iter().map(|one| (one.log - most).exp()).collect();
    let drawn_one = of.get(weighted(rng, &weights))?;
    let fit = drawn(&drawn_one.fit, rng);
    Some(Joint::new(pair.between, pair.stopped(drawn_one, fit.joint(poses)?, poses)))
}

/// Samples the geometry and the errors of unobserved headings.
fn drawn(fit: &Fit, rng: &mut impl Rng) -> Fit {
    let eigen = fit.covariance.symmetric_eigen();
    let along = Vector6::from_fn(|k, _| eigen.eigenvalues[k].max(0.0).sqrt() * normal(rng));
    let off = eigen.eigenvectors * along;
    Fit {
        mean: fit.mean + off.fixed_rows::<4>(0),
        errors: fit.errors + off.fixed_rows::<2>(4),
        ..*fit
    }
}
