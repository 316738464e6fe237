//! The cases, and the measurement of each.

use std::sync::Arc;

use pushplan::internals::effect::EffectModel;
use pushplan::internals::recording::Recording;
use pushplan::internals::seeded::generator;
use pushplan::internals::sim::Simulator;
use pushplan::internals::{
    outcome::{Frame, Record},
    scene::{Physics, Scene, State},
    task::{Job, ToolMotion},
};
use pushplan_act::act::{ProbeRule, choose_probe};
use pushplan_act::belief::{Belief, BeliefSettings, JointType, carried};
use pushplan_act::judge::mean;
use pushplan_bench::store::Measured;
use pushplan_learn::dataset::{Episode, JointRule, Solids, true_type};
use serde::{Deserialize, Serialize};

use crate::bench::{CrowdFamily, CrowdSet, Sighting};

use super::pushes::random_push;

/// Salts that separate the random numbers of noise, probes and test pushes from the numbers of
/// scenes.
const NOISE: u64 = 0x5052_4F42_4500_0000;
const PUSHES: u64 = 0x5052_4F42_4500_0001;
const TESTS: u64 = 0x5052_4F42_4500_0002;

/// Number of successive probes, and number of candidates for each.
const PROBES: usize = 3;
const CHOICE: usize = 16;

/// Travel of a probe and of a test push, metres.
const PROBE: f64 = 0.10;
const TEST: f64 = 0.20;

/// Number of test pushes in every scene.
const TESTED: usize = 4;

/// Number of samples of the belief that probes are evaluated under.
const SAMPLES: usize = 12;

/// A set of scenes and a rule for the choice of probes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProbeCase {
    /// Set of the scenes.
    pub set: CrowdSet,
    /// Rule for the choice of the next push.
    pub rule: ProbeRule,
}

/// State of knowledge after some probes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Learnt {
    /// Number of near pairs whose most likely type is the true one.
    pub right: usize,
    /// Sum of the negative logarithms of the probabilities of their true types.
    pub surprise: f64,
    /// Mean distance of predicted from true final positions over all objects, for every test push
    /// from this state, metres.
    pub errors: Vec<f64>,
    /// `errors` with the true joints.
    pub known: Vec<f64>,
}

/// Result of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProbeRecord {
    /// The case, an index into [`ProbeSuite::cases`].
    pub case: usize,
    /// Number of near pairs.
    pub pairs: usize,
    /// State of knowledge before the first probe and after each.
    pub learnt: Vec<Learnt>,
}

/// Scenes of several cases, in turn.
pub struct ProbeSuite {
    cases: Vec<ProbeCase>,
    seed: u64,
}

impl ProbeSuite {
    /// Version of the measurement; another version has other records for the same settings.
    pub const VERSION: u32 = 1;

    /// Creates a suite of dense scenes of `objects` cylinders with all types of joints, observed
    /// with 1 mm and 0.5 degrees of noise, under each of these rules.
    pub fn new(objects: usize, rules: &[ProbeRule], seed: u64) -> Self {
        let set = CrowdSet {
            family: CrowdFamily::Dense,
            objects,
            joints: JointRule::Mixed,
            solids: Solids::Cylinders,
        };
        Self { cases: rules.iter().map(|rule| ProbeCase { set, rule: *rule }).collect(), seed }
    }

    /// Returns the cases.
    pub fn cases(&self) -> &[ProbeCase] {
        &self.cases
    }

    /// Makes the probes of the scene with this index. `model` rolls out hypotheses, probes and test
    /// pushes; the 2-D engine is the ground truth. Every rule has the same scenes, and the same
    /// candidate probes while its choices are the same.
    pub fn measure(&self, model: &dyn EffectModel, index: usize) -> Measured<ProbeRecord> {
        let case = index % self.cases.len();
        let ProbeCase { set, rule } = self.cases[case];
        let number = (index / self.cases.len()) as u64;
        let Episode { scene, motion, .. } = set.episode(self.seed, number);
        let mut table = Table::new(scene, motion, self.seed, number);
        let seeing = Sighting::Fine.seeing();
        let mut rng = generator(self.seed ^ NOISE, number);
        let (seen, _) = seeing.observe(&table.recording(&table.hand, &table.start()), &mut rng);
        let settings = BeliefSettings::new(seeing.noise);
        let tool = (table.hand.tool.clone(), table.hand.lift);
        let mut belief = Belief::new(&seen, tool.0, tool.1, settings);
        let mut learnt = vec![table.learnt(model, &belief)];
        let mut pushes = generator(self.seed ^ PUSHES, number);
        for probe in 0..PROBES {
            let probes: Vec<_> = (0..CHOICE)
                .map(|_| {
                    let now = (&table.scene, &table.state);
                    random_push(&mut pushes, now, &table.hand, PROBE)
                })
                .collect();
            let draw = (SAMPLES, number * PROBES as u64 + probe as u64);
            let by = (rule, seeing.noise);
            if let Some(chosen) = choose_probe(model, by, &belief, draw, &probes) {
                let motion = &probes[chosen].motion;
                let frames = table.play(motion);
                let (_, observations) = seeing.observe(&table.recording(motion, &frames), &mut rng);
                for observation in observations {
                    belief.update(model, observation);
                }
                belief.settle(model);
                table.state = end(&frames);
            }
            learnt.push(table.learnt(model, &belief));
        }
        let record = ProbeRecord { case, pairs: belief.pairs().len(), learnt };
        Measured { record, seconds: Default::default() }
    }
}

/// The true scene on the table.
struct Table {
    scene: Scene,
    hand: ToolMotion,
    state: State,
    /// Seed and stream of the random numbers of test pushes.
    tests: (u64, u64),
}

impl Table {
    fn new(scene: Scene, motion: ToolMotion, seed: u64, number: u64) -> Self {
        let hand = ToolMotion { strokes: Vec::new(), ..motion };
        Self { state: scene.start(), scene, hand, tests: (seed ^ TESTS, number) }
    }

    /// Returns the frames before anything has moved.
    fn start(&self) -> Vec<Frame> {
        Simulator::planar()
            .run(&self.scene, &Job::stated(&self.scene, self.hand.clone()), Record::Frames)
            .frames
    }

    fn recording(&self, motion: &ToolMotion, frames: &[Frame]) -> Recording {
        Recording::of_frames("drawn", &self.scene, motion, frames)
    }

    /// Simulates the true outcome of a motion.
    fn play(&self, motion: &ToolMotion) -> Vec<Frame> {
        let physics = Physics::stated(&self.scene).into();
        let job = Job { start: self.state.clone(), motion: motion.clone().into(), physics };
        Simulator::planar().run(&self.scene, &job, Record::Frames).frames
    }

    /// Measures the accuracy of the belief, and of predictions made with it.
    fn learnt(&self, model: &dyn EffectModel, belief: &Belief) -> Learnt {
        let situation = belief.situation();
        let shares = belief.probabilities();
        let (mut right, mut surprise) = (0, 0.0);
        for (pair, shares) in belief.pairs().zip(&shares) {
            let truth = true_type(&self.scene, pair);
            let joint = situation.physics.joints.iter().find(|joint| {
                let [a, b] = joint.between;
                [a.min(b), a.max(b)] == pair
            });
            right += usize::from(JointType::of(joint) == truth);
            surprise -= shares[truth as usize].max(1e-9).ln();
        }
        let mut rng = generator(self.tests.0, self.tests.1);
        let known = Arc::new(Physics {
            joints: carried(&self.scene.joints, &self.scene, &situation.start),
            ..(*situation.physics).clone()
        });
        let (mut errors, mut knowns) = (Vec::new(), Vec::new());
        for _ in 0..TESTED {
            let motion = random_push(&mut rng, (&self.scene, &self.state), &self.hand, TEST).motion;
            let truth = end(&self.play(&motion));
            let start = situation.start.clone();
            let jobs = [&situation.physics, &known].map(|physics| Job {
                start: start.clone(),
                motion: motion.clone().into(),
                physics: physics.clone(),
            });
            let rolled = model.rollout(&situation.scene, &jobs, Record::Outcome);
            for (of, rolled) in [&mut errors, &mut knowns].into_iter().zip(&rolled) {
                let pairs = rolled.outcome().poses.iter().zip(&truth.poses);
                of.push(mean(
                    &pairs.map(|(a, b)| (a.position - b.position).norm()).collect::<Vec<_>>(),
                ));
            }
        }
        Learnt { right, surprise, errors, known: knowns }
    }
}

/// Returns the state at rest after a motion.
fn end(frames: &[Frame]) -> State {
    State::at_rest(frames.last().map(|frame| frame.state.poses.clone()).unwrap_or_default())
}
