//! The belief, and how it follows what is seen.

use std::sync::Arc;

use nalgebra::Vector3;
use serde::Serialize;

use crate::{
    effect::EffectModel,
    scene::{
        Job, Joint, Observation, Physics, Record, Scene, Sight, Situation, Stroke, Tool,
        ToolMotion, near_pairs,
    },
};

use super::{
    joints::{likeliest, with},
    pair::{JointType, PairBelief},
    relative::{relative, spread},
    rolled::Rolled,
    settings::BeliefSettings,
    track::{ARM, Track},
    window::{Doubt, Instant, drift, evidence},
};

/// Observations that are looked at together: fewer show less than the noise, more let errors of the
/// rollout grow.
const WINDOW: usize = 5;

/// How much the places of all objects count beside those of a pair against each other: where headings
/// of the pair are seen, and where they are not and more must come from how all objects move.
const PLACES: [f64; 2] = [0.3, 0.6];

/// What is believed about the joints of a scene.
#[derive(Clone, Debug)]
pub struct Belief {
    scene: Scene,
    tool: Arc<Tool>,
    lift: f64,
    settings: BeliefSettings,
    pairs: Vec<PairBelief>,
    track: Track,
    /// Not looked at yet.
    window: Vec<Observation>,
    seen: usize,
    history: Vec<Step>,
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

/// What a window tells of a pair.
struct Told {
    /// Of every hypothesis, as logarithms; `None` where nothing of the pair moved.
    evidence: Option<Vec<f64>>,
    /// By type of joint: the instants of the window, and the headings of the two that were rolled
    /// out to its end; `None` for those that were seen then.
    instants: [Vec<Instant>; 4],
    ends: [[Option<f64>; 2]; 4],
}

impl Belief {
    /// What is believed of `scene` before anything has moved, but for its joints, which are not
    /// known; its objects were seen where it states them. The tool's underside is `lift` metres above
    /// the table.
    pub fn new(scene: &Scene, tool: Arc<Tool>, lift: f64, settings: BeliefSettings) -> Self {
        let scene = Scene { joints: Vec::new(), ..scene.clone() };
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
            window: Vec::new(),
            seen: 0,
            history: Vec::new(),
        }
    }

    /// Pairs of objects that were near each other at the start and so may be joined: indices, the
    /// lower first.
    pub fn pairs(&self) -> impl ExactSizeIterator<Item = [usize; 2]> {
        self.pairs.iter().map(|pair| pair.between)
    }

    /// Of each of these pairs the probabilities of [`JointType::ALL`].
    pub fn probabilities(&self) -> Vec<[f64; 4]> {
        let map = self.map();
        let follows = |pair: &PairBelief| {
            pair.likeliest() != JointType::None && joint_of(&map, pair.between).is_none()
        };
        self.pairs.iter().map(|pair| pair.probabilities(follows(pair))).collect()
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
        let Some((mut base, mut told)) = self.look(model, &window, &self.map()) else { return };
        let unseen = |sight: &Sight| sight.heading.is_none();
        if window.iter().any(|now| now.seen.iter().flatten().any(unseen)) {
            // Without headings a pair is told by how all of its group moves: once more, with the
            // others joined as this window has them.
            let mut pairs = self.pairs.clone();
            for (pair, Told { evidence, .. }) in pairs.iter_mut().zip(&told) {
                if let Some(evidence) = evidence {
                    pair.weigh(evidence, self.settings.tempering);
                }
            }
            let map = likeliest(&self.scene, &pairs, &self.track.state);
            let Some(again) = self.look(model, &window, &map) else { return };
            (base, told) = again;
        }
        self.track.follow(&base, &window);
        let mut evidences = Vec::new();
        for (pair, Told { evidence, instants, ends }) in self.pairs.iter_mut().zip(told) {
            if let Some(evidence) = &evidence {
                pair.weigh(evidence, self.settings.tempering);
            }
            pair.learn(&instants);
            let between = pair.between;
            pair.recount(&ends.map(|ends| {
                [0, 1].map(|k| Some(ends[k]? - self.track.state.poses[between[k]].heading))
            }));
            evidences.push(evidence.map(|evidence| pair.by_type(&evidence)));
        }
        self.history.push(Step {
            observations: self.seen,
            probabilities: self.probabilities(),
            evidence: evidences,
        });
    }

    /// What a window tells of every pair, the others joined as in `map`, which is rolled out too.
    fn look(
        &self,
        model: &dyn EffectModel,
        window: &[Observation],
        map: &Physics,
    ) -> Option<(Rolled, Vec<Told>)> {
        let known: Vec<JointType> =
            self.pairs.iter().map(|pair| JointType::of(joint_of(map, pair.between))).collect();
        let base = self.roll(model, window, vec![map.clone()]).pop()?;
        let moved: Vec<f64> = (0..self.scene.objects.len())
            .map(|object| self.track.motion(object, &base, window))
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
            .map(|&(p, kind)| with(map, &self.pairs, (&self.pairs[p], kind), &self.track.state));
        let rolled = self.roll(model, window, physics.collect());
        let tell = |(p, pair): (usize, &PairBelief)| {
            let by_type = JointType::ALL.map(|kind| {
                let job = asked.iter().position(|one| *one == (p, kind));
                job.map_or(&base, |job| &rolled[job])
            });
            let instants =
                by_type.map(|rolled| self.instants(pair.between, rolled, window, &moved));
            let judged = || self.judge(pair, &by_type, &instants, window, &moved);
            let evidence = tells(pair).then(judged);
            let ends =
                by_type.map(|rolled| pair.between.map(|k| Track::unseen_end(k, rolled, window)));
            Told { evidence, instants, ends }
        };
        let told = self.pairs.iter().enumerate().map(tell).collect();
        Some((base, told))
    }

    /// The scene as it is thought to stand now, with the likeliest joints.
    pub fn situation(&self) -> Situation {
        let physics = Arc::new(self.map());
        Situation { scene: Arc::new(self.scene_now()), start: self.track.state.clone(), physics }
    }

    /// The likeliest physics: anchors and axes are where they are with the objects as in
    /// [`Self::situation`].
    pub fn map(&self) -> Physics {
        likeliest(&self.scene, &self.pairs, &self.track.state)
    }

    fn scene_now(&self) -> Scene {
        let mut scene = self.scene.clone();
        for (object, pose) in scene.objects.iter_mut().zip(&self.track.state.poses) {
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
        let strokes: Vec<Stroke> = window.iter().flat_map(|seen| seen.strokes.clone()).collect();
        let motion = ToolMotion { tool: Arc::clone(&self.tool), lift: self.lift, strokes };
        let start = &self.track.state;
        let job = |physics| Job {
            start: start.clone(),
            motion: motion.clone(),
            physics: Arc::new(physics),
        };
        let jobs: Vec<Job> = physics.into_iter().map(job).collect();
        let rolled = model.rollout(&self.scene_now(), &jobs, Record::Frames);
        rolled.iter().map(|trajectory| Rolled::new(trajectory, window, start)).collect()
    }

    /// A pair at the observations of a window, as it was seen and as it was rolled out.
    fn instants(
        &self,
        between: [usize; 2],
        rolled: &Rolled,
        window: &[Observation],
        moved: &[f64],
    ) -> Vec<Instant> {
        let drift = between.map(|k| {
            let end = rolled.states.last().map_or(0.0, |state| state.poses[k].heading);
            let turn = end - self.track.state.poses[k].heading;
            if moved[k] > 0.0 { drift(turn) } else { 0.0 }
        });
        let mut instants = Vec::new();
        for (k, (now, state)) in window.iter().zip(&rolled.states).enumerate() {
            let rolled = between.map(|k| state.poses[k]);
            let sights = [0, 1].map(|k| {
                let seen = now.seen[between[k]];
                let (pose, variance) = self.track.sight(seen, &rolled[k])?;
                Some((pose, variance, seen?.heading.is_some()))
            });
            let [Some(one), Some(other)] = sights else { continue };
            let share = (k + 1) as f64 / window.len() as f64;
            instants.push(Instant {
                share,
                seen: [one.0, other.0],
                headings: [one.2, other.2],
                variance: [one.1, other.1],
                rolled,
                drift: drift.map(|drift| share * drift),
            });
        }
        instants
    }

    /// What a window says of every hypothesis about a pair, rolled out by type.
    fn judge(
        &self,
        pair: &PairBelief,
        rolled: &[&Rolled; 4],
        instants: &[Vec<Instant>; 4],
        window: &[Observation],
        moved: &[f64],
    ) -> Vec<f64> {
        let [a, b] = pair.between;
        let [first, second] = [a, b].map(|k| &self.track.state.poses[k]);
        let before = relative(first, second);
        let by_type = JointType::ALL.map(|kind| {
            let (rolled, instants) = (rolled[kind as usize], &instants[kind as usize]);
            let last = instants.last()?;
            let variance = |which: usize| {
                // Errors of headings that are not seen turn all of a pair's frame alike.
                let known = |k: usize| which == 0 || last.headings[k];
                let of = |k: usize| self.track.variance[pair.between[k]][which];
                [0, 1].map(|k| if known(k) { of(k) } else { 0.0 })
            };
            let start = spread(&before, variance(0), variance(1));
            let change: Vector3<f64> = relative(&last.rolled[0], &last.rolled[1]) - before;
            let relative = change.xy().norm().hypot(ARM * change.z);
            let unseen = last.headings == [false; 2];
            let doubt = Doubt::new(start, relative, moved[a].max(moved[b]), ARM, unseen);
            Some((
                instants,
                doubt,
                PLACES[usize::from(unseen)] * self.track.places(rolled, window, moved),
            ))
        });
        let of = |kind: JointType| by_type[kind as usize].as_ref();
        let judged = pair.hypotheses.iter().map(|hypothesis| {
            of(hypothesis.fit.kind).map_or(f64::NEG_INFINITY, |(instants, doubt, places)| {
                evidence(&hypothesis.fit, instants, doubt) + places
            })
        });
        judged.collect()
    }
}

fn joint_of(physics: &Physics, between: [usize; 2]) -> Option<&Joint> {
    physics.joints.iter().find(|joint| joint.between == between)
}
