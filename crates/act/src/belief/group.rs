//! Joints of a group of objects, inferred together.
//!
//! The filter judges each pair beside what it takes the others for at that moment. One wrong joint
//! misleads its neighbours, above all where headings are not seen and follow from the joints around them,
//! and what they said then is never taken back. Hence after every push whole assignments of joints to
//! pairs are played again from where the push began, and compared by how likely what was seen is under
//! them: coordinate ascent on the likeliest joints, a pair at a time (iterated conditional modes, Besag
//! 1986, doi:10.1111/j.2517-6161.1986.tb01412.x). Under the best of them the filter follows the push once
//! more. A few times this is done in the middle of a push as well, as a robot acts on what it foresees then.
//!
//! Joints are placed where the whole push showed their anchors and axes to be. Where headings are not
//! seen, that depends on the assignment, so each is played with anchors and axes of its own.

use pushplan::{
    effect::EffectModel,
    scene::{DisjointSets, Physics},
    task::Observation,
};

use super::{
    density::log_sum,
    filter::{Belief, follows, joint_of, weigh},
    joints::of_types,
    pair::{JointType, PairBelief},
    testimony::Together,
};

/// Most windows that are played again.
const LONGEST: usize = 10;

/// Windows of a push after which joints are inferred together though it goes on, and all of it will be
/// played again. After every one of six the rest of the way is foreseen no better than after these, and an
/// update takes a third longer.
const EARLIER: [usize; 3] = [2, 4, 6];

/// Times that every pair is asked, unless nothing changes before.
const SWEEPS: usize = 2;

/// What is less likely by the filter is not tried.
const LEAST: f64 = 0.01;

/// Most assignments that are played, which takes about as long as the filter did.
const PLAYS: usize = 64;

/// An assignment that after any window is so much less likely than the best is given up, as a logarithm.
/// It takes three quarters of the time that it takes without, and the rest of the way after 10 and 20
/// observations of 20 dense trajectories is foreseen the same to a tenth of a millimetre.
const HOPELESS: f64 = 10.0;

/// Score of what was given up.
const GIVEN_UP: f64 = -1e6;

/// A push so far, to be played again.
#[derive(Clone, Debug)]
pub(super) struct Push {
    /// What was believed before it; its history is left out.
    before: Box<Belief>,
    windows: Vec<Vec<Observation>>,
}

impl Belief {
    /// Keeps what is believed before a window, and the window.
    pub(super) fn remember(&mut self, window: &[Observation]) {
        let mut push = self.push.take().unwrap_or_else(|| {
            let history = std::mem::take(&mut self.history);
            let before = Box::new(self.clone());
            self.history = history;
            Push { before, windows: Vec::new() }
        });
        push.windows.push(window.to_vec());
        self.push = Some(push);
    }

    /// At the end of a push, after many windows and a few times before that, has all joints inferred together
    /// and takes what follows from them.
    pub(super) fn look_together(&mut self, model: &dyn EffectModel) {
        let windows = self.push.as_ref().map_or(&[][..], |push| &push.windows);
        let lifted = windows.iter().flatten().last().is_some_and(is_lifted);
        let ends = lifted || windows.len() >= LONGEST;
        if !ends && !EARLIER.contains(&windows.len()) {
            return;
        }
        let Some(push) = self.push.take() else { return };
        let Push { before, windows } = &push;
        let seen = !windows.iter().any(|window| has_unseen_headings(window));
        let learnt = seen.then_some(&self.pairs[..]);
        let marginals = self.filtered_shares();
        let played = self.assign(model, before, windows, (learnt, &marginals));
        let Some((types, _)) = played.best() else { return };
        let mut again = (**before).clone();
        if let (Some(again), Some(first)) = (&mut again.regulation, &self.regulation) {
            again.keep(first);
        }
        again.together = Some(played.found(&marginals));
        for window in windows {
            let physics = again.physics_as(types, learnt);
            again.take(model, window, Some(physics));
        }
        again.together = None;
        // Rolled out with its stops a joint never tells of them.
        for (again, first) in again.pairs.iter_mut().zip(&self.pairs) {
            again.keep_stops(first);
        }
        again.history = std::mem::take(&mut self.history);
        *self = again;
        self.push = (!ends).then_some(push);
        let probabilities = self.probabilities();
        if let Some(step) = self.history.last_mut() {
            step.probabilities = probabilities;
        }
    }

    /// Of every pair the probabilities of [`JointType::ALL`] by the filter.
    fn filtered_shares(&self) -> Vec<[f64; 4]> {
        let map = self.filtered_map();
        self.pairs.iter().map(|pair| pair.filtered(follows(&map, pair))).collect()
    }

    /// The likeliest types of all pairs together, searched for from the filter's, whose shares of each are
    /// `marginals`, and all that were played on the way; joints are where they are `learnt` to be.
    fn assign(
        &self,
        model: &dyn EffectModel,
        before: &Belief,
        windows: &[Vec<Observation>],
        (learnt, marginals): (Option<&[PairBelief]>, &[[f64; 4]]),
    ) -> Played {
        let map = self.filtered_map();
        let mut best: Vec<JointType> =
            self.pairs.iter().map(|pair| JointType::of(joint_of(&map, pair.between))).collect();
        let mut logs = before.play(model, &best, windows, learnt, &[]);
        let score = |logs: &[f64]| {
            let whole = logs.last().filter(|_| logs.len() == windows.len());
            whole.copied().filter(|log| log.is_finite()).unwrap_or(GIVEN_UP)
        };
        let mut most = score(&logs);
        let mut played = Played(vec![(best.clone(), most)]);
        let mut order = self.told(windows.len());
        let share = |p: usize| marginals[p][best[p] as usize];
        order.sort_by(|&one, &other| share(one).total_cmp(&share(other)));
        'search: for _ in 0..SWEEPS {
            let before_sweep = best.clone();
            for &p in &order {
                let likely =
                    |kind: &JointType| *kind != best[p] && marginals[p][*kind as usize] >= LEAST;
                let kinds: Vec<JointType> = JointType::ALL.into_iter().filter(likely).collect();
                let options: Vec<_> =
                    kinds.into_iter().flat_map(|kind| self.changed(&best, p, kind)).collect();
                for option in options {
                    if played.0.len() == PLAYS {
                        break 'search;
                    }
                    let least: Vec<f64> = logs.iter().map(|log| log - HOPELESS).collect();
                    let now = before.play(model, &option, windows, learnt, &least);
                    let log = score(&now);
                    if log > most {
                        (most, best, logs) = (log, option.clone(), now);
                    }
                    played.0.push((option, log));
                }
            }
            if best == before_sweep {
                break;
            }
        }
        played
    }

    /// The pairs of which the last `windows` told anything: of the others nothing moved, and how they are
    /// joined changes nothing.
    fn told(&self, windows: usize) -> Vec<usize> {
        let told = |p: &usize| {
            let mut steps = self.history.iter().rev().take(windows);
            steps.any(|step| step.evidence[*p].is_some())
        };
        (0..self.pairs.len()).filter(told).collect()
    }

    /// `types` with one pair of another kind; where that closes a loop, every joint in it gives way in
    /// turn.
    fn changed(&self, types: &[JointType], pair: usize, kind: JointType) -> Vec<Vec<JointType>> {
        let mut changed = types.to_vec();
        changed[pair] = kind;
        if self.is_forest(&changed) {
            return vec![changed];
        }
        let others = (0..types.len()).filter(|&p| p != pair && types[p] != JointType::None);
        let without = others.map(|p| {
            let mut without = changed.clone();
            without[p] = JointType::None;
            without
        });
        without.filter(|types| self.is_forest(types)).collect()
    }

    /// Physics of `types` now, their joints where they are `learnt` to be.
    fn physics_as(&self, types: &[JointType], learnt: Option<&[PairBelief]>) -> Physics {
        let Some(learnt) = learnt else { return self.physics_of(types) };
        self.with_known(of_types(&self.scene, learnt, &self.track.state, types))
    }

    fn is_forest(&self, types: &[JointType]) -> bool {
        let mut sets = DisjointSets::new(self.scene.objects.len());
        let mut joined = self.pairs.iter().zip(types);
        joined.all(|(pair, kind)| *kind == JointType::None || sets.join(pair.between))
    }

    /// How likely `types` are, and what was seen up to the end of each of these windows where they are true,
    /// as logarithms up to what is the same for all of them. As much of the evidence counts as in the filter.
    /// Ends early where they are less than `least` says.
    fn play(
        &self,
        model: &dyn EffectModel,
        types: &[JointType],
        windows: &[Vec<Observation>],
        learnt: Option<&[PairBelief]>,
        least: &[f64],
    ) -> Vec<f64> {
        let mut played = self.clone();
        let mut log = 0.0;
        for (pair, kind) in played.pairs.iter_mut().zip(types) {
            log += pair.filtered(false)[*kind as usize].ln();
            pair.hypotheses.retain(|hypothesis| hypothesis.fit.kind == *kind);
        }
        let mut logs = Vec::with_capacity(windows.len());
        for (k, window) in windows.iter().enumerate() {
            let map = played.physics_as(types, learnt);
            let Some((looked, places)) = played.look_at(model, window, &map) else { break };
            for (pair, told) in played.pairs.iter().zip(&looked.told) {
                if let Some(judged) = &told.judged {
                    log += self.settings.tempering * pair.log_density(&judged.evidence);
                }
            }
            log += self.settings.tempering * places;
            logs.push(log);
            if least.get(k).is_some_and(|least| log < *least) {
                break;
            }
            weigh(&mut played.pairs, &looked.told, self.settings.tempering);
            played.learn(window, &looked);
        }
        logs
    }
}

/// Types of all pairs that were played, and how likely these were, as logarithms. The first is the
/// filter's.
struct Played(Vec<(Vec<JointType>, f64)>);

impl Played {
    /// The likeliest; of equals, the first.
    fn best(&self) -> Option<&(Vec<JointType>, f64)> {
        self.0.iter().rev().max_by(|one, other| one.1.total_cmp(&other.1))
    }

    /// Of every pair, how likely the best is in which the pair is joined so, by type; where none was played,
    /// what the filter thought of it before, which is in `marginals`.
    fn found(&self, marginals: &[[f64; 4]]) -> Vec<Together> {
        let Some((best, most)) = self.best() else { return Vec::new() };
        let of = |(p, before): (usize, &[f64; 4])| {
            let share = |kind: JointType| before[kind as usize].max(1e-6);
            let against = |kind: JointType| {
                let scores = self.0.iter().filter(|(types, _)| types[p] == kind);
                let score = scores.map(|(_, score)| *score).reduce(f64::max);
                score.map_or((share(kind) / share(best[p])).ln(), |score| score - most)
            };
            Together { best: JointType::ALL.map(against), before: *before }
        };
        marginals.iter().enumerate().map(of).collect()
    }
}

impl PairBelief {
    /// Logarithm of the density of a window under all hypotheses, where it is `evidence` under each.
    fn log_density(&self, evidence: &[f64]) -> f64 {
        let logs = || self.hypotheses.iter().map(|hypothesis| hypothesis.log);
        let both = logs().zip(evidence).map(|(log, evidence)| log + evidence);
        log_sum(both) - log_sum(logs())
    }
}

/// Whether a heading of something that was seen was not.
pub(super) fn has_unseen_headings(window: &[Observation]) -> bool {
    window.iter().any(|now| now.seen.iter().flatten().any(|sight| sight.heading.is_none()))
}

/// Whether the tool is lifted after an observation.
pub(super) fn is_lifted(seen: &Observation) -> bool {
    seen.strokes.last().is_some_and(|stroke| stroke.settle)
}

#[cfg(test)]
mod tests;
