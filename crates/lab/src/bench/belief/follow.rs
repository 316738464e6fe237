//! A trajectory followed by all methods.

use std::sync::Arc;
use std::time::Duration;

use pushplan::internals::effect::EffectModel;
use pushplan::internals::geometry::{Pose, Vector};
use pushplan::internals::recording::Recording;
use pushplan::internals::{
    outcome::Record,
    scene::{Joint, JointKind, Physics, Scene, Situation, Span, near_pairs},
    task::{Job, Noise, Observation, ToolMotion},
};
use pushplan_act::belief::{Belief, BeliefRegulator, BeliefSettings, JointType};
use pushplan_act::judge::mean;
use pushplan_learn::dataset::true_type;

use super::super::cpu_clock::processor_time;
use super::record::{BeliefRecord, Checkpoint, JointMethod, Rest, When};
use super::residual::residual_types;

/// Times at which beliefs are evaluated in addition to the end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// After some observations of a single stroke, and after each of several strokes.
    OnTheWay,
    /// A number of observations after the first motion.
    AfterContact,
}

/// Numbers of observations of a single stroke after which beliefs are evaluated.
const OBSERVATIONS: [usize; 5] = [5, 10, 15, 20, 30];

/// Numbers of observations after the first one with motion, as in the real world in Tekden (2020,
/// section 7.4.3).
const CONTACT: [usize; 5] = [0, 1, 3, 5, 10];

/// Displacement above which an object counts as touched, metres, if it exceeds the noise.
const CONTACT_MOTION: f64 = 1e-3;

/// Displacement below which objects count as unmoved, metres.
const MOVED: f64 = 0.01;

/// Minimum joint motion for errors of an anchor and an axis: radians and metres.
const PLAY: [f64; 2] = [15.0 / 180.0 * std::f64::consts::PI, 0.02];

/// A trajectory and the observations that beliefs are computed from.
struct Followed<'a> {
    recording: &'a Recording,
    /// Scene as observed at the start.
    seen: &'a Scene,
    observations: &'a [Observation],
    pairs: Vec<[usize; 2]>,
    noise: Noise,
    model: &'a dyn EffectModel,
}

/// Follows a recording, observed with some noise, with the filter and with the `regulator`, if any.
/// Predicts the remaining motion if `rest` is set. Also returns the time that this thread
/// spent on the updates of each belief.
pub fn follow(
    recording: &Recording,
    (seen, observations, noise): (&Scene, &[Observation], Noise),
    (model, regulator, rest): (&dyn EffectModel, Option<&BeliefRegulator>, bool),
    asked: Asked,
    case: usize,
) -> (BeliefRecord, Vec<(JointMethod, Duration)>) {
    let settings = BeliefSettings::new(noise);
    let filter = Belief::new(seen, recording.tool.clone(), recording.lift, settings);
    // True near pairs, whatever the noise: a pair that a belief does not consider counts as not
    // joined.
    let near = near_pairs(&recording.scene).into_iter();
    let pairs = near.map(|(between, _)| between).collect();
    let of = Followed { recording, seen, observations, pairs, noise, model };
    let regulated = regulator.map(|regulator| filter.clone().regulated(regulator.clone()));
    let mut beliefs = vec![(JointMethod::Filter, filter)];
    beliefs.extend(regulated.map(|belief| (JointMethod::Regulator, belief)));
    let mut spent: Vec<(JointMethod, Duration)> =
        beliefs.iter().map(|(method, _)| (*method, Duration::ZERO)).collect();
    let several = observations.iter().filter(|one| lifted(one)).count() > 1;
    let contact = (1..=observations.len()).find(|count| of.contact(*count));
    let mut checkpoints = Vec::new();
    let mut strokes = 0;
    for (k, observation) in observations.iter().enumerate() {
        for ((_, belief), (_, spent)) in beliefs.iter_mut().zip(&mut spent) {
            let seen = observation.clone();
            *spent += processor_time(|| belief.update(model, seen));
        }
        strokes += usize::from(lifted(observation));
        let when = match asked {
            _ if k + 1 == observations.len() => Some(When::End),
            Asked::AfterContact => contact
                .and_then(|contact| (k + 1).checked_sub(contact))
                .filter(|since| CONTACT.contains(since))
                .map(When::AfterContact),
            Asked::OnTheWay if several => lifted(observation).then_some(When::Strokes(strokes)),
            Asked::OnTheWay => OBSERVATIONS.contains(&(k + 1)).then_some(When::Observations(k + 1)),
        };
        if let Some(when) = when {
            for (_, belief) in &mut beliefs {
                belief.settle(model);
            }
            checkpoints.push(of.checkpoint(k + 1, when, &beliefs, rest && when != When::End));
        }
    }
    let best = beliefs.last().map(|(_, belief)| belief);
    let (anchors, axes) = best.map_or_else(Default::default, |belief| of.places(belief));
    let record = BeliefRecord {
        case,
        observations: observations.len(),
        objects: seen.objects.len(),
        types: of.pairs.iter().map(|pair| true_type(&recording.scene, *pair)).collect(),
        checkpoints,
        anchors,
        axes,
    };
    (record, spent)
}

fn lifted(observation: &Observation) -> bool {
    observation.strokes.last().is_some_and(|stroke| stroke.settle)
}

impl Followed<'_> {
    fn checkpoint(
        &self,
        count: usize,
        when: When,
        beliefs: &[(JointMethod, Belief)],
        rest: bool,
    ) -> Checkpoint {
        let (_, filter) = &beliefs[0];
        let physics = |method: JointMethod, belief: &Belief, situation: &Situation| match method {
            JointMethod::True => self.true_physics(situation),
            JointMethod::None => situation.physics.without_joints(),
            JointMethod::ContactsFixed => Physics {
                joints: situation.physics.with_contacts_fixed(self.seen).joints,
                ..(*situation.physics).clone()
            },
            JointMethod::Residuals => {
                let seen = &self.observations[..count];
                let pairs: Vec<[usize; 2]> = filter.pairs().collect();
                let types = residual_types(self.seen, &pairs, seen, self.noise);
                filter.physics_of(&types)
            }
            JointMethod::LastWindow => filter.physics_of(&filter.last_types()),
            // The most likely type; predictions may use another one.
            JointMethod::Filter | JointMethod::Regulator => belief.map(),
        };
        let mut types = Vec::new();
        let mut rests = Vec::new();
        for method in JointMethod::ALL {
            let belief = match method {
                JointMethod::Regulator => {
                    beliefs.iter().find(|(by, _)| *by == method).map(|(_, b)| b)
                }
                _ => Some(filter),
            };
            let Some(belief) = belief else { continue };
            let situation = belief.situation();
            let physics = physics(method, belief, &situation);
            if method != JointMethod::True {
                types.push((method, self.types(&physics)));
            }
            if rest {
                let ends = match method {
                    JointMethod::Filter | JointMethod::Regulator => {
                        belief.foresee(self.model, &self.motion_after(count))
                    }
                    _ => self.rest(count, &situation, physics),
                };
                rests.push(Rest { by: method, error: self.error(&ends) });
            }
        }
        let probabilities =
            beliefs.iter().map(|(method, belief)| (*method, self.probabilities(belief)));
        Checkpoint {
            when,
            moved: self.pairs.iter().map(|pair| self.moved(*pair, count)).collect(),
            types,
            probabilities: probabilities.collect(),
            rest: rests,
        }
    }

    fn types(&self, physics: &Physics) -> Vec<JointType> {
        let of = |pair: &[usize; 2]| {
            JointType::of(physics.joints.iter().find(|joint| sorted(joint) == *pair))
        };
        self.pairs.iter().map(of).collect()
    }

    fn probabilities(&self, belief: &Belief) -> Vec<[f64; 4]> {
        let believed: Vec<([usize; 2], [f64; 4])> =
            belief.pairs().zip(belief.probabilities()).collect();
        let of = |pair: &[usize; 2]| {
            let found = believed.iter().find(|(between, _)| between == pair);
            found.map_or([1.0, 0.0, 0.0, 0.0], |(_, probabilities)| *probabilities)
        };
        self.pairs.iter().map(of).collect()
    }

    /// Returns the true poses after `count` observations.
    fn poses(&self, count: usize) -> &[Pose] {
        let replay = self.recording.observed_frames();
        &self.recording.frames[replay[count - 1]].poses
    }

    /// Returns `true` if any object was certainly observed to have moved by observation `count`.
    fn contact(&self, count: usize) -> bool {
        let least = CONTACT_MOTION.max(4.0 * self.noise.position);
        let now = self.observations[count - 1].seen.iter().zip(&self.seen.objects);
        now.flat_map(|(sight, object)| sight.map(|sight| sight.position - object.pose.position))
            .any(|far| far.norm() > least)
    }

    fn moved(&self, pair: [usize; 2], count: usize) -> bool {
        let far = |k: usize, poses: &[Pose]| {
            (poses[k].position - self.recording.scene.objects[k].pose.position).norm() > MOVED
        };
        let last = self.recording.observed_frames()[count - 1];
        let frames = &self.recording.frames[..=last];
        pair.iter().any(|k| frames.iter().any(|frame| far(*k, &frame.poses)))
    }

    /// Returns the true physics at the believed poses.
    fn true_physics(&self, situation: &Situation) -> Physics {
        let scene = &self.recording.scene;
        let carried = |joint: &Joint| {
            let then = joint.between.map(|k| scene.objects[k].pose);
            let now = joint.between.map(|k| situation.start.poses[k]);
            let place = |v: Vector| now[0].point(then[0].local_point(v));
            let kind = match joint.kind {
                JointKind::Fixed => JointKind::Fixed,
                JointKind::Revolute { at, limits } => {
                    let turned = worked(&then, &now).1;
                    JointKind::Revolute { at: place(at), limits: limits.map(|of| left(of, turned)) }
                }
                JointKind::Prismatic { axis, limits } => {
                    let local = then[0].local_vector(axis);
                    let slid = worked(&then, &now).0.dot(&local);
                    let axis = now[0].vector(local);
                    JointKind::Prismatic { axis, limits: limits.map(|of| left(of, slid)) }
                }
            };
            Joint { kind, ..joint.clone() }
        };
        let joints = scene.joints.iter().map(carried).collect();
        Physics { joints, ..(*situation.physics).clone() }
    }

    /// Returns the motion of the tool after `count` observations.
    fn motion_after(&self, count: usize) -> ToolMotion {
        let strokes = self.observations[count..].iter().flat_map(|one| one.strokes.clone());
        ToolMotion {
            tool: Arc::clone(&self.recording.tool),
            lift: self.recording.lift,
            strokes: strokes.collect(),
        }
    }

    /// Predicts the final poses of all objects under some physics.
    fn rest(&self, count: usize, situation: &Situation, physics: Physics) -> Vec<Pose> {
        let motion = self.motion_after(count);
        let job = Job {
            start: situation.start.clone(),
            motion: motion.into(),
            physics: Arc::new(physics),
        };
        let rolled = self.model.rollout(&situation.scene, &[job], Record::Outcome);
        let end = rolled.first().and_then(|trajectory| trajectory.frames.last());
        end.map_or_else(|| situation.start.poses.clone(), |frame| frame.state.poses.clone())
    }

    /// Returns the error of predicted final positions, mean over all objects, metres.
    fn error(&self, predicted: &[Pose]) -> f64 {
        let errors = predicted.iter().zip(self.poses(self.observations.len()));
        mean(&errors.map(|(a, b)| (a.position - b.position).norm()).collect::<Vec<_>>())
    }

    /// Returns the errors of identified anchors and axes whose joints have moved.
    fn places(&self, belief: &Belief) -> (Vec<f64>, Vec<f64>) {
        let situation = belief.situation();
        let truth = self.true_physics(&situation);
        let (start, end) = (&self.recording.scene.objects, self.poses(self.observations.len()));
        let (mut anchors, mut axes) = (Vec::new(), Vec::new());
        for joint in &truth.joints {
            let found = situation.physics.joints.iter().find(|one| one.between == sorted(joint));
            let then = joint.between.map(|k| start[k].pose);
            let (slid, turned) = worked(&then, &joint.between.map(|k| end[k]));
            match (found.map(|joint| joint.kind), joint.kind) {
                (Some(JointKind::Revolute { at: found, .. }), JointKind::Revolute { at, .. })
                    if turned.abs() > PLAY[0] =>
                {
                    anchors.push((found - at).norm())
                }
                (
                    Some(JointKind::Prismatic { axis: found, .. }),
                    JointKind::Prismatic { axis, .. },
                ) if slid.norm() > PLAY[1] => axes.push(found.perp(&axis).abs().min(1.0).asin()),
                _ => {}
            }
        }
        (anchors, axes)
    }
}

fn sorted(joint: &Joint) -> [usize; 2] {
    let [a, b] = joint.between;
    [a.min(b), a.max(b)]
}

/// Returns the motion of the second of two objects in the frame of the first: shift, metres, and
/// rotation, radians.
fn worked(then: &[Pose; 2], now: &[Pose; 2]) -> (Vector, f64) {
    let place = |[first, second]: &[Pose; 2]| first.local_point(second.position);
    let turn = |[first, second]: &[Pose; 2]| second.heading - first.heading;
    (place(now) - place(then), turn(now) - turn(then))
}

/// Returns the remaining play to either side.
fn left(limits: Span, worked: f64) -> Span {
    Span::new((limits.low - worked).min(0.0), (limits.high - worked).max(0.0))
}
