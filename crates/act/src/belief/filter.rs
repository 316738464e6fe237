//! The belief filter and its update with observations.

use std::{borrow::Cow, sync::Arc};

use serde::Serialize;

use pushplan::{
    effect::EffectModel,
    scene::{
        JOINABLE, Joint, NearPair, Physics, Scene, Situation, State, Tool, Unknowns, pairs_within,
    },
    task::{Job, Noise, Observation},
};

use super::{
    distributions::LOGISTIC,
    group::{Push, has_unseen_headings, is_lifted},
    importance::Stretch,
    joints::{carried, likeliest, of_types},
    masses::Masses,
    pair::{JointType, PairBelief},
    pair_likelihood::{PairEvidence, WindowEvidence},
    particles::Particles,
    regulation::{BeliefRegulator, Regulation},
    regulator_features::{Circumstances, Draft, RegulatorFeatures, Together, features},
    relative::{relative, spread},
    settings::BeliefSettings,
    state_filter::{ARM, StateFilter},
};

/// Number of observations per window. Shorter windows are dominated by noise; in longer ones errors
/// of the rollout grow.
const WINDOW: usize = 5;

/// Additional gap up to which two objects are considered joinable, in standard deviations of the
/// observed gap.
const BEYOND: f64 = 2.0;

/// Belief about a scene.
#[derive(Clone, Debug)]
pub struct Belief {
    pub(super) scene: Scene,
    pub(super) tool: Arc<Tool>,
    pub(super) lift: f64,
    pub(super) settings: BeliefSettings,
    /// Pairs as the filter estimates them.
    pub(super) pairs: Vec<PairBelief>,
    pub(super) track: StateFilter,
    /// Known joints, at the poses stated in the scene.
    pub(super) known: Vec<Joint>,
    pub(super) particles: Particles,
    pub(super) masses: Option<Masses>,
    pub(super) stretch: Option<Stretch>,
    pub(super) push: Option<Push>,
    /// Results of the joint inference for every pair, while a push is replayed with them.
    pub(super) together: Option<Vec<Together>>,
    /// Observations not yet processed.
    window: Vec<Observation>,
    pub(super) seen: usize,
    pub(super) history: Vec<Step>,
    pub(super) regulation: Option<Regulation>,
}

/// Entry of a belief's history.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Step {
    /// Number of observations processed so far.
    pub observations: usize,
    /// Probabilities of [`JointType::ALL`] for every pair, in the order of [`Belief::pairs`]. At
    /// the end of a push they come from the joint inference over all pairs.
    pub probabilities: Vec<[f64; 4]>,
    /// Log-likelihood of the window for each type, relative to the best; `None` if neither object
    /// moved.
    pub evidence: Vec<Option<[f64; 4]>>,
}

impl Belief {
    /// Returns the initial belief about `scene`, whose joints are unknown except within compound
    /// objects.
    ///
    /// The objects were observed at their stated poses. The tool's underside is `lift` metres above
    /// the table.
    pub fn new(scene: &Scene, tool: Arc<Tool>, lift: f64, settings: BeliefSettings) -> Self {
        let known = scene.seams().collect();
        let scene = Scene { joints: Vec::new(), ..scene.clone() };
        let particles = Particles::new(scene.objects.len(), Unknowns::NONE, 0);
        let track = StateFilter::new(scene.start(), settings.noise);
        let doubt = gap_deviation(settings.noise);
        let pairs = pairs_within(&scene, JOINABLE + BEYOND * doubt)
            .into_iter()
            .filter(|pair| !scene.same_thing(pair.between))
            .map(|NearPair { between: [a, b], gap, midway }| {
                let [first, second] = [a, b].map(|k| &scene.objects[k].pose);
                let seen = relative(first, second);
                let variance = |which: usize| [a, b].map(|k| track.variance[k][which]);
                let spread = spread(&seen, variance(0), variance(1));
                let near = joinable(gap, doubt);
                PairBelief::new([a, b], seen, &spread, first.local_point(midway), near)
            })
            .collect();
        Self {
            scene,
            tool,
            lift,
            settings,
            pairs,
            track,
            known,
            particles,
            masses: None,
            stretch: None,
            push: None,
            together: None,
            window: Vec::new(),
            seen: 0,
            history: Vec::new(),
            regulation: None,
        }
    }

    /// Adds a regulator that corrects the filter.
    pub fn regulated(self, regulator: BeliefRegulator) -> Self {
        Self { regulation: Some(Regulation::new(regulator)), ..self }
    }

    /// Returns the features of all windows recorded by a [listening](BeliefRegulator::listening)
    /// regulator.
    pub fn recorded(&self) -> &[RegulatorFeatures] {
        self.regulation.as_ref().map_or(&[], |regulation| &regulation.recorded)
    }

    /// Returns the features recorded for pushes before their joints were inferred jointly.
    pub fn drafts(&self) -> &[Draft] {
        self.regulation.as_ref().map_or(&[], |regulation| &regulation.drafts)
    }

    /// Returns the pairs of objects that were close at the start and so may be joined. The lower
    /// index is first.
    pub fn pairs(&self) -> impl ExactSizeIterator<Item = [usize; 2]> {
        self.pairs.iter().map(|pair| pair.between)
    }

    /// Returns the probabilities of [`JointType::ALL`] for each of these pairs.
    pub fn probabilities(&self) -> Vec<[f64; 4]> {
        let pairs = self.regulated_pairs();
        let map = likeliest(&self.scene, &pairs, &self.track.state);
        pairs.iter().map(|pair| pair.probabilities(follows(&map, pair))).collect()
    }

    /// Returns the pairs, with the regulator's probabilities where it corrects them.
    pub(super) fn regulated_pairs(&self) -> Cow<'_, [PairBelief]> {
        let Some(regulation) = &self.regulation else { return Cow::Borrowed(&self.pairs) };
        let mut pairs = self.pairs.clone();
        for (pair, shares) in pairs.iter_mut().zip(&regulation.shares) {
            pair.regulated = *shares;
        }
        Cow::Owned(pairs)
    }

    /// Returns the history of the belief.
    pub fn history(&self) -> &[Step] {
        &self.history
    }

    /// Adds an observation. Observations are processed in windows, so the last ones may have no
    /// effect before [`Self::settle`].
    pub fn update(&mut self, model: &dyn EffectModel, observation: Observation) {
        let lifted = is_lifted(&observation);
        self.window.push(observation);
        if self.window.len() >= WINDOW || lifted {
            self.settle(model);
        }
    }

    /// Processes all pending observations.
    pub fn settle(&mut self, model: &dyn EffectModel) {
        let window = std::mem::take(&mut self.window);
        if window.is_empty() {
            return;
        }
        self.remember(&window);
        self.take(model, &window, None);
        self.look_together(model);
    }

    /// Processes a window with the physics `assumed`, otherwise with the most probable physics.
    pub(super) fn take(
        &mut self,
        model: &dyn EffectModel,
        window: &[Observation],
        assumed: Option<Physics>,
    ) {
        self.seen += window.len();
        let open = assumed.is_none();
        let mut map = assumed.unwrap_or_else(|| self.filtered_map());
        let Some(mut window_evidence) = self.look(model, window, &map) else { return };
        if open && has_unseen_headings(window) {
            // Without headings the evidence about a pair depends on the motion of its group. The
            // window is therefore evaluated again with the joints that it supports.
            let mut pairs = self.pairs.clone();
            weigh(&mut pairs, &window_evidence.pairs, self.settings.tempering);
            map = self.with_known(likeliest(&self.scene, &pairs, &self.track.state));
            let Some(again) = self.look(model, window, &map) else { return };
            window_evidence = again;
        }
        weigh(&mut self.pairs, &window_evidence.pairs, self.settings.tempering);
        self.weigh_numbers(model, window);
        let played = (self.scene_now(), self.job(window, map));
        self.learn(window, &window_evidence);
        for (pair, pair_evidence) in self.pairs.iter_mut().zip(&window_evidence.pairs) {
            pair.learn_stops(&pair_evidence.instants, &pair_evidence.doubts);
        }
        let of = |(pair, pair_evidence): (&PairBelief, &PairEvidence)| {
            pair_evidence.judged.as_ref().map(|judged| pair.by_type(&judged.evidence))
        };
        let evidence = self.pairs.iter().zip(&window_evidence.pairs).map(of).collect();
        self.regulate(played, window, &window_evidence);
        let probabilities = self.probabilities();
        self.history.push(Step { observations: self.seen, probabilities, evidence });
    }

    /// Updates the state estimate and the geometry of all hypotheses with a window.
    pub(super) fn learn(&mut self, window: &[Observation], window_evidence: &WindowEvidence) {
        self.track.follow(&window_evidence.base, window);
        for (pair, PairEvidence { instants, ends, .. }) in
            self.pairs.iter_mut().zip(&window_evidence.pairs)
        {
            pair.learn(instants);
            let between = pair.between;
            pair.recount(&ends.map(|ends| {
                [0, 1].map(|k| Some(ends[k]? - self.track.state.poses[between[k]].heading))
            }));
        }
    }

    /// Returns the physics in which [`Self::pairs`] have joints of these `types`, at their most
    /// probable geometry. Joints close no loop.
    pub fn physics_of(&self, types: &[JointType]) -> Physics {
        self.with_known(of_types(&self.scene, &self.pairs, &self.track.state, types))
    }

    /// Returns the types from the last informative window alone: a memoryless baseline.
    pub fn last_types(&self) -> Vec<JointType> {
        let last = |p: usize| self.history.iter().rev().find_map(|step| step.evidence[p]);
        let of = |p| last(p).map_or(JointType::None, |evidence| PairBelief::by_window(&evidence));
        (0..self.pairs.len()).map(of).collect()
    }

    /// Lets the regulator, if any, correct the filter's result for a window. `played` is the
    /// rollout job with the most probable physics, in the scene before the window.
    fn regulate(
        &mut self,
        played: (Scene, Job),
        window: &[Observation],
        window_evidence: &WindowEvidence,
    ) {
        let Some(mut regulation) = self.regulation.take() else { return };
        let (scene, job) = (&played.0, &played.1);
        let now = self.filtered_map();
        let seen = |k: usize| {
            window.iter().any(|one| one.seen[k].is_some_and(|sight| sight.heading.is_some()))
        };
        let of = |(p, (pair, pair_evidence)): (usize, (&PairBelief, &PairEvidence))| {
            let around = Circumstances {
                noise: self.settings.noise,
                windows: self.history.len(),
                moved: pair.between.map(|k| window_evidence.moved[k]),
                worked: self.worked(pair.between),
                headings: pair.between.map(seen),
                cylinders: pair.between.map(|k| self.scene.objects[k].shape.is_cylinder()),
                taken: JointType::of(joint_of(&job.physics, pair.between)),
                follows: follows(&now, pair),
            };
            let together = self.together.as_ref().map(|together| &together[p]);
            pair_evidence.judged.as_ref().map(|judged| features(pair, judged, &around, together))
        };
        let pair_evidence = self.pairs.iter().zip(&window_evidence.pairs).enumerate();
        let evidence: Vec<_> = pair_evidence.map(of).collect();
        let filtered = self.pairs.iter().map(|pair| pair.filtered(follows(&now, pair))).collect();
        let pairs: Vec<[usize; 2]> = self.pairs().collect();
        regulation.take((scene, job), &pairs, &evidence, filtered);
        self.regulation = Some(regulation);
    }

    /// Returns the estimated relative displacement of two objects: metres, radians.
    fn worked(&self, [a, b]: [usize; 2]) -> [f64; 2] {
        let (start, now) = (&self.scene.objects, &self.track.state.poses);
        let change = relative(&now[a], &now[b]) - relative(&start[a].pose, &start[b].pose);
        [change.xy().norm(), change.z.abs()]
    }

    /// Returns the estimated current scene, with the joints used for prediction.
    pub fn situation(&self) -> Situation {
        let physics = Arc::new(self.supposed());
        Situation { scene: Arc::new(self.scene_now()), start: self.track.state.clone(), physics }
    }

    /// Returns the most probable physics, with anchors and axes at the poses of
    /// [`Self::situation`].
    pub fn map(&self) -> Physics {
        self.with_known(likeliest(&self.scene, &self.regulated_pairs(), &self.track.state))
    }

    /// Returns the most probable physics according to the filter alone.
    ///
    /// Windows are rolled out with it because the regulator was trained on evidence obtained this
    /// way.
    pub(super) fn filtered_map(&self) -> Physics {
        self.with_known(likeliest(&self.scene, &self.pairs, &self.track.state))
    }

    /// Completes the physics of near pairs with the known joints and the estimated parameters.
    pub(super) fn with_known(&self, mut physics: Physics) -> Physics {
        physics.joints.extend(carried(&self.known, &self.scene, &self.track.state));
        self.with_numbers(physics)
    }

    /// Inserts the most probable masses, frictions and supports.
    pub(super) fn with_numbers(&self, physics: Physics) -> Physics {
        let physics = self.particles.mean(&self.scene, physics);
        match &self.masses {
            Some(masses) => masses.likeliest(physics),
            None => physics,
        }
    }

    pub(super) fn scene_now(&self) -> Scene {
        self.scene_at(&self.track.state)
    }

    pub(super) fn scene_at(&self, state: &State) -> Scene {
        self.scene.moved_to(state)
    }
}

/// Returns the standard deviation of the gap between two objects observed with this noise, metres.
fn gap_deviation(noise: Noise) -> f64 {
    noise.position.hypot(ARM * noise.heading) * std::f64::consts::SQRT_2
}

/// Returns the probability that two objects are close enough to be joined, given their observed gap
/// and its standard deviation, metres.
fn joinable(gap: f64, doubt: f64) -> f64 {
    if doubt == 0.0 {
        return 1.0;
    }
    (1.0 + (LOGISTIC * (gap - JOINABLE) / doubt).exp()).recip()
}

/// Returns `true` if a pair moves as if joined but its motion follows from more probable joints.
pub(super) fn follows(physics: &Physics, pair: &PairBelief) -> bool {
    pair.likeliest() != JointType::None && joint_of(physics, pair.between).is_none()
}

pub(super) fn joint_of(physics: &Physics, between: [usize; 2]) -> Option<&Joint> {
    physics.joints.iter().find(|joint| joint.between == between)
}

/// Updates the pairs with the evidence of a window, raised to the power `tempering`.
pub(super) fn weigh(pairs: &mut [PairBelief], pair_evidence: &[PairEvidence], tempering: f64) {
    for (pair, pair_evidence) in pairs.iter_mut().zip(pair_evidence) {
        if let Some(judged) = &pair_evidence.judged {
            pair.weigh(&judged.evidence, tempering);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pushplan::{
        geometry::{Pose, Shape},
        scene::{Object, Part},
    };

    #[test]
    fn objects_that_noise_may_have_separated_may_be_joined() {
        let can = |name: &str, x| Object::cylinder(name, 0.05, 0.1).at(x, 0.0, 0.0);
        let scene = Scene::new([can("a", 0.0), can("b", 0.1 + JOINABLE + 1e-3), can("c", 0.5)]);
        let none = |position: f64| {
            let finger = Shape::Cylinder { radius: 0.01, height: 0.05 };
            let tool = Tool::new("finger", [Part::new("finger", finger, Pose::default())]);
            let settings = BeliefSettings::new(Noise { position, heading: 0.0 });
            let belief = Belief::new(&scene, Arc::new(tool.expect("one piece")), 0.0, settings);
            belief.pairs().zip(belief.probabilities()).map(|(_, [none, ..])| none).next()
        };
        assert_eq!(none(0.0), None);
        // With more noise, the observed gap is weaker evidence against a joint.
        let (fine, coarse) = (none(1e-3).expect("a pair"), none(5e-3).expect("a pair"));
        assert!(0.85 < fine && fine < 0.9, "{fine}");
        assert!(0.75 < coarse && coarse < 0.8, "{coarse}");
    }
}
