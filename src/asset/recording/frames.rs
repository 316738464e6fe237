//! Frames of a recording: parsing of their times and poses, and the rules they must keep.

use crate::asset::node::Node;
use crate::asset::strict::Ledger;
use crate::asset::take::{name_of, vector};
use crate::geometry::Pose;
use crate::recording::{Body, Gap, Jump, Moving, RecordedFrame, Recording, Strange, gaps, jumps};

/// Returns the time of every frame, starting at 0 s; `None` if the times are unknown.
pub(super) fn times(root: &Node, ledger: &mut Ledger) -> Option<Vec<f64>> {
    let frames = root.get("frames")?;
    let count = frames.items().len();
    match (root.get("frame_time"), root.get("times")) {
        (Some(_), Some(times)) => {
            let advice = "keep one of the two; use `times` if frames are not evenly spaced";
            ledger.fault(times, "both `frame_time` and `times` are given", advice);
            None
        }
        (None, None) => {
            let message = "neither `frame_time` nor `times` is given";
            ledger.fault(root, message, "add `frame_time`, the time between frames in seconds");
            None
        }
        (Some(step), None) => {
            let step = step.number()?;
            Some((0..count).map(|k| k as f64 * step).collect())
        }
        (None, Some(times)) => listed(times, count, ledger),
    }
}

fn listed(times: &Node, count: usize, ledger: &mut Ledger) -> Option<Vec<f64>> {
    let found = times.items().len();
    if found != count && found > 0 {
        let message = format!("{found} times for {count} frames");
        ledger.fault(times, message, "give one time for each frame");
        return None;
    }
    let values: Vec<f64> = times.items().iter().map(Node::number).collect::<Option<_>>()?;
    let mut sound = true;
    for (k, pair) in values.windows(2).enumerate() {
        if pair[1] <= pair[0] {
            let message = format!(
                "frame {} is at {} s, which is not after frame {k} at {} s",
                k + 1,
                pair[1],
                pair[0]
            );
            ledger.fault(&times.items()[k + 1], message, "times must increase from frame to frame");
            sound = false;
        }
    }
    sound.then(|| values.iter().map(|time| time - values[0]).collect())
}

/// Returns the frames, and whether the heading of each object is known; `None` if a frame is
/// faulty.
pub(super) fn frames(
    root: &Node,
    objects: &[Node],
    times: Option<&[f64]>,
    ledger: &mut Ledger,
) -> Option<(Vec<RecordedFrame>, Vec<bool>)> {
    let nodes = root.get("frames")?.items();
    let (first, last) = (nodes.first()?, nodes.last()?);
    for (frame, which) in [(first, "first"), (last, "last")] {
        if frame.get("objects").is_none() {
            let message = format!("the {which} frame does not state the poses of the objects");
            ledger.fault(
                frame,
                message,
                "add `objects`; only frames between the first and the last may omit it",
            );
            return None;
        }
    }
    let sizes = |frame: &Node| -> Option<Vec<usize>> {
        let poses = frame.get("objects")?.items();
        Some(frame.get("pusher").into_iter().chain(poses).map(|pose| pose.items().len()).collect())
    };
    let usual = sizes(first).unwrap_or_default();
    let mut frames: Vec<Option<RecordedFrame>> = Vec::new();
    for (k, node) in nodes.iter().enumerate() {
        frames.push(frame(k, node, objects, &usual, ledger));
    }
    let start: Vec<f64> = objects
        .iter()
        .map(|object| object.get("yaw_deg").and_then(Node::number).unwrap_or(0.0).to_radians())
        .collect();
    let headings: Vec<bool> = usual.iter().skip(1).map(|size| *size == 3).collect();
    if !headings.is_empty() {
        for frame in frames.iter_mut().flatten() {
            for (pose, (known, start)) in frame.poses.iter_mut().zip(headings.iter().zip(&start)) {
                pose.heading = if *known { pose.heading } else { *start };
            }
        }
    }
    let names: Vec<&str> = objects.iter().map(|object| name_of(object).unwrap_or("?")).collect();
    steps(&mut frames, nodes, &names, ledger);
    let mut frames: Vec<RecordedFrame> = frames.into_iter().collect::<Option<_>>()?;
    let times = times?;
    for (frame, time) in frames.iter_mut().zip(times) {
        frame.time = *time;
    }
    missing(&frames, nodes, ledger);
    Some((frames, headings))
}

/// Reads a single frame; its time and unknown headings are filled in later.
fn frame(
    index: usize,
    node: &Node,
    objects: &[Node],
    usual: &[usize],
    ledger: &mut Ledger,
) -> Option<RecordedFrame> {
    let pusher = node.get("pusher")?;
    let Some(list) = node.get("objects") else { return unseen(index, pusher, node, usual, ledger) };
    let (found, expected) = (list.items().len(), objects.len());
    if found != expected && found > 0 {
        let message = format!("frame {index}: expected {expected} poses, found {found}");
        ledger.fault(list, message, "write one pose per object, in the order of the scene");
        return None;
    }
    let mut sound = true;
    for (pose, usual) in std::iter::once(pusher).chain(list.items()).zip(usual) {
        if pose.items().len() != *usual && pose.items().len() >= 2 && *usual >= 2 {
            let (has, had) = if *usual == 2 { ("a", "none") } else { ("no", "one") };
            ledger.fault(
                pose,
                format!("frame {index} has {has} heading, but frame 0 has {had}"),
                "state a body's heading in all frames or in none",
            );
            sound = false;
        }
    }
    let poses = list.items().iter().map(pose).collect::<Option<_>>()?;
    let (tool, lifted) = (pose(pusher)?, lifted(index, node));
    sound.then_some(RecordedFrame { time: 0.0, tool, lifted, seen: true, poses })
}

/// Reads a frame without objects; their poses are filled in later.
fn unseen(
    index: usize,
    pusher: &Node,
    node: &Node,
    usual: &[usize],
    ledger: &mut Ledger,
) -> Option<RecordedFrame> {
    if usual.first().is_some_and(|usual| *usual != pusher.items().len()) {
        let message =
            format!("the pusher of frame {index} has a different number of values than in frame 0");
        ledger.fault(pusher, message, "state a body's heading in all frames or in none");
        return None;
    }
    let (tool, lifted) = (pose(pusher)?, lifted(index, node));
    Some(RecordedFrame { time: 0.0, tool, lifted, seen: false, poses: Vec::new() })
}

fn pose(node: &Node) -> Option<Pose> {
    let heading = match node.items().get(2) {
        Some(yaw) => yaw.number()?.to_radians(),
        None => 0.0,
    };
    Some(Pose { position: vector(node)?, heading })
}

fn lifted(index: usize, node: &Node) -> bool {
    index > 0 && node.get("lifted").and_then(Node::switch).unwrap_or(false)
}

/// Reports jumps, and unwraps headings so that they count full turns.
fn steps(
    frames: &mut [Option<RecordedFrame>],
    nodes: &[Node],
    names: &[&str],
    ledger: &mut Ledger,
) {
    for k in 1..frames.len() {
        let (before, now) = frames.split_at_mut(k);
        let (Some(before), Some(now)) = (&before[k - 1], &mut now[0]) else { continue };
        if !now.seen {
            now.poses.clone_from(&before.poses);
        }
        now.unwrap_after(before);
        for Jump { body, what } in jumps(before, now) {
            let (name, place, advice) = match body {
                Body::Pusher => (
                    "the pusher".to_owned(),
                    nodes[k].get("pusher"),
                    "if the pusher was lifted and set down again, write `\"lifted\": true`; \
                     otherwise frames are missing",
                ),
                Body::Object(index) => (
                    format!("`{}`", names[index]),
                    nodes[k].get("objects").and_then(|list| list.items().get(index)),
                    "frames are missing here, or the tracker has swapped bodies",
                ),
            };
            let what = match what {
                Strange::Moves(travel) => format!("moves {:.0} cm", travel * 100.0),
                Strange::Turns(turn) => format!("rotates by {:.0} degrees", turn.to_degrees()),
            };
            let message = format!("{name} {what} between frames {} and {k}", k - 1);
            ledger.fault(place.unwrap_or(&nodes[k]), message, advice);
        }
    }
}

/// Reports time steps that are much longer than the others while an object moves.
fn missing(frames: &[RecordedFrame], nodes: &[Node], ledger: &mut Ledger) {
    for Gap { frame, step, usual } in gaps(frames) {
        let message = format!(
            "frames are missing between frames {} and {frame}: {step:.3} s instead of {usual:.3} s",
            frame - 1
        );
        let advice = "record without gaps, or cut the recording here into two files";
        ledger.fault(&nodes[frame], message, advice);
    }
}

/// Reports objects that the pusher penetrates where it is set down.
pub(super) fn set_down(root: &Node, recording: &Recording, ledger: &mut Ledger) {
    let Some(nodes) = root.get("frames").map(Node::items) else { return };
    for (frame, object) in recording.set_down_inside() {
        let name = &recording.scene.objects[object].name;
        ledger.fault(
            nodes[frame].get("pusher").unwrap_or(&nodes[frame]),
            format!("in frame {frame} the pusher overlaps `{name}`"),
            "check the size of the pusher and the origin of its positions, which must be its \
             centre",
        );
    }
}

/// Reports objects that already move in the first frame.
pub(super) fn starts(root: &Node, recording: &Recording, ledger: &mut Ledger) {
    let Some(nodes) = root.get("frames").map(Node::items) else { return };
    for Moving { object, frame, travel, turn } in recording.moving_at_the_start() {
        let name = &recording.scene.objects[object].name;
        let poses = nodes[frame].get("objects");
        let message = format!(
            "the recording starts in motion: `{name}` moves by {:.1} mm and rotates by {:.1} \
             degrees in the first {:.2} s although nothing touches it",
            1e3 * travel,
            turn.to_degrees(),
            recording.frames[frame].time
        );
        let advice = "begin with a frame in which all objects rest, or state `velocity` and \
                      `spin_deg` of the moving objects";
        let place = poses.and_then(|list| list.items().get(object)).unwrap_or(&nodes[frame]);
        ledger.fault(place, message, advice);
    }
}
