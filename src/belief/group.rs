//! Joints of a group of objects, inferred together.
//!
//! The filter judges each pair beside what it takes the others for at that moment. One wrong joint
//! misleads its neighbours, above all where headings are not seen and follow from the joints around them,
//! and what they said then is never taken back. Hence after every push whole assignments of joints to
//! pairs are played again from where the push began, and compared by how likely what was seen is under
//! them: coordinate ascent on the likeliest joints, a pair at a time (iterated conditional modes, Besag
//! 1986, doi:10.1111/j.2517-6161.1986.tb01412.x). Under the best of them the filter follows the push once
//! more.
//!
//! Joints are placed where the whole push showed their anchors and axes to be. Where headings are not
//! seen, that depends on the assignment, so each is played with anchors and axes of its own.

use crate::{
    effect::EffectModel,
    scene::{DisjointSets, Observation, Physics},
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

/// Times that every pair is asked, unless nothing changes before.
const SWEEPS: usize = 2;

/// What is less likely by the filter is not tried.
const LEAST: f64 = 0.01;

/// Most assignments that are played, which takes about as long as the filter did.
const PLAYS: usize = 64;

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

    /// At the end of a push, and after many windows, has all joints inferred together and takes what
    /// follows from them.
    pub(super) fn look_together(&mut self, model: &dyn EffectModel) {
        let windows = self.push.as_ref().map_or(&[][..], |push| &push.windows);
        if windows.len() < LONGEST && !windows.iter().flatten().last().is_some_and(is_lifted) {
            return;
        }
        let Some(Push { before, windows }) = self.push.take() else { return };
        let seen = !windows.iter().any(|window| has_unseen_headings(window));
        let learnt = seen.then_some(&self.pairs[..]);
        let (types, together) = self.assign(model, &before, &windows, learnt);
        let mut again = *before;
        if let (Some(again), Some(first)) = (&mut again.regulation, &self.regulation) {
            again.keep(first);
        }
        again.together = Some(together);
        for window in &windows {
            let physics = again.physics_as(&types, learnt);
            again.take(model, window, Some(physics));
        }
        again.together = None;
        again.history = std::mem::take(&mut self.history);
        *self = again;
        let probabilities = self.probabilities();
        if let Some(step) = self.history.last_mut() {
            step.probabilities = probabilities;
        }
    }

    /// The likeliest types of all pairs together, searched for from the filter's, their joints where
    /// they are `learnt` to be; and what was found of every pair on the way.
    fn assign(
        &self,
        model: &dyn EffectModel,
        before: &Belief,
        windows: &[Vec<Observation>],
        learnt: Option<&[PairBelief]>,
    ) -> (Vec<JointType>, Vec<Together>) {
        let map = self.filtered_map();
        let marginals: Vec<[f64; 4]> =
            self.pairs.iter().map(|pair| pair.filtered(follows(&map, pair))).collect();
        let mut best: Vec<JointType> =
            self.pairs.iter().map(|pair| JointType::of(joint_of(&map, pair.between))).collect();
        let mut most = before.play(model, &best, windows, learnt);
        let mut played = Played::new(&best, most);
        let mut plays = 1;
        let mut order: Vec<usize> = (0..best.len()).collect();
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
                    if plays == PLAYS {
                        break 'search;
                    }
                    plays += 1;
                    let score = before.play(model, &option, windows, learnt);
                    played.take(&option, score);
                    if score > most {
                        (most, best) = (score, option);
                    }
                }
            }
            if best == before_sweep {
                break;
            }
        }
        let together = played.found(&best, most, &marginals);
        (best, together)
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

    /// How likely `types` are, and what was seen in these windows where they are true, as a logarithm
    /// up to what is the same for all of them. As much of the evidence counts as in the filter.
    fn play(
        &self,
        model: &dyn EffectModel,
        types: &[JointType],
        windows: &[Vec<Observation>],
        learnt: Option<&[PairBelief]>,
    ) -> f64 {
        let mut played = self.clone();
        let mut log = 0.0;
        for (pair, kind) in played.pairs.iter_mut().zip(types) {
            log += pair.filtered(false)[*kind as usize].ln();
            pair.hypotheses.retain(|hypothesis| hypothesis.fit.kind == *kind);
        }
        for window in windows {
            let map = played.physics_as(types, learnt);
            let Some((looked, places)) = played.look_at(model, window, &map) else { break };
            for (pair, told) in played.pairs.iter().zip(&looked.told) {
                if let Some(judged) = &told.judged {
                    log += self.settings.tempering * pair.log_density(&judged.evidence);
                }
            }
            log += self.settings.tempering * places;
            weigh(&mut played.pairs, &looked.told, self.settings.tempering);
            played.learn(window, &looked);
        }
        log
    }
}

/// Of every pair, by type, the best score of assignments in which it is joined so.
struct Played(Vec<[f64; 4]>);

impl Played {
    fn new(types: &[JointType], score: f64) -> Self {
        let mut played = Self(vec![[f64::NEG_INFINITY; 4]; types.len()]);
        played.take(types, score);
        played
    }

    fn take(&mut self, types: &[JointType], score: f64) {
        for (scores, kind) in self.0.iter_mut().zip(types) {
            let best = &mut scores[*kind as usize];
            *best = best.max(score);
        }
    }

    /// What was found beside the `best` assignment, whose score is `most`; where a type was not played,
    /// what the filter thought of it.
    fn found(&self, best: &[JointType], most: f64, marginals: &[[f64; 4]]) -> Vec<Together> {
        let of = |((scores, kind), before): ((&[f64; 4], &JointType), &[f64; 4])| {
            let share = |k: usize| before[k].max(1e-6);
            let against = |k: usize| match scores[k] == f64::NEG_INFINITY {
                true => (share(k) / share(*kind as usize)).ln(),
                false => scores[k] - most,
            };
            Together { best: [0, 1, 2, 3].map(against), before: *before }
        };
        self.0.iter().zip(best).zip(marginals).map(of).collect()
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
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::{
        belief::BeliefSettings,
        geometry::{Pose, Shape},
        scene::{Noise, Object, Part, Scene, Tool},
    };

    #[test]
    fn a_joint_that_closes_a_loop_makes_each_other_one_in_it_give_way() {
        use JointType::{Fixed, None, Revolute};
        let can = |name: &str, x, y| Object::cylinder(name, 0.05, 0.1).at(x, y, 0.0);
        let scene = Scene::new([
            can("a", 0.0, 0.0),
            can("b", 0.11, 0.0),
            can("c", 0.055, 0.095),
            can("d", 0.22, 0.0),
        ]);
        let finger = Shape::Cylinder { radius: 0.01, height: 0.05 };
        let tool = Tool::new("finger", [Part::new("finger", finger, Pose::default())]);
        let settings = BeliefSettings::new(Noise { position: 0.0, heading: 0.0 });
        let belief = Belief::new(&scene, Arc::new(tool.expect("one piece")), 0.0, settings);
        assert_eq!(belief.pairs().collect::<Vec<_>>(), [[0, 1], [0, 2], [1, 2], [1, 3]]);
        let types = [Fixed, Revolute, None, Fixed];
        assert_eq!(
            belief.changed(&types, 2, Fixed),
            [[None, Revolute, Fixed, Fixed], [Fixed, None, Fixed, Fixed]]
        );
        assert_eq!(belief.changed(&types, 3, None), [[Fixed, Revolute, None, None]]);
        assert_eq!(belief.changed(&types, 1, Fixed), [[Fixed, Fixed, None, Fixed]]);
    }
}
