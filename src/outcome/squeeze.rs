//! Squeezes: pushes that need far more force than friction explains.
//!
//! A tool that presses an object against something fixed exerts any force. Whether the object still
//! slides out depends on contacts that models and engines resolve differently.

use crate::geometry::Pose;
use crate::scene::{Body, GRAVITY, Scene};

use super::{Trajectory, Warning};

/// Ratio of the lasting force to the friction of all moved objects above which an object is
/// squeezed. In replays of 150 random plans the ratio was at most 2.1 without obstacles; with an
/// obstacle it was up to 33, and above 4 for 8 of 50 plans.
const EXCESS: f64 = 4.0;

/// Smallest friction that counts, newtons: impacts of light objects exceed their friction.
const LEAST: f64 = 0.5;

/// Displacement from which an object counts as moved, metres.
const MOVED: f64 = 1e-3;

/// Rotation from which an object counts as moved, radians.
const TURNED: f64 = 0.02;

/// Returns a warning if the lasting force of a recorded push far exceeds the friction of all
/// objects that it moves. Lever-ups, which lift objects, are not judged.
pub fn squeeze(scene: &Scene, trajectory: &Trajectory) -> Option<Warning> {
    let start = &trajectory.frames.first()?.state;
    let needed = trajectory.force?.lasting;
    if !trajectory.lifts.is_empty() || start.space.is_some() {
        return None;
    }
    let moves = |k: usize| {
        let from = start.poses[k];
        trajectory.frames.iter().any(|frame| has_moved(&from, &frame.state.poses[k]))
    };
    let moved: Vec<usize> = scene.things().map(|(k, _)| k).filter(|&k| moves(k)).collect();
    let load = |&k: &usize| scene.support_friction(k) * scene.mass(k) * GRAVITY;
    let friction: f64 = moved.iter().map(load).sum();
    if needed <= EXCESS * friction.max(LEAST) {
        return None;
    }
    let against = trajectory.contacts.iter().find_map(|contact| match contact.with {
        Body::Obstacle(k) if moved.contains(&scene.thing(contact.object)) => scene.obstacles.get(k),
        _ => None,
    });
    let against = against.map(|obstacle| obstacle.name.clone());
    Some(Warning::Squeezed { against, needed, friction })
}

fn has_moved(from: &Pose, to: &Pose) -> bool {
    (to.position - from.position).norm() > MOVED || (to.heading - from.heading).abs() > TURNED
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outcome::{Contact, Force};
    use crate::scene::{ModelKind, Object, Obstacle};

    /// Returns the warning after a can that needs 1.8 N is moved by `travel` metres under this
    /// lasting force, beside a wall.
    fn pushed(travel: f64, lasting: f64) -> Option<Warning> {
        let can = Object::cylinder("can", 0.04, 0.1).mass(0.4);
        let wall = Obstacle::cuboid("wall", [0.02, 0.2, 0.1]).at(0.2, 0.0, 0.0);
        let scene = Scene::new([can]).with_obstacle(wall);
        let by = ModelKind::Still.into();
        let mut trajectory = Trajectory::standing(by, Pose::default(), scene.start());
        let mut end = trajectory.frames[0].clone();
        end.state.poses[0].position.x += travel;
        trajectory.frames.push(end);
        trajectory.contacts.push(Contact { frame: 1, object: 0, with: Body::Obstacle(0) });
        trajectory.force = Some(Force { peak: 2.0 * lasting, lasting });
        squeeze(&scene, &trajectory)
    }

    #[test]
    fn only_a_force_far_above_friction_is_a_squeeze() {
        assert_eq!(pushed(0.1, 4.0), None);
        let Some(Warning::Squeezed { against, needed, friction }) = pushed(0.1, 20.0) else {
            panic!("eleven times the friction")
        };
        assert_eq!((against.as_deref(), needed), (Some("wall"), 20.0));
        assert!((friction - 0.45 * 0.4 * GRAVITY).abs() < 1e-9, "{friction}");
        // Friction explains no force if nothing moves.
        assert!(pushed(0.0, 4.0).is_some());
    }
}
