//! The test sets: families of crowds by number of objects, joints and solids.

use pushplan::internals::watch::{Count, Watch};
use pushplan_act::judge::Trial;
use pushplan_learn::dataset::{Constraints, DatasetConfig, Episode, JointRule, Preset, Solids};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Keeps the seeds of test sets apart from those of training and of its held-out data, which
/// are small numbers.
const SALT: u64 = 0x7465_7374_0000_0000;

/// A family of crowds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CrowdFamily {
    /// Scattered objects, seven or eight strokes.
    Sparse,
    /// Scattered objects, one long stroke.
    SparseLine,
    /// A grid of objects almost touching, one stroke.
    Dense,
}

impl CrowdFamily {
    /// A name for tables and files.
    pub fn title(self) -> &'static str {
        match self {
            CrowdFamily::Sparse => "sparse",
            CrowdFamily::SparseLine => "sparse-line",
            CrowdFamily::Dense => "dense",
        }
    }

    /// How its scenes are drawn, and with which numbers of objects it is tested: those of the
    /// thesis, training's nine among them.
    fn drawn(self) -> (Preset, [usize; 3]) {
        match self {
            CrowdFamily::Sparse => (Preset::Sparse, [6, 9, 12]),
            CrowdFamily::SparseLine => (Preset::SparseLine, [6, 9, 12]),
            CrowdFamily::Dense => (Preset::Dense, [6, 8, 9]),
        }
    }
}

/// One test set: what its scenes hold.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CrowdSet {
    /// Its family.
    pub family: CrowdFamily,
    /// Number of objects.
    pub objects: usize,
    /// Joints between near neighbours.
    pub joints: JointRule,
    /// Which solids.
    pub solids: Solids,
}

impl CrowdSet {
    /// All sets of a family: three numbers of objects, fixed and mixed joints, cylinders alone
    /// and any solids.
    pub fn all(family: CrowdFamily) -> Vec<Self> {
        let (_, counts) = family.drawn();
        let mut sets = Vec::new();
        for objects in counts {
            for joints in [JointRule::Fixed, JointRule::Mixed] {
                for solids in [Solids::Cylinders, Solids::Any] {
                    sets.push(Self { family, objects, joints, solids });
                }
            }
        }
        sets
    }

    /// A line for tables: `dense, 9 objects, mixed joints, cylinders`.
    pub fn title(&self) -> String {
        let joints = match self.joints {
            JointRule::None => "no joints",
            JointRule::Fixed => "fixed joints",
            JointRule::Mixed => "mixed joints",
        };
        let solids = match self.solids {
            Solids::Any => "any solids",
            Solids::Cylinders => "cylinders",
            Solids::Cuboids => "cuboids",
        };
        format!("{}, {} objects, {joints}, {solids}", self.family.title(), self.objects)
    }

    /// The first `count` trajectories of the set under `seed`, simulated in the plane on all
    /// threads of the current rayon pool. `watch` is told the
    /// trajectories done.
    pub fn draw(&self, seed: u64, count: usize, watch: &dyn Watch) -> Vec<Trial> {
        watch.stage("simulating");
        let done = Count::new(watch, 0, count);
        (0..count as u64)
            .into_par_iter()
            .map(|index| {
                let Episode { scene, motion, frames, .. } = self.episode(seed, index);
                let trial = Trial::of_frames(scene, motion, &frames);
                done.one();
                trial
            })
            .collect()
    }

    /// Trajectory `index` of the set under `seed`, simulated in the plane.
    pub fn episode(&self, seed: u64, index: u64) -> Episode {
        let (preset, _) = self.family.drawn();
        let config = DatasetConfig {
            // Sets must not share scenes either.
            seed: (seed ^ SALT).wrapping_mul(64).wrapping_add(self.number()),
            episodes: index + 1,
            preset,
            constraints: Constraints::test(self.objects, self.joints, self.solids),
            ..DatasetConfig::default()
        };
        Episode::of_crowd(&config, index)
    }

    /// Different for every set of a family.
    fn number(&self) -> u64 {
        let rule = match self.joints {
            JointRule::None => 0,
            JointRule::Fixed => 1,
            JointRule::Mixed => 2,
        };
        self.objects as u64 * 4 + rule
    }
}
