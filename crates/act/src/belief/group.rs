//! Joint inference over a group of objects.
//!
//! The filter judges each pair given its current estimate of the others. A wrong joint misleads its
//! neighbours, above all where headings are not observed, and their evidence is never revised.
//!
//! After every push, whole assignments of joints to pairs are therefore replayed from the start of
//! the push. They are compared by the likelihood of the observations. The search is coordinate
//! ascent, one pair at a time (iterated conditional modes, Besag 1986,
//! doi:10.1111/j.2517-6161.1986.tb01412.x). The filter then processes the push again under the best
//! assignment. This also happens a few times during a push because a robot acts on the predictions.
//!
//! Anchors and axes are estimated from the whole push. Without observed headings they depend on the
//! assignment, so each assignment is replayed with its own estimate.

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
    regulator_features::Together,
};

/// Maximum number of windows that are replayed.
const LONGEST: usize = 10;

/// Numbers of windows after which joints are inferred during a push; the windows are replayed again
/// later.
///
/// Inference after each of six windows predicts the rest no better, and an update takes a third
/// longer.
const EARLIER: [usize; 3] = [2, 4, 6];

/// Maximum number of sweeps over all pairs; the search stops earlier if nothing changes.
const SWEEPS: usize = 2;

/// Minimum filter probability of a type that is tried.
const LEAST: f64 = 0.01;

/// Maximum number of replayed assignments, whose cost equals about the cost of the filter.
const PLAYS: usize = 64;

/// Log-likelihood deficit to the best assignment after any window at which a replay is abandoned.
///
/// This saves a quarter of the time. After 10 and 20 observations of 20 dense trajectories,
/// predictions of the rest change by at most 0.1 mm.
const HOPELESS: f64 = 10.0;

/// Score of an abandoned assignment.
const GIVEN_UP: f64 = -1e6;

/// Push so far, kept for replays.
#[derive(Clone, Debug)]
pub(super) struct Push {
    /// Belief before the push, without its history.
    before: Box<Belief>,
    windows: Vec<Vec<Observation>>,
}

impl Belief {
    /// Stores a window, and the belief before the push.
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

    /// Infers all joints jointly and applies the result.
    ///
    /// This happens at the end of a push, after many windows, and a few times before.
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
        // A replay with its own joint limits contains no evidence about them.
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

    /// Returns the filter's probabilities of [`JointType::ALL`] for every pair.
    fn filtered_shares(&self) -> Vec<[f64; 4]> {
        let map = self.filtered_map();
        self.pairs.iter().map(|pair| pair.filtered(follows(&map, pair))).collect()
    }

    /// Searches for the most probable types of all pairs and returns all replayed assignments.
    ///
    /// The search starts from the filter's types; `marginals` are its probabilities. Joints have
    /// the geometry `learnt`, if given.
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
        let mut order = self.informative(windows.len());
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

    /// Returns the pairs for which the last `windows` were informative. The other objects did not
    /// move, so their joints have no effect.
    fn informative(&self, windows: usize) -> Vec<usize> {
        let informative = |p: &usize| {
            let mut steps = self.history.iter().rev().take(windows);
            steps.any(|step| step.evidence[*p].is_some())
        };
        (0..self.pairs.len()).filter(informative).collect()
    }

    /// Returns `types` with one pair changed to `kind`. If this closes a loop, each other joint is
    /// removed in turn.
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

    /// Returns the current physics of `types`, with the joint geometry `learnt`, if given.
    fn physics_as(&self, types: &[JointType], learnt: Option<&[PairBelief]>) -> Physics {
        let Some(learnt) = learnt else { return self.physics_of(types) };
        self.with_known(of_types(&self.scene, learnt, &self.track.state, types))
    }

    fn is_forest(&self, types: &[JointType]) -> bool {
        let mut sets = DisjointSets::new(self.scene.objects.len());
        let mut joined = self.pairs.iter().zip(types);
        joined.all(|(pair, kind)| *kind == JointType::None || sets.join(pair.between))
    }

    /// Returns the cumulative log-likelihood of `types` and the observations after each window.
    ///
    /// A common constant is omitted. Evidence is tempered as in the filter. The replay stops early
    /// if the log-likelihood falls below `least`.
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
            let Some((window_evidence, places)) = played.look_at(model, window, &map) else {
                break;
            };
            for (pair, pair_evidence) in played.pairs.iter().zip(&window_evidence.pairs) {
                if let Some(judged) = &pair_evidence.judged {
                    log += self.settings.tempering * pair.log_density(&judged.evidence);
                }
            }
            log += self.settings.tempering * places;
            logs.push(log);
            if least.get(k).is_some_and(|least| log < *least) {
                break;
            }
            weigh(&mut played.pairs, &window_evidence.pairs, self.settings.tempering);
            played.learn(window, &window_evidence);
        }
        logs
    }
}

/// Replayed assignments with their log-likelihoods. The filter's assignment is first.
struct Played(Vec<(Vec<JointType>, f64)>);

impl Played {
    /// Returns the most probable assignment; of equal ones, the first.
    fn best(&self) -> Option<&(Vec<JointType>, f64)> {
        self.0.iter().rev().max_by(|one, other| one.1.total_cmp(&other.1))
    }

    /// Returns for every pair the log-likelihood of the best assignment with each type. Types that
    /// were not replayed use the filter's `marginals`.
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
    /// Returns the log-density of a window averaged over the hypotheses, given their `evidence`.
    fn log_density(&self, evidence: &[f64]) -> f64 {
        let logs = || self.hypotheses.iter().map(|hypothesis| hypothesis.log);
        let both = logs().zip(evidence).map(|(log, evidence)| log + evidence);
        log_sum(both) - log_sum(logs())
    }
}

/// Returns `true` if an observed object lacks a heading.
pub(super) fn has_unseen_headings(window: &[Observation]) -> bool {
    window.iter().any(|now| now.seen.iter().flatten().any(|sight| sight.heading.is_none()))
}

/// Returns `true` if the tool is lifted after the observation.
pub(super) fn is_lifted(seen: &Observation) -> bool {
    seen.strokes.last().is_some_and(|stroke| stroke.settle)
}

#[cfg(test)]
mod tests;
