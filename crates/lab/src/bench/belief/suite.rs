//! The cases and their trajectories.

use pushplan::internals::effect::EffectModel;
use pushplan::internals::recording::Recording;
use pushplan::internals::seeded::generator;
use pushplan::internals::task::Noise;
use pushplan_act::belief::BeliefRegulator;
use pushplan_bench::store::Measured;
use pushplan_learn::dataset::{Episode, JointRule, Seeing, Solids};
use serde::{Deserialize, Serialize};

use crate::bench::{CrowdFamily, CrowdSet};

use super::circumstances::Circumstances;
use super::follow::{Asked, follow};
use super::record::BeliefRecord;

/// Salt that separates the random numbers of noise from the numbers of scenes.
const SALT: u64 = 0x5345_4549_4E47_0000;

/// Quality of observations, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sighting {
    /// True poses.
    Exact,
    /// Noise of 1 mm and 0.5 degrees.
    Fine,
    /// Noise of 3 mm and 2 degrees.
    Coarse,
    /// True positions, without headings of cylinders.
    Unmarked,
    /// Noise of 1 mm, without headings of cylinders.
    UnmarkedFine,
}

impl Sighting {
    /// Every quality.
    pub const ALL: [Self; 5] =
        [Self::Exact, Self::Fine, Self::Coarse, Self::Unmarked, Self::UnmarkedFine];

    /// Returns a name for tables.
    pub fn title(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Fine => "1 mm, 0.5 deg",
            Self::Coarse => "3 mm, 2 deg",
            Self::Unmarked => "no headings",
            Self::UnmarkedFine => "1 mm, no headings",
        }
    }

    /// Returns the noise, and whether headings of round objects are observed.
    pub fn seeing(self) -> Seeing {
        let (position, degrees) = match self {
            Self::Exact | Self::Unmarked => (0.0, 0.0),
            Self::Fine | Self::UnmarkedFine => (1e-3, 0.5f64),
            Self::Coarse => (3e-3, 2.0),
        };
        let noise = Noise { position, heading: degrees.to_radians() };
        Seeing { noise, round_headings: !matches!(self, Self::Unmarked | Self::UnmarkedFine) }
    }

    /// Returns the solids of its scenes. Headings can only be missing for round objects.
    fn solids(self) -> Solids {
        match self {
            Self::Unmarked | Self::UnmarkedFine => Solids::Cylinders,
            _ => Solids::Any,
        }
    }
}

/// A set of crowds and its observations.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeliefCase {
    /// Set of the scenes.
    pub set: CrowdSet,
    /// Quality of the observations.
    pub sight: Sighting,
}

/// Trajectories of several cases, in turn.
pub struct BeliefSuite {
    cases: Vec<BeliefCase>,
    seed: u64,
    regulator: Option<BeliefRegulator>,
    rest: bool,
    circumstances: Circumstances,
}

impl BeliefSuite {
    /// Version of the measurement; another version has other records for the same settings.
    pub const VERSION: u32 = 3;

    /// Creates a suite of every set of these families, numbers of objects and joints, observed with
    /// each of these qualities. With `rest`, the remaining motion is also predicted, which costs
    /// more than the beliefs.
    pub fn new(
        (families, objects, joints): (&[CrowdFamily], &[usize], JointRule),
        sights: &[Sighting],
        seed: u64,
        (regulator, rest): (Option<BeliefRegulator>, bool),
    ) -> Self {
        let mut cases = Vec::new();
        for family in families {
            for set in CrowdSet::all(*family) {
                if set.joints != joints || !objects.contains(&set.objects) {
                    continue;
                }
                let seen = sights.iter().filter(|sight| sight.solids() == set.solids);
                cases.extend(seen.map(|sight| BeliefCase { set, sight: *sight }));
            }
        }
        Self { cases, seed, regulator, rest, circumstances: Circumstances::USUAL }
    }

    /// Returns the suite under other circumstances.
    pub fn under(self, circumstances: Circumstances) -> Self {
        Self { circumstances, ..self }
    }

    /// Returns the cases.
    pub fn cases(&self) -> &[BeliefCase] {
        &self.cases
    }

    /// Follows the trajectory with this index; `model` rolls out hypotheses and the remaining
    /// motion. The seconds are processor time of the beliefs' updates, which is known only with a
    /// single thread.
    pub fn measure(&self, model: &dyn EffectModel, index: usize) -> Measured<BeliefRecord> {
        let case = index % self.cases.len();
        let BeliefCase { set, sight } = self.cases[case];
        let trajectory = (index / self.cases.len()) as u64;
        let episode = set.episode(self.seed, trajectory);
        let frames = self.circumstances.frames(&episode);
        let Episode { scene, motion, .. } = &episode;
        let recording = Recording::of_frames("drawn", scene, motion, &frames);
        let by = (model, self.regulator.as_ref(), self.rest);
        let seeing = sight.seeing();
        // Every case and trajectory has its own noise.
        let mut rng = generator(self.seed ^ SALT, index as u64);
        let (seen, observations) = seeing.observe(&recording, &mut rng);
        let seen = self.circumstances.stated(seen);
        let seen = (&seen, &observations[..], seeing.noise);
        let (record, spent) = follow(&recording, seen, by, Asked::OnTheWay, case);
        let alone = rayon::current_num_threads() == 1;
        let seconds = spent.iter().filter(|_| alone);
        let seconds =
            seconds.map(|(by, spent)| (by.title().to_owned(), spent.as_secs_f64())).collect();
        Measured { record, seconds }
    }
}
