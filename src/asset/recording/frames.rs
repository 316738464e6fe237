//! The frames of a recording: their times and poses, and what no real table does between them.

use crate::asset::node::Node;
use crate::asset::strict::Ledger;
use crate::asset::take::{name_of, vector};
use crate::geometry::{Pose, clearance, wrap_angle};

use super::load::{NOISE, RecordedFrame, Recording};

/// A body that moves farther than this between two frames was lost by the tracker, metres.
const JUMP: f64 = 0.10;

/// The same for turns: a right angle, as when a tracker mixes up the sides of a square.
const TURN: f64 = 0.45 * std::f64::consts::PI;

/// Frames are missing where a time step is this many times the usual one and something moved
/// farther than [`MOVED`] metres meanwhile.
const GAP: f64 = 2.5;
const MOVED: f64 = 0.002;

/// The time of every frame, the first at 0 s; `None` if they are not known.
pub(super) fn times(root: &Node, ledger: &mut Ledger) -> Option<Vec<f64>> {
    let frames = root.get("frames")?;
    let count = frames.items().len();
    match (root.get("frame_time"), root.get("times")) {
        (Some(_), Some(times)) => {
            let advice = "keep one of the two: `times` where frames are not evenly spaced";
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
                "frame {} is at {} s, not after frame {k} at {} s",
                k + 1,
                pair[1],
                pair[0]
            );
            ledger.fault(&times.items()[k + 1], message, "times increase from frame to frame");
            sound = false;
        }
    }
    sound.then(|| values.iter().map(|time| time - values[0]).collect())
}

/// The frames, and whether the heading of each object is known; `None` if any is faulty.
pub(super) fn frames(
    root: &Node,
    objects: &[Node],
    times: Option<&[f64]>,
    ledger: &mut Ledger,
) -> Option<(Vec<RecordedFrame>, Vec<bool>)> {
    let nodes = root.get("frames")?.items();
    let first = nodes.first()?;
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

/// One frame by itself; its time and unknown headings are filled in later.
fn frame(
    index: usize,
    node: &Node,
    objects: &[Node],
    usual: &[usize],
    ledger: &mut Ledger,
) -> Option<RecordedFrame> {
    let (pusher, list) = (node.get("pusher")?, node.get("objects")?);
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
                format!("frame {index} has {has} heading where frame 0 has {had}"),
                "give a body's heading in all frames or in none",
            );
            sound = false;
        }
    }
    let pose = |node: &Node| -> Option<Pose> {
        let heading = match node.items().get(2) {
            Some(yaw) => yaw.number()?.to_radians(),
            None => 0.0,
        };
        Some(Pose { position: vector(node)?, heading })
    };
    let poses = list.items().iter().map(pose).collect::<Option<_>>()?;
    let lifted = index > 0 && node.get("lifted").and_then(Node::switch).unwrap_or(false);
    sound.then_some(RecordedFrame { time: 0.0, tool: pose(pusher)?, lifted, poses })
}

/// Notes jumps, and makes headings count their turns on the way.
fn steps(
    frames: &mut [Option<RecordedFrame>],
    nodes: &[Node],
    names: &[&str],
    ledger: &mut Ledger,
) {
    for k in 1..frames.len() {
        let (before, now) = frames.split_at_mut(k);
        let (Some(before), Some(now)) = (&before[k - 1], &mut now[0]) else { continue };
        let node = &nodes[k];
        if now.lifted {
            now.tool.heading = unwrapped(now.tool.heading, before.tool.heading);
        } else if let Some(jump) = jump(&before.tool, &mut now.tool) {
            ledger.fault(
                node.get("pusher").unwrap_or(node),
                format!("the pusher {jump} between frames {} and {k}", k - 1),
                "where it was lifted and set down again, write `\"lifted\": true`; else frames \
                 are missing",
            );
        }
        let poses = before.poses.iter().zip(&mut now.poses).zip(names);
        for (index, ((before, now), name)) in poses.enumerate() {
            if let Some(jump) = jump(before, now) {
                let place = node.get("objects").and_then(|list| list.items().get(index));
                ledger.fault(
                    place.unwrap_or(node),
                    format!("`{name}` {jump} between frames {} and {k}", k - 1),
                    "frames are missing here, or the tracker has mixed up bodies",
                );
            }
        }
    }
}

/// What a body does that cannot be, in words.
fn jump(before: &Pose, now: &mut Pose) -> Option<String> {
    now.heading = unwrapped(now.heading, before.heading);
    let travel = (now.position - before.position).norm();
    let turn = (now.heading - before.heading).abs();
    if travel > JUMP {
        Some(format!("moves {:.0} cm", travel * 100.0))
    } else if turn > TURN {
        Some(format!("turns by {:.0} degrees", turn.to_degrees()))
    } else {
        None
    }
}

/// `heading` plus whole turns, nearest to `before`.
fn unwrapped(heading: f64, before: f64) -> f64 {
    before + wrap_angle(heading - before)
}

/// Notes time steps that are much longer than the others although something moves.
fn missing(frames: &[RecordedFrame], nodes: &[Node], ledger: &mut Ledger) {
    let mut steps: Vec<f64> = frames.windows(2).map(|pair| pair[1].time - pair[0].time).collect();
    steps.sort_by(f64::total_cmp);
    let Some(usual) = steps.get(steps.len() / 2).copied() else { return };
    for (k, pair) in frames.windows(2).enumerate().filter(|(_, pair)| !pair[1].lifted) {
        let step = pair[1].time - pair[0].time;
        let bodies = pair[0].poses.iter().zip(&pair[1].poses);
        let moved = bodies
            .chain([(&pair[0].tool, &pair[1].tool)])
            .any(|(before, now)| (now.position - before.position).norm() > MOVED);
        if step > GAP * usual && moved {
            let message = format!(
                "frames are missing between frames {k} and {}: {step:.3} s instead of {usual:.3} s",
                k + 1
            );
            let advice = "record without gaps, or cut the recording here into two files";
            ledger.fault(&nodes[k + 1], message, advice);
        }
    }
}

/// Notes objects that the pusher stands on where it is set down.
pub(super) fn set_down(root: &Node, recording: &Recording, ledger: &mut Ledger) {
    let Some(nodes) = root.get("frames").map(Node::items) else { return };
    for (k, frame) in recording.frames.iter().enumerate().filter(|(k, f)| *k == 0 || f.lifted) {
        for (object, pose) in recording.scene.objects.iter().zip(&frame.poses) {
            let solid = object.shape.footprint().shrunk(NOISE);
            let parts = recording.tool.parts.iter().enumerate();
            let on = recording.lift < object.shape.height()
                && parts.into_iter().any(|(index, part)| {
                    let at = recording.tool.part_pose(index, &frame.tool);
                    clearance((&part.footprint(), &at), (&solid, pose), NOISE) <= 0.0
                });
            if on {
                ledger.fault(
                    nodes[k].get("pusher").unwrap_or(&nodes[k]),
                    format!("in frame {k} the pusher stands inside `{}`", object.name),
                    "check its size and the origin of its positions: they are those of centres",
                );
            }
        }
    }
}
