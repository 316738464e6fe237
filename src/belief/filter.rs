//! The belief, and how it follows what is seen.

use std::sync::Arc;

use nalgebra::Vector3;
use serde::Serialize;

use crate::{
    effect::EffectModel,
    geometry::Pose,
    scene::{
        Job, Joint, Observation, Physics, Record, Scene, Sight, Situation, State, Stroke, Tool,
        ToolMotion, Unknowns, near_pairs,
    },
};

use super::{
    joints::{carried, likeliest, of_types, with},
    pair::{JointType, PairBelief},
    particles::Particles,
    regulation::{BeliefRegulator, Regulation},
    relative::{relative, relative_like, spread},
    rolled::Rolled,
    settings::BeliefSettings,
    testimony::{Circumstances, Judged, Testimony, features},
    track::{ARM, Track},
    weighing::Stretch,
    window::{Doubt, Instant, evidence, whitened},
};

/// Observations that are looked at together: fewer show less than the noise, more let errors of the
/// rollout grow.
const WINDOW: usize = 5;

/// How much the places of all objects count beside those of a pair against each other.
const PLACES: f64 = 0.3;

/// What is believed about a scene.
#[derive(Clone, Debug)]
pub struct Belief {
    pub(super) scene: Scene,
    pub(super) tool: Arc<Tool>,
    pub(super) lift: f64,
    settings: BeliefSettings,
    pub(super) pairs: Vec<PairBelief>,
    pub(super) track: Track,
    /// Joints that are not to be found out, where the scene states its objects.
    pub(super) known: Vec<Joint>,
    pub(super) particles: Particles,
    pub(super) stretch: Option<Stretch>,
    /// Not looked at yet.
    window: Vec<Observation>,
    seen: usize,
    history: Vec<Step>,
    regulation: Option<Regulation>,
}

/// What was believed when, and why.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Step {
    /// Observations until then.
    pub observations: usize,
    /// Of every near pair, in the order of [`Belief::pairs`]: probabilities of [`JointType::ALL`].
    pub probabilities: Vec<[f64; 4]>,
    /// What the window said for each type, as logarithms against the best; `None` where nothing of
    /// the pair moved.
    pub evidence: Vec<Option<[f64; 4]>>,
}

impl Belief {
    /// What is believed of `scene` before anything has moved, but for its joints, which are not
    /// known; its objects were seen where it states them. The tool's underside is `lift` metres above
    /// the table.
    pub fn new(scene: &Scene, tool: Arc<Tool>, lift: f64, settings: BeliefSettings) -> Self {
        let scene = Scene { joints: Vec::new(), ..scene.clone() };
        let particles = Particles::new(scene.objects.len(), Unknowns::NONE, 0);
        let track = Track::new(scene.start(), settings.noise);
        let pairs = near_pairs(&scene)
            .into_iter()
            .map(|([a, b], midway)| {
                let [first, second] = [a, b].map(|k| &scene.objects[k].pose);
                let seen = relative(first, second);
                let variance = |which: usize| [a, b].map(|k| track.variance[k][which]);
                let spread = spread(&seen, variance(0), variance(1));
                PairBelief::new([a, b], seen, &spread, first.local_point(midway))
            })
            .collect();
        Self {
            scene,
            tool,
            lift,
            settings,
            pairs,
            track,
            known: Vec::new(),
            particles,
            stretch: None,
            window: Vec::new(),
            seen: 0,
            history: Vec::new(),
            regulation: None,
        }
    }

    /// The belief with a regulator beside the filter.
    pub fn regulated(self, regulator: BeliefRegulator) -> Self {
        Self { regulation: Some(Regulation::new(regulator)), ..self }
    }

    /// What windows told a regulator that only listens.
    pub fn heard(&self) -> &[Testimony] {
        self.regulation.as_ref().map_or(&[], |regulation| &regulation.heard)
    }

    /// Pairs of objects that were near each other at the start and so may be joined: indices, the
    /// lower first.
    pub fn pairs(&self) -> impl ExactSizeIterator<Item = [usize; 2]> {
        self.pairs.iter().map(|pair| pair.between)
    }

    /// Of each of these pairs the probabilities of [`JointType::ALL`].
    pub fn probabilities(&self) -> Vec<[f64; 4]> {
        let map = self.map();
        self.pairs.iter().map(|pair| pair.probabilities(follows(&map, pair))).collect()
    }

    /// What was believed when, and why.
    pub fn history(&self) -> &[Step] {
        &self.history
    }

    /// Takes what was seen. Every few observations are looked at together, so the last ones may
    /// not have told anything yet: see [`Self::settle`].
    pub fn update(&mut self, model: &dyn EffectModel, observation: Observation) {
        let lifted = observation.strokes.last().is_some_and(|stroke| stroke.settle);
        self.window.push(observation);
        if self.window.len() >= WINDOW || lifted {
            self.settle(model);
        }
    }

    /// Looks at all that was seen.
    pub fn settle(&mut self, model: &dyn EffectModel) {
        let window = std::mem::take(&mut self.window);
        if window.is_empty() {
            return;
        }
        self.seen += window.len();
        let map = self.map();
        let known: Vec<JointType> =
            self.pairs.iter().map(|pair| JointType::of(joint_of(&map, pair.between))).collect();
        let Some(base) = self.roll(model, &window, vec![map.clone()]).pop() else { return };
        let moved: Vec<f64> = (0..self.scene.objects.len())
            .map(|object| self.track.motion(object, &base, &window))
            .collect();
        let tells = |pair: &PairBelief| pair.between.iter().any(|&k| moved[k] > 0.0);
        // Every other type of joint of every pair that moved.
        let mut asked: Vec<(usize, JointType)> = Vec::new();
        for (p, _) in self.pairs.iter().enumerate().filter(|(_, pair)| tells(pair)) {
            let others = JointType::ALL.into_iter().filter(|kind| *kind != known[p]);
            asked.extend(others.map(|kind| (p, kind)));
        }
        let physics = asked
            .iter()
            .map(|&(p, kind)| with(&map, &self.pairs, (&self.pairs[p], kind), &self.track.state));
        let rolled = self.roll(model, &window, physics.collect());
        let mut evidences = Vec::new();
        let mut told = Vec::new();
        for (p, known) in known.iter().copied().enumerate() {
            let by_type = |kind: JointType| match kind == known {
                true => Some(&base),
                false => asked.iter().position(|one| *one == (p, kind)).map(|job| &rolled[job]),
            };
            let pair = &self.pairs[p];
            let judged = tells(pair).then(|| self.judge(pair, by_type, &window, &moved));
            let pair = &mut self.pairs[p];
            if let Some(judged) = &judged {
                pair.weigh(&judged.evidence, self.settings.tempering);
            }
            learn(pair, &window, &self.settings);
            evidences.push(judged.as_ref().map(|judged| pair.by_type(&judged.evidence)));
            told.push(judged);
        }
        self.regulate(&map, &window, &told, &moved);
        self.history.push(Step {
            observations: self.seen,
            probabilities: self.probabilities(),
            evidence: evidences,
        });
        self.weigh_particles(model, &window);
        self.track.follow(&base, &window);
    }

    /// Physics in which [`Self::pairs`] are joined as `types` say, where these joints would most likely
    /// be; joints close no loop.
    pub fn physics_of(&self, types: &[JointType]) -> Physics {
        self.with_known(of_types(&self.scene, &self.pairs, &self.track.state, types))
    }

    /// The types that the last window which told of a pair says by itself: a belief without memory.
    pub fn last_types(&self) -> Vec<JointType> {
        let last = |p: usize| self.history.iter().rev().find_map(|step| step.evidence[p]);
        let of = |p| last(p).map_or(JointType::None, |evidence| PairBelief::by_window(&evidence));
        (0..self.pairs.len()).map(of).collect()
    }

    /// Has the regulator, if there is one, correct what the filter found in a window that was played
    /// with the likeliest `physics` before it.
    fn regulate(
        &mut self,
        physics: &Physics,
        window: &[Observation],
        told: &[Option<Judged>],
        moved: &[f64],
    ) {
        let Some(mut regulation) = self.regulation.take() else { return };
        let now = self.map();
        let seen = |k: usize| {
            window.iter().any(|one| one.seen[k].is_some_and(|sight| sight.heading.is_some()))
        };
        let evidence: Vec<_> = self
            .pairs
            .iter()
            .zip(told)
            .map(|(pair, judged)| {
                let around = Circumstances {
                    noise: self.settings.noise,
                    windows: self.history.len(),
                    moved: pair.between.map(|k| moved[k]),
                    headings: pair.between.map(seen),
                    cylinders: pair.between.map(|k| self.scene.objects[k].shape.is_cylinder()),
                    taken: JointType::of(joint_of(physics, pair.between)),
                    follows: follows(&now, pair),
                };
                judged.as_ref().map(|judged| features(pair, judged, &around))
            })
            .collect();
        let filtered = self.pairs.iter().map(|pair| pair.filtered(follows(&now, pair))).collect();
        let pairs: Vec<[usize; 2]> = self.pairs().collect();
        let (scene, job) = (self.scene_now(), self.job(window, physics.clone()));
        let corrections = regulation.take((&scene, &job), &pairs, &evidence, filtered);
        for (pair, correction) in self.pairs.iter_mut().zip(corrections) {
            pair.regulated = correction.unwrap_or(pair.regulated);
        }
        self.regulation = Some(regulation);
    }

    /// The scene as it is thought to stand now, with the likeliest joints.
    pub fn situation(&self) -> Situation {
        let physics = Arc::new(self.map());
        Situation { scene: Arc::new(self.scene_now()), start: self.track.state.clone(), physics }
    }

    /// The likeliest physics: anchors and axes are where they are with the objects as in
    /// [`Self::situation`].
    pub fn map(&self) -> Physics {
        self.with_known(likeliest(&self.scene, &self.pairs, &self.track.state))
    }

    /// These joints of near pairs with all that is believed besides.
    fn with_known(&self, mut physics: Physics) -> Physics {
        physics.joints.extend(carried(&self.known, &self.scene, &self.track.state));
        self.particles.mean(&self.scene, physics)
    }

    fn scene_now(&self) -> Scene {
        self.scene_at(&self.track.state)
    }

    pub(super) fn scene_at(&self, state: &State) -> Scene {
        let mut scene = self.scene.clone();
        for (object, pose) in scene.objects.iter_mut().zip(&state.poses) {
            object.pose = *pose;
        }
        scene
    }

    /// What the tool did in a window, rolled out under every one of `physics`.
    fn roll(
        &self,
        model: &dyn EffectModel,
        window: &[Observation],
        physics: Vec<Physics>,
    ) -> Vec<Rolled> {
        let jobs: Vec<Job> = physics.into_iter().map(|physics| self.job(window, physics)).collect();
        let rolled = model.rollout(&self.scene_now(), &jobs, Record::Frames);
        let start = &self.track.state;
        rolled.iter().map(|trajectory| Rolled::new(trajectory, window, start)).collect()
    }

    /// What the tool did in a window, as a rollout under `physics`.
    fn job(&self, window: &[Observation], physics: Physics) -> Job {
        let strokes: Vec<Stroke> = window.iter().flat_map(|seen| seen.strokes.clone()).collect();
        let motion = ToolMotion { tool: Arc::clone(&self.tool), lift: self.lift, strokes };
        Job { start: self.track.state.clone(), motion, physics: Arc::new(physics) }
    }

    /// A pair at the observations of a window, as it was seen and as it was rolled out.
    fn instants(
        &self,
        [a, b]: [usize; 2],
        rolled: &Rolled,
        window: &[Observation],
    ) -> Vec<Instant> {
        let mut instants = Vec::new();
        for (k, (now, state)) in window.iter().zip(&rolled.states).enumerate() {
            let [first, second] = [a, b].map(|k| &state.poses[k]);
            let one = self.track.sight(a, now.seen[a], first);
            let other = self.track.sight(b, now.seen[b], second);
            let (Some(one), Some(other)) = (one, other) else { continue };
            let predicted = relative(first, second);
            let seen = relative_like(&one.0, &other.0, &predicted);
            let spread = spread(&seen, [one.1[0], other.1[0]], [one.1[1], other.1[1]]);
            let share = (k + 1) as f64 / window.len() as f64;
            instants.push(Instant { share, seen, spread, predicted });
        }
        instants
    }

    /// What a window says of every hypothesis about a pair, rolled out by type.
    fn judge<'a>(
        &self,
        pair: &PairBelief,
        rolled: impl Fn(JointType) -> Option<&'a Rolled>,
        window: &[Observation],
        moved: &[f64],
    ) -> Judged {
        let [a, b] = pair.between;
        let [first, second] = [a, b].map(|k| &self.track.state.poses[k]);
        let before = relative(first, second);
        let variance = |which: usize| [a, b].map(|k| self.track.variance[k][which]);
        let start = spread(&before, variance(0), variance(1));
        let by_type = JointType::ALL.map(|kind| {
            let rolled = rolled(kind)?;
            let instants = self.instants(pair.between, rolled, window);
            let change: Vector3<f64> = instants.last()?.predicted - before;
            let relative = change.xy().norm().hypot(ARM * change.z);
            let doubt = Doubt::new(start, relative, moved[a].max(moved[b]), ARM);
            Some((instants, doubt, PLACES * self.track.places(rolled, window, moved)))
        });
        let of = |kind: JointType| by_type[kind as usize].as_ref();
        let judged = pair.hypotheses.iter().map(|hypothesis| {
            of(hypothesis.fit.kind).map_or(f64::NEG_INFINITY, |(instants, doubt, places)| {
                evidence(&hypothesis.fit, instants, doubt) + places
            })
        });
        let evidence = judged.collect();
        let off = JointType::ALL.map(|kind| match (pair.best(kind), of(kind)) {
            (Some(best), Some((instants, doubt, _))) => whitened(&best.fit, instants, doubt),
            _ => [0.0; 3],
        });
        let change = of(JointType::None).and_then(|(instants, ..)| instants.last()).map_or(
            [0.0; 2],
            |now| {
                let change = now.seen - before;
                [change.xy().norm(), change.z.abs()]
            },
        );
        Judged { evidence, off, change }
    }
}

/// Whether the motion of a pair is likest to a joint but follows from likelier ones already.
fn follows(physics: &Physics, pair: &PairBelief) -> bool {
    pair.likeliest() != JointType::None && joint_of(physics, pair.between).is_none()
}

fn joint_of(physics: &Physics, between: [usize; 2]) -> Option<&Joint> {
    physics.joints.iter().find(|joint| joint.between == between)
}

/// Takes where a pair was seen into the geometry of every hypothesis; where a heading was not seen
/// geometry would follow the errors of rollouts, so nothing is learnt.
fn learn(pair: &mut PairBelief, window: &[Observation], settings: &BeliefSettings) {
    let [position, heading] = [settings.noise.position, settings.noise.heading].map(|sd| sd * sd);
    for now in window {
        let pose =
            |sight: Sight| sight.heading.map(|heading| Pose { position: sight.position, heading });
        let [Some(one), Some(other)] = pair.between.map(|k| now.seen[k].and_then(pose)) else {
            continue;
        };
        pair.learn(&one, &other, [position, heading]);
    }
}
