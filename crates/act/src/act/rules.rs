//! Rules for objects in a run: `keep` and `keep_out`, checked on every observation and on every
//! estimate at rest.
//!
//! A violation ends the run. A displacement or an overlap within the error of the observation
//! counts as none, because it cannot be distinguished from an object that has not moved.

use pushplan::outcome::{ObjectRules, Warning};
use pushplan::scene::{ObservedPose, Situation, State};
use pushplan::task::{Noise, Observation};

use crate::belief::Belief;

/// Largest error of an observation in standard deviations: one observation in 25,000 has a larger
/// error, and a run has hundreds.
const SIGHT: f64 = 4.5;

/// Largest error of an estimate at rest in standard deviations; a run has a dozen.
const ESTIMATE: f64 = 3.0;

/// Error of an unobserved heading, radians: any heading is possible.
const UNSEEN: f64 = 1e3;

/// Returns the first rule that the observations of a motion break. The motion began in `before`;
/// objects that were not observed are taken to be still there.
pub(super) fn broken_in(
    before: &Situation,
    noise: Noise,
    observations: &[Observation],
) -> Option<Warning> {
    observations.iter().find_map(|observation| {
        let (mut state, mut errors) = (before.start.clone(), Vec::new());
        for (pose, sight) in state.poses.iter_mut().zip(&observation.seen) {
            errors.push(blurred(SIGHT, noise, [noise.position, noise.heading]));
            let Some(ObservedPose { position, heading }) = *sight else { continue };
            pose.position = position;
            match (heading, errors.last_mut()) {
                (Some(heading), _) => pose.heading = heading,
                (None, Some(error)) => error[1] = UNSEEN,
                (None, None) => {}
            }
        }
        ObjectRules::of(&before.scene).observed(errors).first_broken([&state])
    })
}

/// Returns the first rule that the estimated state at rest breaks.
pub(super) fn broken_at_rest(belief: &Belief, noise: Noise) -> Option<Warning> {
    let Situation { scene, start, .. } = belief.situation();
    let errors = belief.doubt().into_iter().map(|doubt| blurred(ESTIMATE, noise, doubt));
    let state: &State = &start;
    ObjectRules::of(&scene).observed(errors.collect()).first_broken([state])
}

/// Returns the largest error of a displacement since the first observation, metres and radians,
/// for a pose with these standard deviations.
fn blurred(times: f64, first: Noise, [position, heading]: [f64; 2]) -> [f64; 2] {
    [times * position.hypot(first.position), times * heading.hypot(first.heading)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use pushplan::geometry::{Pose, Vector};
    use pushplan::scene::{Object, Scene};

    #[test]
    fn one_observation_of_a_kept_object_far_away_is_enough_and_noise_is_not() {
        let vase = Object { keep: Some(0.005), ..Object::cylinder("vase", 0.03, 0.1) };
        let before = Situation::stated(&Scene::new([vase]));
        let noise = Noise { position: 1e-3, heading: 0.01 };
        let seen = |x: f64, heading| Observation {
            strokes: Vec::new(),
            seen: vec![Some(ObservedPose { position: Vector::new(x, 0.0), heading })],
        };
        let broken = |all: &[Observation]| broken_in(&before, noise, all);
        // The vase is pushed 5 cm away and back.
        let there_and_back = [seen(0.0, Some(0.0)), seen(0.05, None), seen(0.001, Some(0.0))];
        assert!(matches!(broken(&there_and_back), Some(Warning::NotKept { .. })));
        assert_eq!(broken(&[seen(0.004, Some(0.3)), seen(-0.006, None)]), None);
        let unseen = Observation { strokes: Vec::new(), seen: vec![None] };
        assert_eq!(broken(&[unseen]), None);
    }

    #[test]
    fn a_turn_is_seen_where_headings_are() {
        let bar = Object { keep: Some(0.005), ..Object::cuboid("bar", [0.26, 0.03, 0.07]) };
        let before = Situation::stated(&Scene::new([bar]));
        let noise = Noise { position: 5e-4, heading: 3e-3 };
        let turned = |heading| Observation {
            strokes: Vec::new(),
            seen: vec![Some(ObservedPose { heading, ..ObservedPose::new(&Pose::default(), true) })],
        };
        assert!(broken_in(&before, noise, &[turned(Some(1.5))]).is_some());
        assert_eq!(broken_in(&before, noise, &[turned(None)]), None);
    }
}
