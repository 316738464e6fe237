//! What a belief foresees, which is not always what it takes for likeliest.
//!
//! Before much has moved, half of the near pairs are joined and nobody knows how, so that *none* is
//! likelier than every single joint. But in a crowd two that touch mostly go along with each other at first,
//! whatever holds them together, so a prediction that takes them for one body is then off by less.

use std::sync::Arc;

use crate::{
    effect::EffectModel,
    geometry::{Pose, clearance},
    scene::{DisjointSets, Job, Physics, Record, ToolMotion},
};

use super::{
    chance::generator,
    filter::{Belief, joint_of},
    joints::of_types,
    median::{geometric_median, weighted_median},
    pair::{JointType, PairBelief},
};

/// Windows up to which predictions are made with what the regulator says of each pair by itself.
const FEW_WINDOWS: usize = 3;

/// So many physics are drawn to foresee with, and the likeliest counts as much as so many of them.
const DRAWN: usize = 24;

/// Objects with a smaller gap touch as soon as either moves, metres.
const TOUCHING: f64 = 0.005;

/// So many objects that touch, one the next, are a crowd. Of fewer one is often pushed past the others.
const CROWD: usize = 5;

/// Share of the pairs of which nothing was told, above which little has moved.
const MOST: f64 = 0.5;

impl Belief {
    /// Physics to predict with. After few windows pairs are joined as soon as the regulator finds joints
    /// likelier than none all together, see [`PairBelief::supposed`]. Later the filter's joints are better: each
    /// was judged beside the others, so that together they explain what was seen, which types that are
    /// likeliest one by one may not.
    pub(super) fn supposed(&self) -> Physics {
        if self.history.len() > FEW_WINDOWS {
            return self.filtered_map();
        }
        let pairs = self.regulated_pairs();
        let types: Vec<JointType> = pairs.iter().map(PairBelief::supposed).collect();
        self.with_known(of_types(&self.scene, &pairs, &self.track.state, &types))
    }

    /// Where all objects are foreseen to be after a motion of the tool, which begins where they are thought
    /// to be: of each, the place from which it is nearest on average to where drawn physics, and the
    /// likeliest, take it.
    pub fn foresee(&self, model: &dyn EffectModel, motion: ToolMotion) -> Vec<Pose> {
        let mut rng = generator(self.seen as u64, DRAWN as u64);
        let likeliest = if std::env::var("FORE").is_ok() { self.foreseen() } else { self.supposed() };
        let drawn = (0..DRAWN).map(|_| self.sample(&mut rng));
        let start = &self.track.state;
        let motion = Arc::new(motion);
        let job = |physics| Job {
            start: start.clone(),
            motion: ToolMotion::clone(&motion),
            physics: Arc::new(physics),
        };
        let jobs: Vec<Job> = std::iter::once(likeliest).chain(drawn).map(job).collect();
        let rolled = model.rollout(&self.scene_now(), &jobs, Record::Outcome);
        let likely: f64 = std::env::var("LIKELY").map_or(4.0, |s| s.parse().unwrap());
        let weight = |k: usize| if k == 0 { likely } else { 1.0 };
        (0..start.poses.len())
            .map(|object| {
                let ends: Vec<(f64, Pose)> = rolled
                    .iter()
                    .enumerate()
                    .map(|(k, trajectory)| (weight(k), trajectory.outcome().poses[object]))
                    .collect();
                let places: Vec<_> = ends.iter().map(|(weight, end)| (*weight, end.position)).collect();
                let headings = ends.iter().map(|(weight, end)| (*weight, end.heading)).collect();
                Pose { position: geometric_median(&places), heading: weighted_median(headings) }
            })
            .collect()
    }

    /// Physics to predict with: the likeliest, but for touching pairs of a crowd of which nothing was told
    /// while this is so of most pairs. These are taken for fixed.
    pub fn foreseen(&self) -> Physics {
        let map = self.supposed();
        let told = |p: usize| self.history.iter().any(|step| step.evidence[p].is_some());
        let told: Vec<bool> = (0..self.pairs.len()).map(told).collect();
        let untold = told.iter().filter(|told| !**told).count();
        if untold as f64 <= MOST * told.len() as f64 {
            return map;
        }
        let scene = self.scene_now();
        let touch = |between: [usize; 2]| {
            let [a, b] = between.map(|k| &scene.objects[k]);
            let (one, other) = (a.shape.footprint(), b.shape.footprint());
            clearance((&one, &a.pose), (&other, &b.pose), TOUCHING) < TOUCHING
        };
        let touching: Vec<[usize; 2]> = self.pairs().filter(|pair| touch(*pair)).collect();
        let groups = DisjointSets::of(scene.objects.len(), touching.clone()).names().to_vec();
        let crowded = |[a, _]: [usize; 2]| {
            groups.iter().filter(|group| **group == groups[a]).count() >= CROWD
        };
        let of = |(pair, told): (&PairBelief, &bool)| match *told {
            false if touching.contains(&pair.between) && crowded(pair.between) => JointType::Fixed,
            _ => JointType::of(joint_of(&map, pair.between)),
        };
        let types: Vec<JointType> = self.pairs.iter().zip(&told).map(of).collect();
        self.physics_of(&types)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::{
        belief::BeliefSettings,
        geometry::{Pose, Shape},
        scene::{JointKind, Noise, Object, Part, Scene, Tool},
    };

    #[test]
    fn in_a_crowd_what_touches_is_foreseen_to_go_along_until_something_is_known() {
        let can = |k: usize, x| Object::cylinder(format!("{k}"), 0.05, 0.1).at(x, 0.0, 0.0);
        let row = |count: usize| (0..count).map(|k| can(k, 0.101 * k as f64));
        // The last one is near, but does not touch.
        let scene = |count| Scene::new(row(count).chain([can(count, 0.101 * count as f64 + 0.02)]));
        let believed = |scene: &Scene| {
            let finger = Shape::Cylinder { radius: 0.01, height: 0.05 };
            let tool = Tool::new("finger", [Part::new("finger", finger, Pose::default())]);
            let settings = BeliefSettings::new(Noise { position: 0.0, heading: 0.0 });
            Belief::new(scene, Arc::new(tool.expect("one piece")), 0.0, settings)
        };
        let crowd = believed(&scene(CROWD));
        assert_eq!(crowd.pairs().len(), CROWD);
        assert!(crowd.map().joints.is_empty());
        let joints = crowd.foreseen().joints;
        assert_eq!(joints.len(), CROWD - 1);
        for (k, joint) in joints.iter().enumerate() {
            assert_eq!((joint.between, joint.kind), ([k, k + 1], JointKind::Fixed));
        }
        assert!(believed(&scene(CROWD - 1)).foreseen().joints.is_empty());
    }
}
