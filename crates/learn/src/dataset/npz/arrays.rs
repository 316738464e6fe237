//! Conversion of episodes to arrays.

use pushplan::internals::geometry::{MAX_CORNERS, Pose, Shape, Vector};
use pushplan::internals::{outcome::Frame, scene::Object, task::Stroke};

use crate::dataset::Episode;

use super::archive::{Array, Numbers};

/// Returns the arrays of episodes with at most `most` objects; see `format.md`.
pub(super) fn arrays(episodes: &[Episode], most: usize) -> Vec<Array> {
    let (count, objects) = (episodes.len(), |episode: &Episode| episode.scene.objects.len());
    let strokes = || episodes.iter().flat_map(|episode| &episode.motion.strokes);
    let frames = || episodes.iter().flat_map(|episode| &episode.frames);
    let (all_strokes, all_frames) = (strokes().count(), frames().count());
    let per_episode =
        |value: &dyn Fn(&Episode) -> f64| Numbers::Floats(episodes.iter().map(value).collect());
    // Rows of `width` numbers per object, padded with NaN.
    let per_object = |width: usize, value: &dyn Fn(&Object) -> Vec<f64>| {
        let mut numbers = Vec::with_capacity(count * most * width);
        for episode in episodes {
            numbers.extend(episode.scene.objects.iter().flat_map(value));
            numbers.extend(vec![f64::NAN; (most - objects(episode)) * width]);
        }
        Numbers::Floats(numbers)
    };
    let per_frame = |value: &dyn Fn(&Frame, usize) -> [f64; 3]| {
        let mut numbers = Vec::with_capacity(all_frames * most * 3);
        for frame in frames() {
            let here = frame.state.poses.len();
            numbers.extend((0..here).flat_map(|object| value(frame, object)));
            numbers.extend(vec![f64::NAN; (most - here) * 3]);
        }
        Numbers::Floats(numbers)
    };
    let kinds = episodes.iter().flat_map(|episode| {
        let kinds = episode.scene.objects.iter().map(|object| kind(&object.shape));
        kinds.chain(std::iter::repeat_n(0, most - objects(episode)))
    });
    let flat = |stroke: &Stroke| [numbers(&stroke.from), numbers(&stroke.to)].concat();
    let texts = |value: &dyn Fn(&Episode) -> serde_json::Value| {
        Numbers::Texts(episodes.iter().map(|episode| value(episode).to_string()).collect())
    };
    let array = |name, shape: &[usize], numbers| Array { name, shape: shape.to_vec(), numbers };
    let integers = |numbers: Vec<i64>| Numbers::Integers(numbers);
    vec![
        array("episode", &[count], integers(episodes.iter().map(|e| e.index as i64).collect())),
        array("objects", &[count], integers(episodes.iter().map(|e| objects(e) as i64).collect())),
        array("kind", &[count, most], integers(kinds.collect())),
        array("size", &[count, most, 3], per_object(3, &|object| size(&object.shape).to_vec())),
        array(
            "corners",
            &[count, most, MAX_CORNERS, 2],
            per_object(2 * MAX_CORNERS, &|object| corners(&object.shape)),
        ),
        array("mass", &[count, most], per_object(1, &|object| vec![object.mass])),
        array("friction", &[count, most], per_object(1, &|object| vec![object.friction])),
        array("table_friction", &[count], per_episode(&|e| e.scene.table_friction)),
        array("scene", &[count], texts(&|e| e.scene.to_json())),
        array("tool", &[count], texts(&|e| e.motion.tool.to_json())),
        array("tool_friction", &[count], per_episode(&|e| e.motion.tool.friction)),
        array("lift", &[count], per_episode(&|e| e.motion.lift)),
        array("stroke_start", &[count + 1], starts(episodes, |e| e.motion.strokes.len())),
        array("stroke", &[all_strokes, 6], Numbers::Floats(strokes().flat_map(flat).collect())),
        array(
            "stroke_time",
            &[all_strokes],
            Numbers::Floats(strokes().map(|stroke| stroke.duration).collect()),
        ),
        array("settles", &[all_strokes], Numbers::Flags(strokes().map(|s| s.settle).collect())),
        array("frame_start", &[count + 1], starts(episodes, |e| e.frames.len())),
        array("time", &[all_frames], Numbers::Floats(frames().map(|frame| frame.time).collect())),
        array(
            "frame_stroke",
            &[all_frames],
            integers(frames().map(|frame| frame.stroke as i64).collect()),
        ),
        array(
            "tool_pose",
            &[all_frames, 3],
            Numbers::Floats(frames().flat_map(|frame| numbers(&frame.tool)).collect()),
        ),
        array(
            "pose",
            &[all_frames, most, 3],
            per_frame(&|frame, object| numbers(&frame.state.poses[object])),
        ),
        array(
            "velocity",
            &[all_frames, most, 3],
            per_frame(&|frame, object| {
                let velocity = frame.state.velocities[object];
                [velocity.linear.x, velocity.linear.y, velocity.angular]
            }),
        ),
        array("change", &[all_frames, most, 3], changes(episodes, most)),
    ]
}

/// Returns the first row of each episode, followed by the total number of rows.
fn starts(episodes: &[Episode], rows: impl Fn(&Episode) -> usize) -> Numbers {
    let mut found = vec![0];
    for episode in episodes {
        found.push(found[found.len() - 1] + rows(episode) as i64);
    }
    Numbers::Integers(found)
}

/// Returns the changes of all poses since the previous frame.
fn changes(episodes: &[Episode], most: usize) -> Numbers {
    let mut found = Vec::new();
    for episode in episodes {
        for (index, frame) in episode.frames.iter().enumerate() {
            let before = &episode.frames[index.saturating_sub(1)].state.poses;
            for (now, before) in frame.state.poses.iter().zip(before) {
                let (now, before) = (numbers(now), numbers(before));
                found.extend([0, 1, 2].map(|axis| now[axis] - before[axis]));
            }
            found.extend(vec![f64::NAN; (most - frame.state.poses.len()) * 3]);
        }
    }
    Numbers::Floats(found)
}

fn numbers(pose: &Pose) -> [f64; 3] {
    [pose.position.x, pose.position.y, pose.heading]
}

fn kind(shape: &Shape) -> i64 {
    match shape {
        Shape::Cylinder { .. } => 1,
        Shape::Cuboid { .. } => 2,
        Shape::Prism { .. } => 3,
    }
}

fn size(shape: &Shape) -> [f64; 3] {
    match *shape {
        Shape::Cylinder { radius, height } => [2.0 * radius, 2.0 * radius, height],
        Shape::Cuboid { size } => size,
        Shape::Prism { base, height } => {
            let along = |axis: Vector| base.extent(axis) + base.extent(-axis);
            [along(Vector::x()), along(Vector::y()), height]
        }
    }
}

fn corners(shape: &Shape) -> Vec<f64> {
    let mut found = match shape {
        Shape::Prism { base, .. } => base.corners().iter().flat_map(|c| [c.x, c.y]).collect(),
        _ => Vec::new(),
    };
    found.resize(2 * MAX_CORNERS, f64::NAN);
    found
}
