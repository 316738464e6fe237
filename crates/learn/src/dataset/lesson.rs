//! What the belief regulator learns from: what windows of observed trajectories told of pairs of
//! objects, and how these really hang together.

use std::sync::Arc;

use pushplan::internals::effect::{EffectModel, Network};
use pushplan::internals::recording::Recording;
use pushplan::internals::seeded::generator;
use pushplan::internals::{
    scene::{Joint, Scene, Span},
    task::Noise,
};
use pushplan_act::belief::{Belief, BeliefRegulator, BeliefSettings, Draft, JointType, Testimony};
use rand::Rng;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use super::chance::log_uniform;
use super::config::DatasetConfig;
use super::constraints::{Constraints, JointRule};
use super::episode::Episode;
use super::observed::Seeing;
use super::preset::Preset;
use super::tabletop::Solids;

/// Keeps the random numbers of noise apart from those of episodes.
const SALT: u64 = 0x6E6F_6973_7900_0000;

/// Share of lessons in dense scenes, in which pairs are harder to tell apart; the rest are sparse.
const DENSE: f64 = 0.75;

/// Share of lessons with all types of joints alike, as in the test sets; the others follow the
/// curriculum of training.
const MIXED: f64 = 0.7;

/// Share of lessons without any noise, and noise of the others: metres, radians.
const EXACT: f64 = 0.25;
const POSITION: Span = Span::new(1e-4, 5e-3);
const HEADING: Span = Span::new(8.7e-4, 5.2e-2);

/// Share of lessons in which the headings of cylinders are not seen.
const UNMARKED: f64 = 0.33;

/// Share of these in which all objects are cylinders, so that no heading is seen.
const CYLINDERS: f64 = 0.6;

/// Objects that moved by less are none of a test's business, metres.
const MOVED: f64 = 0.01;

/// A trajectory as the belief heard of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lesson {
    /// Which draw of its set this is.
    pub index: u64,
    /// Number of objects.
    pub objects: usize,
    /// Pairs that may be joined.
    pub pairs: Vec<[usize; 2]>,
    /// How they are joined.
    pub types: Vec<JointType>,
    /// Whether either of the two moved in the end.
    pub moved: Vec<bool>,
    /// Window by window; of pushes whose joints were inferred together, as they were taken after that.
    pub windows: Vec<Testimony>,
    /// Evidence of these pushes during their motion.
    pub drafts: Vec<Draft>,
}

impl Lesson {
    /// Draws and hears lesson `index` under `seed`: a pure function of these, the propagation
    /// `network` and the `model` that rolls hypotheses out.
    pub fn draw(seed: u64, index: u64, network: &Arc<Network>, model: &dyn EffectModel) -> Self {
        let mut rng = generator(seed ^ SALT, index);
        let preset = if rng.random_bool(DENSE) { Preset::Dense } else { Preset::Sparse };
        let joints = rng.random_bool(MIXED).then_some(JointRule::Mixed);
        let seeing = seeing(&mut rng);
        let alone = !seeing.round_headings && rng.random_bool(CYLINDERS);
        let solids = alone.then_some(Solids::Cylinders);
        let constraints = Constraints { joints, solids, ..Constraints::default() };
        // Numbered by themselves: scenes must not follow from which presets came before.
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
            windows: belief.heard().to_vec(),
            drafts: belief.drafts().to_vec(),
        }
    }

    /// Windows as a belief takes them at the end of one of its `drafts`, or else in the end.
    pub fn windows(&self, draft: Option<usize>) -> Vec<&Testimony> {
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

/// How a scene says that a pair, the lower index first, is joined.
pub fn true_type(scene: &Scene, pair: [usize; 2]) -> JointType {
    let of = |joint: &&Joint| {
        let [a, b] = joint.between;
        [a.min(b), a.max(b)] == pair
    };
    JointType::of(scene.joints.iter().find(of))
}

/// Whether an object was ever farther than a centimetre from its start.
pub fn moved(recording: &Recording, object: usize) -> bool {
    let start = recording.scene.objects[object].pose.position;
    recording.frames.iter().any(|frame| (frame.poses[object].position - start).norm() > MOVED)
}
