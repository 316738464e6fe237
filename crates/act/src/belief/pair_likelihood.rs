//! Evidence of a window about every pair, from rollouts of the hypotheses.

use std::sync::Arc;

use nalgebra::Vector3;

use pushplan::{
    effect::EffectModel,
    geometry::wrap_angle,
    outcome::Record,
    scene::Physics,
    task::{Job, Observation, Stroke, ToolMotion},
};

use super::{
    filter::{Belief, joint_of},
    joints::with,
    pair::{JointType, PairBelief},
    regulator_features::Judged,
    relative::{relative, spread},
    rolled::Rolled,
    state_filter::{ARM, StateFilter},
    window::{Doubt, Instant, drift, evidence, whitened},
};

/// Weight of the positions of all objects relative to the relative pose of a pair. The first value
/// applies if the headings of the pair are observed, the second otherwise, because the group's
/// motion is then more informative.
const PLACES: [f64; 2] = [0.3, 0.6];

/// Evaluated window.
pub(super) struct WindowEvidence {
    /// Rollout with the assumed joints.
    pub base: Rolled,
    /// Evidence about every pair.
    pub pairs: Vec<PairEvidence>,
    /// Displacement of every object, metres; zero if it may be noise.
    pub moved: Vec<f64>,
}

/// Evidence of a window about a pair.
pub(super) struct PairEvidence {
    /// Result for the hypotheses; `None` if neither object moved.
    pub judged: Option<Judged>,
    /// Instants of the window by joint type, and rolled-out headings at its end. Headings that were
    /// observed then are `None`.
    pub instants: [Vec<Instant>; 4],
    pub ends: [[Option<f64>; 2]; 4],
    /// Uncertainty of the rollout by type; `None` if the pair was not observed or did not move.
    pub doubts: [Option<Doubt>; 4],
}

impl Belief {
    /// Evaluates a window for every pair, with the other pairs joined as in `map`.
    pub(super) fn look(
        &self,
        model: &dyn EffectModel,
        window: &[Observation],
        map: &Physics,
    ) -> Option<WindowEvidence> {
        let known: Vec<JointType> =
            self.pairs.iter().map(|pair| JointType::of(joint_of(map, pair.between))).collect();
        let base = self.roll(model, window, vec![map.clone()]).pop()?;
        let moved: Vec<f64> = (0..self.scene.objects.len())
            .map(|object| self.track.motion(object, &base, window))
            .collect();
        let informative = |pair: &PairBelief| pair.between.iter().any(|&k| moved[k] > 0.0);
        // All other joint types of every pair that moved.
        let mut queries: Vec<(usize, JointType)> = Vec::new();
        for (p, _) in self.pairs.iter().enumerate().filter(|(_, pair)| informative(pair)) {
            let others = JointType::ALL.into_iter().filter(|kind| *kind != known[p]);
            queries.extend(others.map(|kind| (p, kind)));
        }
        let physics = queries
            .iter()
            .map(|&(p, kind)| with(map, &self.pairs, (&self.pairs[p], kind), &self.track.state));
        let rolled = self.roll(model, window, physics.collect());
        let evidence_of = |(p, pair): (usize, &PairBelief)| {
            let by_type = JointType::ALL.map(|kind| {
                let job = queries.iter().position(|one| *one == (p, kind));
                job.map_or(&base, |job| &rolled[job])
            });
            let instants =
                by_type.map(|rolled| self.instants(pair.between, rolled, window, &moved));
            let places = by_type.map(|rolled| self.track.places(rolled, window, &moved));
            let doubts = match informative(pair) {
                true => self.doubts(pair, &instants, &moved),
                false => [None; 4],
            };
            let judged = informative(pair).then(|| self.judge(pair, &places, &instants, &doubts));
            let ends = by_type
                .map(|rolled| pair.between.map(|k| StateFilter::unseen_end(k, rolled, window)));
            PairEvidence { judged, instants, ends, doubts }
        };
        let pairs = self.pairs.iter().enumerate().map(evidence_of).collect();
        Some(WindowEvidence { base, pairs, moved })
    }

    /// Evaluates a window with the joints of `map` only and returns the log-likelihood of the
    /// object positions. The positions do not enter the evidence of the pairs.
    pub(super) fn look_at(
        &self,
        model: &dyn EffectModel,
        window: &[Observation],
        map: &Physics,
    ) -> Option<(WindowEvidence, f64)> {
        let base = self.roll(model, window, vec![map.clone()]).pop()?;
        let moved: Vec<f64> = (0..self.scene.objects.len())
            .map(|object| self.track.motion(object, &base, window))
            .collect();
        let evidence_of = |pair: &PairBelief| {
            let instants = self.instants(pair.between, &base, window, &moved);
            let instants = JointType::ALL.map(|_| instants.clone());
            let doubts = self.doubts(pair, &instants, &moved);
            let judged = Some(self.judge(pair, &[0.0; 4], &instants, &doubts));
            let ends = pair.between.map(|k| StateFilter::unseen_end(k, &base, window));
            PairEvidence { judged, instants, ends: [ends; 4], doubts }
        };
        let pairs = self.pairs.iter().map(evidence_of).collect();
        let places = self.track.places(&base, window, &moved);
        Some((WindowEvidence { base, pairs, moved }, places))
    }

    /// Rolls out the tool's motion in a window under every element of `physics`.
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

    /// Returns the job for the tool's motion in a window under `physics`.
    pub(super) fn job(&self, window: &[Observation], physics: Physics) -> Job {
        let strokes: Vec<Stroke> = window.iter().flat_map(|seen| seen.strokes.clone()).collect();
        let motion = ToolMotion { tool: Arc::clone(&self.tool), lift: self.lift, strokes };
        Job { start: self.track.state.clone(), motion: motion.into(), physics: Arc::new(physics) }
    }

    /// Returns the observed and the rolled-out poses of a pair at every observation of a window.
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

    /// Returns the uncertainty of a pair's rollout by type; `None` if the pair was not observed.
    fn doubts(
        &self,
        pair: &PairBelief,
        instants: &[Vec<Instant>; 4],
        moved: &[f64],
    ) -> [Option<Doubt>; 4] {
        let [a, b] = pair.between;
        let [first, second] = [a, b].map(|k| &self.track.state.poses[k]);
        let before = relative(first, second);
        JointType::ALL.map(|kind| {
            let last = instants[kind as usize].last()?;
            let variance = |which: usize| {
                // Errors of unobserved headings rotate the whole frame of a pair.
                let known = |k: usize| which == 0 || last.headings[k];
                let of = |k: usize| self.track.variance[pair.between[k]][which];
                [0, 1].map(|k| if known(k) { of(k) } else { 0.0 })
            };
            let start = spread(&before, variance(0), variance(1));
            let change: Vector3<f64> = relative(&last.rolled[0], &last.rolled[1]) - before;
            let relative = change.xy().norm().hypot(ARM * change.z);
            let unseen = last.headings == [false; 2];
            Some(Doubt::new(start, relative, moved[a].max(moved[b]), ARM, unseen))
        })
    }

    /// Returns the evidence of a window for every hypothesis about a pair.
    ///
    /// `doubts` are the uncertainties of the rollouts and `places` the log-likelihoods of all
    /// positions, both by type.
    fn judge(
        &self,
        pair: &PairBelief,
        places: &[f64; 4],
        instants: &[Vec<Instant>; 4],
        doubts: &[Option<Doubt>; 4],
    ) -> Judged {
        let [first, second] = pair.between.map(|k| &self.track.state.poses[k]);
        let before = relative(first, second);
        let by_type = JointType::ALL.map(|kind| {
            let instants = &instants[kind as usize];
            let unseen = instants.last()?.headings == [false; 2];
            let doubt = doubts[kind as usize].as_ref()?;
            Some((instants, doubt, PLACES[usize::from(unseen)] * places[kind as usize]))
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
        let last = of(JointType::None).and_then(|(instants, ..)| instants.last());
        let change = last.map_or([0.0; 2], |last| {
            let change = relative(&last.seen[0], &last.seen[1]) - before;
            [change.xy().norm(), wrap_angle(change.z).abs()]
        });
        Judged { evidence, off, change }
    }
}
