//! The test sets: families of crowds by number of objects, joints and solids.

use pushplan::internals::progress::{Count, Progress};
use pushplan_act::judge::Trial;
use pushplan_learn::dataset::{Constraints, DatasetConfig, Episode, JointRule, Preset, Solids};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Salt that separates the seeds of test sets from the seeds of training and of its held-out data,
/// which are small numbers.
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
    /// Returns a name for tables and files.
    pub fn title(self) -> &'static str {
        match self {
            CrowdFamily::Sparse => "sparse",
            CrowdFamily::SparseLine => "sparse-line",
            CrowdFamily::Dense => "dense",
        }
    }

    /// Returns the preset of its scenes and the tested numbers of objects: the numbers of Tekden
    /// (2020), including nine, the number in training.
    fn drawn(self) -> (Preset, [usize; 3]) {
        match self {
            CrowdFamily::Sparse => (Preset::Sparse, [6, 9, 12]),
            CrowdFamily::SparseLine => (Preset::SparseLine, [6, 9, 12]),
            CrowdFamily::Dense => (Preset::Dense, [6, 8, 9]),
        }
    }
}

/// A test set: the content of its scenes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CrowdSet {
    /// Family of its scenes.
    pub family: CrowdFamily,
    /// Number of objects.
    pub objects: usize,
    /// Joints between near neighbours.
    pub joints: JointRule,
    /// Kind of solids.
    pub solids: Solids,
}

impl CrowdSet {
    /// Returns all sets of a family: three numbers of objects, fixed and mixed joints, cylinders
    /// alone and any solids.
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

    /// Returns a title for tables: `dense, 9 objects, mixed joints, cylinders`.
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

    /// Draws the first `count` trajectories of the set under `seed`, simulated in 2-D on all
    /// threads of the current rayon pool. `progress` receives the number of finished trajectories.
    pub fn draw(&self, seed: u64, count: usize, progress: &dyn Progress) -> Vec<Trial> {
        progress.stage("simulating");
        let done = Count::new(progress, 0, count);
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

    /// Draws trajectory `index` of the set under `seed`, simulated in 2-D.
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

    /// Returns a number that differs between sets of a family.
    fn number(&self) -> u64 {
        let rule = match self.joints {
            JointRule::None => 0,
            JointRule::Fixed => 1,
            JointRule::Mixed => 2,
        };
        self.objects as u64 * 4 + rule
    }
}
