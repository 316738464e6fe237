//! Training data of the belief regulator: features of pairs in windows of observed trajectories,
//! and the true joint types.

use std::sync::Arc;

use pushplan::internals::effect::{EffectModel, Network};
use pushplan::internals::recording::Recording;
use pushplan::internals::seeded::generator;
use pushplan::internals::{
    scene::{Joint, Scene, Span},
    task::Noise,
};
use pushplan_act::belief::{
    Belief, BeliefRegulator, BeliefSettings, Draft, JointType, RegulatorFeatures,
};
use rand::Rng;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use super::config::DatasetConfig;
use super::constraints::{Constraints, JointRule};
use super::distributions::log_uniform;
use super::episode::Episode;
use super::observed::Seeing;
use super::preset::Preset;
use super::tabletop::Solids;

/// Constant that separates the random numbers of noise and episodes.
const SALT: u64 = 0x6E6F_6973_7900_0000;

/// Share of lessons in dense scenes, in which pairs are harder to distinguish; the others are
/// sparse.
const DENSE: f64 = 0.75;

/// Share of lessons with equally frequent joint types, as in the test sets; the others follow the
/// training curriculum.
const MIXED: f64 = 0.7;

/// Share of lessons without noise, and ranges of the noise of the others: metres, radians.
const EXACT: f64 = 0.25;
const POSITION: Span = Span::new(1e-4, 5e-3);
const HEADING: Span = Span::new(8.7e-4, 5.2e-2);

/// Share of lessons in which the headings of cylinders are not observed.
const UNMARKED: f64 = 0.33;

/// Share of these lessons in which all objects are cylinders, so that no heading is observed.
const CYLINDERS: f64 = 0.6;

/// Minimum displacement of objects that are evaluated in tests, metres.
const MOVED: f64 = 0.01;

/// Trajectory as recorded by a listening regulator.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lesson {
    /// Index of the lesson in its set.
    pub index: u64,
    /// Number of objects.
    pub objects: usize,
    /// Pairs that may be joined.
    pub pairs: Vec<[usize; 2]>,
    /// True joint types of the pairs.
    pub types: Vec<JointType>,
    /// Whether either object of each pair moved.
    pub moved: Vec<bool>,
    /// Features window by window; for pushes with joint inference, the windows processed after it.
    pub windows: Vec<RegulatorFeatures>,
    /// Features of these pushes before the joint inference.
    pub drafts: Vec<Draft>,
}

impl Lesson {
    /// Draws and records lesson `index`. The result depends only on `seed`, `index`, the
    /// propagation `network` and the `model` that rolls out hypotheses.
    pub fn draw(seed: u64, index: u64, network: &Arc<Network>, model: &dyn EffectModel) -> Self {
        let mut rng = generator(seed ^ SALT, index);
        let preset = if rng.random_bool(DENSE) { Preset::Dense } else { Preset::Sparse };
        let joints = rng.random_bool(MIXED).then_some(JointRule::Mixed);
        let seeing = seeing(&mut rng);
        let alone = !seeing.round_headings && rng.random_bool(CYLINDERS);
        let solids = alone.then_some(Solids::Cylinders);
        let constraints = Constraints { joints, solids, ..Constraints::default() };
        // Lessons are numbered independently of the presets, so that scenes do not depend on
        // earlier presets.
        let config = DatasetConfig {
            seed,
            episodes: u64::MAX,
            preset,
            constraints,
            ..DatasetConfig::default()
        };
        let Episode { scene, motion, frames, .. } = Episode::of_crowd(&config, index);
        let recording = Recording::of_frames("drawn", &scene, &motion, &frames);
        let (seen, observations) = seeing.observe(&recording, &mut rng);
        let settings = BeliefSettings::new(seeing.noise);
        let mut belief = Belief::new(&seen, recording.tool.clone(), recording.lift, settings)
            .regulated(BeliefRegulator::listening(Arc::clone(network)));
        for observation in observations {
            belief.update(model, observation);
        }
        belief.settle(model);
        let pairs: Vec<[usize; 2]> = belief.pairs().collect();
        Self {
            index,
            objects: scene.objects.len(),
            types: pairs.iter().map(|pair| true_type(&scene, *pair)).collect(),
            moved: pairs.iter().map(|pair| pair.iter().any(|k| moved(&recording, *k))).collect(),
            pairs,
            windows: belief.recorded().to_vec(),
            drafts: belief.drafts().to_vec(),
        }
    }

    /// Returns the windows as recorded at the end of one of the `drafts`, otherwise the final
    /// windows.
    pub fn windows(&self, draft: Option<usize>) -> Vec<&RegulatorFeatures> {
        match draft.and_then(|draft| self.drafts.get(draft)) {
            Some(Draft { after, windows }) => {
                self.windows[..*after].iter().chain(windows).collect()
            }
            None => self.windows.iter().collect(),
        }
    }
}

fn seeing(rng: &mut Pcg64) -> Seeing {
    let exact = rng.random_bool(EXACT);
    let noise = Noise { position: log_uniform(rng, POSITION), heading: log_uniform(rng, HEADING) };
    Seeing {
        noise: if exact { Noise::default() } else { noise },
        round_headings: !rng.random_bool(UNMARKED),
    }
}

/// Returns the joint type of a pair in a scene, with the lower index first.
pub fn true_type(scene: &Scene, pair: [usize; 2]) -> JointType {
    let of = |joint: &&Joint| {
        let [a, b] = joint.between;
        [a.min(b), a.max(b)] == pair
    };
    JointType::of(scene.joints.iter().find(of))
}

/// Returns `true` if an object was ever more than a centimetre from its start.
pub fn moved(recording: &Recording, object: usize) -> bool {
    let start = recording.scene.objects[object].pose.position;
    recording.frames.iter().any(|frame| (frame.poses[object].position - start).norm() > MOVED)
}
