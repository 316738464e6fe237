//! Objects that the single steps of a plan move.

use serde::Serialize;

use crate::geometry::wrap_angle;
use crate::scene::State;
use crate::task::Task;

use super::Trajectory;

/// Smallest displacement of a moved object, metres.
const MOVED: f64 = 5e-3;

/// Smallest rotation of a moved object, radians.
const TURNED: f64 = 0.1;

/// Object that a step moves by more than 5 mm or 0.1 rad.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MovedObject {
    /// Name of the object; parts of a compound object count as the whole.
    pub object: String,
    /// Displacement of the centre during the step, metres.
    pub moved: f64,
    /// Rotation during the step, radians, at most half a turn.
    pub turned: f64,
}

/// Effect of one step of a plan on objects.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct StepMoves {
    /// Object that the step is for: of the moved goal objects the one whose error decreases most,
    /// otherwise the object moved farthest. `None` if the step moves no object.
    pub object: Option<MovedObject>,
    /// Other moved objects, farthest first.
    pub also: Vec<MovedObject>,
}

/// Returns the effect of each of `steps` steps on the objects of `task`. The result is empty if
/// the trajectory does not contain the end of every step, as with
/// [`Record::Outcome`](super::Record::Outcome).
pub fn step_moves(task: &Task, steps: usize, trajectory: &Trajectory) -> Vec<StepMoves> {
    let mut before = task.scene.start();
    let mut found = Vec::new();
    for step in 0..steps {
        let Some(last) = trajectory.frames.iter().rfind(|frame| frame.stroke == step) else {
            return Vec::new();
        };
        found.push(between(task, &before, &last.state));
        before = last.state.clone();
    }
    found
}

/// Returns the effect of a step from state `before` to state `after`.
fn between(task: &Task, before: &State, after: &State) -> StepMoves {
    let mut moved: Vec<(usize, MovedObject)> = Vec::new();
    for (k, object) in task.scene.things() {
        let (Some(from), Some(to)) = (before.poses.get(k), after.poses.get(k)) else { continue };
        let distance = (to.position - from.position).norm();
        let turned = wrap_angle(to.heading - from.heading).abs();
        if distance > MOVED || turned > TURNED {
            let name = object.name.clone();
            moved.push((k, MovedObject { object: name, moved: distance, turned }));
        }
    }
    moved.sort_by(|(_, a), (_, b)| b.moved.total_cmp(&a.moved));
    let gain = |k: usize| {
        let goals = task
            .goals
            .iter()
            .filter(|goal| goal.movers().iter().any(|mover| task.scene.thing(*mover) == k));
        goals.map(|goal| goal.error(before) - goal.error(after)).reduce(f64::max)
    };
    // The first of equal gains is the object moved farthest.
    let mut own: Option<(usize, f64)> = None;
    for (index, (k, _)) in moved.iter().enumerate() {
        if let Some(gain) = gain(*k)
            && own.is_none_or(|(_, best)| gain > best)
        {
            own = Some((index, gain));
        }
    }
    let mut moved: Vec<MovedObject> = moved.into_iter().map(|(_, one)| one).collect();
    let own = own.map_or(0, |(index, _)| index);
    let object = (own < moved.len()).then(|| moved.remove(own));
    StepMoves { object, also: moved }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose;
    use crate::outcome::Frame;
    use crate::scene::ModelKind;

    const TASK: &str = "
scene:
  objects:
    - {name: a, shape: {cylinder: {radius: 0.02, height: 0.1}}, mass: 1, friction: 0.4,
       position: [0.4, 0.1]}
    - {name: b, shape: {cylinder: {radius: 0.02, height: 0.1}}, mass: 1, friction: 0.4,
       position: [0.5, 0.1]}
    - {name: c, shape: {cylinder: {radius: 0.02, height: 0.1}}, mass: 1, friction: 0.4,
       position: [0.6, 0.1]}
robot: {reach: {min: 0.1, max: 0.9}}
tools: all
goal:
  - {object: a, position: [0.4, 0.2], tolerance: 0.02}
  - {object: b, position: [0.5, 0.3], tolerance: 0.02}
";

    /// Returns the state of `task` with its objects moved along y.
    fn state(task: &Task, shifts: [f64; 3]) -> State {
        let mut state = task.scene.start();
        state.poses.iter_mut().zip(shifts).for_each(|(pose, shift)| pose.position.y += shift);
        state
    }

    #[test]
    fn a_step_is_for_the_goal_object_that_it_brings_nearer() {
        let task = Task::parse(TASK, "task.yaml").unwrap();
        let frame = |stroke, shifts| Frame {
            time: stroke as f64,
            stroke,
            tool: Pose::default(),
            state: state(&task, shifts),
            blade: None,
        };
        let frames = vec![
            frame(0, [0.1, -0.15, 0.0]),
            frame(1, [0.1, 0.2, 0.03]),
            frame(2, [0.1, 0.2, 0.1]),
        ];
        let trajectory = Trajectory { frames, ..Trajectory::new(ModelKind::PLANAR.into()) };
        let names = |moves: &StepMoves| {
            let also = moves.also.iter().map(|one| one.object.clone());
            let object = moves.object.iter().map(|one| one.object.clone());
            object.chain(also).collect::<Vec<String>>().join(" ")
        };
        let moves = step_moves(&task, 3, &trajectory);
        assert_eq!(moves.iter().map(names).collect::<Vec<_>>(), ["a b", "b c", "c"]);
        assert!((moves[1].also[0].moved - 0.03).abs() < 1e-12);
        // Without the end of every step nothing is claimed.
        assert!(step_moves(&task, 4, &trajectory).is_empty());
    }
}
