//! Trajectories, packed for the page.

use pushplan::geometry::Pose;
use pushplan::{
    outcome::{Evidence, Frame, Trajectory, Verdict},
    scene::{Engine, ModelKind, Scene},
    task::{Job, Task},
};

use super::data::{End, Layer, Replay, fine, length, point};
use crate::graph::{Graph, GraphRelation};

/// Returns the packed trajectory; `reached` states whether it reaches the goal. Returns `None` if
/// no frame is finite.
pub fn replay(layer: Layer, trajectory: &Trajectory, reached: bool) -> Option<Replay> {
    replay_of(layer, trajectory.by.to_string(), &trajectory.frames, reached)
}

/// Returns the frames that can be shown.
pub fn sound(frames: &[Frame]) -> impl Iterator<Item = &Frame> {
    frames.iter().filter(|frame| frame.state.is_finite() && frame.tool.is_finite())
}

/// Returns packed frames of the source `by`; `reached` states whether they reach the goal. Returns
/// `None` if no frame is finite.
pub fn replay_of(layer: Layer, by: String, frames: &[Frame], reached: bool) -> Option<Replay> {
    let frames: Vec<&Frame> = sound(frames).collect();
    let objects = frames.first()?.state.poses.len();
    let mut strokes = Vec::new();
    for (k, frame) in frames.iter().enumerate() {
        while strokes.len() <= frame.stroke {
            strokes.push(k);
        }
    }
    let column = |value: &dyn Fn(&Frame) -> i64| packed(frames.iter().map(|frame| value(frame)));
    let pose = |of: &dyn Fn(&Frame) -> Pose| {
        vec![
            column(&|frame| length(of(frame).position.x)),
            column(&|frame| length(of(frame).position.y)),
            column(&|frame| fine(of(frame).heading)),
        ]
    };
    Some(Replay {
        layer,
        by,
        reached,
        time: differences(frames.iter().map(|frame| fine(frame.time))),
        strokes,
        tool: pose(&|frame| frame.tool),
        objects: (0..objects).map(|k| pose(&|frame| frame.state.poses[k])).collect(),
        measure: Vec::new(),
        graph: Vec::new(),
    })
}

/// Returns the relations of every frame of the trajectory predicted for `job`, see
/// [`Replay::graph`].
pub fn graph(scene: &Scene, job: &Job, trajectory: &Trajectory) -> Vec<Vec<[usize; 3]>> {
    let relations = |frame: usize| -> Option<Vec<[usize; 3]>> {
        let graph = Graph::at(scene, job, trajectory, frame)?;
        // Relations in both directions are kept once.
        let mut relations: Vec<[usize; 3]> = Vec::new();
        for GraphRelation { receiver, sender, kind, .. } in graph.relations {
            let one = [receiver.min(sender), receiver.max(sender), kind as usize];
            if !relations.contains(&one) {
                relations.push(one);
            }
        }
        Some(relations)
    };
    (0..).map_while(relations).collect()
}

/// Returns the recorded nominal replays of a verdict, and whether they reach the goal.
pub fn replays(verdict: &Verdict) -> impl Iterator<Item = (Layer, &Trajectory, bool)> {
    Engine::ALL.into_iter().filter_map(|engine| {
        let evidence = verdict.nominal(engine)?;
        Some((layer(engine), evidence.trajectory.as_ref()?, evidence.outcome.reached))
    })
}

/// Returns the final positions of the goal's object in the perturbed replays.
pub fn ends(task: &Task, verdict: &Verdict) -> Vec<End> {
    let end = |evidence: &Evidence| {
        let pose = evidence.outcome.state.poses.get(task.goals[0].object)?;
        pose.is_finite().then(|| End {
            layer: layer(evidence.engine),
            at: point(pose.position),
            reached: evidence.outcome.reached,
        })
    };
    let all = Engine::ALL.into_iter().flat_map(|engine| verdict.perturbed(engine));
    all.filter_map(end).collect()
}

/// Returns the layer in which a trajectory is shown.
pub fn layer_of(trajectory: &Trajectory) -> Layer {
    match &trajectory.by {
        by if *by == ModelKind::PLANAR.into() => Layer::Planar,
        by if *by == ModelKind::SPATIAL.into() => Layer::Spatial,
        _ => Layer::Predicted,
    }
}

fn layer(engine: Engine) -> Layer {
    match engine {
        Engine::Planar => Layer::Planar,
        Engine::Spatial | Engine::Upright => Layer::Spatial,
    }
}

/// Encodes values as the first value and differences; a constant sequence keeps one value.
pub fn packed(values: impl Iterator<Item = i64>) -> Vec<i64> {
    let mut packed = differences(values);
    if packed.iter().skip(1).all(|step| *step == 0) {
        packed.truncate(1);
    }
    packed
}

/// Encodes values as the first value and differences.
pub fn differences(values: impl Iterator<Item = i64>) -> Vec<i64> {
    let mut before = 0;
    let step = |value: i64| value.wrapping_sub(std::mem::replace(&mut before, value));
    values.map(step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_is_its_first_value_and_differences() {
        assert_eq!(packed([5, 7, 7, 4].into_iter()), [5, 2, 0, -3]);
        assert_eq!(packed([5, 5, 5].into_iter()), [5]);
        assert_eq!(differences([0, 0, 1].into_iter()), [0, 0, 1]);
    }
}
