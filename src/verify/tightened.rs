//! Worst geometry of a squeeze: the obstacles that an object is pressed against stand nearer, are
//! turned against the push, and are rougher.

use crate::geometry::{Footprint, Pose, clearance, contact_points, perpendicular};
use crate::outcome::{Contact, Evidence, Trajectory};
use crate::scene::{Body, Obstacle, Scene};

use super::perturbation::{FRICTION, SHIFT, TURN};

/// Largest gap of an object and an obstacle in contact, metres.
const NEAR: f64 = 0.01;

/// Returns the scene with the obstacles changed against which the tool presses objects in these
/// nominal replays; `None` if there are none.
pub(super) fn tightened(scene: &Scene, nominal: &[Evidence]) -> Option<Scene> {
    let mut tight = scene.clone();
    let mut changed = vec![false; scene.obstacles.len()];
    for trajectory in nominal.iter().filter_map(|evidence| evidence.trajectory.as_ref()) {
        for contact in &trajectory.contacts {
            if let Body::Obstacle(k) = contact.with
                && changed.get(k) == Some(&false)
                && let Some(pose) = nearer(scene, &scene.obstacles[k], trajectory, contact)
            {
                let obstacle = &mut tight.obstacles[k];
                obstacle.friction *= 1.0 + FRICTION;
                obstacle.pose = pose;
                changed[k] = true;
            }
        }
    }
    changed.contains(&true).then_some(tight)
}

/// Returns the pose of an obstacle that is shifted towards the touching object and turned about the
/// contact against the push. The turn is left out if the obstacle would then stand in an object,
/// and so is the shift. Returns `None` if the tool does not move the object against the obstacle.
fn nearer(
    scene: &Scene,
    obstacle: &Obstacle,
    trajectory: &Trajectory,
    contact: &Contact,
) -> Option<Pose> {
    let frame = trajectory.frames.get(contact.frame)?;
    let before = trajectory.frames.get(contact.frame.checked_sub(1)?)?;
    let along = frame.tool.position - before.tool.position;
    let own = scene.objects.get(contact.object)?.shape.footprint();
    let footprint = obstacle.shape().footprint();
    let own = (&own, &frame.state.poses[contact.object]);
    let point = contact_points(own, (&footprint, &obstacle.pose), NEAR).0[0]?;
    if point.normal.dot(&along) >= 0.0 {
        return None;
    }
    let turn = -TURN * perpendicular(point.normal).dot(&along).signum();
    let moved = |shift: f64, turn: f64| {
        let about = Pose { position: point.on_second + shift * point.normal, heading: turn };
        let arm = Pose { position: obstacle.pose.position - point.on_second, ..obstacle.pose };
        about * arm
    };
    let choices = [moved(SHIFT, turn), moved(SHIFT, 0.0)];
    let free = choices.into_iter().find(|pose| stands_free(scene, obstacle, &footprint, pose));
    Some(free.unwrap_or(obstacle.pose))
}

/// Returns `true` if the obstacle at `pose` stands in no object that it stood apart from.
fn stands_free(scene: &Scene, obstacle: &Obstacle, footprint: &Footprint, pose: &Pose) -> bool {
    scene.objects.iter().all(|object| {
        let own = object.shape.footprint();
        let gap = |pose: &Pose| clearance((&own, &object.pose), (footprint, pose), NEAR);
        gap(pose) > 0.0 || gap(&obstacle.pose) == 0.0 && pose == &obstacle.pose
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;
    use crate::outcome::Frame;
    use crate::scene::{ModelKind, Object};

    /// Returns the pose of a wall behind a can after the tool pushed the can against it in this
    /// direction.
    fn wall(direction: Vector) -> Option<Pose> {
        let can = Object::cylinder("can", 0.04, 0.1).at(0.0, 0.0, 0.0);
        let wall = Obstacle::cuboid("wall", [0.02, 0.2, 0.1]).at(0.1, 0.0, 0.0);
        let scene = Scene::new([can]).with_obstacle(wall);
        let by = ModelKind::Still.into();
        let mut trajectory = Trajectory::standing(by, Pose::default(), scene.start());
        let mut end: Frame = trajectory.frames[0].clone();
        end.tool.position += direction;
        end.state.poses[0].position = Vector::new(0.05, 0.01);
        trajectory.frames.push(end);
        let contact = Contact { frame: 1, object: 0, with: Body::Obstacle(0) };
        nearer(&scene, &scene.obstacles[0], &trajectory, &contact)
    }

    #[test]
    fn a_wall_comes_nearer_and_turns_against_the_push() {
        let pose = wall(Vector::new(0.01, 0.01)).expect("towards the wall");
        let face = |y: f64| pose.point(Vector::new(-0.01, y)).x;
        // At the contact the face is nearer by 1 mm, and farther along the push it is nearer still.
        assert!((face(0.01) - (0.09 - SHIFT)).abs() < 1e-4, "{}", face(0.01));
        assert!(face(0.1) < face(-0.1) - 0.2 * TURN * 0.9);
        assert_eq!(wall(Vector::new(-0.01, 0.0)), None);
    }
}
