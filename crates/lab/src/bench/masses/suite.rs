//! The cases and their trajectories.

use pushplan::internals::effect::EffectModel;
use pushplan::internals::recording::Recording;
use pushplan::internals::scene::Unknowns;
use pushplan::internals::seeded::generator;
use pushplan_act::belief::{Belief, BeliefSettings};
use pushplan_bench::store::Measured;
use pushplan_learn::dataset::{Controlled, MASS_RANGES, MassEpisode, MassSetup, Touched};
use serde::{Deserialize, Serialize};

use crate::bench::Sighting;

/// Salt that separates the random numbers of noise from the numbers of scenes.
const SALT: u64 = 0x4845_4156_5900_0000;

/// A scene setup and its observation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MassCase {
    /// Setup of the scenes.
    pub setup: MassSetup,
    /// Observation of the scenes.
    pub sight: Sighting,
}

impl MassCase {
    /// Returns a description of the scenes for tables.
    pub fn scenes(&self) -> String {
        match self.setup {
            MassSetup::Touching(count) => format!("{count} touching, 1 stroke"),
            MassSetup::Crowd(count) => format!("crowd of {count}, 3 strokes"),
            MassSetup::Controlled(Controlled::Rows) => "three rows of 3, 3 strokes".to_owned(),
            MassSetup::Controlled(Controlled::Wedges) => "three wedges of 3, 3 strokes".to_owned(),
        }
    }
}

/// Final belief about the mass of an object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeenMass {
    /// Range of the true mass.
    pub range: usize,
    /// Bodies that touched the object.
    pub touched: Touched,
    /// Probabilities of the ranges; `None` if nothing is known.
    pub believed: Option<Vec<f64>>,
}

/// Belief about the ratio of two masses.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeenRatio {
    /// Natural logarithm of the true ratio.
    pub truth: f64,
    /// Mean and standard deviation of the believed logarithm.
    pub believed: [f64; 2],
}

/// Result of a trajectory.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MassRecord {
    /// The case, an index into [`MassSuite::cases`].
    pub case: usize,
    /// Beliefs about all objects.
    pub objects: Vec<SeenMass>,
    /// Beliefs about pairs that are believed to have touched each other.
    pub ratios: Vec<SeenRatio>,
}

/// Trajectories of several cases, in turn.
pub struct MassSuite {
    cases: Vec<MassCase>,
    seed: u64,
    frictions: bool,
}

impl MassSuite {
    /// Version of the measurement; another version has other records for the same settings.
    pub const VERSION: u32 = 1;

    /// Creates a suite of every setup, observed in each of these ways. With `frictions`, the
    /// friction values of the objects and of the table are also unknown.
    pub fn new(setups: &[MassSetup], sights: &[Sighting], seed: u64, frictions: bool) -> Self {
        let of =
            |setup: &MassSetup| sights.iter().map(|sight| (*setup, *sight)).collect::<Vec<_>>();
        let cases = setups.iter().flat_map(of).map(|(setup, sight)| MassCase { setup, sight });
        Self { cases: cases.collect(), seed, frictions }
    }

    /// Returns the cases.
    pub fn cases(&self) -> &[MassCase] {
        &self.cases
    }

    /// Follows the trajectory with this index; `model` simulates pushes under every assignment of
    /// ranges.
    pub fn measure(&self, model: &dyn EffectModel, index: usize) -> Measured<MassRecord> {
        let case = index % self.cases.len();
        let MassCase { setup, sight } = self.cases[case];
        // Every case of a setup has the same scenes.
        let episode = MassEpisode::draw(setup, self.seed, (index / self.cases.len()) as u64);
        let MassEpisode { scene, motion, frames, ranges, touched } = &episode;
        let recording = Recording::of_frames("drawn", scene, motion, frames);
        let seeing = sight.seeing();
        let mut rng = generator(self.seed ^ SALT, index as u64);
        let (seen, observations) = seeing.observe(&recording, &mut rng);
        let unknown = Unknowns { frictions: self.frictions, ..Unknowns::NONE };
        let tool = (recording.tool.clone(), recording.lift);
        let settings = BeliefSettings::new(seeing.noise);
        let mut belief = Belief::about(&seen, unknown, tool, settings, index as u64)
            .with_mass_ranges(&MASS_RANGES);
        for observation in observations {
            belief.update(model, observation);
        }
        belief.finish(model);
        let shares = belief.mass_shares().unwrap_or_default();
        let objects = ranges.iter().zip(touched).zip(shares.objects);
        let objects = objects
            .map(|((range, touched), believed)| SeenMass {
                range: *range,
                touched: *touched,
                believed,
            })
            .collect();
        let ratios = shares.ratios.iter().map(|ratio| {
            let [first, second] = ratio.between.map(|k| scene.objects[k].mass);
            SeenRatio { truth: (first / second).ln(), believed: ratio.log }
        });
        let record = MassRecord { case, objects, ratios: ratios.collect() };
        Measured { record, seconds: Default::default() }
    }
}
