//! What a window tells of every pair: hypotheses rolled out beside what was seen.

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
    relative::{relative, spread},
    rolled::Rolled,
    testimony::Judged,
    track::{ARM, Track},
    window::{Doubt, Instant, drift, evidence, whitened},
};

/// How much the places of all objects count beside those of a pair against each other: where headings
/// of the pair are seen, and where they are not and more must come from how all objects move.
const PLACES: [f64; 2] = [0.3, 0.6];

/// A window, looked at.
pub(super) struct Looked {
    /// Rolled out with the joints that were taken for true.
    pub base: Rolled,
    /// What it tells of every pair.
    pub told: Vec<Told>,
    /// How far every object moved, metres; zero where that may be noise.
    pub moved: Vec<f64>,
}

/// What a window tells of a pair.
pub(super) struct Told {
    /// `None` where nothing of the pair moved.
    pub judged: Option<Judged>,
    /// By type of joint: the instants of the window, and the headings of the two that were rolled
    /// out to its end; `None` for those that were seen then.
    pub instants: [Vec<Instant>; 4],
    pub ends: [[Option<f64>; 2]; 4],
    /// By type, what is not known of the rollout; `None` where nothing of the pair was seen or moved.
    pub doubts: [Option<Doubt>; 4],
}

impl Belief {
    /// What a window tells of every pair, the others joined as in `map`, which is rolled out too.
    pub(super) fn look(
        &self,
        model: &dyn EffectModel,
        window: &[Observation],
        map: &Physics,
    ) -> Option<Looked> {
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
            let places = by_type.map(|rolled| self.track.places(rolled, window, &moved));
            let doubts = match tells(pair) {
                true => self.doubts(pair, &instants, &moved),
                false => [None; 4],
            };
            let judged = tells(pair).then(|| self.judge(pair, &places, &instants, &doubts));
            let ends =
                by_type.map(|rolled| pair.between.map(|k| Track::unseen_end(k, rolled, window)));
            Told { judged, instants, ends, doubts }
        };
        let told = self.pairs.iter().enumerate().map(tell).collect();
        Some(Looked { base, told, moved })
    }

    /// What a window tells of all pairs, joined as in `map`, where no other type is asked and places of
    /// objects do not count; and how likely these are.
    pub(super) fn look_at(
        &self,
        model: &dyn EffectModel,
        window: &[Observation],
        map: &Physics,
    ) -> Option<(Looked, f64)> {
        let base = self.roll(model, window, vec![map.clone()]).pop()?;
        let moved: Vec<f64> = (0..self.scene.objects.len())
            .map(|object| self.track.motion(object, &base, window))
            .collect();
        let tell = |pair: &PairBelief| {
            let instants = self.instants(pair.between, &base, window, &moved);
            let instants = JointType::ALL.map(|_| instants.clone());
            let doubts = self.doubts(pair, &instants, &moved);
            let judged = Some(self.judge(pair, &[0.0; 4], &instants, &doubts));
            let ends = pair.between.map(|k| Track::unseen_end(k, &base, window));
            Told { judged, instants, ends: [ends; 4], doubts }
        };
        let told = self.pairs.iter().map(tell).collect();
        let places = self.track.places(&base, window, &moved);
        Some((Looked { base, told, moved }, places))
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
    pub(super) fn job(&self, window: &[Observation], physics: Physics) -> Job {
        let strokes: Vec<Stroke> = window.iter().flat_map(|seen| seen.strokes.clone()).collect();
        let motion = ToolMotion { tool: Arc::clone(&self.tool), lift: self.lift, strokes };
        Job { start: self.track.state.clone(), motion: motion.into(), physics: Arc::new(physics) }
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

    /// What is not known of how a pair was rolled out, by type; `None` where it was not seen.
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
                // Errors of headings that are not seen turn all of a pair's frame alike.
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

    /// What a window says of every hypothesis about a pair, rolled out by type with these `doubts`; by
    /// type too, how likely the `places` of all objects are.
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
